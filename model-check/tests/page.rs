//! The verification page says what the scenario files say, and the scenario on the page for verifiers is one.

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::timed::TimedProperty;

const PAGE: &str = include_str!("../doc/verification.md");
const GUIDE: &str = include_str!("../doc/verifying.md");

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
        let properties: Vec<_> = match &scenario.timed {
            Some(timed) => timed
                .properties
                .iter()
                .map(|id| id.name().to_owned())
                .collect(),
            None => scenario
                .properties
                .iter()
                .map(ToString::to_string)
                .collect(),
        };
        assert_eq!(cells[7], properties.join(", "), "{row}");
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

/// What stands in the row of a property: what breaks it, the tests that show it, and what else fails
/// there.
fn breaking(id: &str) -> (Vec<&'static str>, &'static str) {
    let row = PAGE
        .lines()
        .find(|line| line.starts_with(&format!("| {id} |")));
    let row = row.unwrap_or_else(|| panic!("no row of {id}"));
    let cells: Vec<_> = row.split('|').map(str::trim).collect();
    let tests = cells[4].split(", ").map(|name| name.trim_matches('`'));
    (tests.collect(), cells[5])
}

/// The text of a test.
fn body(name: &str) -> &'static str {
    let files = [
        include_str!("weakenings.rs"),
        include_str!("timed_weakenings.rs"),
    ];
    let start = format!("fn {name}() {{\n");
    let body = files.iter().find_map(|file| file.split_once(&start));
    let (_, body) = body.unwrap_or_else(|| panic!("no test {name}"));
    body.split_once("\n}\n").expect("it ends").0
}

#[test]
fn every_property_has_a_weakening_that_breaks_it_and_says_what_else_fails() {
    // The other properties of the timed view are in the table as ones of the untimed view.
    let timed = ["I10", "I19", "W5", "W6", "W8"].map(str::to_owned);
    let known = format!("{}, {}", PropertyId::list(), TimedProperty::list());
    for id in PropertyId::ALL.iter().map(ToString::to_string).chain(timed) {
        let (tests, with) = breaking(&id);
        let is_told = with != "see below";
        let others = with
            .split(", ")
            .filter(|other| is_told && *other != "alone");
        let others: Vec<_> = others.collect();
        for test in tests {
            let body = body(test);
            let words: Vec<_> = body.split(|c: char| !c.is_alphanumeric()).collect();
            assert!(words.contains(&id.as_str()), "{test} does not break {id}");
            let says_all = body.contains("assert_breaks_alone") || body.contains("violated(");
            assert_eq!(says_all, is_told, "{test} looks at all properties, or not");
            let named = |id: &&str| known.split(", ").any(|known| known == *id);
            let broken: Vec<_> = words.iter().filter(|word| named(word)).collect();
            assert!(
                !is_told || broken.len() == others.len() + 1,
                "{test} breaks {broken:?}"
            );
            for other in &others {
                assert!(
                    words.contains(other),
                    "{test} does not break {other} with {id}"
                );
            }
        }
    }
}

#[test]
fn the_scenario_of_the_guide_can_be_checked_and_holds() {
    let (_, text) = GUIDE.split_once("```toml\n").expect("a scenario");
    let (text, _) = text.split_once("```").expect("it ends");
    let scenario = Scenario::parse("my.toml", text).unwrap();
    let report = check(&Model::new(scenario), &Options::default(), &mut |_| ());
    assert!(report.exhaustive && !report.failed(), "{report:#?}");
}
