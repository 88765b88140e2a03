//! How far an exploration may go, and how far it is.

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::properties::PropertyId;
use crate::report::CutOff;

/// How far and with what a check may go.
#[derive(Clone, Debug)]
pub struct Options {
    /// Threads that explore. No count, verdict or length of a run depends on them.
    pub threads: NonZeroUsize,
    /// Give up after this many states.
    pub states_max: Option<usize>,
    /// Give up after this time.
    pub time_max: Option<Duration>,
    /// Be content as soon as all of these are found to be broken; with none, find all that are.
    pub until_broken: Vec<PropertyId>,
    /// Give up when an observer asks for it.
    pub stop: Stop,
    /// Let stateright explore the model too, and compare what both find. Timed models have none.
    pub second_opinion: bool,
    /// Judge states and steps alone, and keep no transitions: runs are left out of the report. Timed models judge
    /// nothing else.
    pub safety_only: bool,
}

/// A request to give up, which an observer of a check may make. Clones are the same request.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Asks to give up.
    pub fn request(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub(crate) fn withdraw(&self) {
        self.0.store(false, Ordering::Relaxed);
    }

    /// Whether it was asked.
    #[must_use]
    pub fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Default for Options {
    fn default() -> Self {
        let threads = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        Self {
            threads,
            states_max: None,
            time_max: None,
            until_broken: Vec::new(),
            stop: Stop::default(),
            second_opinion: false,
            safety_only: false,
        }
    }
}

impl Options {
    /// The limits on states and time; time runs from now.
    pub(crate) fn limits(&self) -> ExplorationLimits {
        ExplorationLimits::new(self.states_max, self.time_max, &self.stop)
    }
}

/// When an exploration has to stop.
#[derive(Clone, Debug)]
pub struct ExplorationLimits {
    states_max: Option<usize>,
    time_max: Option<Duration>,
    start: Instant,
    stop: Stop,
}

impl ExplorationLimits {
    /// These limits on states and time; time runs from now.
    #[must_use]
    pub fn new(states_max: Option<usize>, time_max: Option<Duration>, stop: &Stop) -> Self {
        Self {
            states_max,
            time_max,
            start: Instant::now(),
            stop: stop.clone(),
        }
    }

    /// How long the exploration has taken until now.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    /// Whether there are as many states as there may be.
    #[must_use]
    pub fn states_reached(&self, states: usize) -> bool {
        self.states_max.is_some_and(|max| states >= max)
    }

    /// Why an exploration has to stop that has taken until now, if it has.
    #[must_use]
    pub fn time_reached(&self) -> Option<CutOff> {
        let reached = self.time_max.is_some_and(|max| self.start.elapsed() >= max);
        let stopped = self.stop.is_requested().then_some(CutOff::Stopped);
        stopped.or(reached.then_some(CutOff::TimeLimit))
    }
}

/// How far a check is.
#[derive(Clone, Copy, Debug, Default)]
pub struct CheckProgress {
    /// Distinct states that stateright has found; where its opinion is not asked for, as many as
    /// `explored`.
    pub checked: usize,
    /// Distinct states that the kit's own exploration has found.
    pub explored: usize,
    /// How many of the latter are still to be expanded.
    pub frontier: usize,
    /// Steps from the initial state to the farthest of the latter.
    pub depth: usize,
    /// How many there will be in the end, where the scenario's file says so.
    pub expected: Option<usize>,
}
