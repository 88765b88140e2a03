//! The shipped scenarios: every property holds, every premise is reachable, nothing was cut off, and
//! the state spaces have the sizes that their files name, by two explorations that agree.

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::report::{CheckVerdict, CutOff, ScenarioReport};
use crossguard_model_check::scenario::Scenario;

fn assert_verified(name: &str) {
    let model = Model::new(Scenario::load(name).unwrap());
    let options = Options {
        second_opinion: true,
        ..Options::default()
    };
    let report = check(&model, &options, &mut |_| ());
    assert_eq!(report.engines, ["crossguard", "stateright"]);
    assert_judged_well(name, &report);
}

/// Asserts that each property was judged, holds, and was put to the test, in all states of the size that the file names. It does not
/// ask the report whether it failed.
pub(crate) fn assert_judged_well(name: &str, report: &ScenarioReport) {
    assert!(report.exhaustive, "{name}: {:?}", report.cut_off);
    for property in &report.properties {
        let fine = matches!(
            property.verdict,
            CheckVerdict::Holds | CheckVerdict::Reachable
        );
        assert!(fine, "{name}: {property:#?}");
    }
    let found = (report.unique_states, report.depth);
    assert_eq!(
        report.size_as_expected,
        Some(true),
        "{name}: found {found:?}"
    );
}

macro_rules! shipped {
    ($($duration:ident $time:ident $test:ident $name:literal;)*) => {
        $(shipped!(@ $duration $time $test $name);)*

        #[test]
        fn the_list_says_in_which_scenarios_time_passes() {
            $(
                let is_timed = Scenario::load($name).unwrap().timed.is_some();
                assert_eq!(is_timed, stringify!($time) == "timed", $name);
            )*
        }
    };
    (@ quick plain $test:ident $name:literal) => {
        #[test]
        fn $test() {
            assert_verified($name);
        }
    };
    // Timed scenarios are verified in `timed.rs`, and long ones by `crossguard check --all`.
    (@ $duration:ident $time:ident $test:ident $name:literal) => {};
}

include!("../scenarios/list.rs");

#[test]
fn together_the_scenarios_check_every_property() {
    let mut checked: Vec<_> = Scenario::shipped()
        .flat_map(|name| Scenario::load(name).unwrap().properties)
        .collect();
    checked.sort_unstable();
    checked.dedup();
    assert!(PropertyId::all_untimed().eq(checked));
    let mut timed: Vec<_> = Scenario::shipped()
        .filter_map(|name| Scenario::load(name).unwrap().timed)
        .flat_map(|timed| timed.properties)
        .collect();
    timed.sort_unstable();
    timed.dedup();
    assert!(PropertyId::all_timed().eq(timed));
}

#[test]
fn an_exploration_that_was_cut_off_proves_nothing() {
    let model = Model::new(Scenario::load("pair").unwrap());
    let options = Options {
        states_max: Some(5_000),
        ..Options::default()
    };
    let report = check(&model, &options, &mut |_| ());
    assert!(!report.exhaustive);
    assert_eq!(report.cut_off, Some(CutOff::StateLimit));
    let mut properties = report.properties.iter();
    assert!(properties.all(|it| it.verdict != CheckVerdict::Holds));
    assert_eq!(report.size_as_expected, None);
    let size = report.unique_states;
    assert_eq!(size, 5_000, "the limit is kept to the state");
}

#[test]
fn a_check_that_somebody_stops_is_incomplete_and_says_so() {
    let model = Model::new(Scenario::load("team-of-four").unwrap());
    let options = Options::default();
    let mut told = 0;
    let report = check(&model, &options, &mut |_| {
        told += 1;
        options.stop.request();
    });
    assert!(told > 0 && !report.exhaustive);
    assert_eq!(report.cut_off, Some(CutOff::Stopped));
    assert_eq!(report.verdict("I1"), Some(CheckVerdict::Incomplete));
}

#[test]
fn a_limit_that_is_as_large_as_the_state_space_cuts_nothing_off() {
    let model = Model::new(Scenario::load("stable").unwrap());
    let states = model.scenario().expected.unwrap().unique_states;
    let explored = |states_max| {
        let options = Options {
            states_max: Some(states_max),
            ..Options::default()
        };
        check(&model, &options, &mut |_| ()).cut_off
    };
    assert_eq!(explored(states), None);
    assert_eq!(explored(states - 1), Some(CutOff::StateLimit));
}

#[test]
fn a_premise_that_is_met_nowhere_is_a_failure() {
    let text = include_str!("../scenarios/pair.toml")
        .replace("commands = 2", "commands = 0")
        .replace("delayed = 1", "delayed = 0");
    let model = Model::new(Scenario::parse("no commands", &text).unwrap());
    let report = check(&model, &Options::default(), &mut |_| ());
    let premise = report.verdict("I4-premise");
    assert_eq!(premise, Some(CheckVerdict::Unreachable));
    assert!(report.failed());
}
