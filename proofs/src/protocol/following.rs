//! Stages 3 and 4: a follower.

use crossguard_protocol::laws::arbitrary::{Happening, Kind, Stage};
use crossguard_protocol::Role;
use crossguard_protocol::laws::watch::Sort;

use super::stage::{EVENTS, any_of, any_step, becomes};
use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// A RAM of a leader.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_leader() {
        let step = any_step(Stage::Following, 0, Kind::RamLeader);
        kani::cover!(becomes(&step, Role::None), "is not listed any more");
        kani::cover!(!step.is_ignored() && step.said.is_empty(), "hears a newer heartbeat");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_another_ram() {
        let kinds = [Kind::RamNone, Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamFollower];
        let step = any_step(Stage::Following, 0, any_of(&kinds));
        kani::cover!(step.said.has(Sort::StopManeuver), "stops as the session ends");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A command.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_command() {
        let step = any_step(Stage::Following, 0, Kind::Command);
        let starts = step.said.has(Sort::StartManeuver);
        let answers = step.said.has(Sort::Answer);
        kani::cover!(starts && step.said.has(Sort::StopManeuver), "supersedes");
        kani::cover!(starts, "accepts");
        kani::cover!(answers && step.before == step.after, "answers again");
        kani::cover!(answers && !starts && step.before != step.after, "rejects");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// An answer.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_an_answer() {
        let step = any_step(Stage::Following, 0, Kind::Answer);
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A maneuver that ended.
    #[unwind(17)]
    #[solver(cadical)]
    fn ends_a_maneuver() {
        let step = any_step(Stage::Following, 0, Kind::Local(Happening::ManeuverEnded));
        kani::cover!(!step.is_ignored(), "reports");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any event.
    #[unwind(17)]
    #[solver(cadical)]
    fn takes_an_event() {
        let step = any_step(Stage::Following, 0, any_of(&EVENTS));
        kani::cover!(becomes(&step, Role::None), "leaves");
        kani::cover!(step.said.has(Sort::StopManeuver) && becomes(&step, Role::Follower), "stops and stays");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The expiry of any timer.
    #[unwind(17)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = any_step(Stage::Following, 0, Kind::Expired);
        kani::cover!(step.said.has(Sort::FallBack), "falls back");
        kani::cover!(becomes(&step, Role::None), "leaves");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
