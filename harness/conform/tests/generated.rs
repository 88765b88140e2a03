//! The cases of the file are those that are generated; `cargo xtask bless cases.txt` writes them.

use std::path::Path;

use crossguard_conform::case::Case;
use crossguard_conform::generate::generate;

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
