//! Stage 1: a robot without a part in a session.

use crossguard_protocol::laws::arbitrary::{Kind, Stage};
use crossguard_protocol::Role;
use crossguard_protocol::laws::watch::Sort;

use super::stage::{EVENTS, any_of, any_step, becomes};
use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// Any RAM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_ram() {
        let kinds = [Kind::RamNone, Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamLeader, Kind::RamFollower];
        let step = any_step(Stage::Idle, 0, any_of(&kinds));
        kani::cover!(becomes(&step, Role::Helper), "offers");
        kani::cover!(!step.is_ignored() && becomes(&step, Role::None), "names a session as over");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any RMCM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_an_rmcm() {
        let step = any_step(Stage::Idle, 0, any_of(&[Kind::Command, Kind::Answer]));
        kani::cover!(step.said.has(Sort::LockIdentity), "says farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any event.
    #[unwind(17)]
    #[solver(cadical)]
    fn takes_an_event() {
        let step = any_step(Stage::Idle, 0, any_of(&EVENTS));
        kani::cover!(becomes(&step, Role::Requester), "requests");
        kani::cover!(step.before.station() != step.after.station(), "changes its identity");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The expiry of any timer.
    #[unwind(17)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = any_step(Stage::Idle, 0, Kind::Expired);
        kani::cover!(step.said.has(Sort::UnlockIdentity), "unlocks");
        kani::cover!(step.said.has(Sort::SendRam), "repeats its farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
