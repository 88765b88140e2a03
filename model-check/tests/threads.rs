//! The result of a check depends on no number of threads: sizes, verdicts, figures, and counterexamples step by step.

use std::num::NonZeroUsize;

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::report::ScenarioReport;
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::timed;
use crossguard_testkit::rules::FollowersWaitForEver;
use serde_json::Value;

/// A report without its cost.
fn found(report: &ScenarioReport) -> Value {
    let mut found = serde_json::to_value(report).unwrap();
    let report = found.as_object_mut().unwrap();
    report.remove("seconds");
    found
}

/// Asserts that a check with one, two and five threads finds the same in more states than a thread takes at a time.
fn assert_same(check: impl Fn(&Options) -> ScenarioReport) -> ScenarioReport {
    let with = |threads: usize| {
        check(&Options {
            threads: NonZeroUsize::new(threads).unwrap(),
            ..Options::default()
        })
    };
    let alone = with(1);
    assert!(alone.unique_states > 256, "{}", alone.unique_states);
    for threads in [2, 5] {
        assert_eq!(found(&with(threads)), found(&alone), "{threads} threads");
    }
    alone
}

#[test]
fn of_a_scenario() {
    let text = include_str!("../scenarios/pair.toml")
        .replace("commands = 2", "commands = 1")
        .replace("delayed = 1", "delayed = 0");
    let scenario = Scenario::parse("a smaller pair", &text).unwrap();
    let report = assert_same(|options| check(&Model::new(scenario.clone()), options, &mut |_| ()));
    assert_eq!(report.violated().count(), 0);
    assert!(report.exhaustive);
}

#[test]
fn of_a_protocol_that_breaks_its_properties() {
    let mut scenario = Scenario::load("leader-crash").unwrap();
    scenario.channel.delayed = 0;
    scenario.expected = None;
    let report = assert_same(|options| {
        let model = Model::with_rules(scenario.clone(), FollowersWaitForEver);
        check(&model, options, &mut |_| ())
    });
    let lassos = report
        .properties
        .iter()
        .filter(|property| property.repeats_after.is_some());
    assert!(report.violated().count() > lassos.clone().count() && lassos.count() > 0);
}

#[test]
fn of_a_search_that_ends_where_something_breaks() {
    let mut scenario = Scenario::load("leader-crash").unwrap();
    scenario.expected = None;
    let report = assert_same(|options| {
        let model = Model::with_rules(scenario.clone(), FollowersWaitForEver);
        let options = Options {
            states_max: Some(5_000),
            ..options.clone()
        };
        check(&model, &options, &mut |_| ())
    });
    assert_eq!(report.unique_states, 5_000);
}

#[test]
fn of_a_timed_scenario() {
    let scenario = Scenario::load("timed-rivals").unwrap();
    let report = assert_same(|options| {
        let model = timed::TimedModel::new(scenario.clone()).expect("a timed scenario");
        timed::check(&model, options, &mut |_| ())
    });
    assert!(report.exhaustive && !report.figures.is_empty());
}
