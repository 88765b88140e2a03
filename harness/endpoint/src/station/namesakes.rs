//! Who goes by which station id.
//!
//! A ticket says nothing of station ids, so the holder of one could speak in the name of another robot.
//! But a robot changes its id only together with its ticket. So an id belongs to the ticket under
//! which it was heard first, until it has been silent for a while.

use std::collections::HashMap;

use crossguard_codec::geonet::Signer;
use crossguard_protocol::StationId;

/// How long an id belongs to a ticket that is silent; longer than any lease.
const SILENCE_MS: u64 = 10_000;
/// How many ids are remembered.
pub const NAMES_MAX: usize = 256;

/// The tickets by station id.
#[derive(Clone, Debug, Default)]
pub(super) struct Namesakes(HashMap<StationId, (Signer, u64)>);

impl Namesakes {
    /// Whether `signer` may go by this id at `now_ms`; if so, it is remembered. Of too many, the one
    /// that was silent for longest is forgotten.
    pub(super) fn admit(&mut self, station: StationId, signer: Signer, now_ms: u64) -> bool {
        if let Some((owner, heard_ms)) = self.0.get_mut(&station) {
            if *owner != signer && now_ms.saturating_sub(*heard_ms) < SILENCE_MS {
                return false;
            }
            (*owner, *heard_ms) = (signer, now_ms);
            return true;
        }
        if self.0.len() == NAMES_MAX {
            let oldest = self.0.iter().min_by_key(|(_, (_, heard_ms))| *heard_ms);
            if let Some(station) = oldest.map(|(station, _)| *station) {
                self.0.remove(&station);
            }
        }
        self.0.insert(station, (signer, now_ms));
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Signer = Signer([1; 8]);
    const B: Signer = Signer([2; 8]);

    #[test]
    fn an_id_belongs_to_one_ticket_until_it_is_silent() {
        let mut names = Namesakes::default();
        assert!(names.admit(StationId(1), A, 0));
        assert!(!names.admit(StationId(1), B, 1));
        assert!(names.admit(StationId(2), B, 1));
        assert!(names.admit(StationId(1), A, 9_000));
        assert!(!names.admit(StationId(1), B, 18_999));
        assert!(names.admit(StationId(1), B, 19_000));
        assert!(!names.admit(StationId(1), A, 19_001));
    }

    #[test]
    fn of_too_many_the_most_silent_is_forgotten() {
        let mut names = Namesakes::default();
        for id in 0..=u32::try_from(NAMES_MAX).unwrap() {
            assert!(names.admit(StationId(id), A, u64::from(id)));
        }
        assert_eq!(names.0.len(), NAMES_MAX);
        assert!(names.admit(StationId(0), B, 300), "it was forgotten");
        assert!(!names.admit(StationId(200), B, 300));
    }
}
