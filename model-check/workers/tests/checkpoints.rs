//! A check that was ended goes on from its last checkpoint, and finds what it would have found.

mod processes;

use std::fs;
use std::path::Path;
use std::time::Duration;

use crossguard_model_check::model::Model;
use crossguard_model_check::report::CutOff;
use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::rules::NEVER_STOPS;
use crossguard_workers::{
    CheckpointError, Checkpoints, Options, WorkersError, WorkersReport, check,
};

use processes::workers;

fn trio() -> Scenario {
    let mut trio = Scenario::load("trio-corridor").unwrap();
    trio.expected = None;
    trio.bounds.losses = Some(0);
    trio
}

/// Options with a checkpoint at the end of each level.
fn keeping(number: usize, folder: &Path) -> Options {
    Options {
        checkpoints: Some(Checkpoints {
            folder: folder.to_owned(),
            every: Duration::ZERO,
        }),
        ..workers(number)
    }
}

/// The result of a check that is given up after some states again and again, and goes on each time; and how often.
fn in_pieces(model: &dyn Fn() -> Model, number: usize, folder: &Path) -> (WorkersReport, usize) {
    let mut states_max = 0;
    for pieces in 1.. {
        states_max += 40_000;
        let options = Options {
            states_max: Some(states_max),
            ..keeping(number, folder)
        };
        let report = check(&model(), &options, &mut |_| ()).unwrap();
        if report.scenario.cut_off.is_none() {
            return (report, pieces);
        }
        assert_eq!(report.scenario.cut_off, Some(CutOff::StateLimit));
    }
    unreachable!("it ends")
}

/// The names of the files with what was found.
fn kept(folder: &Path) -> Vec<String> {
    let files = fs::read_dir(folder).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.filter(|name| name.contains(".level-")).collect();
    names.sort();
    names
}

/// What must not depend on how often a check was ended.
fn found(report: &WorkersReport) -> String {
    let scenario = &report.scenario;
    let properties = scenario.properties.iter();
    let properties: Vec<_> = properties
        .map(|p| (&p.id, p.verdict, p.counterexample.len()))
        .collect();
    format!(
        "{} {} {} {properties:?} {:?}",
        scenario.unique_states, scenario.transitions, scenario.depth, scenario.transitions_taken
    )
}

#[test]
fn a_check_in_pieces_finds_what_a_whole_one_finds() {
    let model = || Model::new(trio());
    for number in [1, 3] {
        let folder = tempfile::tempdir().unwrap();
        let whole = check(&model(), &workers(number), &mut |_| ()).unwrap();
        let (report, pieces) = in_pieces(&model, number, folder.path());
        assert!(pieces > 3 && report.resumed_at.is_some_and(|level| level > 10));
        assert!(report.scenario.exhaustive);
        assert_eq!(found(&report), found(&whole));
        assert_eq!(kept(folder.path()), [""; 0]);
    }
}

#[test]
fn a_broken_property_is_shown_by_a_run_from_the_beginning() {
    let model = || Model::with_rules(trio(), NEVER_STOPS);
    let folder = tempfile::tempdir().unwrap();
    let whole = check(&model(), &workers(2), &mut |_| ()).unwrap();
    assert!(whole.scenario.failed());
    let (report, _) = in_pieces(&model, 2, folder.path());
    assert!(report.resumed_at.is_some());
    assert_eq!(found(&report), found(&whole));
}

#[test]
fn a_checkpoint_of_another_check_is_refused_and_stays() {
    let folder = tempfile::tempdir().unwrap();
    let cut = |model: Model, number| {
        let options = Options {
            states_max: Some(40_000),
            ..keeping(number, folder.path())
        };
        check(&model, &options, &mut |_| ())
    };
    cut(Model::new(trio()), 2).unwrap();
    let before = kept(folder.path());
    assert_eq!(before.len(), 2, "{before:?}");
    let mut other = trio();
    other.bounds.commands = 1;
    for refused in [cut(Model::new(other), 2), cut(Model::new(trio()), 1)] {
        let error = refused.unwrap_err();
        assert!(
            matches!(
                error,
                WorkersError::Checkpoint(CheckpointError::Other { .. })
            ),
            "{error}"
        );
    }
    assert_eq!(kept(folder.path()), before);
}

#[test]
fn two_checks_do_not_share_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let options = keeping(1, folder.path());
    let mut second = None;
    check(&Model::new(trio()), &options, &mut |_| {
        let try_it = || check(&Model::new(trio()), &options, &mut |_| ());
        second.get_or_insert_with(try_it);
    })
    .unwrap();
    // A short check is over before it is looked at.
    if let Some(second) = second {
        let error = second.unwrap_err();
        let is_refused = matches!(
            error,
            WorkersError::Checkpoint(CheckpointError::InUse { .. })
        );
        assert!(is_refused, "{error}");
    }
}

#[test]
fn a_damaged_checkpoint_ends_the_check_as_incomplete() {
    let folder = tempfile::tempdir().unwrap();
    let options = Options {
        states_max: Some(40_000),
        ..keeping(1, folder.path())
    };
    let model = Model::new(trio());
    check(&model, &options, &mut |_| ()).unwrap();
    let file = folder.path().join(&kept(folder.path())[0]);
    let octets = fs::read(&file).unwrap();
    fs::write(&file, &octets[..octets.len() - 1]).unwrap();
    let error = check(&model, &options, &mut |_| ()).unwrap_err();
    assert!(error.is_incomplete(), "{error}");
    assert!(error.to_string().contains("checkpoint"), "{error}");
}

#[test]
fn a_check_goes_on_where_no_checkpoint_can_be_written() {
    let folder = tempfile::tempdir().unwrap();
    for level in 1..100 {
        let in_the_way = format!("worker-0.level-{level}-unfinished");
        fs::create_dir(folder.path().join(in_the_way)).unwrap();
    }
    let mut kept = None;
    let options = keeping(1, folder.path());
    let report = check(&Model::new(trio()), &options, &mut |progress| {
        kept = Some(progress.kept);
    });
    assert!(report.unwrap().scenario.exhaustive);
    // A short check says nothing on its way.
    if let Some(kept) = kept {
        assert!(kept.error.is_some() && kept.level.is_none(), "{kept:?}");
    }
}
