//! Stage 2: a robot that asks for help, with any number of offers.

use crossguard_protocol::laws::arbitrary::{Kind, Stage};
use crossguard_protocol::Role;
use crossguard_protocol::laws::watch::Sort;

use super::stage::{EVENTS, any_of, any_step, becomes};
use crate::harness::harnesses;
use crate::kani;

/// How many offers the requester has heard.
const OFFERS: usize = crossguard_protocol::MAX_FOLLOWERS;

harnesses! {
    /// A RAM that asks for help as well.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_a_request() {
        let step = any_step(Stage::Requesting, OFFERS, Kind::RamNeedHelp);
        kani::cover!(becomes(&step, Role::Helper), "helps the one that goes before");
        kani::cover!(becomes(&step, Role::None), "withdraws");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A RAM that offers help.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_an_offer() {
        let step = any_step(Stage::Requesting, OFFERS, Kind::RamOfferHelp);
        kani::cover!(!step.is_ignored() && step.said.is_empty(), "takes it");
        kani::cover!(step.said.has(Sort::SendRam), "names a session as over");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_another_ram() {
        let kinds = [Kind::RamNone, Kind::RamLeader, Kind::RamFollower];
        let step = any_step(Stage::Requesting, OFFERS, any_of(&kinds));
        kani::cover!(!step.is_ignored() && step.said.is_empty(), "forgets an offer");
        kani::cover!(step.said.has(Sort::SendRam), "names a session as over");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any RMCM.
    #[unwind(17)]
    #[solver(cadical)]
    fn hears_an_rmcm() {
        let step = any_step(Stage::Requesting, OFFERS, any_of(&[Kind::Command, Kind::Answer]));
        kani::cover!(step.said.has(Sort::SendRam), "says farewell");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any event.
    #[unwind(17)]
    #[solver(cadical)]
    fn takes_an_event() {
        let step = any_step(Stage::Requesting, OFFERS, any_of(&EVENTS));
        kani::cover!(becomes(&step, Role::None), "ends its session");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The expiry of any timer.
    #[unwind(17)]
    #[solver(cadical)]
    fn fires_a_timer() {
        let step = any_step(Stage::Requesting, OFFERS, Kind::Expired);
        kani::cover!(becomes(&step, Role::Leader), "establishes the roles");
        kani::cover!(becomes(&step, Role::None), "ends its session");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
