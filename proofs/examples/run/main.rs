//! Runs the harnesses under Kani, and says what came of each, how long all will take, and how much memory it took.
//!
//! A harness fails when Kani does not verify it within the limit, or when a cover mark is not satisfied, which Kani by
//! itself does not call a failure. The environment variable `CARGO_KANI` names another command than `cargo-kani`.

mod kani;
mod kept;

use std::collections::VecDeque;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};

use clap::Parser;
use nix::sys::resource::{UsageWho, getrusage};
use serde::Deserialize;

use kani::{Batch, Outcome};
use kept::Kept;

/// How many harnesses one call of Kani takes: each call builds anew, for half a minute.
const BATCH: usize = 16;

/// How long a harness is thought to take that was never measured, where none was, in seconds.
const GUESS_S: f64 = 15.0;

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
    /// Where verified harnesses are kept, so that a run that was stopped goes on from there.
    #[arg(long, value_name = "FILE", default_value = "target/proofs.jsonl")]
    keep: PathBuf,
    /// Run verified harnesses again.
    #[arg(long)]
    again: bool,
    /// Check each access to memory as well. The crates forbid unsafe code, so the compiler has done that.
    #[arg(long)]
    memory: bool,
}

const AFTER_HELP: &str = "\
A run that was stopped goes on with the harnesses that were not verified yet, unless a source has changed since.
Exit codes: 0 all were verified, 1 some were not, 2 bad usage, or Kani cannot be run.";

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
    let chosen = choose(&arguments);
    if chosen.is_empty() {
        eprintln!("no harness is chosen: harnesses.toml has their names");
        return ExitCode::from(2);
    }
    match run(&arguments, chosen) {
        Ok(failed) => ExitCode::from(u8::from(failed > 0)),
        Err(cause) => {
            eprintln!("{cause}");
            ExitCode::from(2)
        }
    }
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
fn run(arguments: &Arguments, chosen: Vec<Entry>) -> Result<usize, String> {
    let mut kept = Kept::open(&arguments.keep, arguments.memory)?;
    let known = |entry: &Entry| !arguments.again && kept.verified(&entry.name);
    let (known, mut wanted): (Vec<_>, Vec<_>) = chosen.into_iter().partition(known);
    // The longest first, so that no job is left with one at the end.
    let seconds = |entry: &Entry| entry.measured().unwrap_or(f64::INFINITY);
    wanted.sort_by(|one, other| seconds(other).total_cmp(&seconds(one)));
    if !known.is_empty() {
        println!(
            "{} harnesses were verified before, {} has them; --again runs them again.",
            known.len(),
            arguments.keep.display()
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

/// How far it is.
struct Progress {
    weights: Vec<(String, f64)>,
    weight: f64,
    done: usize,
    of: usize,
    weight_done: f64,
    start: Instant,
}

impl Progress {
    fn of(wanted: &[Entry]) -> Self {
        let measured: Vec<_> = wanted.iter().filter_map(Entry::measured).collect();
        let count = u32::try_from(measured.len()).unwrap_or(u32::MAX);
        let mean = measured.iter().sum::<f64>() / f64::from(count.max(1));
        let guess = if measured.is_empty() { GUESS_S } else { mean };
        let weigh = |entry: &Entry| (entry.name.clone(), entry.measured().unwrap_or(guess) + 1.0);
        let weights: Vec<_> = wanted.iter().map(weigh).collect();
        Self {
            weight: weights.iter().map(|(_, weight)| weight).sum(),
            weights,
            done: 0,
            of: wanted.len(),
            weight_done: 0.0,
            start: Instant::now(),
        }
    }

    fn show(&mut self, outcome: &Outcome) {
        self.done += 1;
        let weight = self.weights.iter().find(|(name, _)| *name == outcome.name);
        self.weight_done += weight.map_or(0.0, |(_, weight)| *weight);
        let elapsed = self.start.elapsed().as_secs_f64();
        let left = (self.weight - self.weight_done).max(0.0);
        let minutes = left * elapsed / self.weight_done.max(1.0) / 60.0;
        let verdict = outcome.failure.as_deref().unwrap_or("verified");
        println!(
            "{:3}/{}  {:6.1} s  {}  {verdict}; about {minutes:.0} min to go",
            self.done, self.of, outcome.seconds, outcome.name
        );
    }

    fn end(&self, known: usize, failed: usize) {
        let minutes = self.start.elapsed().as_secs_f64() / 60.0;
        let missing = self.of - self.done;
        print!(
            "{} of {} harnesses verified",
            known + self.done - failed,
            known + self.of
        );
        if missing > 0 {
            print!(", {missing} of them not run");
        }
        print!("; this run: {} in {minutes:.1} min", self.done);
        // In KiB on Linux.
        if let Ok(usage) = getrusage(UsageWho::RUSAGE_CHILDREN) {
            let mebibytes = usage.max_rss() / 1024;
            print!(", {mebibytes} MiB at most for one process");
        }
        println!(".");
    }
}
