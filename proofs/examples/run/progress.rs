//! How far a run is, how long the rest will take, and what it took.

use std::time::Instant;

use nix::sys::resource::{UsageWho, getrusage};

use crate::Entry;
use crate::kani::Outcome;

/// How long a harness is thought to take that was never measured, where none was, in seconds.
const GUESS_S: f64 = 15.0;

/// How far it is.
pub(crate) struct Progress {
    weights: Vec<(String, f64)>,
    weight: f64,
    done: usize,
    of: usize,
    weight_done: f64,
    start: Instant,
}

impl Progress {
    pub(crate) fn of(wanted: &[Entry]) -> Self {
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

    pub(crate) fn show(&mut self, outcome: &Outcome) {
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

    pub(crate) fn end(&self, known: usize, failed: usize) {
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
