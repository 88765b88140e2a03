//! `crossguard conform` against robots that run as processes of their own.

use std::process::Output;

use crossguard_testkit::command::*;
use serde_json::Value;

/// Tests the robot that this command starts, as one of this file; it may be late by so many ms.
fn conform(tested: &str, start: &str, slack_ms: &str, rules: &[&str]) -> Output {
    let mut arguments = vec!["conform", "--config", tested, "--start", start, "--typed"];
    arguments.extend(["--slack", slack_ms, "--json"]);
    for rule in rules {
        arguments.extend(["--rule", rule]);
    }
    run(&arguments)
}

/// The command that runs the robot of a file.
fn start_of(config: &str) -> String {
    format!(
        "'{}' run --config '{config}'",
        env!("CARGO_BIN_EXE_crossguard")
    )
}

fn rule<'a>(report: &'a Value, id: &str) -> &'a Value {
    let mut rules = report["rules"].as_array().unwrap().iter();
    rules.find(|rule| rule["rule"] == id).unwrap()
}

#[test]
fn a_robot_of_run_passes() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let robot = robot_file(folder.path(), "Go2", 2, port, port + 1);
    edit(&robot, &[("autopilot = true\n", "")]);
    let output = conform(&robot, &start_of(&robot), "2000", &["R4", "R15"]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}{}",
        stdout(&output),
        stderr(&output)
    );
    let report = json(&output);
    assert_eq!(report["robot"], 2);
    assert_eq!(report["played"], report["cases"]);
    for (id, is_weak) in [("R4", false), ("R15", true)] {
        let rule = rule(&report, id);
        assert_eq!(rule["verdict"], "pass", "{rule}");
        assert!(rule["kept"].as_u64().unwrap() > 0, "{rule}");
        assert_eq!(rule["weakEvidence"], is_weak, "{rule}");
    }
}

#[test]
fn a_robot_that_selects_too_late_fails_by_name_with_a_chart() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let tested = robot_file(folder.path(), "Go2", 2, port, port + 1);
    let robot = robot_file(folder.path(), "late", 2, port, port + 1);
    edit(&robot, &[("autopilot = true\n", "")]);
    let late = std::fs::read_to_string(&robot).unwrap() + "\n[protocol]\nt_select = 2900\n";
    std::fs::write(&robot, late).unwrap();
    let output = conform(&tested, &start_of(&robot), "500", &["R4"]);
    assert_eq!(
        output.status.code(),
        Some(1),
        "{}{}",
        stdout(&output),
        stderr(&output)
    );
    let report = json(&output);
    let rule = rule(&report, "R4");
    assert_eq!(rule["verdict"], "fail");
    let broken = &rule["broken"][0];
    assert_eq!(broken["statement"], "selects-in-time", "{broken}");
    assert!(
        broken["chart"].as_str().unwrap().contains("needHelp"),
        "{broken}"
    );
}

#[test]
fn a_robot_that_is_not_there_is_no_pass() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let robot = robot_file(folder.path(), "Go2", 2, port, port + 1);
    let output = conform(&robot, "sleep 600", "500", &["R15"]);
    assert_eq!(
        output.status.code(),
        Some(3),
        "{}{}",
        stdout(&output),
        stderr(&output)
    );
    assert_eq!(rule(&json(&output), "R15")["verdict"], "notObserved");
}
