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

/// A program to run from the root of the workspace, with its arguments, by single spaces.
pub(crate) struct Step<'a> {
    name: &'a str,
    command: &'a str,
    environment: Vec<(&'a str, &'a str)>,
}

impl<'a> Step<'a> {
    pub(crate) fn new(name: &'a str, command: &'a str) -> Self {
        Self {
            name,
            command,
            environment: Vec::new(),
        }
    }

    /// With a variable in its environment.
    pub(crate) fn with(mut self, name: &'a str, value: &'a str) -> Self {
        self.environment.push((name, value));
        self
    }
}

/// Whether the program succeeds.
pub(crate) fn run(root: &Path, step: &Step) -> Result<bool, NotStarted> {
    println!("== {}: {}", step.name, step.command);
    let mut words = step.command.split(' ');
    let program = words.next().unwrap_or_default();
    let began = Instant::now();
    let mut command = Command::new(program);
    command.args(words).current_dir(root);
    command.envs(step.environment.iter().copied());
    let status = command.status().map_err(|cause| NotStarted {
        program: program.to_owned(),
        cause,
    })?;
    let verdict = if status.success() { "passed" } else { "FAILED" };
    let seconds = began.elapsed().as_secs();
    println!("== {}: {verdict}, {seconds} s", step.name);
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
    for (name, command) in steps {
        is_ok &= run(root, &Step::new(name, command))?;
    }
    let verdict = if is_ok { "passed" } else { "FAILED" };
    println!("quick: {verdict}, {} s", began.elapsed().as_secs());
    Ok(is_ok)
}

/// Checks everything.
pub(crate) fn full(root: &Path) -> Result<bool, NotStarted> {
    run(root, &Step::new("full", ".ci/run"))
}
