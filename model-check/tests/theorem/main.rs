//! The predicates of the theorem, on states that are reached: they hold there, so a proof from them is about the robots
//! that run, and what breaks a property of safety breaks them.

mod budgets;
mod leases;
mod runs;

use std::panic::{AssertUnwindSafe, catch_unwind};

use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::laws::exchange::{Heard, History};
use crossguard_testkit::rules::*;
use runs::{Followed, Run, follow};

/// Reads one fact.
type IsKnown = fn(&History) -> bool;

/// Runs, and what was known and what was not at their ends.
fn walk(scenario: &Scenario, rules: &dyn Rules, seeds: std::ops::Range<u8>) -> Vec<Followed> {
    let mut followed = Vec::new();
    for seed in seeds {
        let run = Run::drawn(scenario, rules, seed);
        for exchange in run.exchanges() {
            followed.push(follow(&scenario.config, &exchange, &run.entries));
        }
    }
    followed
}

#[test]
fn it_holds_in_runs_of_every_scenario() {
    let mut followed = Vec::new();
    for name in Scenario::quick() {
        let scenario = Scenario::load(name).unwrap();
        if scenario.timed.is_none() {
            println!("{name}");
            followed.extend(walk(&scenario, &Protocol, 0..40));
        }
    }
    println!("{} exchanges", followed.len());
    let corridors: usize = followed.iter().map(|it| it.corridors).sum();
    println!("{corridors} steps with an open corridor");
    assert!(corridors > 0, "no corridor rests on anybody");
    let histories: Vec<_> = followed.iter().map(|it| it.history).collect();
    let facts: [(&str, IsKnown); 19] = [
        ("requested", |h| h.requested),
        ("ended", |h| h.ended),
        ("listed", |h| h.listed.is_some()),
        ("dropped", |h| h.dropped),
        ("beaten", |h| h.beaten),
        ("commanded", |h| h.commanded.is_some()),
        ("offered", |h| h.offered),
        ("joined", |h| h.joined),
        ("left", |h| h.left),
        ("heard before the end", |h| {
            h.heard == Some(Heard::BeforeTheEnd)
        }),
        ("heard after the end", |h| {
            h.heard == Some(Heard::AfterTheEnd)
        }),
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

/// The weakenings of `weakenings.rs`, and those of leases, that break a property of safety which is one of an exchange, with the properties that
/// they break there, and what each breaks here.
#[test]
fn it_does_not_hold_without_a_rule_that_it_rests_on() {
    let disagree = "state and facts disagree";
    let on_heartbeats = "I10: state and facts disagree on heartbeats";
    #[rustfmt::skip]
    let weakenings: [(&str, &dyn Rules, &str, &str); 19] = [
        ("I2, I15", &ConfirmsByStationAlone, "pair-reboot", disagree),
        ("I2", &NeedsNoConfirmation, "pair", "I2, I3, I6, I10: facts disagree"),
        ("I3", &ObeysCommandsOfAnySession, "pair-reboot", "I3: starts what was not commanded"),
        ("I4, I9", &StartsRepeatedCommands, "pair", "I4, I9: starts twice"),
        // A leader waits for the answer to each command, so that an older one was started before.
        ("I5", &StartsOlderCommands, "pair", "I4, I9: starts twice"),
        ("I6", &StartsBeforeItAcknowledges, "pair", "I6: starts before it accepts"),
        ("I6, I7", &TakesAnyAcknowledgement, "pair", "I6: counts as accepted"),
        ("I8", &TakesAnyProgress, "pair", "I8: counts as in position"),
        ("I14", &NEVER_STOPS, "pair", disagree),
        ("I1, I2, I6", &TakesItsLeadersPseudonym, "pair", "a fact of another robot"),
        ("C2", &CountsOneForAll, "trio", "I17: another robot touches the record"),
        ("C3", &AdmitsWhoSaysThatItFollows, "trio", disagree),
        ("I17", &LosesTwoForOne, "trio", "I17: another robot touches the record"),
        ("I10", &leases::CountsWhatWasNotEchoed, "pair", on_heartbeats),
        ("I10", &leases::HearsWhatWasNotSent, "pair", "I2, I3, I6, I10: facts disagree"),
        ("I10, I11", &ReadsNoProgress, "pair", on_heartbeats),
        ("I10", &leases::CountsFromTheArrival, "pair", "I10: a lease outlasts the heartbeat that it counts from"),
        ("I10", &leases::LosesContactEarly, "pair", "I10: contact is shortened"),
        ("I18", &NEVER_LOCKS_ITS_IDENTITY, "offer-race", "I18: the station id is not locked"),
    ];
    for (properties, rules, scenario, what) in weakenings {
        assert!(breaks(scenario, rules, what), "{properties}, in {scenario}");
    }
}
