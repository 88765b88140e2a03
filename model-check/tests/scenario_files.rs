//! Scenario files: what is wrong with one is said with its line.

use crossguard_model_check::scenario::{Scenario, ScenarioError};

const PAIR: &str = include_str!("../scenarios/pair.toml");

/// The error that the pair scenario gives when one of its lines is replaced.
fn error(from: &str, to: &str) -> String {
    assert!(PAIR.contains(from), "no line '{from}'");
    Scenario::parse("my.toml", &PAIR.replacen(from, to, 1))
        .unwrap_err()
        .to_string()
}

fn line_of(text: &str) -> usize {
    PAIR.lines().position(|line| line.contains(text)).unwrap() + 1
}

#[test]
fn the_shipped_scenarios_load_by_name() {
    for name in Scenario::shipped().chain(Scenario::large()) {
        assert_eq!(Scenario::load(name).unwrap().name, name);
    }
}

#[test]
fn an_unknown_key_is_named_with_its_line() {
    let error = error("commands = 2", "comands = 2");
    assert!(error.contains("unknown field `comands`"), "{error}");
    assert!(
        error.contains(&format!("line {}", line_of("commands = 2"))),
        "{error}"
    );
}

#[test]
fn impossible_values_are_named_with_their_line() {
    let cases = [
        (
            "delayed = 1",
            "delayed = 9",
            "9 messages delayed at a time: at most 4 are possible",
        ),
        (
            "followers = 1",
            "followers = 17",
            "a request for 17 followers: between 1 and 16",
        ),
        (
            "tasks = [\"move\"]",
            "tasks = [\"fly\"]",
            "no task 'fly': initialPos, move, block",
        ),
        (
            "n_ack = 1",
            "n_ack = 0",
            "the settings break 'repeats-in-range': 1 <= n_ack <= 15",
        ),
        (
            "n_ack = 1",
            "t_lease = 1990",
            "the settings break 'lease-within-safety'",
        ),
        (
            "detects = true",
            "detects = false",
            "nothing would ever happen",
        ),
        ("station = 2", "station = 1", "two robots have station id 1"),
        (
            "station = 2",
            "station = 201",
            "station ids 1 and 201 must not differ by a multiple of 100",
        ),
        (
            "\"L4\"",
            "\"L3\"",
            "L3 speaks about cooperative scenarios only",
        ),
    ];
    for (from, to, message) in cases {
        let error = error(from, to);
        assert!(error.contains(message), "{error}");
        let line = if message.contains("station") || message.contains("nothing") {
            line_of("[[robots]]")
        } else {
            line_of(from)
        };
        assert!(
            error.starts_with(&format!("my.toml:{line}: ")),
            "line {line}: {error}"
        );
    }
}

#[test]
fn an_unknown_property_is_named_with_its_line_and_those_there_are() {
    let error = error("\"I14\"", "\"I99\"");
    assert!(error.contains("no property 'I99': I1, I2"), "{error}");
    let line = line_of("\"I14\"");
    assert!(error.starts_with(&format!("my.toml:{line}: ")), "{error}");
}

#[test]
fn a_scenario_that_is_neither_shipped_nor_a_file_is_told_apart() {
    let unknown = Scenario::load("quartet").unwrap_err();
    assert!(
        unknown.to_string().contains("the shipped ones are pair,"),
        "{unknown}"
    );
    let missing = Scenario::load("no/such/file.toml").unwrap_err();
    assert!(
        matches!(missing, ScenarioError::Unreadable { .. }),
        "{missing}"
    );
}

/// The error that the monotone pair gives when one of its lines is replaced.
fn monotone_error(from: &str, to: &str) -> String {
    let valid = include_str!("../scenarios/pair-monotone.toml");
    assert!(valid.contains(from), "no line '{from}'");
    let text = valid.replacen(from, to, 1);
    Scenario::parse("my.toml", &text).unwrap_err().to_string()
}

#[test]
fn what_does_not_fit_a_monotone_channel_is_refused() {
    let cases = [
        (
            "monotone = true",
            "monotone = true\ndelayed = 1",
            "exclude each other",
        ),
        (
            "loss = true",
            "loss = false",
            "'loss = false': a monotone channel decides about no loss",
        ),
        (
            "commands = 1",
            "commands = 1\nlosses = 1",
            "'losses': a monotone channel decides about no loss",
        ),
        (
            "heartbeats = 1",
            "",
            "'monotone = true' needs 'heartbeats = n' in [bounds]",
        ),
        (
            "offers = 2",
            "",
            "'monotone = true' needs 'offers = n' in [bounds]",
        ),
        (
            "monotone = true",
            "",
            "'heartbeats' bounds runs on a monotone channel only",
        ),
        (
            "corridor = true",
            "cooperative = true",
            "assumes that messages arrive",
        ),
        ("\"L7\"", "\"L6\"", "L6 does not hold of a monotone channel"),
    ];
    for (from, to, message) in cases {
        let error = monotone_error(from, to);
        assert!(error.contains(message), "{error}");
        assert!(error.starts_with("my.toml:"), "{error}");
    }
}

#[test]
fn an_urgency_that_is_never_used_is_refused() {
    let error = error("station = 2", "station = 2\nurgency = \"high\"");
    assert!(error.contains("robot 2 has an urgency"), "{error}");
    let line = line_of("station = 2") + 1;
    assert!(error.starts_with(&format!("my.toml:{line}: ")), "{error}");
}
