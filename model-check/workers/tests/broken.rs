//! A broken property is shown by a shortest run, which the model takes too.

use crossguard_model_check::check;
use crossguard_model_check::model::Model;
use crossguard_model_check::replay::Replay;
use crossguard_model_check::report::CheckVerdict;
use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::rules::{NEVER_CLOSES_THE_CORRIDOR, NEVER_STOPS};
use crossguard_workers::{WorkersReport, check as check_by_workers};

use crate::processes::{by_processes, workers};

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
fn two_processes_rebuild_the_run_across_them() {
    let make = || {
        let mut pair = Scenario::load("pair").unwrap();
        pair.expected = None;
        pair.channel.delayed = 0;
        Model::with_rules(pair, NEVER_CLOSES_THE_CORRIDOR)
    };
    let reports = by_processes(&make, 2, 1);
    let reports: Vec<_> = reports.into_iter().map(Result::unwrap).collect();
    let shown = |report: &WorkersReport| format!("{:?}", report.scenario.properties);
    assert_eq!(shown(&reports[0]), shown(&reports[1]));
    assert_shown(&make(), &reports[0]);
}

#[test]
fn symmetric_robots_take_their_own_places_in_the_run() {
    let mut team = Scenario::load("team-symmetric").unwrap();
    team.expected = None;
    team.bounds.losses = Some(0);
    let make = || Model::with_rules(team.clone(), NEVER_STOPS);
    for report in by_processes(&make, 2, 1) {
        let report = report.unwrap();
        for property in &report.scenario.properties {
            if let Some(replay) = Replay::of(&report.scenario, property) {
                assert!(replay.is_broken_in(&make()), "{replay:#?}");
            }
        }
    }
}
