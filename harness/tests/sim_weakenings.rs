//! What the simulator is good for: each rule of the protocol that it can do without is missed by it
//! within a bounded number of seeds.

#[path = "../../model-check/tests/rules/mod.rs"]
mod rules;

use crossguard_harness::sim::{Failure, Fuzz, Totals};
use crossguard_model_check::node::Rules;
use crossguard_protocol::*;
use rules::*;

/// How many seeds a weakening may take.
const SEEDS: u64 = 400;

fn fuzz(seeds: u64) -> Fuzz<'static> {
    Fuzz {
        first: 1,
        seeds,
        robots: 6,
        faults: None,
        threads: 2,
        failures_max: 1,
    }
}

fn run(rules: &'static dyn Rules, seeds: u64) -> Totals {
    fuzz(seeds).run_with(rules, &|_| true)
}

/// The same with these faults in every run.
fn assert_found_with(faults: &str, rules: &'static dyn Rules, properties: &[&str]) {
    let faults = faults.parse().unwrap();
    let fuzz = Fuzz {
        faults: Some(&faults),
        ..fuzz(SEEDS)
    };
    judge(&fuzz.run_with(rules, &|_| true), properties);
}

/// Asserts that the first property found broken under these rules is one of those that it must be.
fn assert_found(rules: &'static dyn Rules, properties: &[&str]) {
    judge(&run(rules, SEEDS), properties);
}

fn judge(totals: &Totals, properties: &[&str]) {
    let Some(Failure { seed, finding }) = totals.failures.first() else {
        panic!("not found in {SEEDS} seeds, where {properties:?} should break");
    };
    println!(
        "{:?} at seed {seed}, after {} seeds",
        finding.property, totals.seeds
    );
    assert!(
        properties.contains(&finding.property.as_str()),
        "{finding:?} instead of {properties:?}"
    );
}

#[test]
fn the_protocol_itself_breaks_nothing_in_as_many_seeds() {
    let totals = run(&crossguard_model_check::node::Protocol, SEEDS);
    assert_eq!(totals.failures, []);
    assert_eq!(totals.seeds, SEEDS);
}

#[test]
fn offers_without_numbers_are_found() {
    assert_found(&ConfirmsByStationAlone, &["I2", "I4", "I15"]);
}

#[test]
fn roles_without_confirmation_are_found() {
    assert_found(&NeedsNoConfirmation, &["I2"]);
}

#[test]
fn commands_of_any_session_are_found() {
    // It takes a command that outlives its session.
    let faults = "delay=0..4000,loss=0.1,duplication=0.3";
    assert_found_with(faults, &ObeysCommandsOfAnySession, &["I3"]);
}

#[test]
fn commands_started_twice_are_found() {
    assert_found(&StartsRepeatedCommands, &["I4", "I9", "I14"]);
}

#[test]
fn older_commands_that_are_started_are_found() {
    assert_found(&StartsOlderCommands, &["I4", "I5", "I14"]);
}

#[test]
fn any_acknowledgement_that_is_taken_is_found() {
    assert_found(&TakesAnyAcknowledgement, &["I6", "I7"]);
}

#[test]
fn progress_of_any_command_that_is_taken_is_found() {
    assert_found(&TakesAnyProgress, &["I8"]);
}

#[test]
fn a_corridor_that_does_not_close_is_found() {
    assert_found(
        &Drops(|output| matches!(output, Output::CorridorClosed(_))),
        &["I11"],
    );
}

#[test]
fn a_released_robot_that_goes_on_is_found() {
    assert_found(
        &Drops(|output| matches!(output, Output::StopManeuver(..))),
        &["I14"],
    );
}

#[test]
fn an_identity_that_is_not_locked_is_found() {
    assert_found(
        &Drops(|output| matches!(output, Output::LockIdentity)),
        &["I18"],
    );
}

#[test]
fn a_pseudonym_of_the_leader_is_found() {
    assert_found(&TakesItsLeadersPseudonym, &["I1", "I13"]);
}

#[test]
fn a_follower_that_goes_and_takes_another_with_it_is_found() {
    assert_found(&LosesTwoForOne, &["I17"]);
}

#[test]
fn one_repeat_too_many_is_found() {
    assert_found(&RepeatsOnceTooOften, &["I13", "I16"]);
}

#[test]
fn followers_without_timers_are_found() {
    assert_found(&FollowersWaitForEver, &["I10", "L4", "L5"]);
}

#[test]
fn a_leader_that_reads_no_progress_is_found_by_its_corridor_that_never_opens() {
    // It breaks no property of safety, and the execution limit ends the session in time: what shows
    // is that no run ever meets the premise of I11.
    let totals = run(&ReadsNoProgress, 100);
    assert_eq!(totals.failures, []);
    assert_eq!(totals.premises.get("I11"), None);
}
