//! Stages 3 and 4: a leader, with one or two followers.

use crossguard_protocol::laws::arbitrary::{Happening, Kind, Stage};
use crossguard_protocol::Role;
use crossguard_protocol::laws::watch::Sort;

use super::stage::{any_of, any_step, becomes};
use crate::harness::harnesses;
use crate::kani;

/// How many followers the leader has, at most: one that a message is about, and another.
const FOLLOWERS: usize = 2;

harnesses! {
    /// A RAM of a follower.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_follower() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::RamFollower);
        kani::cover!(step.said.has(Sort::FollowerJoined), "joins");
        kani::cover!(step.said.has(Sort::LeaseGranted), "grants a lease");
        kani::cover!(step.said.has(Sort::CommandAcknowledged), "counts as acknowledged");
        kani::cover!(step.said.has(Sort::ManeuverCompleted), "counts as completed");
        kani::cover!(step.said.has(Sort::FollowerGone), "drops a follower that left");
        kani::cover!(step.said.has(Sort::CorridorClosed), "closes the corridor");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A RAM without a part, which may name a session as over.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_farewell() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::RamNone);
        kani::cover!(becomes(&step, Role::None), "the last follower left");
        kani::cover!(step.said.has(Sort::FollowerGone) && becomes(&step, Role::Leader), "a follower left");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_another_ram() {
        let kinds = [Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamLeader];
        let step = any_step(Stage::Leading, FOLLOWERS, any_of(&kinds));
        kani::cover!(step.said.has(Sort::SendRam), "names a session as over");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A command.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_command() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Command);
        kani::cover!(step.said.has(Sort::SendRam), "says farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// An answer.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_an_answer() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Answer);
        kani::cover!(step.said.has(Sort::CommandAcknowledged), "acknowledged");
        kani::cover!(step.said.has(Sort::CommandRejected), "rejected");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The application commands a maneuver.
    #[unwind(17)]
    #[solver(cadical)]
    fn commands() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Local(Happening::CommandManeuver));
        kani::cover!(step.said.has(Sort::Command), "commands");
        kani::cover!(step.said.has(Sort::Renewed), "renews the session");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The application opens or closes the corridor.
    #[unwind(17)]
    #[solver(cadical)]
    fn moves_the_corridor() {
        let step = any_step(Stage::Leading, FOLLOWERS, Kind::Local(Happening::Corridor));
        kani::cover!(step.said.has(Sort::CorridorOpened), "opens");
        kani::cover!(step.said.has(Sort::CorridorClosed), "closes");
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
        kani::cover!(step.said.has(Sort::LeaseExpired), "a lease ran out");
        kani::cover!(step.said.has(Sort::Command), "repeats a command");
        kani::cover!(step.said.has(Sort::FollowerGone), "drops a follower");
        kani::cover!(step.said.has(Sort::ManeuverFailed), "the execution limit ran out");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
