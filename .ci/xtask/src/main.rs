//! `cargo xtask bless [PART]` writes every generated and golden file anew, or those whose paths contain PART. Look at the
//! difference before you commit it.
//!
//! A test compares each file with what it should be. With `CROSSGUARD_BLESS=1` in its environment, the test writes the
//! file instead. Exit codes: 0 all are written, 1 a test failed, 2 wrong arguments, 3 a program could not be started.

use std::path::Path;
use std::process::{Command, ExitCode};

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
model-check/doc/paper-literal.md: the hazards <- cargo test -p crossguard-model-check --test it paper_literal::
protocol/doc/protocol.md: the state diagram <- cargo test -p crossguard-model-check --test it state_diagram::
protocol/doc/protocol.md: the index of rules <- cargo test -p crossguard-harness --test it pages::the_index_of_rules
harness/tests/cmd/ <- cargo test -p crossguard-harness --test it cmd::
README.md: the sum of states <- cargo test -p crossguard-harness --test it pages::the_readmes_sum_of_states";

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    let part = match arguments[..] {
        ["bless"] => "",
        ["bless", part] => part,
        _ => {
            eprintln!("usage: cargo xtask bless [PART OF A PATH]");
            return ExitCode::from(2);
        }
    };
    let rows = || GENERATED.lines().filter_map(|row| row.split_once(" <- "));
    let named: Vec<_> = rows().filter(|(path, _)| path.contains(part)).collect();
    if named.is_empty() {
        let paths: Vec<_> = rows().map(|(path, _)| path).collect();
        let paths = paths.join("\n    ");
        eprintln!("no generated file is named so; there are:\n    {paths}");
        return ExitCode::from(2);
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (mut done, mut is_ok) = (Vec::new(), true);
    for (path, by) in named {
        if done.contains(&by) {
            continue;
        }
        println!("== {path}: {by}");
        let mut words = by.split(' ');
        let mut command = Command::new(words.next().unwrap_or_default());
        command.args(words).current_dir(&root);
        match command.env("CROSSGUARD_BLESS", "1").status() {
            Ok(status) => is_ok &= status.success(),
            Err(cause) => {
                eprintln!("could not start {by}: {cause}");
                return ExitCode::from(3);
            }
        }
        done.push(by);
    }
    ExitCode::from(u8::from(!is_ok))
}
