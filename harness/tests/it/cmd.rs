//! Outputs of commands, in the pages `tests/cmd/*.md`. `cargo xtask bless` writes the present ones.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use crossguard_testkit::command::*;

/// The files that the commands find.
fn files() -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cmd/refused.in");
    let names = folder.read_dir().unwrap().map(|it| it.unwrap().file_name());
    let names = names.filter(|it| Path::new(it).extension().is_none_or(|it| it != "lock"));
    names.map(|it| it.to_string_lossy().into_owned()).collect()
}

#[test]
fn commands_say_what_their_pages_show_and_leave_nothing_behind() {
    crossguard_harness::cli::command().debug_assert();
    let before = files();
    let cases = trycmd::TestCases::new();
    cases.case("tests/cmd/*.md").env("COLUMNS", "120");
    cases.run();
    assert_eq!(files(), before);
}

/// Whether git knows this commit in the folder of the harness.
fn knows(commit: &str) -> bool {
    let mut git = Command::new("git");
    git.args(["-C", env!("CARGO_MANIFEST_DIR"), "rev-parse", "--verify"]);
    let known = git.arg(format!("{commit}^{{commit}}")).output();
    known.is_ok_and(|it| it.status.success())
}

#[test]
fn the_version_has_the_commit_where_there_is_one() {
    let said = stdout(&run_line("--version"));
    let (name, commit) = said.trim_end().split_once(" (").unwrap_or((&said, ")"));
    let version = env!("CARGO_PKG_VERSION");
    assert_eq!(name.trim_end(), format!("crossguard {version}"));
    let commit = commit.strip_suffix(')').expect("it ends");
    let commit = commit.strip_suffix("-dirty").unwrap_or(commit);
    let is_known = if commit.is_empty() {
        !knows("HEAD")
    } else {
        knows(commit)
    };
    assert!(is_known, "{said}");
}

/// Hazard: a guard of a site without kerbs steps on the road in front of vehicles, and nobody was told that it knows no road.
#[test]
fn a_robot_that_knows_no_carriageway_says_so() {
    let checked = run_well("run --config tests/cmd/refused.in/kerbless.toml --check");
    stderr(&checked).must_have(&["no kerbs_m"]);
}

/// Hazard: a robot with a real body and real sensors leads by simulated people, and its guards leave when these are across.
#[test]
fn a_robot_that_does_not_count_the_people_of_its_sensors_says_so() {
    for (config, expected) in [
        ("ari", Some("those of a simulation")),
        ("go2", Some("at its leader's word")),
        ("kerb", None),
    ] {
        let perceived = "--perceived examples/people.jsonl --check";
        let checked = run_well(&format!("run --config examples/{config}.toml {perceived}"));
        match expected {
            Some(warning) => stderr(&checked).must_have(&[warning]),
            None => assert!(!stderr(&checked).contains("warning"), "{config}"),
        }
    }
}
