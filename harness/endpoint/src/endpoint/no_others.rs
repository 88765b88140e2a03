//! Without the feature `foreign`, nothing is said to other stations than robots, and what they say is dropped.

use crossguard_codec::geonet::Indication;
use crossguard_protocol::{Robot, StateMachine};

use super::turn::Turn;
use crate::cause::Cause;
use crate::exchange::{Exchange, Host as _};
use crate::ras::surroundings::Awareness;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Others {}

#[expect(clippy::unused_self, reason = "its counterpart has a state")]
impl Others {
    pub(super) const fn new(_: &Awareness) -> Self {
        Self {}
    }

    pub(super) const fn are_told(self) -> bool {
        false
    }

    pub(super) const fn tell_of_people<P: StateMachine>(
        self,
        _: &mut Exchange<P>,
        _: &mut Turn<'_>,
    ) {
    }

    pub(super) const fn tell_of_robot<P: StateMachine>(
        self,
        _: &mut Exchange<P>,
        _: &mut Turn<'_>,
        _: u64,
    ) {
    }
}

/// Drops what another station tells.
pub(super) fn hear(
    turn: &mut Turn<'_>,
    _: &Robot,
    indication: &Indication<'_>,
    packet: &[u8],
    _: u64,
) {
    let cause = Cause::NoUse(indication.service);
    turn.dropped(cause, &cause, packet);
}
