//! Which harnesses of the proofs notice a mutant, all of them and not only the first.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::Failure;
use crate::points::{Mutant, Sources};

/// The test that names the harnesses which fail.
const TEST: [&str; 4] = [
    "--exact",
    "the_harnesses_that_fail_are_named",
    "--ignored",
    "--nocapture",
];

/// Asks the bodies of the proofs about each mutant whose text contains one of `only`, and prints a table.
pub(crate) fn tell(sources: &Sources, only: &[String], proofs: &Path) -> Result<(), Failure> {
    let has = |mutant: &Mutant, text: &String| mutant.to_string().contains(text);
    for text in only {
        if !sources.mutants().iter().any(|mutant| has(mutant, text)) {
            return Err(Failure::NoMutant(text.clone()));
        }
    }
    if !noticed_by(0, proofs)?.is_empty() {
        return Err(Failure::Unfit("proofs".to_owned()));
    }
    println!("| mutant | harnesses that notice it | the first of them |\n|---|--:|---|");
    for mutant in sources.mutants() {
        if only.iter().any(|text| has(mutant, text)) {
            let names = noticed_by(mutant.number, proofs)?;
            let first: Vec<_> = names
                .iter()
                .take(3)
                .map(|name| format!("`{name}`"))
                .collect();
            println!(
                "| {} | {} | {} |",
                mutant.key(),
                names.len(),
                first.join(", ")
            );
        }
    }
    Ok(())
}

fn noticed_by(number: usize, proofs: &Path) -> Result<Vec<String>, Failure> {
    let output = Command::new(proofs)
        .args(TEST)
        .env("MUTANT", number.to_string())
        .env("RUST_BACKTRACE", "0")
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()
        .map_err(Failure::file(proofs))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let names = text
        .lines()
        .filter_map(|line| line.strip_prefix("fails: protocol::"));
    Ok(names.map(str::to_owned).collect())
}
