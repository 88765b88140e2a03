//! Stage 2, Help establishment: which of two requesters or leaders at one place goes before.

use core::cmp::Reverse;

use crate::id::StationId;
use crate::output::Ignored;
use crate::task::{HelpRequest, Place, Urgency};

/// The claim of a request or a leader: a place, with this urgency.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Claim {
    pub(crate) urgency: Urgency,
    pub(crate) place: Place,
}

impl Claim {
    pub(crate) const fn of(request: HelpRequest) -> Self {
        Self {
            urgency: request.urgency,
            place: request.place,
        }
    }

    /// Succeeds if this claim of `station` goes before the one of `other_station` at the same place.
    pub(crate) fn goes_before(
        self,
        station: StationId,
        other: Self,
        other_station: StationId,
    ) -> Result<(), Ignored> {
        if !self.place.may_be(other.place) {
            return Err(Ignored::OtherPlace);
        }
        // R6: one of two goes before.
        if (Reverse(self.urgency), station) > (Reverse(other.urgency), other_station) {
            return Err(Ignored::LowerPrecedence);
        }
        Ok(())
    }
}
