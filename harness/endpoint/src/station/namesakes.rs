//! Who goes by which station id.
//!
//! The id of a robot follows from its ticket, so nobody else can go by it. The tickets of other stations say nothing
//! of ids: there, an id belongs to the ticket under which it was heard first, until that has been silent for a while,
//! and a ticket has one id at a time. Nobody who is heard is forgotten to make room for somebody new.

use std::collections::HashMap;

use crossguard_codec::geonet::Signer;
use crossguard_protocol::StationId;

use crate::cause::Cause;

/// How long an id belongs to a ticket that is silent; longer than any lease.
const SILENCE_MS: u64 = 10_000;
/// How many ids are remembered.
pub const NAMES_MAX: usize = 256;

/// Why a ticket may not go by a station id.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotAdmitted {
    /// The id is that of another ticket.
    #[error("station {0} goes by another certificate")]
    OtherTicket(StationId),
    /// The ticket goes by another id.
    #[error("the certificate of station {0} goes by station {1} as well")]
    SecondId(StationId, StationId),
    /// As many are heard as can be told apart.
    #[error("{NAMES_MAX} stations are heard, and station {0} is one more")]
    TooMany(StationId),
}

impl From<NotAdmitted> for Cause {
    fn from(why: NotAdmitted) -> Self {
        Self::Rejected(match why {
            NotAdmitted::OtherTicket(_) => "station id of another certificate",
            NotAdmitted::SecondId(..) => "second station id of a certificate",
            NotAdmitted::TooMany(_) => "too many stations",
        })
    }
}

/// The tickets by station id.
#[derive(Clone, Debug, Default)]
pub(super) struct Namesakes(HashMap<StationId, (Signer, u64)>);

impl Namesakes {
    /// A robot was heard at `now_ms`, whose id follows from its ticket: the id is its own, whoever had it before.
    pub(super) fn bind(&mut self, station: StationId, signer: Signer, now_ms: u64) {
        if self.0.len() == NAMES_MAX && !self.0.contains_key(&station) {
            let oldest = self.0.iter().min_by_key(|(_, (_, heard_ms))| *heard_ms);
            if let Some(station) = oldest.map(|(station, _)| *station) {
                self.0.remove(&station);
            }
        }
        self.0.insert(station, (signer, now_ms));
    }

    /// Whether `signer` may go by this id at `now_ms`, which does not follow from its ticket; if so, that is
    /// remembered.
    ///
    /// # Errors
    /// Why not.
    pub(super) fn admit(
        &mut self,
        station: StationId,
        signer: Signer,
        now_ms: u64,
    ) -> Result<(), NotAdmitted> {
        let is_heard = |heard_ms: u64| now_ms.saturating_sub(heard_ms) < SILENCE_MS;
        if let Some((owner, heard_ms)) = self.0.get_mut(&station)
            && (*owner == signer || is_heard(*heard_ms))
        {
            if *owner != signer {
                return Err(NotAdmitted::OtherTicket(station));
            }
            *heard_ms = now_ms;
            return Ok(());
        }
        self.0.retain(|_, (_, heard_ms)| is_heard(*heard_ms));
        if let Some((first, _)) = self.0.iter().find(|(_, (owner, _))| *owner == signer) {
            return Err(NotAdmitted::SecondId(*first, station));
        }
        if self.0.len() == NAMES_MAX {
            return Err(NotAdmitted::TooMany(station));
        }
        self.0.insert(station, (signer, now_ms));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Signer = Signer([1; 8]);
    const B: Signer = Signer([2; 8]);
    const OTHER: Result<(), NotAdmitted> = Err(NotAdmitted::OtherTicket(StationId(1)));

    /// A ticket for each number.
    fn ticket(number: usize) -> Signer {
        Signer(u64::try_from(number + 1_000).unwrap().to_be_bytes())
    }

    #[test]
    fn an_id_belongs_to_one_ticket_until_it_is_silent() {
        let mut names = Namesakes::default();
        let mut admit = |id, signer, now_ms| names.admit(StationId(id), signer, now_ms);
        assert_eq!(admit(1, A, 0), Ok(()));
        assert_eq!(admit(1, B, 1), OTHER);
        assert_eq!(admit(1, A, 9_000), Ok(()));
        assert_eq!(admit(1, B, 18_999), OTHER);
        assert_eq!(admit(1, B, 19_000), Ok(()));
        assert_eq!(admit(1, A, 19_001), OTHER);
    }

    #[test]
    fn a_ticket_has_one_id_at_a_time() {
        let mut names = Namesakes::default();
        let mut admit = |id, now_ms| names.admit(StationId(id), A, now_ms);
        assert_eq!(admit(1, 0), Ok(()));
        let second = Err(NotAdmitted::SecondId(StationId(1), StationId(2)));
        assert_eq!(admit(2, 9_999), second);
        assert_eq!(admit(2, 10_000), Ok(()));
    }

    #[test]
    fn nobody_who_is_heard_is_forgotten_for_somebody_new() {
        let mut names = Namesakes::default();
        let id = |number: usize| StationId(u32::try_from(number).unwrap());
        for number in 0..NAMES_MAX {
            assert_eq!(names.admit(id(number), ticket(number), 0), Ok(()));
        }
        let one_more = names.admit(id(300), ticket(300), 9_999);
        assert_eq!(one_more, Err(NotAdmitted::TooMany(id(300))));
        assert_eq!(names.admit(id(5), ticket(5), 9_999), Ok(()));
        // The others have been silent for long enough by now.
        assert_eq!(names.admit(id(300), ticket(300), 10_000), Ok(()));
        assert_eq!(names.0.len(), 2);
    }

    #[test]
    fn a_robots_id_is_its_own_whoever_squats_on_it() {
        let mut names = Namesakes::default();
        assert_eq!(names.admit(StationId(1), A, 0), Ok(()));
        names.bind(StationId(1), B, 1);
        assert_eq!(names.admit(StationId(1), A, 2), OTHER);
        assert_eq!(names.admit(StationId(1), B, 3), Ok(()));
        for number in 0..2 * NAMES_MAX {
            names.bind(StationId(u32::try_from(number).unwrap()), ticket(number), 4);
        }
        assert_eq!(names.0.len(), NAMES_MAX);
    }
}
