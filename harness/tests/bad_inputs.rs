//! Bad usage and bad inputs of every command: each is refused with a readable cause and its exit code, before
//! anything is done. The page `doc/errors.md` lists them; `CROSSGUARD_BLESS=1` writes it.

mod bad_inputs_cases;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Stdio;

use bad_inputs_cases::{CASES, FILES, ROBOT};
use crossguard_testkit::command::*;

/// What stands at the top of the page.
const HEAD: &str = "\
# What is refused, and why

Every command with bad inputs, what it says on standard error, and its exit code. The test
[`bad_inputs.rs`](../tests/bad_inputs.rs) runs them all and compares them with this page; `cargo xtask bless errors.md`
writes it. Exit codes: 1 something was found to be wrong, 2 bad usage or input. Nothing has been written when
one of these ends. The files that commands name here are made by that test.

";

/// Words of programmers, by which nobody knows what to do.
const UNREADABLE: [&str; 6] = [
    "panicked",
    "invalid digit",
    "invalid float",
    "cannot parse integer",
    "would be zero",
    "reading bytes",
];

/// Writes the files that the commands name.
fn prepare(folder: &Path) {
    fs::create_dir(folder.join("folder")).unwrap();
    for (name, text) in FILES {
        fs::write(folder.join(name), text).unwrap();
    }
    for (name, from, to) in ROBOT.changes {
        let text = ROBOT.text.replace(from, to);
        assert_ne!(
            text, ROBOT.text,
            "{name}: '{from}' is not in the robot's file"
        );
        fs::write(folder.join(name), text).unwrap();
    }
    fs::write(folder.join("robot.toml"), ROBOT.text).unwrap();
}

/// What a command says at first, and its exit code.
fn refused(folder: &Path, line: &str) -> (String, i32) {
    let words: Vec<_> = line.split(' ').map(|word| word.replace("''", "")).collect();
    let words: Vec<_> = words.iter().map(String::as_str).collect();
    let output = crossguard(&words)
        .current_dir(folder)
        .env("COLUMNS", "120")
        .env_remove("RUST_LOG")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let said = stderr(&output);
    let first = said.split("\n\n").next().unwrap_or_default();
    let first = first.split_whitespace().collect::<Vec<_>>().join(" ");
    let code = output.status.code();
    (
        first,
        code.unwrap_or_else(|| panic!("{line}: died of a signal: {said}")),
    )
}

#[test]
fn every_bad_input_is_refused_with_a_readable_cause_and_the_page_lists_them() {
    let folder = tempfile::tempdir().unwrap();
    prepare(folder.path());
    let made = fs::read_dir(folder.path()).unwrap();
    let made: BTreeSet<_> = made.map(|entry| entry.unwrap().file_name()).collect();
    let (mut page, mut count, mut bad) = (HEAD.to_owned(), 0, Vec::new());
    for (command, lines) in CASES {
        write!(
            page,
            "## {command}\n\n| command | what it says | exit code |\n|---|---|---|\n"
        )
        .unwrap();
        for (line, code) in *lines {
            let (said, found) = refused(folder.path(), line);
            let negative = |digit| said.contains(&format!("unexpected argument '-{digit}"));
            let is_readable = !said.is_empty()
                && !UNREADABLE.iter().any(|word| said.contains(word))
                && !(0..=9).any(negative);
            if found != *code || !is_readable {
                bad.push(format!("{line} ({found}): {said}"));
            }
            // Neither ends a cell or a quotation there.
            let said = said.replace('|', "\\|").replace('`', "'");
            writeln!(
                page,
                "| `{}` | `{said}` | {code} |",
                line.replace('|', "\\|")
            )
            .unwrap();
            count += 1;
        }
        page.push('\n');
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
    let page = page.trim_end().to_owned() + "\n";
    assert!(count >= 120, "{count} cases");
    let left = fs::read_dir(folder.path()).unwrap();
    let left: BTreeSet<_> = left.map(|entry| entry.unwrap().file_name()).collect();
    let more: Vec<_> = left.difference(&made).collect();
    assert_eq!(
        more,
        ["corrupt.boot.lock"],
        "a lock is all that is left behind"
    );
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("doc/errors.md");
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        fs::write(&path, &page).unwrap();
    }
    let there = fs::read_to_string(&path).unwrap_or_default();
    let differs = page
        .lines()
        .zip(there.lines())
        .find(|(new, old)| new != old);
    assert!(
        there == page,
        "run: cargo xtask bless errors.md\n{differs:?}"
    );
}

#[test]
fn the_page_leaves_no_command_out() {
    let help = stdout(&run(&["--help"]));
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let (commands, _) = commands.split_once("\n\n").unwrap();
    let is_name = |line: &&str| line.starts_with("  ") && !line.starts_with("   ");
    let names = commands.lines().filter(is_name);
    let names: BTreeSet<_> = names
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    let told: BTreeSet<_> = CASES.iter().map(|(command, _)| *command).collect();
    let missing: Vec<_> = names
        .iter()
        .filter(|it| **it != "help" && !told.contains(*it))
        .collect();
    assert!(missing.is_empty(), "no bad inputs of {missing:?}");
}
