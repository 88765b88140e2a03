//! `crossguard conform` against robots that run as processes of their own.

use std::process::Output;

use crossguard_testkit::command::*;
use serde_json::Value;

/// Tests the robot that this command starts, as one of this file, with `more` arguments.
fn conform(tested: &str, start: &str, more: &[&str]) -> Output {
    let arguments = ["conform", "--config", tested, "--start", start, "--typed"];
    run(&[&arguments[..], &["--json"], more].concat())
}

/// The command that runs the robot of a file, with `more` arguments.
fn start_of(config: &str, more: &str) -> String {
    format!(
        "'{}' run --config '{config}' {more}",
        env!("CARGO_BIN_EXE_crossguard")
    )
}

fn rule<'a>(report: &'a Value, id: &str) -> &'a Value {
    let mut rules = report["rules"].as_array().unwrap().iter();
    rules.find(|rule| rule["rule"] == id).unwrap()
}

#[test]
fn a_robot_of_run_that_signs_passes() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let robot = robot_file(folder.path(), "Go2", 2, port, port + 1);
    edit(&robot, &[("autopilot = true\n", "")]);
    let pki = folder.path().join("pki").to_str().unwrap().to_owned();
    let robots = "--robot Go2=2 --robot Ada --robot Bo";
    run_well(&format!("pki init {pki} {robots}"));
    let security = ["--security", "enforce", "--pki", &pki];
    let start = start_of(&robot, &format!("--security enforce --pki '{pki}'"));
    let asked = ["--slack", "2000", "--rule", "R4", "--rule", "R5"];
    let output = conform(&robot, &start, &[&security[..], &asked].concat());
    assert_code(&output, 0);
    let report = json(&output);
    assert_eq!(report["robot"], 2);
    assert_eq!(report["played"], report["cases"]);
    for id in ["R4", "R5"] {
        let rule = rule(&report, id);
        assert_eq!(rule["verdict"], "pass", "{rule}");
        assert!(rule["kept"].as_u64().unwrap() > 0, "{rule}");
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
    let asked = ["--slack", "2000", "--rule", "R5"];
    let output = conform(&tested, &start_of(&robot, ""), &asked);
    assert_code(&output, 1);
    let report = json(&output);
    let rule = rule(&report, "R5");
    assert_eq!(rule["verdict"], "fail");
    let mut broken = rule["broken"].as_array().unwrap().iter();
    let broken = broken.find(|it| it["statement"] == "requests-end-at-t-help");
    let broken = broken.unwrap_or_else(|| panic!("{rule}"));
    broken["chart"].as_str().unwrap().must_have(&["needHelp"]);
}

#[test]
fn a_robot_that_is_not_there_is_no_pass() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let robot = robot_file(folder.path(), "Go2", 2, port, port + 1);
    let output = conform(&robot, "sleep 600", &["--rule", "R5"]);
    assert_refused(&output, "station 2 says nothing");
}

#[test]
fn the_list_says_what_is_not_judged() {
    let text = stdout(&run_line("conform --list --rule R16"));
    text.must_have(&["go-is-shown-over-guards", "not judged: the sign"]);
    let text = stdout(&run_line("conform --list --rule R5"));
    assert!(!text.contains("not judged"), "{text}");
}
