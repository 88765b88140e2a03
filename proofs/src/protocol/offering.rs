//! Stage 2: a robot that offers help.

use crossguard_protocol::laws::arbitrary::{Kind, Stage};
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
        let step = any_step(Stage::Offering, 0, Kind::RamLeader);
        kani::cover!(becomes(&step, Role::Follower), "joins");
        kani::cover!(becomes(&step, Role::None), "is not listed");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_another_ram() {
        let kinds = [Kind::RamNone, Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamFollower];
        let step = any_step(Stage::Offering, 0, any_of(&kinds));
        kani::cover!(becomes(&step, Role::None), "the session ended");
        kani::cover!(step.said.has(Sort::SendRam) && becomes(&step, Role::Helper), "names a session as over");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any RMCM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_an_rmcm() {
        let step = any_step(Stage::Offering, 0, any_of(&[Kind::Command, Kind::Answer]));
        kani::cover!(step.said.has(Sort::SendRam), "says farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any event.
    #[unwind(17)]
    #[solver(cadical)]
    fn takes_an_event() {
        let step = any_step(Stage::Offering, 0, any_of(&EVENTS));
        kani::cover!(becomes(&step, Role::None), "leaves");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The expiry of any timer.
    #[unwind(17)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = any_step(Stage::Offering, 0, Kind::Expired);
        kani::cover!(becomes(&step, Role::None), "withdraws");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
