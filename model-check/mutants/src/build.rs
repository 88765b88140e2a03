//! Builds the judges in the copy, and says which there are.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::Failure;
use crate::judge::{Judge, Judges};

/// What is asked about every mutant, about what that lets pass, and about what both let pass: scenarios, with
/// the seconds of processor time that each may take, ten times what it takes by itself or more.
const SCENARIOS: [&[(&str, u64)]; 3] = [
    &[("crossing", 30), ("stable", 30), ("rivals", 30)],
    &[
        ("leader-crash", 60),
        ("pair-hang", 60),
        ("contention", 60),
        ("two-teams", 60),
        ("timed-hang", 60),
        ("wrap", 60),
        ("contention-urgency", 150),
        ("offer-race", 150),
        ("bilateral", 150),
        ("trio-corridor", 200),
    ],
    &[
        ("timed-trio-drift", 400),
        ("pair-monotone", 400),
        ("blocker", 400),
        ("timed-pair", 600),
        ("timed-trio", 600),
        ("pair", 600),
    ],
];

/// How many seeds the fuzzer runs behind the scenarios of each stage, and in how many seconds at most.
const SEEDS: [(&str, &str, u64); 3] = [
    ("fuzz", "60", 60),
    ("fuzz-1000", "1000", 150),
    ("fuzz-5000", "5000", 600),
];

/// Judges that are to be faster than a development build is; the registry's crates stay as they are.
const OPTIMIZED: [&str; 4] = [
    "crossguard-codec",
    "crossguard-endpoint",
    "crossguard-robot",
    "crossguard-judge",
];

/// Builds the executables in the copy, and puts them where no later build disturbs a run.
pub(crate) fn build(tree: &Path, folder: &Path) -> Result<(), Failure> {
    let built = cargo(tree, folder, &["build", "-p", "crossguard-harness"])?;
    keep(&executable(&built, "crossguard")?, &crossguard(folder))?;
    build_proofs(tree, folder)
}

/// Builds the bodies of the proofs alone.
pub(crate) fn build_proofs(tree: &Path, folder: &Path) -> Result<(), Failure> {
    let tests = ["test", "--no-run", "-p", "crossguard-proofs"];
    let harnesses = [&tests[..], &["--test", "harnesses"]].concat();
    let built = cargo(tree, folder, &harnesses)?;
    keep(&executable(&built, "harnesses")?, &proofs(folder))
}

fn crossguard(folder: &Path) -> PathBuf {
    folder.join("bin/crossguard")
}

pub(crate) fn proofs(folder: &Path) -> PathBuf {
    folder.join("bin/harnesses")
}

fn keep(from: &Path, to: &Path) -> Result<(), Failure> {
    if let Some(folder) = to.parent() {
        std::fs::create_dir_all(folder).map_err(Failure::file(folder))?;
    }
    // One that runs cannot be written over, and can be removed.
    let _ = std::fs::remove_file(to);
    std::fs::copy(from, to).map_err(Failure::file(from))?;
    Ok(())
}

/// The judges, of what was built.
pub(crate) fn judges(folder: &Path) -> Judges {
    let command = |name: &str, program: PathBuf, arguments: &[&str], seconds_max| Judge {
        name: name.to_owned(),
        program,
        arguments: arguments.iter().map(|a| (*a).to_owned()).collect(),
        seconds_max,
    };
    let check = |&(name, seconds): &(&str, u64)| {
        let arguments = ["check", "--threads", "1", name];
        command(name, crossguard(folder), &arguments, seconds)
    };
    let fuzz = |(name, seeds, seconds): (&str, &str, u64)| {
        let arguments = [
            &["fuzz", "--threads", "1", "--failures", "1"][..],
            &["--robots", "4", "--seeds", seeds, "--out", name],
        ];
        command(name, crossguard(folder), &arguments.concat(), seconds)
    };
    let harnesses = [
        "--exact",
        "every_harness_of_the_protocol_holds_for_random_values_and_reaches_its_marks",
    ];
    let mut stages: Vec<Vec<Judge>> = SCENARIOS
        .iter()
        .zip(SEEDS)
        .map(|(scenarios, seeds)| scenarios.iter().map(check).chain([fuzz(seeds)]).collect())
        .collect();
    let before_fuzz = SCENARIOS[0].len();
    stages[0].insert(
        before_fuzz,
        command("proofs", proofs(folder), &harnesses, 300),
    );
    Judges { stages }
}

/// Runs cargo in the copy; its messages. Warnings are among them, and nobody reads them.
fn cargo(tree: &Path, folder: &Path, arguments: &[&str]) -> Result<String, Failure> {
    let command = format!("cargo {}", arguments.join(" "));
    let failure = |text: String| Failure::Command {
        command: command.clone(),
        text,
    };
    let faster = OPTIMIZED.map(|name| format!("--config=profile.dev.package.{name}.opt-level=2"));
    let output = Command::new("nice")
        .args(["-n", "10", "cargo"])
        .args(arguments)
        .args(["--message-format", "json"])
        .args(faster)
        .env("CARGO_TARGET_DIR", folder.join("target"))
        .env("CARGO_INCREMENTAL", "0")
        .current_dir(tree)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|cause| failure(cause.to_string()))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(failure("see above".to_owned()))
}

/// The executable that cargo's messages name for a target.
fn executable(messages: &str, target: &str) -> Result<PathBuf, Failure> {
    let lines = messages.lines();
    let parsed = lines.filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let mut paths = parsed
        .filter(|message| message["target"]["name"] == target)
        .filter_map(|message| message["executable"].as_str().map(PathBuf::from));
    paths.next().ok_or_else(|| Failure::Command {
        command: "cargo".to_owned(),
        text: format!("no executable of {target}"),
    })
}
