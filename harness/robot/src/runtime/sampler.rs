//! How many drops of one cause are recorded one by one: a flood must not fill the disk.
//!
//! Datagrams come from anybody, and lines from sensors, bodies and operators that may have a mistake in them. Whatever is
//! dropped of them would be in the log, datagrams with their octets. Of each cause so many are recorded in a second; the
//! others are counted, and the counts are recorded.

use std::collections::BTreeMap;

use crossguard_endpoint::cause::{Cause, Layer};
use crossguard_endpoint::counters::{CauseName, Counts};

/// How many drops of one cause are recorded in a second.
pub(super) const RECORDED: u32 = 32;

/// A second, in µs.
const SECOND_US: u64 = 1_000_000;

/// Drops in the present second.
#[derive(Debug, Default)]
pub(super) struct Sampler {
    began_us: u64,
    recorded: BTreeMap<CauseName, u32>,
    unrecorded: Counts,
}

impl Sampler {
    /// Whether a drop is recorded; it is counted if not.
    pub(super) fn admits(&mut self, cause: &CauseName) -> bool {
        if !is_of_others(cause) {
            return true;
        }
        let recorded = self.recorded.entry(cause.clone()).or_default();
        if *recorded < RECORDED {
            *recorded += 1;
            return true;
        }
        self.count(cause, 1);
        false
    }

    /// Counts drops that have no records of their own.
    pub(super) fn count(&mut self, cause: &CauseName, count: u64) {
        if count > 0 {
            self.unrecorded.add(cause, count);
        }
    }

    /// The counts of a second that is over at `now_us`, if anything was not recorded in it.
    pub(super) fn elapse(&mut self, now_us: u64) -> Option<Counts> {
        if now_us.saturating_sub(self.began_us) < SECOND_US {
            return None;
        }
        self.began_us = now_us;
        self.recorded.clear();
        self.finish()
    }

    /// Drops that remain to be recorded.
    pub(super) fn finish(&mut self) -> Option<Counts> {
        let unrecorded = std::mem::take(&mut self.unrecorded);
        (!unrecorded.is_empty()).then_some(unrecorded)
    }
}

/// Whether others bring it about: what the robot drops of its own is rare, and of use one by one.
fn is_of_others(cause: &CauseName) -> bool {
    match cause.layer {
        Layer::Simulated | Layer::Storage | Layer::Log | Layer::Output => false,
        Layer::Link => {
            let own = [Cause::NotSent, Cause::LinkFailed];
            !own.into_iter().any(|own| *cause == own.into())
        }
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_is_counted_and_other_causes_are_recorded() {
        let mut sampler = Sampler::default();
        let flooded = [
            Cause::Undecodable("truncated"),
            Cause::FrameDropped("malformed"),
            Cause::BodyGarbled,
            Cause::OperatorGarbled,
        ];
        let flooded = flooded.map(CauseName::from);
        let forged = CauseName::from(Cause::Rejected("wrong signature"));
        for cause in &flooded {
            let admitted = (0..1_000).filter(|_| sampler.admits(cause)).count();
            assert_eq!(admitted, RECORDED as usize, "{cause}");
        }
        assert!(sampler.admits(&forged));
        assert_eq!(sampler.elapse(999_999), None);
        let counts = sampler.elapse(1_000_000).unwrap();
        for cause in &flooded {
            assert_eq!(counts.of(cause), 1_000 - u64::from(RECORDED), "{cause}");
            assert!(sampler.admits(cause));
        }
        assert_eq!(counts.of(&forged), 0);
        assert_eq!(sampler.elapse(3_000_000), None);
    }

    #[test]
    fn what_the_robot_does_not_send_is_always_recorded() {
        let mut sampler = Sampler::default();
        for own in [Cause::NotSent, Cause::LinkFailed, Cause::TimeNotKept] {
            assert!((0..1_000).all(|_| sampler.admits(&own.into())));
        }
        assert_eq!(sampler.finish(), None);
    }
}
