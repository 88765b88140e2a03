//! Stage 1: a robot without a part in a session.

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Kind, Stage};
use crossguard_protocol::laws::watch::Sort;

use super::stage::{From, any_of, becomes};
use crate::harness::harnesses;
use crate::kani;

const FROM: From = From::stage(Stage::Idle);

harnesses! {
    /// A RAM that asks for help.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_a_request() {
        let step = FROM.any_step(Kind::RamNeedHelp);
        kani::cover!(becomes(&step, Role::Helper), "offers");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[random_only("not run under Kani to its end.")]
    fn hears_another_ram() {
        let kinds = [Kind::RamNone, Kind::RamOfferHelp, Kind::RamLeader, Kind::RamFollower];
        any_of(&kinds, |kind| {
            let step = FROM.any_step(kind);
            kani::cover!(!step.is_ignored() && becomes(&step, Role::None), "names a session as over");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// A command.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_a_command() {
        let step = FROM.any_step(Kind::Command);
        kani::cover!(step.said.has(Sort::LockIdentity), "says farewell");
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
            kani::cover!(becomes(&step, Role::Requester), "requests");
            kani::cover!(step.before.station() != step.after.station(), "changes its identity");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// The expiry of any timer.
    #[unwind(6)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = FROM.any_step(Kind::Expired);
        kani::cover!(step.said.has(Sort::UnlockIdentity), "unlocks");
        kani::cover!(step.said.has(Sort::SendRam), "repeats its farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
