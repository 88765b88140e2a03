//! Stage 2: a robot that asks for help, with at most two offers.

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Kind, Stage};
use crossguard_protocol::laws::watch::Sort;

use super::stage::{From, any_of, becomes};
use crate::harness::harnesses;
use crate::kani;

/// How many offers the requester has heard, at most: one of the station that a message is about, and
/// another.
const OFFERS: usize = 2;

const FROM: From = From {
    peers: (0, OFFERS),
    ..From::stage(Stage::Requesting)
};

harnesses! {
    /// A RAM that asks for help as well.
    #[unwind(6)]
    #[solver(cadical)]
    fn hears_a_request() {
        let step = FROM.any_step(Kind::RamNeedHelp);
        kani::cover!(becomes(&step, Role::Helper), "helps the one that goes before");
        kani::cover!(becomes(&step, Role::None), "withdraws");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A RAM that offers help.
    #[random_only("not run under Kani to its end.")]
    fn hears_an_offer() {
        let step = FROM.any_step(Kind::RamOfferHelp);
        kani::cover!(!step.is_ignored() && step.said.is_empty(), "takes it");
        kani::cover!(step.said.has(Sort::SendRam), "names a session as over");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[random_only("not run under Kani to its end.")]
    fn hears_another_ram() {
        let kinds = [Kind::RamNone, Kind::RamLeader, Kind::RamFollower];
        any_of(&kinds, |kind| {
            let step = FROM.any_step(kind);
            kani::cover!(!step.is_ignored() && step.said.is_empty(), "forgets an offer");
            kani::cover!(step.said.has(Sort::SendRam), "names a session as over");
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
            kani::cover!(becomes(&step, Role::None), "ends its session");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// The expiry of any timer.
    #[random_only("Kani was stopped unfinished.")]
    fn fires_a_timer() {
        let step = FROM.any_step(Kind::Expired);
        kani::cover!(becomes(&step, Role::Leader), "establishes the roles");
        kani::cover!(becomes(&step, Role::None), "ends its session");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
