//! Stage 2: a robot that offers help.

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Kind, Stage};
use crossguard_protocol::laws::watch::Sort;

use super::stage::{From, any_of, becomes};
use crate::harness::harnesses;
use crate::kani;

const FROM: From = From::stage(Stage::Offering);

harnesses! {
    /// A RAM of a leader.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_a_leader() {
        let step = FROM.any_step(Kind::RamLeader);
        kani::cover!(becomes(&step, Role::Follower), "joins");
        kani::cover!(becomes(&step, Role::None), "is not listed");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[random_only("not run under Kani to its end.")]
    fn hears_another_ram() {
        let kinds = [Kind::RamNone, Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamFollower];
        any_of(&kinds, |kind| {
            let step = FROM.any_step(kind);
            kani::cover!(becomes(&step, Role::None), "the session ended");
            kani::cover!(step.said.has(Sort::SendRam) && becomes(&step, Role::Helper), "names a session as over");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// A command.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_a_command() {
        let step = FROM.any_step(Kind::Command);
        kani::cover!(step.said.has(Sort::SendRam), "says farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// An answer.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_an_answer() {
        let step = FROM.any_step(Kind::Answer);
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any event.
    #[random_only("not run under Kani to its end.")]
    fn takes_an_event() {
        any_of(&Kind::EVENTS, |kind| {
            let step = FROM.any_step(kind);
            kani::cover!(becomes(&step, Role::None), "leaves");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// The expiry of any timer.
    #[unwind(6)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = FROM.any_step(Kind::Expired);
        kani::cover!(becomes(&step, Role::None), "withdraws");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
