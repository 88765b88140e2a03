//! Stages 3 and 4: a leader, with one or two followers. The laws of its steps are proved in three parts, each of
//! which takes less than its share of all.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::{EventKind, Role};

use super::stage::{From, peers};

/// A RAM says nothing but its sender's part in a session, unless it says nothing but a farewell.
pub(super) const FROM: From = From {
    peers: peers(Role::Leader),
    farewells: false,
    ..From::stage(Role::Leader)
};

/// Inputs that a leader always ignores. [`ignored`](super::ignored) proves the other laws of such a step.
pub(super) const IGNORED: [Kind; 10] = [
    Kind::RamNeedHelp,
    Kind::Command,
    Kind::Local(EventKind::PedestrianDetected),
    Kind::Local(EventKind::ManeuverCompleted),
    Kind::Local(EventKind::ManeuverFailed),
    Kind::Local(EventKind::IdentityChanged),
    Kind::Local(EventKind::InPosition),
    Kind::Local(EventKind::AllAnswered),
    Kind::Local(EventKind::OutOfPosition),
    Kind::Local(EventKind::PersonOnRoad),
];

/// Declares one harness of these laws for each message, event and timer that a leader can act on. [`conduct`] marks the
/// outcomes.
macro_rules! of_each_input {
    ($laws:expr) => {
        $crate::protocol::stage::steps_with_those_of_leaders! { super::FROM, $laws;
            @each |step| { "a step": step.before.role() == Role::Leader } {
                hears_a_follower(Kind::RamFollower);
                hears_a_farewell(Kind::RamNone);
                hears_an_offer(Kind::RamOfferHelp);
                hears_a_leader(Kind::RamLeader);
                hears_an_answer(Kind::Answer);
                completes_the_task(Kind::Local(EventKind::TaskCompleted));
                leaves(Kind::Local(EventKind::LeaveRequested));
                changes_its_availability(Kind::Local(EventKind::AvailabilityChanged));
                clears_the_road(Kind::Local(EventKind::RoadClear));
                renews_its_epoch(Kind::Local(EventKind::EpochRenewed));
                loses_a_lease(Kind::Fires(TimerKind::Lease));
                gives_up_a_follower(Kind::Fires(TimerKind::Lost));
                limits_an_execution(Kind::Fires(TimerKind::Execution));
                misses_an_acknowledgement(Kind::Fires(TimerKind::Acknowledgement));
                must_unlock(Kind::Fires(TimerKind::IdentityLock));
                repeats_itself(Kind::Fires(TimerKind::Ram));
                ends_a_farewell(Kind::Fires(TimerKind::Farewell));
            }
        }
    };
}

pub mod conduct;
pub mod peers;
pub mod road;
