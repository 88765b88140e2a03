//! The state of a leader stays valid.
//!
//! Of the timers [`firing`](crate::protocol::timers::firing) and what is beside it prove that, part by part. What
//! can come of an input is marked in [`conduct`](super::conduct).

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Happening, Kind};
use crossguard_protocol::laws::steps::keeps_the_state_valid;

use super::FROM;
use crate::protocol::stage::steps;

/// Declares a harness for each kind of input.
macro_rules! validity {
    ($($(#[doc = $doc:literal])* $(#[random_only($reason:literal)])? $name:ident($kind:expr))+) => {
        steps! { FROM, keeps_the_state_valid; $(
            $(#[doc = $doc])*
            $(#[random_only($reason)])?
            $name($kind) |step| {
                "a step": step.before.role() == Role::Leader,
            }
        )+ }
    };
}

validity! {
    /// A RAM of a follower.
    hears_a_follower(Kind::RamFollower)
    /// A RAM of a robot without a part in a session.
    hears_a_farewell(Kind::RamNone)
    /// A RAM that asks for help.
    hears_a_request(Kind::RamNeedHelp)
    /// A RAM that offers help.
    hears_an_offer(Kind::RamOfferHelp)
    /// A RAM of a leader.
    hears_a_leader(Kind::RamLeader)
    /// A command.
    hears_a_command(Kind::Command)
    /// An answer.
    hears_an_answer(Kind::Answer)
    /// A pedestrian.
    detects_a_pedestrian(Kind::Local(Happening::PedestrianDetected))
    /// The application commands a maneuver.
    commands(Kind::Local(Happening::CommandManeuver))
    /// The application opens the corridor.
    opens_the_corridor(Kind::Local(Happening::OpenCorridor))
    /// The application closes the corridor.
    closes_the_corridor(Kind::Local(Happening::CloseCorridor))
    /// The body has completed a maneuver.
    completes_a_maneuver(Kind::Local(Happening::ManeuverCompleted))
    /// The body has failed at a maneuver.
    fails_a_maneuver(Kind::Local(Happening::ManeuverFailed))
    /// The task is completed.
    completes_the_task(Kind::Local(Happening::TaskCompleted))
    /// The robot is to leave.
    leaves(Kind::Local(Happening::LeaveRequested))
    /// The robot becomes available or unavailable.
    changes_its_availability(Kind::Local(Happening::AvailabilityChanged))
    /// The robot has another pseudonym.
    changes_its_identity(Kind::Local(Happening::IdentityChanged))
    /// The body holds its place.
    reaches_its_position(Kind::Local(Happening::InPosition))
    /// The road is clear.
    clears_the_road(Kind::Local(Happening::RoadClear))
    /// All robots nearby have answered.
    hears_that_all_have_answered(Kind::Local(Happening::AllAnswered))
    /// A larger boot counter has been persisted.
    renews_its_epoch(Kind::Local(Happening::EpochRenewed))
}
