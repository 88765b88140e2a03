//! The paper's text taken word for word fails as it must, and the page and the replay files say what
//! the checker finds.
//!
//! `CROSSGUARD_BLESS=1` writes the files anew.

use std::path::{Path, PathBuf};

use crossguard_model_check::paper::{Hazard, check, fails_as_it_must, page, replays};
use crossguard_model_check::report::Verdict;

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

#[test]
fn it_fails_as_it_must() {
    let report = check();
    for property in &report.properties {
        println!("{} {:?}", property.id, property.verdict);
        for step in &property.counterexample {
            println!("    {} {:?}", step.action, step.outputs);
        }
    }
    assert!(
        fails_as_it_must(&report),
        "{:?}",
        report.violated().collect::<Vec<_>>()
    );
    let found = (report.unique_states, report.depth);
    println!("{found:?} {}", report.seconds);
}

#[test]
fn the_page_shows_what_the_checker_finds() {
    assert_is(&folder().join("doc/paper-literal.md"), &page());
}

#[test]
fn the_replay_files_tell_what_the_checker_finds() {
    for replay in replays() {
        let name = format!("replays/{}.json", replay.property.to_lowercase());
        let text = serde_json::to_string_pretty(&replay).unwrap() + "\n";
        assert_is(&folder().join(name), &text);
    }
}
