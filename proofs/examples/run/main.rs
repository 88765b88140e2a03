//! Runs the harnesses under Kani, and says what came of each, how long all will take, and how much memory it took.
//!
//! A harness fails when Kani does not verify it within the limit, or when a cover mark is not satisfied, which Kani by
//! itself does not call a failure. The environment variable `CARGO_KANI` names another command than `cargo-kani`.

mod kani;
mod kept;
mod progress;
mod record;
mod sources;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError, mpsc};
use std::time::Duration;

use clap::Parser;
use serde::Deserialize;

use kani::Batch;
use kept::Kept;
use progress::Progress;
use sources::Sources;

/// How many harnesses one call of Kani takes: each call builds anew, for half a minute.
const BATCH: usize = 16;

/// Proves the harnesses with Kani, those of `harnesses.toml`.
#[derive(Parser)]
#[command(name = "run", after_help = AFTER_HELP)]
struct Arguments {
    /// Only harnesses with one of these in their name.
    #[arg(value_name = "PART_OF_A_NAME")]
    names: Vec<String>,
    /// Only this part of them: `2/4` takes every fourth, from the second on.
    #[arg(long, value_name = "N/OF", value_parser = part)]
    part: Option<(usize, usize)>,
    /// Only harnesses that were measured to take at most this many seconds.
    #[arg(long, value_name = "SECONDS")]
    within: Option<f64>,
    /// How long one harness may take, in seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 900, value_parser = clap::value_parser!(u64).range(1..))]
    limit: u64,
    /// How many run at a time; each may take some GiB of memory.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..))]
    jobs: u8,
    #[command(flatten)]
    keeping: Keeping,
    /// Check each access to memory as well. The crates forbid unsafe code, so the compiler has done that.
    #[arg(long)]
    memory: bool,
    /// Say whether a source has changed since all harnesses were verified, and run nothing.
    #[arg(long, exclusive = true)]
    status: bool,
}

/// What is kept of a run.
#[derive(clap::Args)]
struct Keeping {
    /// Where verified harnesses are kept, so that a run that was stopped goes on from there.
    #[arg(long, value_name = "FILE", default_value = "target/proofs.jsonl")]
    keep: PathBuf,
    /// Run verified harnesses again.
    #[arg(long)]
    again: bool,
    /// Once all harnesses are verified, write their times to harnesses.toml, and to verified.toml of which sources they are.
    #[arg(long)]
    record: bool,
}

const AFTER_HELP: &str = "\
A run that was stopped goes on with the harnesses that were not verified yet, unless a source has changed since.
Exit codes: 0 all were verified, 1 some were not, or with --status a source has changed, 2 bad usage, or Kani cannot be run.";

/// The folder of the workspace.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Where the lists are in it.
const FOLDER: &str = "proofs";

#[derive(Deserialize)]
struct Committed {
    harness: Vec<Entry>,
}

/// A harness that is meant for Kani.
#[derive(Clone, Deserialize)]
struct Entry {
    name: String,
    covers: usize,
    time: String,
}

impl Entry {
    /// How many seconds it took when it was measured.
    fn measured(&self) -> Option<f64> {
        self.time.strip_suffix(" s")?.parse().ok()
    }
}

fn part(text: &str) -> Result<(usize, usize), String> {
    let parts = text.split_once('/');
    let parts = parts.and_then(|(n, of)| Some((n.parse().ok()?, of.parse().ok()?)));
    let fits = parts.filter(|(number, of)| (1..=*of).contains(number));
    fits.ok_or_else(|| "a part like 2/4 is wanted".to_owned())
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let kani = std::env::var("CARGO_KANI").unwrap_or_else(|_| "cargo-kani".to_owned());
    let is_good = if arguments.status {
        status()
    } else {
        prove(&arguments, &kani, Path::new(ROOT))
    };
    match is_good {
        Ok(is_good) => ExitCode::from(u8::from(!is_good)),
        Err(cause) => {
            eprintln!("{cause}");
            ExitCode::from(2)
        }
    }
}

