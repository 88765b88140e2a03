//! Stages 3 and 4: a leader, with one or two followers.

use crossguard_protocol::laws::arbitrary::{Happening, Kind, Stage};
use crossguard_protocol::laws::steps::Taken;
use crossguard_protocol::{EndReason, Notice, Output, Role};

use super::stage::{any_of, any_step, becomes, has};
use crate::harness::harnesses;
use crate::kani;

/// How many followers the leader has, at most: one that a message is about, and another.
const FOLLOWERS: usize = 2;

fn notifies(step: &Taken, of_kind: impl Fn(Notice) -> bool) -> bool {
    step.outputs.notices().any(of_kind)
}

harnesses! {
    /// A RAM of a follower.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_follower() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::RamFollower);
        kani::cover!(notifies(&step, |n| matches!(n, Notice::FollowerJoined(_))), "joins");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::LeaseGranted(_))), "grants a lease");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::CommandAcknowledged(..))), "counts as acknowledged");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::ManeuverCompleted(..))), "counts as completed");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::FollowerGone(..))), "drops a follower that left");
        kani::cover!(has(&step, |output| matches!(output, Output::CorridorClosed(_))), "closes the corridor");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A RAM without a part, which may name a session as over.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_farewell() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::RamNone);
        kani::cover!(becomes(&step, Role::None), "the last follower left");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::FollowerGone(..))) && becomes(&step, Role::Leader), "a follower left");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_another_ram() {
        let kinds = [Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamLeader];
        let step = any_step(Stage::Leading, FOLLOWERS, any_of(&kinds));
        kani::cover!(has(&step, |output| *output == Output::SendRam), "names a session as over");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A command.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_command() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Command);
        kani::cover!(has(&step, |output| *output == Output::SendRam), "says farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// An answer.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_an_answer() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Answer);
        kani::cover!(notifies(&step, |n| matches!(n, Notice::CommandAcknowledged(..))), "acknowledged");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::CommandRejected(..))), "rejected");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The application commands a maneuver.
    #[unwind(17)]
    #[solver(cadical)]
    fn commands() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Local(Happening::CommandManeuver));
        kani::cover!(has(&step, |output| matches!(output, Output::SendRmcm(_))), "commands");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::SessionEnded(_, EndReason::Renewed))), "renews the session");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The application opens or closes the corridor.
    #[unwind(17)]
    #[solver(cadical)]
    fn moves_the_corridor() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Local(Happening::Corridor));
        kani::cover!(has(&step, |output| *output == Output::CorridorOpened), "opens");
        kani::cover!(has(&step, |output| matches!(output, Output::CorridorClosed(_))), "closes");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other event.
    #[unwind(17)]
    #[solver(cadical)]
    fn takes_an_event() {
        let kinds = [Happening::PedestrianDetected, Happening::ManeuverEnded, Happening::SessionEnded, Happening::AvailabilityChanged, Happening::IdentityChanged];
        let step = any_step(Stage::Leading, FOLLOWERS, any_of(&kinds.map(Kind::Local)));
        kani::cover!(becomes(&step, Role::None), "ends its session");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The expiry of any timer.
    #[unwind(17)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Expired);
        kani::cover!(notifies(&step, |n| matches!(n, Notice::LeaseExpired(_))), "a lease ran out");
        kani::cover!(has(&step, |output| matches!(output, Output::SendRmcm(_))), "repeats a command");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::FollowerGone(..))), "drops a follower");
        kani::cover!(notifies(&step, |n| matches!(n, Notice::ManeuverFailed(..))), "the execution limit ran out");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
