//! Stages 3 and 4: a leader, with one or two followers. The laws of its steps are proved in four parts, each of
//! which takes less than its share of all.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::{EventKind, Role};

use super::stage::From;

/// How many followers the leader has, at most: one that a message is about, and another.
const FOLLOWERS: usize = 2;

/// A RAM says nothing but its sender's part in a session, unless it says nothing but a farewell.
pub(super) const FROM: From = From {
    peers: (1, FOLLOWERS),
    farewells: false,
    ..From::stage(Role::Leader)
};

/// Inputs that a leader always ignores. [`ignored`](super::ignored) proves the other laws of such a step.
pub(super) const IGNORED: [Kind; 8] = [
    Kind::RamNeedHelp,
    Kind::Command,
    Kind::Local(EventKind::PedestrianDetected),
    Kind::Local(EventKind::ManeuverCompleted),
    Kind::Local(EventKind::ManeuverFailed),
    Kind::Local(EventKind::IdentityChanged),
    Kind::Local(EventKind::InPosition),
    Kind::Local(EventKind::AllAnswered),
];

/// Declares one harness of these laws for each message and event that a leader can act on, and for the timers that
/// are passed. [`conduct`] marks the outcomes.
macro_rules! of_each_input {
    ($laws:expr $(; $($timers:tt)+)?) => {
        $crate::protocol::stage::steps! { super::FROM, $laws;
            /// A RAM of a follower.
            hears_a_follower(Kind::RamFollower) |step| { "a step": step.before.role() == Role::Leader }

            /// A RAM of a robot without a part in a session.
            hears_a_farewell(Kind::RamNone) |step| { "a step": step.before.role() == Role::Leader }

            /// A RAM that offers help.
            hears_an_offer(Kind::RamOfferHelp) |step| { "a step": step.before.role() == Role::Leader }

            /// A RAM of a leader.
            hears_a_leader(Kind::RamLeader) |step| { "a step": step.before.role() == Role::Leader }

            /// An answer.
            hears_an_answer(Kind::Answer) |step| { "a step": step.before.role() == Role::Leader }

            /// The application commands a maneuver.
            commands(Kind::Local(EventKind::CommandManeuver)) |step| { "a step": step.before.role() == Role::Leader }

            /// The application opens the corridor.
            opens_the_corridor(Kind::Local(EventKind::OpenCorridor)) |step| { "a step": step.before.role() == Role::Leader }

            /// The application closes the corridor.
            closes_the_corridor(Kind::Local(EventKind::CloseCorridor)) |step| { "a step": step.before.role() == Role::Leader }

            /// The task is completed.
            completes_the_task(Kind::Local(EventKind::TaskCompleted)) |step| { "a step": step.before.role() == Role::Leader }

            /// The robot is to leave.
            leaves(Kind::Local(EventKind::LeaveRequested)) |step| { "a step": step.before.role() == Role::Leader }

            /// The robot becomes available or unavailable.
            changes_its_availability(Kind::Local(EventKind::AvailabilityChanged)) |step| { "a step": step.before.role() == Role::Leader }

            /// The road is clear.
            clears_the_road(Kind::Local(EventKind::RoadClear)) |step| { "a step": step.before.role() == Role::Leader }

            /// A larger boot counter has been persisted.
            renews_its_epoch(Kind::Local(EventKind::EpochRenewed)) |step| { "a step": step.before.role() == Role::Leader }

            $($($timers)+)?
        }
    };
}

/// The same, and for each timer.
macro_rules! of_each_input_and_timer {
    ($laws:expr) => {
        of_each_input! { $laws;
            /// The end of a lease.
            loses_a_lease(Kind::Fires(TimerKind::Lease)) |step| { "a step": step.before.role() == Role::Leader }

            /// A follower without a lease for too long.
            gives_up_a_follower(Kind::Fires(TimerKind::Lost)) |step| { "a step": step.before.role() == Role::Leader }

            /// `T_exec`.
            limits_an_execution(Kind::Fires(TimerKind::Execution)) |step| { "a step": step.before.role() == Role::Leader }

            /// `T_ack`.
            misses_an_acknowledgement(Kind::Fires(TimerKind::Acknowledgement)) |step| { "a step": step.before.role() == Role::Leader }

            /// `T_lock`.
            must_unlock(Kind::Fires(TimerKind::IdentityLock)) |step| { "a step": step.before.role() == Role::Leader }

            /// The next RAM.
            repeats_itself(Kind::Fires(TimerKind::Ram)) |step| { "a step": step.before.role() == Role::Leader }

            /// The end of a farewell.
            ends_a_farewell(Kind::Fires(TimerKind::Farewell)) |step| { "a step": step.before.role() == Role::Leader }
        }
    };
}

pub mod conduct;
pub mod peers;
pub mod road;
pub mod validity;
