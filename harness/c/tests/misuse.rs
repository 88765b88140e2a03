//! Misuse of the interface returns codes, under the sanitizers of gcc: `misuse.c`.

use std::process::Command;

use crossguard_testkit::c::{Language, compile};

#[test]
fn misuse_returns_a_code_and_does_nothing() {
    let Some(program) = compile("misuse", Language::C, "tests/misuse.c") else {
        return;
    };
    let output = Command::new(program).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}{errors}");
    assert_eq!(text, "0 failures\n");
}
