//! Each counterexample that the checker finds in the paper's text, told to real endpoints: they
//! survive it.
//!
//! The stories are `model-check/stories/*.json`; a test there keeps them what the checker finds.

use std::path::Path;

use crossguard_endpoint::Act;
use crossguard_model_check::paper::{Hazard, Story};
use crossguard_protocol::{
    Corridor, EndReason, Ignored, Notice, Progress, Rejection, ReleaseReason, Role, State,
    StationId,
};
use crossguard_testkit::story::Street;

const ARI: u32 = 1;
const GO2: u32 = 2;

fn story(id: &str) -> Story {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../model-check/stories");
    let text = std::fs::read_to_string(folder.join(format!("{id}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Tells a story up to its end, and looks.
fn told(id: &str, look: impl FnOnce(&Street)) -> Street {
    let story = story(id);
    let mut street = Street::new(&story);
    for step in &story.steps {
        street.take(step);
    }
    look(&street);
    street
}

/// Lets the radio be clear for a while, looks again, and asserts that the trace is valid.
fn then(mut street: Street, ms: u64, look: impl FnOnce(&Street)) {
    street.clear_up(ms);
    look(&street);
    assert!(street.validate().steps > 100);
}

/// The progress of the newest acknowledged command of ARI's only follower.
fn progress(street: &Street) -> Option<Progress> {
    street.leading(ARI)?.members.iter().next()?.order?.progress
}

fn was_released(street: &Street, station: u32, why: ReleaseReason) -> bool {
    street.did(
        station,
        |act| matches!(act, Act::Notice(Notice::Released(_, reason)) if *reason == why),
    )
}

fn ended(street: &Street, station: u32, why: EndReason) -> bool {
    street.did(
        station,
        |act| matches!(act, Act::Notice(Notice::SessionEnded(_, reason)) if *reason == why),
    )
}

#[test]
fn p1_late_acknowledgement_after_fallback() {
    let street = told("p1", |street| {
        assert!(street.did(GO2, |act| matches!(act, Act::FallBack(..))));
        assert!(
            street.ignored(ARI, Ignored::NotOutstanding) > 0,
            "the late answer arrived"
        );
        assert_eq!(progress(street), Some(Progress::SafeIdle));
        assert_ne!(street.leading(ARI).unwrap().corridor, Corridor::Open);
    });
    then(street, 2_000, |street| {
        assert_eq!(street.runs(GO2), None, "what was given up is not resumed");
    });
}

#[test]
fn p2_completion_from_a_stale_ram() {
    let street = told("p2", |street| {
        assert_eq!(street.runs(GO2), Some(1));
        assert_eq!(progress(street), Some(Progress::Executing));
        assert_eq!(street.leading(ARI).unwrap().corridor, Corridor::Open);
    });
    then(street, 2_000, |street| {
        assert_eq!(street.runs(GO2), Some(1));
    });
}

#[test]
fn p3_release_that_is_the_idle_default() {
    let street = told("p3", |street| {
        assert_eq!(street.runs(GO2), Some(0));
        assert_eq!(street.robot(GO2).role(), Role::Follower);
        assert_eq!(street.leading(ARI).unwrap().corridor, Corridor::Open);
    });
    then(street, 2_000, |street| {
        assert_eq!(street.runs(GO2), Some(0));
    });
}

#[test]
fn p4_safety_timeout_that_aborts_a_long_move() {
    let street = told("p4", |street| assert_eq!(street.runs(GO2), Some(0)));
    then(street, 21_600, |street| {
        assert_eq!(street.runs(GO2), Some(0), "it lasts as long as the paper's");
        assert!(!street.did(GO2, |act| matches!(act, Act::FallBack(..))));
        assert_eq!(street.leading(ARI).unwrap().corridor, Corridor::Open);
    });
}

#[test]
fn p5_two_requesters_that_wait_for_each_other() {
    let street = told("p5", |_| ());
    then(street, 1_000, |street| {
        assert_eq!(street.robot(ARI).role(), Role::Leader);
        assert_eq!(street.robot(GO2).role(), Role::Follower);
        assert_eq!(street.leaders(), 1);
    });
}

#[test]
fn p6_duplicated_command_that_is_executed_twice() {
    let street = told("p6", |street| {
        assert_eq!(street.started(GO2).len(), 1);
        assert_eq!(street.runs(GO2), Some(0));
    });
    then(street, 2_000, |street| {
        assert_eq!(street.started(GO2).len(), 1);
    });
}

#[test]
fn p7_two_leaders_of_one_follower() {
    const NAO: u32 = 3;
    let street = told("p7", |street| {
        assert_eq!(street.robot(ARI).role(), Role::Leader);
        let not_for_it = street.ignored(GO2, Ignored::NotAddressed);
        assert!(not_for_it > 0, "Go2 has heard the offer to ARI");
        let withdrawn = EndReason::Withdrawn(StationId(ARI));
        assert!(ended(street, GO2, withdrawn), "ARI leads at its place");
    });
    then(street, 10_000, |street| {
        assert_eq!(street.robot(NAO).role(), Role::Follower);
        assert_eq!(street.leaders(), 1);
    });
}

#[test]
fn p8_request_without_end() {
    let street = told("p8", |street| {
        assert_eq!(street.robot(ARI).state(), State::HelpRequested);
    });
    then(street, 10_000, |street| {
        assert_eq!(street.robot(ARI).state(), State::Idle);
        assert!(ended(street, ARI, EndReason::NoHelp));
    });
}

#[test]
fn p9_offer_without_end() {
    let street = told("p9", |street| {
        assert_eq!(street.robot(GO2).role(), Role::Helper);
    });
    then(street, 3_000, |street| {
        assert_eq!(street.robot(GO2).state(), State::Idle);
        assert!(was_released(street, GO2, ReleaseReason::ReservationExpired));
    });
}

#[test]
fn p11_acknowledgement_of_an_earlier_association() {
    let street = told("p11", |street| {
        assert!(
            street.ignored(ARI, Ignored::OtherSession) > 0,
            "the old answer arrived"
        );
        assert_eq!(
            street.runs(GO2),
            None,
            "the new command has not arrived yet"
        );
        assert_eq!(progress(street), None);
    });
    then(street, 2_000, |street| {
        let started = street.started(GO2);
        assert_eq!(started.len(), 2);
        assert_ne!(started[0].session, started[1].session);
        assert_eq!(progress(street), Some(Progress::Executing));
    });
}

#[test]
fn p12_follower_that_broke_down_and_is_counted_on_for_ever() {
    let street = told("p12", |street| {
        assert!(street.did(ARI, |act| matches!(act, Act::OpenCorridor(_))));
    });
    then(street, 2_000, |street| {
        assert!(
            street.leading(ARI).unwrap().corridor != Corridor::Open,
            "the lease has run out"
        );
    });
    then(told("p12", |_| ()), 10_000, |street| {
        assert_eq!(street.robot(ARI).state(), State::Idle);
        assert!(ended(street, ARI, EndReason::NoFollowers));
    });
}

#[test]
fn p13_follower_that_asks_a_lost_leader_for_leave() {
    let street = told("p13", |street| {
        assert!(street.did(GO2, |act| matches!(act, Act::Notice(Notice::Released(..)))));
    });
    then(street, 2_000, |street| {
        assert_eq!(
            street.robot(GO2).state(),
            State::Idle,
            "nobody had to answer"
        );
    });
}

#[test]
fn p14_old_acknowledgement_of_a_reissued_command() {
    let street = told("p14", |street| {
        assert!(street.did(GO2, |act| matches!(act, Act::FallBack(..))));
        assert!(
            street.ignored(ARI, Ignored::NotOutstanding) > 0,
            "the old answer arrived"
        );
        assert_eq!(street.started(GO2).len(), 1, "the new command did not");
        assert_ne!(street.leading(ARI).unwrap().corridor, Corridor::Open);
    });
    then(street, 2_000, |street| {
        let is_rejected = |act: &Act| {
            let Act::Notice(Notice::CommandRejected(_, id, why)) = act else {
                return false;
            };
            (id.request.0, *why) == (1, Rejection::OnDuty)
        };
        let rejected = street.did(ARI, is_rejected);
        assert!(rejected, "it is another command, and the road is not clear");
        assert_eq!(street.started(GO2).len(), 1);
    });
}

#[test]
fn each_hazard_has_its_story_and_its_story_is_told() {
    let tests = include_str!("paper_literal.rs");
    for hazard in Hazard::ALL {
        let text = hazard.text();
        let id = text.id.to_lowercase();
        assert_eq!(story(&id).property, text.id);
        let is_told = tests.contains(&format!("let street = told(\"{id}\", "));
        assert!(is_told, "{id}");
    }
}

#[test]
#[should_panic(expected = "nobody guards the corridor")]
fn a_corridor_that_nobody_guards_is_noticed() {
    told("p3", |_| ()).stop_silently(GO2);
}
