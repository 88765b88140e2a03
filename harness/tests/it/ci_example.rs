//! The workflow to copy (`examples/ci.yml`): its steps pass with good files, and fail with bad ones.

use std::path::Path;
use std::process::{Command, Output};

use crossguard_testkit::command::*;

use crate::check::small_scenario;

const WORKFLOW: &str = include_str!("../../examples/ci.yml");

/// Runs the step of the workflow with this name as GitHub does, in a folder; a few seeds have to do.
fn take(step: &str, folder: &Path) -> Output {
    let (_, step) = WORKFLOW.split_once(&format!("- name: {step}\n")).unwrap();
    let (_, script) = step.split_once("run: ").unwrap();
    let script = script
        .split("      - ")
        .next()
        .unwrap()
        .trim_start_matches('|');
    let script = script.replace("--seeds 200", "--seeds 2 --robots 2");
    let programs = Path::new(env!("CARGO_BIN_EXE_crossguard"))
        .parent()
        .unwrap();
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap());
    let mut bash = Command::new("bash");
    bash.args(["-e", "-c", &script]).env("PATH", path);
    bash.current_dir(folder).output().unwrap()
}

#[test]
fn every_step_passes_with_good_files_and_fails_with_a_bad_one() {
    let project = tempfile::tempdir().unwrap();
    let folder = project.path();
    for name in ["robots", "scenarios", "logs"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    let port = two_free_ports();
    robot_file(&folder.join("robots"), "ARI", 1, port, port + 1);
    std::fs::write(folder.join("scenarios/mine.toml"), small_scenario("'I2'")).unwrap();
    let log = folder.join("logs/demo.jsonl").display().to_string();
    let demo = ["demo", "--quiet", "--speed", "50", "--port"];
    let demo = run(&[&demo[..], &[&port.to_string(), "--log", &log]].concat());
    assert_code(&demo, 0);
    let steps = [
        ("A place for results", None),
        (
            "Configurations of robots",
            Some(("robots/ARI.toml", "station = 1", "station = -1")),
        ),
        (
            "Scenarios",
            Some(("scenarios/mine.toml", "['I2']", "['I2', 'I4']")),
        ),
        ("Simulated streets", None),
        (
            "Logs of real runs",
            Some((
                "logs/demo.jsonl",
                "\"entry\":\"heard\"",
                "\"entry\":\"dropped\"",
            )),
        ),
    ];
    for (step, bad) in steps {
        let output = take(step, folder);
        let said = stdout(&output) + &stderr(&output);
        assert_eq!(output.status.code(), Some(0), "{step}: {said}");
        if let Some((file, from, to)) = bad {
            let text = std::fs::read_to_string(folder.join(file)).unwrap();
            assert!(text.contains(from), "{file}: {text}");
            std::fs::write(folder.join(file), text.replacen(from, to, 1)).unwrap();
            assert_ne!(take(step, folder).status.code(), Some(0), "{step}");
        }
    }
}
