//! Other programs, run one after the other, each with its name before it and its time after it.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// A program could not be started.
#[derive(Debug, thiserror::Error)]
#[error("could not start {program}: {cause}")]
pub(crate) struct NotStarted {
    program: String,
    cause: std::io::Error,
}

/// Whether a command succeeds that is run from the root of the workspace, its words parted by single spaces, with these
/// variables in its environment.
pub(crate) fn run(
    root: &Path,
    (name, line): (&str, &str),
    environment: &[(&str, &str)],
) -> Result<bool, NotStarted> {
    println!("== {name}: {line}");
    let mut words = line.split(' ');
    let program = words.next().unwrap_or_default();
    let began = Instant::now();
    let mut command = Command::new(program);
    command.args(words).current_dir(root);
    command.envs(environment.iter().copied());
    let status = command.status().map_err(|cause| NotStarted {
        program: program.to_owned(),
        cause,
    })?;
    let verdict = if status.success() { "passed" } else { "FAILED" };
    let seconds = began.elapsed().as_secs();
    println!("== {name}: {verdict}, {seconds} s");
    Ok(status.success())
}

/// The two crates that are built and tested most quickly.
const CORE: &str = "--locked -p crossguard-protocol -p crossguard-crossing -p crossguard-codec";

/// Checks what fails most often.
pub(crate) fn quick(root: &Path) -> Result<bool, NotStarted> {
    let began = Instant::now();
    let lint = format!("cargo clippy {CORE} --all-targets -- -D warnings");
    let test = format!("cargo test --quiet {CORE}");
    let steps = [
        ("format", "cargo fmt --all --check"),
        ("lint", &lint),
        ("test", &test),
        ("check", "cargo run --quiet --locked -- check crossing"),
    ];
    let mut is_ok = true;
    for step in steps {
        is_ok &= run(root, step, &[])?;
    }
    let verdict = if is_ok { "passed" } else { "FAILED" };
    println!("quick: {verdict}, {} s", began.elapsed().as_secs());
    Ok(is_ok)
}

/// Checks everything.
pub(crate) fn full(root: &Path) -> Result<bool, NotStarted> {
    run(root, ("full", ".ci/run"), &[])
}

/// Makes what a release consists of, and tries it.
pub(crate) fn dist(root: &Path, is_tried: bool) -> Result<bool, NotStarted> {
    let is_made = run(root, ("dist", ".ci/dist"), &[])?;
    Ok(is_made && (!is_tried || run(root, ("try", ".ci/dist-try"), &[])?))
}
