//! The predicates of the theorem, on states that are reached: they hold there, so a proof from them is about the robots
//! that run, and what breaks a property of safety breaks them.

mod budgets;
mod runs;

use std::panic::{AssertUnwindSafe, catch_unwind};

use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::laws::exchange::History;
use crossguard_testkit::rules::*;
use proptest::test_runner::{RngAlgorithm, TestRng};
use runs::{Run, follow};

/// Reads one fact.
type IsKnown = fn(&History) -> bool;

/// Runs of so many steps, and what was known and what was not at their ends.
fn walk(scenario: &Scenario, rules: &dyn Rules, seeds: std::ops::Range<u8>) -> Vec<History> {
    let mut histories = Vec::new();
    for seed in seeds {
        let mut random = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
        let mut run = Run::new(scenario, rules);
        for _ in 0..600 {
            run.go_on(&mut random);
        }
        for exchange in run.exchanges() {
            histories.push(follow(&exchange, &run.entries));
        }
    }
    histories
}

#[test]
fn it_holds_in_all_short_runs_of_a_pair() {
    let scenario = Scenario::load("pair").unwrap();
    let met = runs::all::explore(&scenario, 9);
    println!("{} histories", met.len());
    assert!(met.iter().any(|history| history.started));
    assert!(met.iter().any(|history| history.left && !history.started));
}

#[test]
fn it_holds_in_runs_of_every_scenario() {
    let mut histories = Vec::new();
    for name in Scenario::quick() {
        let scenario = Scenario::load(name).unwrap();
        if scenario.timed.is_none() {
            println!("{name}");
            histories.extend(walk(&scenario, &Protocol, 0..40));
        }
    }
    println!("{} exchanges", histories.len());
    let facts: [(&str, IsKnown); 16] = [
        ("requested", |h| h.requested),
        ("ended", |h| h.ended),
        ("listed", |h| h.listed.is_some()),
        ("dropped", |h| h.dropped),
        ("commanded", |h| h.commanded.is_some()),
        ("offered", |h| h.offered),
        ("joined", |h| h.joined),
        ("left", |h| h.left),
        ("accepted", |h| h.accepted),
        ("refused", |h| h.refused),
        ("started", |h| h.started),
        ("newer_started", |h| h.newer_started),
        ("in_position", |h| h.in_position),
        ("completed", |h| h.completed),
        ("fell_back", |h| h.fell_back),
        ("over", |h| h.over),
    ];
    for (name, is_known) in facts {
        let known = histories.iter().filter(|history| is_known(history)).count();
        println!("{name}: {known}");
        assert!(known > 0, "{name} is never known");
        assert!(
            name == "requested" || known < histories.len(),
            "{name} is always known"
        );
    }
}

/// Whether `what` is the first that a transition function breaks in some run of this scenario.
fn breaks(scenario: &str, rules: &dyn Rules, what: &str) -> bool {
    let scenario = Scenario::load(scenario).unwrap();
    (0..u8::MAX).any(|seed| {
        let run = AssertUnwindSafe(|| walk(&scenario, rules, seed..seed + 1));
        let panic = catch_unwind(run).err();
        panic.is_some_and(|panic| panic.downcast_ref::<&str>() == Some(&what))
    })
}

/// The weakenings of `weakenings.rs` that break a property of safety which is one of an exchange, with the properties that
/// they break there, and what each breaks here.
#[test]
fn it_does_not_hold_without_a_rule_that_it_rests_on() {
    let disagree = "state and facts disagree";
    let weakenings: [(&str, &dyn Rules, &str, &str); 14] = [
        ("I2, I15", &ConfirmsByStationAlone, "pair-reboot", disagree),
        (
            "I2",
            &NeedsNoConfirmation,
            "pair",
            "I2, I3, I6: facts disagree",
        ),
        (
            "I3",
            &ObeysCommandsOfAnySession,
            "pair-reboot",
            "I3: starts what was not commanded",
        ),
        (
            "I4, I9",
            &StartsRepeatedCommands,
            "pair",
            "I4, I9: starts twice",
        ),
        // A leader waits for the answer to each command, so that an older one was started before.
        ("I5", &StartsOlderCommands, "pair", "I4, I9: starts twice"),
        (
            "I6",
            &StartsBeforeItAcknowledges,
            "pair",
            "I6: starts before it accepts",
        ),
        (
            "I6, I7",
            &TakesAnyAcknowledgement,
            "pair",
            "I6: counts as accepted",
        ),
        ("I8", &TakesAnyProgress, "pair", "I8: counts as in position"),
        ("I14", &NEVER_STOPS, "pair", disagree),
        (
            "I1, I2, I6",
            &TakesItsLeadersPseudonym,
            "pair",
            "a fact of another robot",
        ),
        (
            "C2",
            &CountsOneForAll,
            "trio",
            "I17: another robot touches the record",
        ),
        ("C3", &AdmitsWhoSaysThatItFollows, "trio", disagree),
        (
            "I17",
            &LosesTwoForOne,
            "trio",
            "I17: another robot touches the record",
        ),
        (
            "I18",
            &NEVER_LOCKS_ITS_IDENTITY,
            "offer-race",
            "I18: the station id is not locked",
        ),
    ];
    for (properties, rules, scenario, what) in weakenings {
        assert!(breaks(scenario, rules, what), "{properties}, in {scenario}");
    }
}
