//! The verification page says what the scenario files say.

use crossguard_model_check::properties::{Claim, PropertyId};
use crossguard_model_check::scenario::Scenario;

use crate::{timed_weakenings, weakenings};

const PAGE: &str = include_str!("../doc/verification.md");

/// `1234567` as `1,234,567`.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Asserts that a scenario stands there with its size and summary, and with these properties in this cell.
fn assert_stands_there(scenario: &Scenario, properties: &[&str], cell: usize) {
    let name = &scenario.name;
    let size = scenario.expected.expect("shipped scenarios are pinned");
    let start = format!(
        "| `{name}` | {} | {} |",
        scenario.robots.len(),
        grouped(size.unique_states)
    );
    let row = PAGE.lines().find(|line| line.starts_with(&start));
    let row = row.unwrap_or_else(|| panic!("no row begins with {start}"));
    let cells: Vec<_> = row.split('|').map(str::trim).collect();
    assert_eq!(cells[5], size.depth.to_string(), "{row}");
    assert_eq!(cells[cell], properties.join(", "), "{row}");
    let summary = format!("| `{name}` | {} |", scenario.summary);
    assert!(PAGE.contains(&summary), "no row begins with {summary}");
}

#[test]
fn every_scenario_stands_there_with_its_size_and_properties() {
    for name in Scenario::shipped() {
        let scenario = Scenario::load(name).unwrap();
        let timed = scenario.timed.as_ref().map(|timed| &timed.properties);
        let properties = timed.unwrap_or(&scenario.properties).iter();
        let properties: Vec<_> = properties.map(|id| id.name()).collect();
        assert_stands_there(&scenario, &properties, 7);
    }
}

#[test]
fn every_large_scenario_stands_there_with_its_size_and_properties() {
    for name in Scenario::large() {
        let scenario = Scenario::load(name).unwrap();
        let judged = scenario.properties.iter();
        let judged = judged.filter(|id| id.is_of_states_or_steps());
        let judged: Vec<_> = judged.map(|id| id.name()).collect();
        assert_stands_there(&scenario, &judged, 8);
    }
}

/// Asserts that the weakening which a claim names breaks the property in one of these tests.
fn assert_shown(id: PropertyId, claim: Option<&Claim>, tests: &[(&str, &[PropertyId])]) {
    let Some(Claim { weakening, .. }) = claim else {
        return;
    };
    let mut tests = tests.iter();
    let is_shown =
        tests.any(|(rules, broken)| rules.starts_with(weakening) && broken.contains(&id));
    assert!(is_shown, "no test shows that {weakening} breaks {id}");
}

#[test]
fn every_claim_names_a_weakening_that_a_test_shows_to_break_it() {
    for id in PropertyId::ALL {
        assert_shown(id, id.untimed(), weakenings::BREAKS);
        assert_shown(id, id.timed(), timed_weakenings::BREAKS);
    }
}
