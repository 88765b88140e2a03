//! A broken property is shown by a shortest run, which the model takes too.

use crossguard_model_check::check;
use crossguard_model_check::model::Model;
use crossguard_model_check::replay::Replay;
use crossguard_model_check::report::CheckVerdict;
use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::rules::{Drops, NEVER_STOPS};
use crossguard_workers::{WorkersError, WorkersReport, check as check_by_workers};

use crate::workers;

/// Asserts that a report shows each broken property by a run that breaks it, as short as the existing check's.
fn assert_shown(model: &Model, report: &WorkersReport) {
    let options = check::Options::default();
    let existing = check::check(model, &options, &mut |_| ());
    let broken: Vec<_> = report.scenario.violated().collect();
    let judged = |id: &&str| !report.not_judged.iter().any(|not| not == id);
    assert_eq!(
        broken,
        existing.violated().filter(judged).collect::<Vec<_>>()
    );
    assert!(!broken.is_empty());
    for property in &report.scenario.properties {
        if property.verdict != CheckVerdict::Violated {
            continue;
        }
        let replay = Replay::of(&report.scenario, property).unwrap();
        assert!(replay.is_broken_in(model), "{replay:#?}");
        let protocol = Model::new(model.scenario().clone());
        assert!(!replay.is_broken_in(&protocol), "{replay:#?}");
        let before = existing
            .properties
            .iter()
            .find(|p| p.id == property.id)
            .unwrap();
        assert!(property.counterexample.len() <= before.counterexample.len());
    }
}

fn trio() -> Scenario {
    let mut trio = Scenario::load("trio").unwrap();
    trio.expected = None;
    trio.channel.delayed = 0;
    trio.bounds.losses = Some(1);
    trio
}

#[test]
fn one_and_three_workers_show_a_shortest_run() {
    let model = Model::with_rules(trio(), NEVER_STOPS);
    let lengths = [1, 3].map(|number| {
        let report = check_by_workers(&model, &workers(number), &mut |_| ()).unwrap();
        assert_shown(&model, &report);
        let lengths = report
            .scenario
            .properties
            .iter()
            .map(|p| p.counterexample.len());
        lengths.collect::<Vec<_>>()
    });
    assert_eq!(lengths[0], lengths[1]);
}

#[test]
fn symmetric_robots_take_their_own_places_in_the_run() {
    let mut team = Scenario::load("team-symmetric").unwrap();
    team.expected = None;
    team.bounds.losses = Some(0);
    let model = Model::with_rules(team, NEVER_STOPS);
    let report = check_by_workers(&model, &workers(2), &mut |_| ()).unwrap();
    for property in &report.scenario.properties {
        if let Some(replay) = Replay::of(&report.scenario, property) {
            assert!(replay.is_broken_in(&model), "{replay:#?}");
        }
    }
}

#[test]
fn workers_do_not_wait_for_one_that_has_ended_early() {
    for number in [1, 2, 4] {
        let panics = Drops(|_| panic!("no step can be computed"));
        let model = Model::with_rules(trio(), panics);
        let lost = check_by_workers(&model, &workers(number), &mut |_| ());
        assert!(matches!(lost, Err(WorkersError::Lost)), "{number}");
    }
}
