//! The verification page says what the scenario files say, and the scenario on the page for verifiers is one.

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::properties::{Claim, PropertyId};
use crossguard_model_check::scenario::Scenario;

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

const WEAKENINGS: &str = include_str!("weakenings.rs");
const TIMED_WEAKENINGS: &str = include_str!("timed_weakenings.rs");
const SHARED_WEAKENINGS: &str = include_str!("../../harness/testkit/src/rules.rs");

fn words(text: &str) -> Vec<&str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .collect()
}

/// Asserts that the weakening of a claim is one, and that a test of this file asserts that it breaks the property.
fn assert_has_weakening(id: PropertyId, claim: &Claim, file: &'static str) {
    let weakening = claim.weakening;
    let is_defined = [file, SHARED_WEAKENINGS].iter().any(|file| {
        let kinds = ["struct", "const", "fn"].iter();
        kinds
            .flat_map(|kind| ["(", ";", ":", " "].map(|end| format!("{kind} {weakening}{end}")))
            .any(|definition| file.contains(&definition))
    });
    assert!(
        is_defined,
        "no weakening {weakening}, which is to break {id}"
    );
    let tests = file.split("#[test]\n").skip(1);
    let mut tests = tests.map(|test| test.split_once("\n}\n").map_or(test, |(body, _)| body));
    // What a test asserts to break stands in the last list of its call, or in that of its assertion.
    let asserted = |test: &'static str| {
        let timed = test.split_once("assert_eq!(violated, [");
        let (_, list) = timed.or_else(|| test.rsplit_once("&["))?;
        list.split_once(']').map(|(list, _)| list)
    };
    let breaks = |test: &'static str| {
        let broken = asserted(test).is_some_and(|list| words(list).contains(&id.name()));
        broken && words(test).contains(&weakening)
    };
    assert!(
        tests.any(breaks),
        "no test shows that {weakening} breaks {id}"
    );
}

#[test]
fn every_claim_names_a_weakening_that_a_test_shows_to_break_it() {
    for id in PropertyId::ALL {
        if let Some(claim) = id.untimed() {
            assert_has_weakening(id, claim, WEAKENINGS);
        }
        if let Some(claim) = id.timed() {
            assert_has_weakening(id, claim, TIMED_WEAKENINGS);
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
