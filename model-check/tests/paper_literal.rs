//! The paper's text taken word for word fails as it must, and the page and the replay files say what
//! the checker finds.
//!
//! `CROSSGUARD_BLESS=1` writes the files anew.

use std::path::{Path, PathBuf};

use crossguard_model_check::paper::{Replay, check, fails_as_it_must, page, replays};
use crossguard_model_check::report::Verdict;
use serde::Serialize;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Asserts that the file says this, or writes it.
fn assert_is(path: &Path, text: &str) {
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(path, text).unwrap();
    }
    let found = std::fs::read_to_string(path).unwrap_or_default();
    let name = path.file_name().unwrap().display();
    assert!(
        found == text,
        "{name} is not what the checker finds; CROSSGUARD_BLESS=1 writes it anew"
    );
}

/// The file of a replay: a step a line.
fn text(replay: &Replay) -> String {
    fn json(value: &impl Serialize) -> String {
        serde_json::to_string(value).unwrap()
    }
    let text = format!(
        "{{\n  \"property\": {},\n  \"title\": {},\n  \"robots\": {},\n  \"steps\": [\n    {}\n  ]\n}}\n",
        json(&replay.property),
        json(&replay.title),
        json(&replay.robots),
        replay
            .steps
            .iter()
            .map(json)
            .collect::<Vec<_>>()
            .join(",\n    "),
    );
    assert_eq!(serde_json::from_str::<Replay>(&text).unwrap(), *replay);
    text
}

#[test]
fn it_fails_as_it_must() {
    let report = check();
    let violated: Vec<_> = report.violated().collect();
    assert!(fails_as_it_must(&report), "{violated:?}");
    assert_eq!(violated.len(), 12);
    assert!(report.exhaustive);
    assert_eq!((report.unique_states, report.depth), (156_707, 35));
}

#[test]
fn a_report_that_says_anything_else_is_not_the_failure_it_must_be() {
    let report = check();
    for i in 0..report.properties.len() {
        let mut other = report.clone();
        let verdict = &mut other.properties[i].verdict;
        *verdict = match verdict {
            Verdict::Violated => Verdict::Holds,
            Verdict::Reachable => Verdict::Unreachable,
            _ => Verdict::Violated,
        };
        assert!(!fails_as_it_must(&other), "{}", other.properties[i].id);
    }
}

#[test]
fn each_counterexample_is_a_run_from_a_detection_or_a_delayed_ram() {
    for property in check().properties {
        if property.verdict == Verdict::Violated {
            let first = &property.counterexample[0].action;
            assert!(
                first.ends_with("pedestrian detected") || first.ends_with("(delayed)"),
                "{}: {first}",
                property.id
            );
        }
    }
}

#[test]
fn the_page_shows_what_the_checker_finds() {
    assert_is(&folder().join("doc/paper-literal.md"), &page());
}

#[test]
fn the_replay_files_tell_what_the_checker_finds() {
    let replays = replays();
    for replay in &replays {
        let name = format!("replays/{}.json", replay.property.to_lowercase());
        assert_is(&folder().join(name), &text(replay));
    }
    let files = std::fs::read_dir(folder().join("replays")).unwrap();
    assert_eq!(files.count(), replays.len(), "a file for each hazard");
}
