//! The rules of the tester are those of the protocol's page, word for word.

use std::path::Path;

use crossguard_conform::rules::RULES;
use crossguard_conform::statements::Statement;

#[test]
fn the_rules_are_those_of_the_protocols_page() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../protocol/doc/protocol.md");
    let page = std::fs::read_to_string(page).unwrap();
    let rows = page.lines().filter(|line| line.starts_with("| R"));
    let of_row = |row: &str| {
        let mut cells = row.split('|').map(str::trim).skip(1);
        Some((cells.next()?.to_owned(), cells.next()?.to_owned()))
    };
    let on_the_page: Vec<_> = rows.filter_map(of_row).collect();
    let here = RULES
        .iter()
        .map(|rule| (rule.id.to_owned(), rule.says.to_owned()));
    assert_eq!(here.collect::<Vec<_>>(), on_the_page);
}

#[test]
fn every_rule_has_a_statement_or_cannot_be_judged() {
    let statements = Statement::all();
    for rule in RULES {
        let is_judged = statements.iter().any(|statement| statement.rule == rule.id);
        assert_ne!(is_judged, rule.is_beyond(), "{}", rule.id);
    }
    for statement in statements {
        let rule = RULES.iter().find(|rule| rule.id == statement.rule);
        assert!(
            rule.is_some(),
            "{}: no rule {}",
            statement.name,
            statement.rule
        );
    }
}
