//! `crossguard demo`, as its user runs it.

use std::process::Stdio;

use crossguard_testkit::command::*;
use serde_json::Value;

fn demo(more: &[&str]) -> std::process::Output {
    let port = two_free_ports().to_string();
    run(&[&["demo", "--speed", "50", "--port", &port], more].concat())
}

fn assert_all_well(result: &Value) {
    assert_eq!(result["trace_valid"], true, "{result}");
    assert_eq!(result["final_states"]["ARI"], "Idle", "{result}");
    assert_eq!(result["final_states"]["Go2"], "Idle", "{result}");
}

#[test]
fn the_results_have_the_papers_times_for_each_maneuver() {
    let output = demo(&["--trials", "3", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let result = json(&output);
    assert_all_well(&result);
    assert_eq!(result["crossings"], 3);
    let maneuvers = result["maneuvers"].as_array().unwrap();
    let tasks: Vec<_> = maneuvers
        .iter()
        .map(|m| m["task"].as_str().unwrap())
        .collect();
    assert_eq!(tasks, ["initialPos", "move"]);
    for maneuver in maneuvers {
        assert_eq!(maneuver["trials"], 3);
        let mean = |time: &str| maneuver[time]["mean"].as_f64().unwrap();
        assert!(
            maneuver["t_exec_s"]["sd"].as_f64().unwrap() > 0.0,
            "no two walks are alike"
        );
        assert!(mean("t_neg_s") > 0.0);
        assert!(mean("t_neg_s") < mean("round_trip_s"), "T_neg is one way");
        assert!((mean("t_tmct_s") - mean("t_neg_s") - mean("t_exec_s")).abs() < 1e-9);
    }
    // Both are planned to take as long as the paper's, give or take the gait and the ticks of the body.
    let exec = |it: &Value| it["t_exec_s"]["mean"].as_f64().unwrap();
    let (position, escort) = (exec(&maneuvers[0]), exec(&maneuvers[1]));
    assert!((0.3..3.0).contains(&position), "{position}");
    assert!((20.0..25.0).contains(&escort), "{escort}");
    let paper = |maneuver: &Value, time: &str| maneuver["paper"][time]["mean"].as_f64();
    let of_paper = |maneuver| (paper(maneuver, "t_neg_s"), paper(maneuver, "t_tmct_s"));
    assert_eq!(of_paper(&maneuvers[0]), (Some(0.074), Some(0.574)));
    assert_eq!(of_paper(&maneuvers[1]), (Some(0.129), Some(21.729)));
}

/// On cores that are busy a thread may wake up late, so one crossing of several is enough.
#[test]
fn on_sockets_t_neg_is_the_delay_that_was_put_in_to_a_millisecond() {
    const DELAY_S: f64 = 0.074;
    let beyond_s = || {
        let result = json(&demo(&["--json", "--faults", "delay=74..74"]));
        assert_all_well(&result);
        let maneuvers = result["maneuvers"].as_array().unwrap().clone();
        assert_eq!(maneuvers.len(), 2);
        let means = maneuvers
            .into_iter()
            .map(|it| it["t_neg_s"]["mean"].as_f64());
        means
            .map(|mean| mean.unwrap() - DELAY_S)
            .fold(f64::MIN, f64::max)
    };
    let mut tries = Vec::new();
    let is_close = (0..5).any(|_| {
        let beyond_s = beyond_s();
        tries.push(beyond_s);
        (0.0..0.001).contains(&beyond_s)
    });
    let is_never_early = tries.iter().all(|beyond_s| *beyond_s >= 0.0);
    assert!(is_close && is_never_early, "{tries:?}");
}

#[test]
fn a_person_sees_the_chart_the_table_and_the_verdict_on_the_log() {
    let output = demo(&[]);
    assert_eq!(output.status.code(), Some(0));
    let text = stdout(&output);
    for expected in [
        "pedestrian detected",
        "RAM needHelp",
        "RAM offerHelp",
        "RAM leader",
        "RMCM command 1#1.0/0 initialPos to 2",
        "RMCM ack 1#1.0/0",
        "corridor opened",
        "corridor closed",
        "T_TMCT [s]",
        "round trip [s]",
        "in the paper",
        "0.074 ± 0.015",
        "0.129 ± 0.102",
        "1 of 1 crossings completed; in the end ARI is Idle, Go2 is Idle.",
        "every step was one",
    ] {
        assert!(text.contains(expected), "'{expected}' is not in:\n{text}");
    }
}

#[test]
fn with_three_of_ten_datagrams_lost_the_crossing_ends_well() {
    for seed in ["1", "2"] {
        let output = demo(&["--loss", "0.3", "--seed", seed, "--json"]);
        let result = json(&output);
        assert_all_well(&result);
        let lost = result["counters"]["ARI"]["simulated"]["loss"]
            .as_u64()
            .unwrap();
        assert!(lost > 0, "{result}");
        assert_eq!(output.status.code(), Some(0), "{result}");
    }
}

#[test]
fn bursts_repetition_and_delay_are_survived_and_counted() {
    let faults = "burst=0.2x3,duplication=0.3,reordering=0.1,delay=1..20";
    let result = json(&demo(&["--faults", faults, "--json"]));
    assert_all_well(&result);
    assert_eq!(
        result["faults"],
        "duplication=0.3,reordering=0.1,burst=0.2x3,delay=1..20"
    );
    let counters = &result["counters"]["Go2"];
    assert!(counters["simulated"]["burst loss"].as_u64() > Some(0));
    assert_refused(&run(&["demo", "--faults", "rain=1"]), "no fault 'rain'");
}

#[test]
fn the_log_holds_every_step_of_both_robots() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("demo.log");
    let output = demo(&["--json", "--log", path.to_str().unwrap()]);
    let steps = json(&output)["trace"]["steps"].as_u64().unwrap();
    let log = std::fs::read_to_string(path).unwrap();
    let of_kind = |kind: &str| records(&log).iter().filter(|r| r["entry"] == kind).count() as u64;
    assert_eq!(of_kind("step"), steps);
    assert_eq!(of_kind("started"), 2);
    assert_eq!(of_kind("stopped"), 2);
    let validated = crossguard_judge::validate::one(log.as_bytes()).unwrap();
    assert_eq!(validated.steps as u64, steps);
}

#[test]
fn a_second_demo_on_the_same_port_is_refused_and_the_first_goes_on() {
    let port = two_free_ports().to_string();
    let mut first = crossguard(&["demo", "--speed", "10", "--port", &port, "--json"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    let second = run(&["demo", "--port", &port]);
    assert_refused(
        &second,
        "is in use; is another robot or demo running there?",
    );
    let first = {
        wait_for(&mut first, std::time::Duration::from_mins(1));
        first.wait_with_output().unwrap()
    };
    assert_all_well(&json(&first));
}

#[test]
fn bad_usage_is_refused_with_what_is_wanted() {
    assert_refused(
        &run(&["demo", "--speed", "0.1"]),
        "a number from 1 to 100 is wanted",
    );
    assert_refused(
        &run(&["demo", "--loss", "1.5"]),
        "a number from 0 to 0.9 is wanted",
    );
    assert_refused(
        &run(&["demo", "--trials", "0"]),
        "a whole number from 1 to 1000 is wanted",
    );
    assert_refused(
        &run(&["demo", "--log", "/no/such/folder/log"]),
        "/no/such/folder/log",
    );
    assert_refused(&run(&["dance"]), "unrecognized subcommand 'dance'");
}

#[test]
fn a_reader_that_goes_away_does_not_make_it_panic() {
    let port = two_free_ports().to_string();
    let mut child = crossguard(&["demo", "--speed", "50", "--port", &port])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    wait_for(&mut child, std::time::Duration::from_mins(1));
    let output = child.wait_with_output().unwrap();
    assert!(!stderr(&output).contains("panicked"), "{}", stderr(&output));
}
