//! State of the followers as a leader's application knows it, by the notices alone and not by the protocol state.

use crossguard_protocol::{Notice, Output, Outputs, StationId};

/// The followers whose leases stand, and the followers that do what they were commanded to, as far as notices said
/// so: one bit per place.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Told {
    leases: u8,
    works: u8,
}

impl Told {
    pub(super) const NOTHING: Self = Self {
        leases: 0,
        works: 0,
    };

    /// Whether the application counts on the follower at `place` as a guard.
    pub(crate) const fn counts_on(self, place: u8) -> bool {
        self.leases & self.works & 1 << place != 0
    }
}

/// Why the pedestrian does not see go, by the notices.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Reason {
    /// No notice says why.
    None,
    /// A lease has run out. The protocol tries on, so the wait for go begins anew.
    Lease,
    /// It is for the application to go on.
    Final,
}

/// Report of one step of a robot to its application.
#[derive(Clone, Copy, Debug)]
pub(super) struct Telling {
    keep: Told,
    add: Told,
    pub(super) reason: Reason,
}

impl Telling {
    /// The report in `outputs`, where `bit_of` is the bit of a station's place.
    pub(super) fn of(outputs: &Outputs, bit_of: impl Fn(StationId) -> u8) -> Self {
        let mut telling = Self {
            keep: Told {
                leases: u8::MAX,
                works: u8::MAX,
            },
            add: Told::NOTHING,
            reason: Reason::None,
        };
        for output in outputs.iter() {
            if let Output::Notify(notice) = *output {
                telling.hear(notice, &bit_of);
            }
        }
        telling
    }

    /// Every notice that speaks of a follower's lease or work, or of the end of all.
    fn hear(&mut self, notice: Notice, bit_of: impl Fn(StationId) -> u8) {
        use Notice as N;
        match notice {
            N::LeaseGranted(follower) => self.add.leases |= bit_of(follower),
            N::LeaseExpired(follower) => {
                self.clear(bit_of(follower), 0);
                self.give(Reason::Lease);
            }
            N::CommandAcknowledged(follower, _)
            | N::ManeuverReported(follower, _)
            | N::ManeuverInPosition(follower, _) => self.add.works |= bit_of(follower),
            N::ManeuverCompleted(follower, _)
            | N::CommandRejected(follower, ..)
            | N::ManeuverFailed(follower, ..)
            | N::FollowerSafeIdle(follower, _) => {
                self.clear(0, bit_of(follower));
                self.give(Reason::Final);
            }
            N::FollowerGone(follower, _) => {
                self.clear(bit_of(follower), bit_of(follower));
                self.give(Reason::Final);
            }
            N::SessionEnded(..) => {
                self.clear(u8::MAX, u8::MAX);
                self.give(Reason::Final);
            }
            _ => {}
        }
    }

    fn clear(&mut self, leases: u8, works: u8) {
        for told in [&mut self.keep, &mut self.add] {
            told.leases &= !leases;
            told.works &= !works;
        }
    }

    fn give(&mut self, reason: Reason) {
        self.reason = self.reason.max(reason);
    }

    pub(super) const fn after(self, before: Told) -> Told {
        Told {
            leases: before.leases & self.keep.leases | self.add.leases,
            works: before.works & self.keep.works | self.add.works,
        }
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::{EndReason, SessionId, SessionNumber, UniqueNumber};

    use super::*;

    const STATION: StationId = StationId(7);

    fn told(before: Told, notices: &[Notice]) -> (Told, Reason) {
        let outputs = notices.iter().copied().map(Output::Notify).collect();
        let telling = Telling::of(&outputs, |station| u8::from(station == STATION));
        (telling.after(before), telling.reason)
    }

    #[test]
    fn an_application_counts_on_a_guard_until_it_is_told_of_one_thing_that_fails() {
        let session = SessionId {
            leader: StationId(1),
            number: SessionNumber(UniqueNumber { boot: 1, count: 0 }),
        };
        let request = crossguard_protocol::RequestId(0);
        let id = crossguard_protocol::ManeuverId { session, request };
        let granted = Notice::LeaseGranted(STATION);
        let reported = Notice::ManeuverReported(STATION, id);
        let (guards, reason) = told(Told::NOTHING, &[granted, reported]);
        assert!(guards.counts_on(0));
        assert_eq!(reason, Reason::None);
        let (expired, reason) = told(guards, &[Notice::LeaseExpired(STATION)]);
        assert!(!expired.counts_on(0));
        assert_eq!(reason, Reason::Lease);
        let (again, _) = told(expired, &[granted]);
        assert!(again.counts_on(0));
        // A failure after the lease was granted again counts.
        let (idle, _) = told(expired, &[granted, Notice::FollowerSafeIdle(STATION, id)]);
        assert!(!idle.counts_on(0));
        let ended = Notice::SessionEnded(session, EndReason::NoFollowers);
        assert_eq!(told(guards, &[ended]), (Told::NOTHING, Reason::Final));
    }
}
