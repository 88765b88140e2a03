//! Files that are generated or golden, and what writes them.
//!
//! A test compares each with what it should be. With `CROSSGUARD_BLESS=1` in its environment, the
//! test writes the file instead.

use std::path::Path;

use crate::steps::{NotStarted, run};

/// Files, folders and parts of files, and the command that writes each. Sources first: what follows from other files comes
/// after them.
const GENERATED: &str = "\
protocol/src: words and named tasks, in other languages <- cargo test -p crossguard-protocol --test languages
protocol/words.md <- cargo test -p crossguard-protocol --test words
protocol/tests/scripts/ <- cargo test -p crossguard-protocol --test it interpreter
codec/src/asn1/generated.rs <- cargo test -p crossguard-codec --test it generated
codec/tests/golden/messages.json <- cargo test -p crossguard-codec --test it golden_messages
codec/tests/golden/security.json <- cargo test -p crossguard-codec --features security --test it security::vectors
codec/wireshark/crossguard.lua: the types <- codec/judges/run
harness/robot/tests/beside.json <- codec/judges/run
harness/c/include/crossguard.h <- cargo test -p crossguard-c --test header
model-check/doc/paper-literal.md <- cargo test -p crossguard-model-check --test it paper_literal::
harness/conform/src/cases.txt <- cargo test -p crossguard-conform --test generated
protocol/doc/protocol.md: the state diagram <- cargo test -p crossguard-harness --test it pages::the_state_diagram
protocol/doc/protocol.md: the index of rules <- cargo test -p crossguard-harness --test it pages::the_index_of_rules
harness/tests/cmd/ <- cargo test -p crossguard-harness --test it cmd::
README.md: the sum of states <- cargo test -p crossguard-harness --test it pages::the_readmes_sum_of_states";

/// The rows of the table.
fn generated() -> impl Iterator<Item = (&'static str, &'static str)> {
    GENERATED.lines().filter_map(|row| row.split_once(" <- "))
}

/// A text that the path of a generated file contains.
pub(crate) fn part(text: &str) -> Result<String, String> {
    let paths: Vec<_> = generated().map(|(path, _)| path).collect();
    if paths.iter().any(|it| it.contains(text)) {
        return Ok(text.to_owned());
    }
    let paths = paths.join("\n    ");
    Err(format!(
        "no generated file is named so; there are:\n    {paths}"
    ))
}

/// Writes the files whose names contain the text.
pub(crate) fn bless(root: &Path, part: &str) -> Result<bool, NotStarted> {
    let mut done = Vec::new();
    let mut is_ok = true;
    for (path, by) in generated().filter(|(path, _)| path.contains(part)) {
        if !done.contains(&by) {
            let bless = [("CROSSGUARD_BLESS", "1"), ("TRYCMD", "overwrite")];
            is_ok &= run(root, (path, by), &bless)?;
            done.push(by);
        }
    }
    Ok(is_ok)
}
