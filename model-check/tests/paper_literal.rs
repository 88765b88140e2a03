//! The paper's text taken word for word fails as it must, and the page and the story files say what
//! the checker finds.
//!
//! `CROSSGUARD_BLESS=1` writes the files anew.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crossguard_model_check::paper::{Story, check, fails_as_it_must, page, stories};
use crossguard_model_check::report::{CheckVerdict, PropertyReport, ScenarioReport};
use serde::Serialize;

static REPORT: LazyLock<ScenarioReport> = LazyLock::new(check);

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
        "{name} is not what the checker finds; run: cargo xtask bless model-check"
    );
}

/// The file of a story: a step a line.
fn text(story: &Story) -> String {
    fn json(value: &impl Serialize) -> String {
        serde_json::to_string(value).unwrap()
    }
    let text = format!(
        "{{\n  \"property\": {},\n  \"title\": {},\n  \"robots\": {},\n  \"steps\": [\n    {}\n  ]\n}}\n",
        json(&story.property),
        json(&story.title),
        json(&story.robots),
        story
            .steps
            .iter()
            .map(json)
            .collect::<Vec<_>>()
            .join(",\n    "),
    );
    assert_eq!(serde_json::from_str::<Story>(&text).unwrap(), *story);
    text
}

#[test]
fn it_fails_as_it_must() {
    let report = &*REPORT;
    let violated: Vec<_> = report.violated().collect();
    assert!(fails_as_it_must(report), "{violated:?}");
    assert_eq!(violated.len(), 17);
    assert!(report.exhaustive);
    assert_eq!((report.unique_states, report.depth), (354_683, 35));
}

#[test]
fn a_report_that_says_anything_else_is_not_the_failure_it_must_be() {
    let report = &*REPORT;
    for i in 0..report.properties.len() {
        let mut other = report.clone();
        let verdict = &mut other.properties[i].verdict;
        *verdict = match verdict {
            CheckVerdict::Violated => CheckVerdict::Holds,
            CheckVerdict::Reachable => CheckVerdict::Unreachable,
            _ => CheckVerdict::Violated,
        };
        assert!(!fails_as_it_must(&other), "{}", other.properties[i].id);
    }
}

#[test]
fn each_counterexample_is_the_shortest() {
    let is_violated = |p: &&PropertyReport| p.verdict == CheckVerdict::Violated;
    let violated = REPORT.properties.iter().filter(is_violated);
    let steps: Vec<_> = violated.map(|p| p.counterexample.len()).collect();
    // P1 to P12, then W1 to W4 and W7.
    let hazards = [8, 14, 9, 8, 2, 8, 5, 2, 3, 7, 15, 8];
    let on_road = [8, 9, 17, 8, 7];
    assert!(steps.iter().eq(hazards.iter().chain(&on_road)), "{steps:?}");
}

#[test]
fn the_page_shows_what_the_checker_finds() {
    assert_is(&folder().join("doc/paper-literal.md"), &page());
}

#[test]
fn the_replay_files_tell_what_the_checker_finds() {
    let stories = stories();
    for story in &stories {
        let name = format!("stories/{}.json", story.property.to_lowercase());
        assert_is(&folder().join(name), &text(story));
    }
    let files = std::fs::read_dir(folder().join("stories")).unwrap();
    assert_eq!(files.count(), stories.len(), "a file for each hazard");
}
