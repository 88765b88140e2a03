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
    let output = conform(&robot, &start_of(&robot), "2000", &["R4", "R5"]);
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
    for id in ["R4", "R5"] {
        let rule = rule(&report, id);
        assert_eq!(rule["verdict"], "pass", "{rule}");
        assert!(rule["kept"].as_u64().unwrap() > 0, "{rule}");
        assert_eq!(rule["weakEvidence"], false, "{rule}");
    }
}

#[test]
fn a_request_that_ends_too_soon_fails_by_name_with_a_chart() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let tested = robot_file(folder.path(), "Go2", 2, port, port + 1);
    let robot = robot_file(folder.path(), "early", 2, port, port + 1);
    edit(&robot, &[("autopilot = true\n", "")]);
    let early = std::fs::read_to_string(&robot).unwrap() + "\n[protocol]\nt_help = 4000\n";
    std::fs::write(&robot, early).unwrap();
    let output = conform(&tested, &start_of(&robot), "500", &["R5"]);
    assert_eq!(
        output.status.code(),
        Some(1),
        "{}{}",
        stdout(&output),
        stderr(&output)
    );
    let report = json(&output);
    let rule = rule(&report, "R5");
    assert_eq!(rule["verdict"], "fail");
    let broken = &rule["broken"][0];
    assert_eq!(broken["statement"], "requests-end-at-t-help", "{broken}");
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
    let output = conform(&robot, "sleep 600", "500", &["R5"]);
    assert_refused(&output, "station 2 says nothing");
}

#[test]
fn the_list_says_which_passes_are_weak_evidence_and_what_is_not_judged() {
    let text = stdout(&run(&["conform", "--list", "--rule", "R16"]));
    assert!(text.contains("a pass is weak evidence"), "{text}");
    assert!(text.contains("not judged: the sign"), "{text}");
    let text = stdout(&run(&["conform", "--list", "--rule", "R5"]));
    assert!(!text.contains("weak evidence"), "{text}");
}
