//! What the simulator is good for: each rule of the protocol that it can do without is missed by it
//! within a bounded number of seeds.

use crossguard_judge::sim::{Failure, Fuzz, Totals};
use crossguard_model_check::node::Rules;
use crossguard_protocol::*;
use crossguard_testkit::rules::*;

/// How many seeds a weakening may take.
const SEEDS: u64 = 400;

fn fuzz(seeds: u64) -> Fuzz<'static> {
    Fuzz {
        first: 1,
        seeds,
        robots: 6,
        faults: None,
        plan: None,
        liars: 0.25,
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
        plan: None,
        ..fuzz(SEEDS)
    };
    judge(&fuzz.run_with(rules, &|_| true), properties);
}

/// Asserts that the first property found broken under these rules is one of the expected ones.
fn assert_found(rules: &'static dyn Rules, properties: &[&str]) {
    judge(&run(rules, SEEDS), properties);
}

/// Asserts that the property is found broken under these rules, alone or with others.
fn assert_found_among(rules: &'static dyn Rules, property: &str) {
    const PER_TRY: u64 = 20;
    let has_found = |first: &u64| {
        let fuzz = Fuzz {
            first: *first,
            failures_max: usize::MAX,
            ..fuzz(PER_TRY)
        };
        let totals = fuzz.run_with(rules, &|_| true);
        let mut failures = totals.failures.iter();
        failures.any(|failure| failure.finding.property == property)
    };
    let mut firsts = (1..=SEEDS).step_by(usize::try_from(PER_TRY).unwrap());
    assert!(firsts.any(|first| has_found(&first)), "{property}");
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
fn the_protocol_itself_breaks_nothing() {
    // Ten thousand seeds are a command of the README.
    let totals = run(&crossguard_model_check::node::Protocol, 100);
    assert_eq!(totals.failures, []);
    assert_eq!(totals.seeds, 100);
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
    assert_found(&FollowersWaitForEver, &["I10", "L4", "L5", "W7"]);
}

#[test]
fn a_leader_that_reads_no_progress_completes_no_crossing() {
    // It breaks no property of safety, and the execution limit ends the session in time.
    assert_found(&ReadsNoProgress, &["W7"]);
}

#[test]
fn a_leader_that_asks_for_too_few_lets_people_cross_unguarded() {
    assert_found_among(&AsksForFewer, "W1");
}

#[test]
fn a_guard_that_stops_where_it_is_leaves_people_on_the_road_alone() {
    assert_found_among(&StopsInPlace, "W2");
}

#[test]
fn leaders_that_do_not_hear_each_other_show_go_at_one_place() {
    assert_found_among(&HearsNoLeader, "W3");
}

#[test]
fn a_robot_that_forgets_its_duty_begins_something_new() {
    assert_found_among(&ForgetsItsDuty, "W4");
}

/// A sign that shows go for ten times as long as it is told.
struct ShowsGoForLonger;

impl Rules for ShowsGoForLonger {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let longer = |time: Millis| Millis(time.0 * 10);
        let outputs = robot.step(config, input);
        let shown = outputs.iter().map(|output| match *output {
            Output::CorridorOpened(time) => Output::CorridorOpened(longer(time)),
            Output::CorridorExtended(time) => Output::CorridorExtended(longer(time)),
            output => output,
        });
        shown.collect()
    }
}

#[test]
fn a_sign_that_does_not_end_outlasts_a_leader_that_hangs() {
    assert_found_among(&ShowsGoForLonger, "W5");
}

#[test]
fn an_application_that_is_not_told_of_a_lost_guard_is_found() {
    assert_found_among(
        &Drops(|output| {
            matches!(
                output,
                Output::Notify(Notice::LeaseExpired(_) | Notice::FollowerGone(..))
            )
        }),
        "W6",
    );
}

#[test]
fn an_application_that_gets_no_reason_is_found() {
    assert_found_among(
        &Drops(|output| matches!(output, Output::Notify(Notice::SessionEnded(..)))),
        "W8",
    );
}
