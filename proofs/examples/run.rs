//! Runs the harnesses under Kani, one by one, and says what came of each.
//!
//! ```text
//! cargo run -p crossguard-proofs --example run                 # all of them
//! cargo run -p crossguard-proofs --example run -- numbers      # those with "numbers" in their name
//! cargo run -p crossguard-proofs --example run -- --part 2/4   # every fourth, from the second on
//! ```
//!
//! A harness fails when Kani does not verify it within five minutes, or when a cover mark is not
//! satisfied, which Kani by itself does not call a failure. The environment variable `CARGO_KANI`
//! names another command than `cargo-kani`. Exit codes: 0 all were verified, 1 some were not, 2 bad
//! usage, or Kani cannot be run.

use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use serde::Deserialize;

/// How long one harness may take.
const LIMIT: Duration = Duration::from_mins(5);

#[derive(Deserialize)]
struct Committed {
    harness: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    name: String,
    covers: usize,
}

/// What came of a harness.
struct Outcome {
    seconds: f64,
    /// Why it counts as failed.
    failure: Option<String>,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(chosen) = choose(&arguments) else {
        eprintln!("usage: run [--part N/OF] [PART_OF_A_NAME]");
        return ExitCode::from(2);
    };
    let (mut failed, start) = (0, Instant::now());
    for entry in &chosen {
        let outcome = match run(entry) {
            Ok(outcome) => outcome,
            Err(cause) => {
                eprintln!("{}: {cause}", kani());
                return ExitCode::from(2);
            }
        };
        let verdict = outcome.failure.as_deref().unwrap_or("verified");
        println!("{:7.1} s  {}  {verdict}", outcome.seconds, entry.name);
        failed += usize::from(outcome.failure.is_some());
    }
    println!(
        "{} of {} harnesses verified in {:.0} s.",
        chosen.len() - failed,
        chosen.len(),
        start.elapsed().as_secs_f64()
    );
    ExitCode::from(u8::from(failed > 0))
}

/// The harnesses that the arguments ask for; `None` if they make no sense or ask for none.
fn choose(arguments: &[String]) -> Option<Vec<Entry>> {
    let list = include_str!("../harnesses.toml");
    let all: Committed = toml::from_str(list).expect("the list is well-formed");
    let all = all.harness.into_iter();
    let chosen: Vec<_> = match arguments {
        [] => all.collect(),
        [part, fraction] if part == "--part" => {
            let (number, of) = fraction.split_once('/')?;
            let (number, of): (usize, usize) = (number.parse().ok()?, of.parse().ok()?);
            all.skip(number.checked_sub(1)?)
                .step_by(Some(of).filter(|of| *of > 0)?)
                .collect()
        }
        [name] => all.filter(|entry| entry.name.contains(name)).collect(),
        _ => return None,
    };
    (!chosen.is_empty()).then_some(chosen)
}

fn kani() -> String {
    std::env::var("CARGO_KANI").unwrap_or_else(|_| "cargo-kani".to_owned())
}

fn run(entry: &Entry) -> std::io::Result<Outcome> {
    let start = Instant::now();
    // The limit is that of the tool `timeout`, which ends Kani's solver as well.
    let output = Command::new("timeout")
        .args(["--kill-after=10", &LIMIT.as_secs().to_string(), &kani()])
        .args(["-p", "crossguard-proofs", "--exact", "--harness"])
        .arg(&entry.name)
        .stdin(Stdio::null())
        .output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    let seconds = verification_time(&text).unwrap_or_else(|| start.elapsed().as_secs_f64());
    let failure = match output.status.code() {
        Some(0) => missing_covers(&text, entry.covers),
        Some(124 | 137) => Some(format!("not verified within {} s", LIMIT.as_secs())),
        Some(126 | 127) => {
            let cause = String::from_utf8_lossy(&output.stderr).into_owned();
            return Err(std::io::Error::other(cause));
        }
        _ => Some(format!("NOT verified\n{text}")),
    };
    Ok(Outcome { seconds, failure })
}

/// Seconds, from `Verification Time: 1.5s`.
fn verification_time(text: &str) -> Option<f64> {
    let (_, time) = text.rsplit_once("Verification Time: ")?;
    time.lines().next()?.trim_end_matches('s').parse().ok()
}

/// What is wrong with the cover marks, from `2 of 3 cover properties satisfied`.
fn missing_covers(text: &str, expected: usize) -> Option<String> {
    let found = text.lines().find_map(|line| {
        let (counts, _) = line.split_once(" cover properties satisfied")?;
        let (satisfied, of) = counts.split_once(" of ")?;
        let satisfied: usize = satisfied.split_whitespace().next_back()?.parse().ok()?;
        Some((satisfied, of.trim().parse::<usize>().ok()?))
    });
    let (satisfied, of) = found.unwrap_or_default();
    (satisfied != of || of != expected)
        .then(|| format!("{satisfied} of {of} cover marks satisfied, {expected} expected"))
}