/// Says whether a source has changed since all harnesses were verified; false when one has.
fn status() -> Result<bool, String> {
    let root = Path::new(ROOT);
    let (is_same, said) = record::status(&root.join(FOLDER), &Sources::of(root)?)?;
    println!("{said}");
    Ok(is_same)
}

/// Runs what the arguments ask for, of the workspace in `root`, and records it there where they say so; whether all were
/// verified.
fn prove(arguments: &Arguments, kani: &str, root: &Path) -> Result<bool, String> {
    let chosen = choose(arguments);
    if chosen.is_empty() {
        return Err("no harness is chosen: harnesses.toml has their names".to_owned());
    }
    let mut kept = Kept::open(&arguments.keeping.keep, root, arguments.memory)?;
    let failed = run(arguments, kani, chosen, &mut kept)?;
    if failed > 0 {
        return Ok(false);
    }
    if arguments.keeping.record {
        record::record(&root.join(FOLDER), &kept)?;
    }
    Ok(true)
}

/// The harnesses that the arguments ask for.
fn choose(arguments: &Arguments) -> Vec<Entry> {
    let list = include_str!("../../harnesses.toml");
    let all: Committed = toml::from_str(list).expect("the list is well-formed");
    let (number, of) = arguments.part.unwrap_or((1, 1));
    let named = |entry: &Entry| {
        let names = &arguments.names;
        names.is_empty() || names.iter().any(|name| entry.name.contains(name))
    };
    let quick = |entry: &Entry| {
        let limit = arguments.within;
        limit.is_none_or(|limit| entry.measured().is_some_and(|it| it <= limit))
    };
    let chosen = all.harness.into_iter().filter(named).filter(quick);
    chosen.skip(number - 1).step_by(of).collect()
}

/// Runs the chosen harnesses; how many were not verified.
fn run(
    arguments: &Arguments,
    kani: &str,
    chosen: Vec<Entry>,
    kept: &mut Kept,
) -> Result<usize, String> {
    let known = |entry: &Entry| !arguments.keeping.again && kept.seconds(&entry.name).is_some();
    let (known, mut wanted): (Vec<_>, Vec<_>) = chosen.into_iter().partition(known);
    // The longest first, so that no job is left with one at the end.
    let seconds = |entry: &Entry| entry.measured().unwrap_or(f64::INFINITY);
    wanted.sort_by(|one, other| seconds(other).total_cmp(&seconds(one)));
    if !known.is_empty() {
        println!(
            "{} harnesses were verified before, {} has them; --again runs them again.",
            known.len(),
            arguments.keeping.keep.display()
        );
    }
    let mut progress = Progress::of(&wanted);
    let batches: VecDeque<_> = wanted.chunks(BATCH).map(<[Entry]>::to_vec).collect();
    let batches = Mutex::new(batches);
    let limit = Duration::from_secs(arguments.limit);
    let (sender, outcomes) = mpsc::channel();
    let failed = std::thread::scope(|scope| {
        for job in 1..=arguments.jobs {
            let (sender, batches) = (sender.clone(), &batches);
            scope.spawn(move || {
                let next = || {
                    let mut batches = batches.lock().unwrap_or_else(PoisonError::into_inner);
                    batches.pop_front()
                };
                while let Some(entries) = next() {
                    let batch = Batch {
                        program: kani.to_owned(),
                        entries,
                        limit,
                        memory: arguments.memory,
                        job,
                    };
                    let cause = batch.run(&mut |outcome| sender.send(Ok(outcome)).is_ok());
                    if let Err(cause) = cause {
                        // Where nobody listens any more, another job has said why.
                        let _ = sender.send(Err(cause));
                        return;
                    }
                }
            });
        }
        drop(sender);
        let mut failed = 0;
        for outcome in outcomes {
            // The others end with their batch.
            let outcome = outcome.inspect_err(|_| {
                let mut batches = batches.lock().unwrap_or_else(PoisonError::into_inner);
                batches.clear();
            })?;
            failed += usize::from(outcome.failure.is_some());
            kept.keep(&outcome)?;
            progress.show(&outcome);
        }
        Ok::<_, String>(failed)
    })?;
    progress.end(known.len(), failed);
    Ok(failed)
}
