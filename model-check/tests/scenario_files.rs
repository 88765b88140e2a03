//! Scenario files: what is wrong with one is said with its line.

use std::path::Path;

use crossguard_model_check::scenario::{Scenario, ScenarioError};
use crossguard_model_check::subject::Subject;

const PAIR: &str = include_str!("../scenarios/pair.toml");

/// A text of a scenario, a wrong text in its place, the place of the mistake (empty for that text), and the message.
pub(crate) type Mistake<'a> = (&'a str, &'a str, &'a str, &'a str);

/// Asserts that each of these mistakes in a valid scenario is refused with its line.
pub(crate) fn assert_refused(valid: &str, mistakes: &[Mistake<'_>]) {
    for &(from, to, at, message) in mistakes {
        assert!(valid.contains(from), "no line '{from}'");
        let text = valid.replacen(from, to, 1);
        let error = Scenario::parse("my.toml", &text).unwrap_err().to_string();
        assert!(error.contains(message), "{to}: {error}");
        let first = to.lines().next().unwrap_or_default();
        let at = if at.is_empty() { first } else { at };
        let line = text.lines().position(|line| line.contains(at)).unwrap() + 1;
        let by_toml = format!("my.toml: TOML parse error at line {line},");
        let is_named =
            error.starts_with(&format!("my.toml:{line}: ")) || error.starts_with(&by_toml);
        assert!(is_named, "{to}: line {line}: {error}");
    }
}

#[test]
fn the_shipped_scenarios_load_by_name() {
    for name in Scenario::shipped().chain(Scenario::large()) {
        assert_eq!(Scenario::load(name).unwrap().name, name);
    }
}

#[test]
fn impossible_values_and_unknown_names_are_named_with_their_line() {
    #[rustfmt::skip]
    let mistakes = [
        ("commands = 2", "comands = 2", "", "unknown field `comands`"),
        ("delayed = 1", "delayed = 9", "", "9 messages delayed at a time: at most 4 are possible"),
        ("followers = 1", "followers = 17", "", "a request for 17 followers: between 1 and 16"),
        ("tasks = [\"move\"]", "tasks = [\"fly\"]", "", "no task 'fly': initialPos, move, block"),
        ("n_ack = 1", "n_ack = 0", "", "the settings break 'repeats-in-range': 1 <= n_ack <= 15"),
        ("n_ack = 1", "t_lease = 1990", "", "the settings break 'lease-within-safety'"),
        ("detects = true", "detects = false", "[[robots]]", "nothing would ever happen"),
        ("station = 2", "station = 1", "[[robots]]", "two robots have station id 1"),
        ("station = 2", "station = 201", "[[robots]]", "station ids 1 and 201 must not differ by a multiple of 100"),
        ("station = 2", "station = 2\nurgency = \"high\"", "urgency = \"high\"", "robot 2 has an urgency"),
        ("\"L4\"", "\"L3\"", "", "L3 speaks about cooperative scenarios only"),
        ("\"I14\"", "\"I99\"", "", "no property 'I99': I1, I2"),
    ];
    assert_refused(PAIR, &mistakes);
}

#[test]
fn a_scenario_that_is_neither_shipped_nor_a_file_is_told_apart() {
    let unknown = Scenario::load("quartet").unwrap_err();
    assert!(
        unknown.to_string().contains("the shipped ones are pair,"),
        "{unknown}"
    );
    let read = |path: &Path| std::fs::read_to_string(path);
    let missing = Subject::load("no/such/file.toml", read).unwrap_err();
    assert!(
        matches!(missing, ScenarioError::Unreadable { .. }),
        "{missing}"
    );
}

#[test]
fn what_does_not_fit_a_monotone_channel_is_refused() {
    let valid = include_str!("../scenarios/pair-monotone.toml");
    #[rustfmt::skip]
    let mistakes = [
        ("monotone = true", "monotone = true\ndelayed = 1", "delayed = 1", "exclude each other"),
        ("loss = true", "loss = false", "", "'loss = false': a monotone channel decides about no loss"),
        ("commands = 1", "commands = 1\nlosses = 1", "losses = 1", "'losses': a monotone channel decides about no loss"),
        ("heartbeats = 1", "", "monotone = true", "'monotone = true' needs 'heartbeats = n' in [bounds]"),
        ("offers = 2", "", "monotone = true", "'monotone = true' needs 'offers = n' in [bounds]"),
        ("monotone = true", "", "heartbeats = 1", "'heartbeats' bounds runs on a monotone channel only"),
        ("corridor = true", "cooperative = true", "", "assumes that messages arrive"),
        ("\"L7\"", "\"L6\"", "", "L6 does not hold of a monotone channel"),
    ];
    assert_refused(valid, &mistakes);
}
