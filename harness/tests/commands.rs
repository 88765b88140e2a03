//! `crossguard check`, `fsm` and `codec`, as their user runs them.

mod support;

use serde_json::Value;
use support::*;

#[test]
fn check_reports_every_property_of_a_scenario_as_json() {
    let output = run(&["check", "offer-race", "trio", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let report = json(&output);
    let scenarios = report["scenarios"].as_array().unwrap();
    assert_eq!(scenarios.len(), 2);
    for scenario in scenarios {
        assert_eq!(scenario["exhaustive"], true);
        assert!(scenario["unique_states"].as_u64().unwrap() > 100_000);
        assert!(scenario["depth"].as_u64().unwrap() > 10);
        assert!(scenario["seconds"].as_f64().unwrap() > 0.0);
        for property in scenario["properties"].as_array().unwrap() {
            let verdict = property["verdict"].as_str().unwrap();
            let expected = if property["kind"] == "premise" {
                "reachable"
            } else {
                "holds"
            };
            assert_eq!(verdict, expected, "{property}");
        }
    }
}

#[test]
fn a_timed_check_reports_the_longest_times_beside_their_bounds() {
    let output = run(&["check", "timed-pair", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let report = json(&output);
    let scenario = &report["scenarios"][0];
    assert_eq!(scenario["exhaustive"], true);
    let figures = scenario["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 4);
    for figure in figures {
        let (ms, bound_ms) = (figure["ms"].as_u64(), figure["bound_ms"].as_u64());
        assert!(ms > Some(0) && ms <= bound_ms, "{figure}");
    }
    assert_refused(
        &run(&[
            "check",
            "timed-pair",
            "--export",
            "dot",
            "--output",
            "no-graph.dot",
        ]),
        "'timed-pair' is a timed scenario",
    );
    // What was found before the limit, and by which timers it is bounded.
    let output = run(&["check", "timed-pair", "--max-states", "1000"]);
    assert_eq!(output.status.code(), Some(3));
    let text = stdout(&output);
    assert!(
        text.contains("from a request to roles or to giving up"),
        "{text}"
    );
    assert!(text.contains("by calculation at most 242 ms"), "{text}");
    assert!(
        text.contains("each shows 50 or 60 ms of each tick"),
        "{text}"
    );
}

#[test]
fn a_check_that_is_cut_off_says_so_and_exits_with_3() {
    let output = run(&["check", "pair", "--max-states", "10000"]);
    assert_eq!(output.status.code(), Some(3));
    let text = stdout(&output);
    assert!(text.contains("NOT exhaustive: state limit"), "{text}");
    assert!(
        text.contains("0 of 1 scenarios verified exhaustively"),
        "{text}"
    );
    let output = run(&["check", "pair-reboot", "--timeout", "1", "--json"]);
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(json(&output)["scenarios"][0]["exhaustive"], false);
}

#[test]
fn a_scenario_of_ones_own_is_checked_and_a_property_that_is_put_to_no_test_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("my.toml");
    let text = "name = 'mine'\nsummary = 'nobody is commanded'\nproperties = ['I2', 'I4']\n\
                [[robots]]\nstation = 1\ndetects = true\n[[robots]]\nstation = 2\n\
                [request]\nfollowers = 1\ntasks = ['move']\n[bounds]\ndetections = 1\n\
                [channel]\ndelayed = 0\nloss = true\n";
    std::fs::write(&path, text).unwrap();
    let output = run(&["check", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    let printed = stdout(&output);
    assert!(printed.contains("premise never met!"), "{printed}");
    std::fs::write(&path, text.replace(", 'I4'", "")).unwrap();
    assert_eq!(
        run(&["check", path.to_str().unwrap()]).status.code(),
        Some(0)
    );
}

#[test]
fn bad_scenarios_are_refused_before_any_is_checked() {
    assert_refused(&run(&["check", "trio", "quartet"]), "no scenario 'quartet'");
    assert_refused(&run(&["check", "no-such-file.toml"]), "no-such-file.toml");
    assert!(run(&["check", "trio", "quartet"]).stdout.is_empty());
}

#[test]
fn the_shipped_scenarios_are_listed() {
    let text = stdout(&run(&["check", "--list"]));
    for name in crossguard_model_check::scenario::Scenario::shipped() {
        assert!(text.contains(name), "{text}");
    }
}

#[test]
fn the_state_diagram_has_the_papers_states_in_every_format() {
    for format in ["mermaid", "dot", "json"] {
        let output = run(&["fsm", "--format", format]);
        assert_eq!(output.status.code(), Some(0));
        let text = stdout(&output);
        for state in [
            "Idle",
            "HelpRequested",
            "RoleEstablished",
            "ManeuverExecuting",
        ] {
            assert!(text.contains(state), "{state} is not in:\n{text}");
        }
    }
    let transitions: Value = json(&run(&["fsm", "--format", "json"]));
    let starts = transitions.as_array().unwrap().iter().any(|transition| {
        transition["from"] == "RoleEstablished_follower"
            && transition["to"] == "ManeuverExecuting_follower"
            && transition["on"] == serde_json::json!(["RMCM command"])
    });
    assert!(starts, "{transitions}");
}

#[test]
fn the_readmes_state_diagram_is_the_one_that_the_code_makes() {
    let readme = include_str!("../../README.md");
    let diagram = stdout(&run(&["fsm"]));
    assert!(
        readme.contains(diagram.trim()),
        "put this into README.md:\n{diagram}"
    );
}

/// A message as the demo sends it.
fn a_message() -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log");
    let port = two_free_ports().to_string();
    run(&[
        "demo",
        "--speed",
        "50",
        "--port",
        &port,
        "--json",
        "--log",
        path.to_str().unwrap(),
    ]);
    let log = std::fs::read_to_string(path).unwrap();
    let sent = records(&log)
        .into_iter()
        .find(|record| record["message"] == "RMCM")
        .unwrap();
    sent["octets"].as_str().unwrap().to_owned()
}

#[test]
fn a_message_of_the_demo_survives_decoding_and_encoding() {
    let digits = a_message();
    let decoded = run(&["codec", "decode", "--hex", &digits]);
    assert_eq!(decoded.status.code(), Some(0), "{}", stderr(&decoded));
    let value = json(&decoded);
    assert_eq!(value["octets"], digits.len() / 2);
    let encoded = run_with(&["codec", "encode"], &decoded.stdout);
    assert_eq!(stdout(&encoded).trim(), digits);
    // The same through octets.
    let octets = run_with(&["codec", "encode", "--binary"], &decoded.stdout).stdout;
    let again = run_with(&["codec", "decode", "--binary"], &octets);
    assert_eq!(again.stdout, decoded.stdout);
}

#[test]
fn what_is_no_message_is_refused_with_the_field_or_the_cause() {
    let good = a_message();
    let refused = |digits: &str, cause: &str| {
        assert_refused(&run(&["codec", "decode", "--hex", digits]), cause);
    };
    refused(
        "01f1",
        "2 octets are too few for the header of a message, which has 6",
    );
    refused(&good[..good.len() - 8], "the message ends within it");
    refused(
        &format!("{good}00"),
        "1 octets follow the end of the message",
    );
    refused(
        &format!("09{}", &good[2..]),
        "protocolVersion 9 of RMCM is unknown, 1 is known",
    );
    refused("0202000000050000", "messageId 2 is not that of RAM or RMCM");
    refused("xyz", "not hexadecimal digits");
    assert_refused(&run_with(&["codec", "encode"], b"{"), "not JSON");
    assert_refused(
        &run_with(&["codec", "encode"], b"{\"cam\": {}}"),
        "not a message",
    );
    assert_refused(&run(&["codec", "decode", "no-such-file"]), "no-such-file");
}
