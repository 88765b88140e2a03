//! A check of states and steps alone says of them what a whole check says.

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::report::ScenarioReport;
use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::rules::{NeedsNoConfirmation, RepeatsOnceTooOften};

/// The reports of both.
fn both<R: Rules + 'static>(scenario: &str, rules: impl Fn() -> R) -> [ScenarioReport; 2] {
    let mut scenario = Scenario::load(scenario).unwrap();
    scenario.channel.delayed = 0;
    scenario.expected = None;
    [true, false].map(|safety_only| {
        let options = Options {
            safety_only,
            ..Options::default()
        };
        let model = Model::with_rules(scenario.clone(), rules());
        check(&model, &options, &mut |_| ())
    })
}

/// Asserts that what the first report says, the second one says too, and returns what the first leaves out.
fn assert_part(safety: &ScenarioReport, whole: &ScenarioReport) -> Vec<String> {
    let size = |report: &ScenarioReport| {
        let sizes = (report.unique_states, report.depth, report.transitions);
        (sizes, report.exhaustive)
    };
    assert_eq!(size(safety), size(whole));
    let mut left_out = Vec::new();
    for property in &whole.properties {
        let Some(of_safety) = safety.properties.iter().find(|it| it.id == property.id) else {
            left_out.push(property.id.clone());
            continue;
        };
        assert_eq!(of_safety.verdict, property.verdict, "{}", property.id);
        let length = of_safety.counterexample.len();
        assert_eq!(length, property.counterexample.len(), "{}", property.id);
    }
    left_out
}

#[test]
fn runs_alone_are_left_out_and_that_is_said() {
    let [safety, whole] = both("stable", || Protocol);
    let left_out = assert_part(&safety, &whole);
    assert!(left_out.contains(&"L7".to_owned()) && left_out.contains(&"L3".to_owned()));
    let is_of_runs = left_out.iter().all(|id| id.starts_with('L'));
    assert!(is_of_runs, "{left_out:?}");
    let of_runs = "runs were not judged";
    let said = |report: &ScenarioReport| report.assumptions.join("\n").contains(of_runs);
    assert!(said(&safety) && !said(&whole));
}

#[test]
fn runs_into_broken_states_are_as_short() {
    let [safety, whole] = both("pair", || NeedsNoConfirmation);
    assert_part(&safety, &whole);
    assert_eq!(safety.violated().collect::<Vec<_>>(), ["I2"]);
    let [safety, whole] = both("pair", || RepeatsOnceTooOften);
    assert_part(&safety, &whole);
    assert_eq!(safety.violated().collect::<Vec<_>>(), ["I13", "I16"]);
}
