//! Stages 3 and 4: a follower.

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Happening, Kind, Stage};
use crossguard_protocol::laws::watch::Sort;

use super::stage::{From, any_of, becomes};
use crate::harness::harnesses;
use crate::kani;

const FROM: From = From::stage(Stage::Following);

harnesses! {
    /// A RAM of a leader.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_a_leader() {
        let step = FROM.any_step(Kind::RamLeader);
        kani::cover!(becomes(&step, Role::None), "is not listed any more");
        kani::cover!(!step.is_ignored() && step.said.is_empty(), "hears a newer heartbeat");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[random_only("Kani was stopped unfinished.")]
    fn hears_another_ram() {
        let kinds = [Kind::RamNone, Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamFollower];
        any_of(&kinds, |kind| {
            let step = FROM.any_step(kind);
            kani::cover!(step.said.has(Sort::StopManeuver), "stops as the session ends");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// A command.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_a_command() {
        let step = FROM.any_step(Kind::Command);
        // No branch in a mark: each branch of it would be a mark of its own to Kani.
        let starts = step.said.has(Sort::StartManeuver);
        let answers = step.said.has(Sort::Answer);
        let changes = step.before != step.after;
        let supersedes = starts && step.said.has(Sort::StopManeuver);
        let answers_again = answers && !changes;
        let rejects = answers && !starts && changes;
        kani::cover!(supersedes, "supersedes");
        kani::cover!(starts, "accepts");
        kani::cover!(answers_again, "answers again");
        kani::cover!(rejects, "rejects");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// An answer.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_an_answer() {
        let step = FROM.any_step(Kind::Answer);
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A maneuver that ended.
    #[unwind(6)]
    #[solver(cadical)]
    fn ends_a_maneuver() {
        let step = FROM.any_step(Kind::Local(Happening::ManeuverEnded));
        kani::cover!(!step.is_ignored(), "reports");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any event.
    #[random_only("not run under Kani to its end.")]
    fn takes_an_event() {
        any_of(&Kind::EVENTS, |kind| {
            let step = FROM.any_step(kind);
            kani::cover!(becomes(&step, Role::None), "leaves");
            kani::cover!(step.said.has(Sort::StopManeuver) && becomes(&step, Role::Follower), "stops and stays");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// The expiry of any timer.
    #[unwind(6)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = FROM.any_step(Kind::Expired);
        kani::cover!(step.said.has(Sort::FallBack), "falls back");
        kani::cover!(becomes(&step, Role::None), "leaves");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
