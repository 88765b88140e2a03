//! Workers find what the existing exploration finds, however many they are.

use crossguard_model_check::check;
use crossguard_model_check::model::Model;
use crossguard_model_check::report::ScenarioReport;
use crossguard_model_check::scenario::Scenario;
use crossguard_workers::{WorkersReport, check as check_by_workers};

use crate::workers;

/// The scenarios that workers can explore, with at most so many states.
fn untimed(states_max: usize) -> impl Iterator<Item = &'static str> {
    Scenario::shipped().filter(move |name| {
        let scenario = Scenario::load(name).unwrap();
        let states = scenario.expected.unwrap().unique_states;
        scenario.timed.is_none() && states <= states_max
    })
}

/// The most states that a test without patience explores.
const SMALL: usize = 120_000;

fn explored(name: &str, number: usize) -> WorkersReport {
    let model = Model::new(Scenario::load(name).unwrap());
    check_by_workers(&model, &workers(number), &mut |_| ()).unwrap()
}

/// States, depth and transitions.
fn size(report: &ScenarioReport) -> (usize, usize, usize) {
    (report.unique_states, report.depth, report.transitions)
}

fn verdicts(report: &ScenarioReport) -> Vec<String> {
    let properties = report.properties.iter();
    let verdict = |p: &crossguard_model_check::report::PropertyReport| {
        format!("{} {:?} {:?}", p.id, p.verdict, p.statement)
    };
    properties.map(verdict).collect()
}

/// A test in `model-check/tests/scenarios.rs` shows that the kit's own exploration and stateright find the size
/// that a file says.
fn assert_size_of_file(report: &WorkersReport) {
    let scenario = &report.scenario;
    let name = &scenario.name;
    let expected = Scenario::load(name).unwrap().expected.unwrap();
    let (states, depth, _) = size(scenario);
    assert_eq!(
        (states, depth),
        (expected.unique_states, expected.depth),
        "{name}"
    );
    assert_eq!(scenario.size_as_expected, Some(true));
    assert!(scenario.exhaustive && !scenario.failed(), "{name}");
}

fn assert_counts_of_workers(states_max: usize) {
    for name in untimed(states_max) {
        let one = explored(name, 1);
        assert_size_of_file(&one);
        for number in [2, 4] {
            let more = explored(name, number);
            assert_eq!(
                size(&more.scenario),
                size(&one.scenario),
                "{name} by {number}"
            );
            assert_eq!(
                verdicts(&more.scenario),
                verdicts(&one.scenario),
                "{name} by {number}"
            );
        }
    }
}

#[test]
fn one_two_and_four_workers_count_what_a_scenario_has() {
    assert!(untimed(SMALL).count() > 5);
    assert_counts_of_workers(SMALL);
}

#[test]
#[ignore = "takes a quarter of an hour"]
fn one_two_and_four_workers_count_what_each_scenario_has() {
    assert_counts_of_workers(usize::MAX);
}

#[test]
fn transitions_and_verdicts_are_those_of_the_existing_exploration() {
    for name in ["leader-crash", "stable", "lying-follower"] {
        let model = Model::new(Scenario::load(name).unwrap());
        let existing = check::check(&model, &check::Options::default(), &mut |_| ());
        let by_workers = explored(name, 2);
        assert_eq!(size(&by_workers.scenario), size(&existing), "{name}");
        let judged = |id: &str| {
            let id = id.trim_end_matches("-premise");
            !by_workers.not_judged.iter().any(|not| not == id)
        };
        let mut of_states = existing.clone();
        of_states.properties.retain(|property| judged(&property.id));
        assert_eq!(
            verdicts(&by_workers.scenario),
            verdicts(&of_states),
            "{name}"
        );
        let liveness = existing.properties.len() - of_states.properties.len();
        assert!(liveness >= by_workers.not_judged.len(), "{name}");
    }
}

#[test]
fn symmetric_robots_count_once_by_two_workers() {
    let text =
        include_str!("../../scenarios/team-of-four.toml").replace("losses = 1", "losses = 0");
    let (text, _) = text.split_once("[expected]").unwrap();
    let text = text.replacen("properties", "symmetric = [2, 3, 4]\nproperties", 1);
    let text = ["L1", "L2", "L4"]
        .iter()
        .fold(text, |text, id| text.replace(&format!("\"{id}\","), ""));
    let scenario = Scenario::parse("symmetric.toml", &text).unwrap();
    let options = check::Options {
        safety_only: true,
        ..check::Options::default()
    };
    let alone = check::check(&Model::new(scenario.clone()), &options, &mut |_| ());
    let report = check_by_workers(&Model::new(scenario), &workers(2), &mut |_| ()).unwrap();
    assert_eq!(report.scenario.unique_states, alone.unique_states);
}

#[test]
fn classes_stand_for_all_states() {
    for (name, losses) in [("team-symmetric", 0), ("trio-corridor", 0), ("pair", 0)] {
        let mut scenario = Scenario::load(name).unwrap();
        scenario.expected = None;
        scenario.bounds.losses = Some(losses);
        scenario.bounds.commands = 1;
        scenario.channel.delayed = 0;
        let model = Model::new(scenario);
        let report = check_by_workers(&model, &workers(2), &mut |_| ()).unwrap();
        let all = model.reachable().count();
        assert_eq!(report.states_of_classes, all as u64, "{name}");
        let is_symmetric = !model.scenario().symmetric.is_empty();
        assert_eq!(report.scenario.unique_states < all, is_symmetric, "{name}");
    }
}
