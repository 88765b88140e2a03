//! The generated cases are the ones that the generator makes (`cargo xtask bless cases.txt` writes them), and the written
//! ones meet the statements that they are there for.

use std::collections::BTreeSet;
use std::path::Path;

use crossguard_conform::case::{Case, Table, play};
use crossguard_conform::generate::generate;
use crossguard_conform::in_process::Reference;
use crossguard_conform::statements::Statement;
use crossguard_conform::subject::Subject as _;
use crossguard_protocol::{Config, StationId};

#[test]
fn the_cases_are_those_that_are_generated() {
    let generated = generate();
    println!(
        "{} situations, {} cases, {} edges",
        generated.situations,
        generated.cases.len(),
        generated.edges
    );
    // One of each statement is enough to see.
    let mut broken: Vec<_> = generated.broken.iter().collect();
    broken.sort();
    broken.dedup_by_key(|text| text.split(':').next().unwrap_or_default().to_owned());
    assert!(
        broken.is_empty(),
        "the kit's own robot breaks:\n{broken:#?}"
    );
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        let lines: Vec<_> = generated.cases.iter().map(Case::line).collect();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cases.txt");
        std::fs::write(path, lines.join("\n") + "\n").unwrap();
        return;
    }
    assert!(
        Case::generated() == generated.cases,
        "run: cargo xtask bless cases.txt"
    );
}

#[test]
fn the_written_cases_meet_what_they_name() {
    let robot = StationId(1);
    let mut subject = Reference::reference(robot, Config::default());
    let mut table = Table::in_process(robot);
    let mut known: BTreeSet<_> = Case::generated().into_iter().map(|it| it.plays).collect();
    let statements = Statement::all();
    for case in Case::written() {
        subject.restart().unwrap();
        table.boot += 1;
        let played = play(&mut subject, &table, &case.plays).unwrap();
        let words = case.words();
        assert_eq!(played.stopped, None, "{words}");
        for name in &case.statements {
            let named = statements.iter().find(|it| it.name == name);
            let met = named.map(|it| it.judge(&played.exchange, &table.terms));
            assert!(met.is_some_and(|met| !met.is_empty()), "{name}: {words}");
        }
        assert!(
            !case.statements.is_empty() && known.insert(case.plays),
            "{words}"
        );
    }
}
