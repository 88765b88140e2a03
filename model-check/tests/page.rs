//! The verification page says what the scenario files say.

use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::scenario::Scenario;

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

#[test]
fn every_scenario_stands_there_with_its_size_and_properties() {
    for name in Scenario::shipped() {
        let scenario = Scenario::load(name).unwrap();
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
        // Timed scenarios have the properties of the timed view.
        let is_timed = scenario.timed.is_some();
        let properties: Vec<_> = scenario
            .properties
            .iter()
            .map(ToString::to_string)
            .collect();
        assert!(is_timed || cells[7] == properties.join(", "), "{row}");
        let summary = format!("| `{name}` | {} |", scenario.summary);
        assert!(PAGE.contains(&summary), "no row begins with {summary}");
    }
}

#[test]
fn every_property_stands_there() {
    for id in PropertyId::ALL {
        assert!(PAGE.contains(&format!("| {id} |")), "{id}");
    }
}
