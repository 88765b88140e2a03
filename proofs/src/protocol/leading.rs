//! Stages 3 and 4: a leader, with one or two followers.

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Happening, Kind, Stage};
use crossguard_protocol::laws::watch::Sort;

use super::stage::{From, any_of, becomes};
use crate::harness::harnesses;
use crate::kani;

/// How many followers the leader has, at most: one that a message is about, and another.
const FOLLOWERS: usize = 2;

/// A RAM says nothing but the leader's or follower's part in a session, unless it says nothing but a
/// farewell.
const FROM: From = From {
    peers: (1, FOLLOWERS),
    farewells: false,
    ..From::stage(Stage::Leading)
};

harnesses! {
    /// A RAM of a follower.
    #[random_only("not run under Kani to its end.")]
    fn hears_a_follower() {
        let step = FROM.any_step(Kind::RamFollower);
        kani::cover!(step.said.has(Sort::FollowerJoined), "joins");
        kani::cover!(step.said.has(Sort::LeaseGranted), "grants a lease");
        kani::cover!(step.said.has(Sort::CommandAcknowledged), "counts as acknowledged");
        kani::cover!(step.said.has(Sort::ManeuverCompleted), "counts as completed");
        kani::cover!(step.said.has(Sort::CorridorClosed), "closes the corridor");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// A RAM without a part, which may name a session as over.
    #[random_only("Kani was stopped unfinished.")]
    fn hears_a_farewell() {
        let step = From { farewells: true, ..FROM }.any_step(Kind::RamNone);
        kani::cover!(becomes(&step, Role::None), "the last follower left");
        kani::cover!(step.said.has(Sort::FollowerGone) && becomes(&step, Role::Leader), "a follower left");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other RAM.
    #[random_only("not run under Kani to its end.")]
    fn hears_another_ram() {
        let kinds = [Kind::RamNeedHelp, Kind::RamOfferHelp, Kind::RamLeader];
        any_of(&kinds, |kind| {
            let step = FROM.any_step(kind);
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
        kani::cover!(step.said.has(Sort::CommandAcknowledged), "acknowledged");
        kani::cover!(step.said.has(Sort::CommandRejected), "rejected");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The application commands a maneuver.
    #[random_only("not run under Kani to its end.")]
    fn commands() {
        let step = FROM.any_step(Kind::Local(Happening::CommandManeuver));
        kani::cover!(step.said.has(Sort::Command), "commands");
        kani::cover!(step.said.has(Sort::Renewed), "renews the session");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// The application opens or closes the corridor.
    #[random_only("not run under Kani to its end.")]
    fn moves_the_corridor() {
        let step = FROM.any_step(Kind::Local(Happening::Corridor));
        kani::cover!(step.said.has(Sort::CorridorOpened), "opens");
        kani::cover!(step.said.has(Sort::CorridorClosed), "closes");
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Any other event.
    #[random_only("Kani was stopped unfinished.")]
    fn takes_an_event() {
        let kinds = [Happening::PedestrianDetected, Happening::ManeuverEnded, Happening::SessionEnded, Happening::AvailabilityChanged, Happening::IdentityChanged];
        any_of(&kinds.map(Kind::Local), |kind| {
            let step = FROM.any_step(kind);
            kani::cover!(becomes(&step, Role::None), "ends its session");
            kani::cover!(step.is_ignored(), "ignored");
        });
    }

    /// The expiry of any timer.
    #[random_only("not run under Kani to its end.")]
    fn fires_a_timer() {
        let step = FROM.any_step(Kind::Expired);
        kani::cover!(step.said.has(Sort::LeaseExpired), "a lease ran out");
        kani::cover!(step.said.has(Sort::Command), "repeats a command");
        kani::cover!(step.said.has(Sort::FollowerGone), "drops a follower");
        kani::cover!(step.said.has(Sort::ManeuverFailed), "the execution limit ran out");
        kani::cover!(step.is_ignored(), "ignored");
    }
}
