//! The workflow to copy (`examples/ci.yml`): its steps pass with good files, and fail with bad ones. What they write
//! is what a CI system reads.

use std::path::Path;
use std::process::{Command, Output};

use crossguard_testkit::command::*;

const WORKFLOW: &str = include_str!("../examples/ci.yml");

/// The scripts of the workflow's steps by their names, in order.
fn steps() -> Vec<(String, String)> {
    let mut steps: Vec<(String, String)> = Vec::new();
    for step in WORKFLOW.split("      - name: ").skip(1) {
        let (name, rest) = step.split_once('\n').unwrap();
        if let Some((_, script)) = rest.split_once("run: ") {
            steps.push((name.to_owned(), script.trim_start_matches('|').to_owned()));
        }
    }
    steps
}

/// Runs a step as GitHub does, in a folder; a few seeds have to do.
fn take(step: &str, folder: &Path) -> Output {
    let steps = steps();
    let (_, script) = steps.iter().find(|(name, _)| name == step).unwrap();
    let programs = Path::new(env!("CARGO_BIN_EXE_crossguard"))
        .parent()
        .unwrap();
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap());
    let script = script.replace("--seeds 200", "--seeds 2 --robots 2");
    let mut bash = Command::new("bash");
    bash.args(["-e", "-c", &script]).env("PATH", path);
    bash.current_dir(folder).output().unwrap()
}

const SCENARIO: &str = "\
name = 'mine'
summary = 'nobody is commanded'
properties = ['I2']
[[robots]]
station = 1
detects = true
[[robots]]
station = 2
[request]
followers = 1
tasks = ['move']
[bounds]
detections = 1
[channel]
delayed = 0
loss = true
";

fn project() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["robots", "scenarios", "logs"] {
        std::fs::create_dir(folder.path().join(name)).unwrap();
    }
    let port = two_free_ports();
    robot_file(&folder.path().join("robots"), "ARI", 1, port, port + 1);
    std::fs::write(folder.path().join("scenarios/mine.toml"), SCENARIO).unwrap();
    let log = folder.path().join("logs/demo.jsonl");
    let port = port.to_string();
    let demo = [
        "demo",
        "--quiet",
        "--speed",
        "50",
        "--port",
        &port,
        "--log",
        log.to_str().unwrap(),
    ];
    assert_eq!(run(&demo).status.code(), Some(0));
    folder
}

fn result(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join("results").join(name)).unwrap()
}

#[test]
fn every_step_passes_with_good_files_and_writes_its_results() {
    let project = project();
    let folder = project.path();
    let names: Vec<_> = steps().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names.len(), 6, "{names:?}");
    for name in names.iter().filter(|name| *name != "Install") {
        let output = take(name, folder);
        let said = format!("{}{}", stdout(&output), stderr(&output));
        assert_eq!(output.status.code(), Some(0), "{name}: {said}");
    }
    let check = result(folder, "check.xml");
    assert!(
        check.contains("<testsuite name=\"mine\" tests=\"1\""),
        "{check}"
    );
    assert!(
        check.contains("<testcase name=\"I2\" classname=\"mine\""),
        "{check}"
    );
    let fuzz = result(folder, "fuzz.xml");
    assert!(
        fuzz.contains("tests=\"1\" skipped=\"0\" errors=\"0\" failures=\"0\""),
        "{fuzz}"
    );
    let validate = result(folder, "validate.xml");
    assert!(
        validate.contains("<testcase name=\"logs/demo.jsonl\""),
        "{validate}"
    );
}

#[test]
fn each_step_fails_with_a_bad_file_and_says_so_in_its_results() {
    let project = project();
    let folder = project.path();
    take("A place for results", folder);
    let change = |name: &str, from: &str, to: &str| {
        let path = folder.join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{text}");
        std::fs::write(path, text.replacen(from, to, 1)).unwrap();
    };
    change(
        "robots/ARI.toml",
        "station = 1",
        "station = 1\nplace = [nan, 1e30]",
    );
    let output = take("Configurations of robots", folder);
    assert_refused(&output, "metres east and north");
    change("scenarios/mine.toml", "['I2']", "['I2', 'I4']");
    assert_eq!(take("Scenarios", folder).status.code(), Some(1));
    let check = result(folder, "check.xml");
    assert!(check.contains("failures=\"1\""), "{check}");
    assert!(check.contains("its premise is never met"), "{check}");
    change(
        "logs/demo.jsonl",
        "\"entry\":\"heard\"",
        "\"entry\":\"dropped\"",
    );
    let output = take("Logs of real runs", folder);
    assert_ne!(output.status.code(), Some(0), "{}", stdout(&output));
    assert!(result(folder, "validate.xml").contains("failures=\"1\""));
}

#[test]
fn a_counterexample_is_a_failure_with_its_chart() {
    let folder = tempfile::tempdir().unwrap();
    let charts = folder.path().join("charts");
    let output = run(&[
        "check",
        "paper-literal",
        "--charts",
        charts.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(0));
    let names = charts.read_dir().unwrap().map(|it| it.unwrap().file_name());
    let pictures = names
        .filter(|name| name.to_string_lossy().ends_with(".svg"))
        .count();
    assert!(pictures >= 13, "{pictures}");
}
