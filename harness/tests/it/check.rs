//! `crossguard check` and `codec`, as their user runs them.

use crossguard_codec::golden;
use crossguard_testkit::command::*;

#[test]
fn check_reports_every_property_of_a_scenario_as_json() {
    let output = run_well("check contention leader-crash --json");
    let report = json(&output);
    let scenarios = report["scenarios"].as_array().unwrap();
    assert_eq!(scenarios.len(), 2);
    for scenario in scenarios {
        assert_eq!(scenario["exhaustive"], true);
        assert!(scenario["uniqueStates"].as_u64().unwrap() > 50_000);
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
fn a_timed_check_reports_the_longest_times_beside_their_bounds_also_when_it_is_cut_off() {
    let output = run_well("check timed-hang --json");
    let report = json(&output);
    let scenario = &report["scenarios"][0];
    assert_eq!(scenario["exhaustive"], true);
    let figures = scenario["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 5);
    for figure in figures {
        let (ms, bound_ms) = (figure["ms"].as_u64(), figure["boundMs"].as_u64());
        assert!(ms.is_some() && ms <= bound_ms, "{figure}");
    }
    // Findings before the limit, and the timers that bound them.
    let output = run_line("check timed-hang -v --max-states 1000");
    assert_code(&output, 3);
    let text = stdout(&output);
    text.must_have(&[
        "from a request to roles or to giving up",
        "by calculation at most 303 ms",
        "each shows 50 or 60 ms of each tick",
        "NOT exhaustive: state limit",
        "0 of 1 scenarios verified exhaustively",
    ]);
}

#[test]
fn a_scenario_of_ones_own_is_checked_and_a_property_that_is_put_to_no_test_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("my.toml");
    let check = || run(&["check", path.to_str().unwrap()]);
    std::fs::write(&path, small_scenario("'I2', 'I4'")).unwrap();
    let output = check();
    assert_code(&output, 1);
    stdout(&output).must_have(&["premise never met!"]);
    std::fs::write(&path, small_scenario("'I2'")).unwrap();
    assert_code(&check(), 0);
}

/// A scenario of a few hundred states.
pub(crate) fn small_scenario(properties: &str) -> String {
    format!(
        "name = 'small'\nsummary = 'nobody is commanded'\nproperties = [{properties}]\n\
         [[robots]]\nstation = 1\ndetects = true\n[[robots]]\nstation = 2\n\
         [request]\nfollowers = 1\ntasks = ['move']\n[bounds]\ndetections = 1\n\
         [channel]\ndelayed = 0\nloss = true\n"
    )
}

#[test]
fn the_papers_text_fails_as_it_must_and_that_is_no_failure() {
    let output = run_well("check paper-literal");
    let text = stdout(&output);
    let violated = text.matches("violated, as it must be").count();
    assert_eq!(violated, 18, "{text}");
    for id in ["P12", "P14", "W1", "W7"] {
        assert!(text.contains(&format!("{id} is broken by:")), "{text}");
    }
    text.must_have(&["paper-literal fails as it must.\n"]);
    let report = json(&run_line("check paper-literal --json"));
    assert_eq!(report["scenarios"][0]["name"], "paper-literal");
    assert!(stdout(&run_line("check --list")).contains("paper-literal"));
}

#[test]
fn messages_of_other_stations_and_whole_packets_survive_decoding_and_encoding() {
    for (file, name, kind, standard) in [
        (golden::ITS, "C4", "cam", "TS 103 900 v2.3.1"),
        (golden::ITS, "P2", "cpm", "TS 103 324 v2.1.1"),
        (golden::VAM, "V11", "vam", "TS 103 300-3 v2.3.1"),
        (golden::PACKETS, "G1", "cam", "EN 302 637-2 v1.4.1"),
    ] {
        let digits = golden::vector(file, name);
        let decoded = run(&["codec", "decode", "--hex", digits]);
        assert_code(&decoded, 0);
        let value = json(&decoded);
        assert!(value["message"][kind].is_object(), "{value}");
        assert!(value["standard"].as_str().unwrap().starts_with(standard));
        assert_eq!(value["packet"].is_object(), name.starts_with('G'));
        let encoded = run_with(&["codec", "encode"], &decoded.stdout);
        assert_eq!(stdout(&encoded).trim(), digits, "{}", stderr(&encoded));
    }
    let older = golden::vector(golden::ITS, "W2");
    let decoded = run(&["codec", "decode", "--dictionary", "2.1.1", "--hex", older]);
    assert!(json(&decoded)["message"]["vam211"].is_object());
}

#[test]
fn a_batch_has_a_line_for_each_line_and_names_those_that_are_bad() {
    let [one, other] = ["V1", "V3"].map(|name| golden::vector(golden::VAM, name));
    let text = format!("{one}\n\nxyz\n{other}\n");
    let decoded = run_with(&["codec", "decode", "--batch"], text.as_bytes());
    assert_code(&decoded, 2);
    let errors = stderr(&decoded);
    errors.must_have(&["line 3: not hexadecimal digits", "1 of 3 lines are bad"]);
    let lines = stdout(&decoded);
    let values = records(&lines);
    assert_eq!(values.len(), 3);
    assert_eq!(values[1]["line"], 3);
    assert_eq!(values[0]["octets"], 34);
    // And back: what is no message is an empty line.
    let encoded = run_with(&["codec", "encode", "--batch"], lines.as_bytes());
    assert_eq!(stdout(&encoded), format!("{one}\n\n{other}\n"));
    stderr(&encoded).must_have(&["line 2: not a message"]);
    assert_code(&encoded, 2);
    let good = run_with(&["codec", "decode", "--batch"], one.as_bytes());
    assert_code(&good, 0);
}
