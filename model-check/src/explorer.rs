//! Exploration, breadth first. Several threads expand states, a batch at a time; then one thread numbers what is new, in
//! the order in which a single thread would have found it. So levels, counts and shortest runs depend on no number of
//! threads.

use std::num::NonZeroUsize;

use crate::exploration::{CheckProgress, ExplorationLimits};
use crate::parallel::map_chunks;
use crate::report::CutOff;

/// How many states are expanded before what they lead to is numbered.
const BATCH: usize = 16_384;

/// How many of them a thread takes at a time.
const CHUNK: usize = 256;

/// What is explored, and what has been found of it. States have numbers from 0, in the order in which they are found.
pub(crate) trait Space: Sync {
    type State: Send;
    /// What is noted of a state when it is expanded.
    type Seen: Send;
    /// What is noted of a transition.
    type Way: Copy + Send;
    /// What a thread needs to expand some states, and notes of all of them.
    type Work: Send;

    /// How many states have numbers.
    fn states(&self) -> usize;

    /// The number of a state, if it has one.
    fn find(&self, state: &Self::State) -> Option<u32>;

    /// The number of a state that was reached from `from`, a new one if it has none.
    fn add(&mut self, state: Self::State, from: u32, way: Self::Way) -> u32;

    /// What a thread begins with.
    fn work(&self) -> Self::Work;

    /// Calls `lead_to` for each transition out of a state.
    fn expand(
        &self,
        number: u32,
        work: &mut Self::Work,
        lead_to: impl FnMut(Self::State, Self::Way),
    ) -> Self::Seen;

    /// Adds what a thread noted.
    fn add_work(&mut self, _: Self::Work) {}

    /// Begins to add what a state leads to. States come in their order.
    fn begin(&mut self, number: u32, seen: &Self::Seen);

    /// Adds a transition out of the state that was begun.
    fn add_way(&mut self, from: u32, to: u32, way: Self::Way);

    /// Ends the state that was begun; says why the exploration has to end, if it has.
    fn end(&mut self, _: &Self::Seen) -> Result<(), CutOff> {
        Ok(())
    }

    /// Whether what has been found to be broken is enough.
    fn is_enough(&self) -> bool {
        false
    }
}

/// Explores a space, which has the initial state alone, with this many threads. `watch` receives the progress. Returns
/// the number of the first state of each level, and why the exploration stopped before the end, where it did.
pub(crate) fn explore<S: Space>(
    space: &mut S,
    threads: NonZeroUsize,
    limits: &ExplorationLimits,
    watch: &mut dyn FnMut(CheckProgress),
) -> (Vec<u32>, Option<CutOff>) {
    let mut levels = vec![0];
    let stopped = explore_levels(space, &mut levels, threads, limits, watch);
    (levels, stopped.err())
}

fn explore_levels<S: Space>(
    space: &mut S,
    levels: &mut Vec<u32>,
    threads: NonZeroUsize,
    limits: &ExplorationLimits,
    watch: &mut dyn FnMut(CheckProgress),
) -> Result<(), CutOff> {
    // The next state to be expanded, and the first one behind its level.
    let (mut at, mut level_ends) = (0, 1);
    while at < space.states() {
        watch(CheckProgress {
            checked: space.states(),
            explored: space.states(),
            frontier: space.states() - at,
            depth: levels.len() - 1,
            expected: None,
        });
        limits.time_reached().map_or(Ok(()), Err)?;
        let batch: Vec<u32> = (short(at)..short(space.states())).take(BATCH).collect();
        let expand = |states: &[u32]| Expansion::of(space, states);
        for expansion in map_chunks(threads, &batch, CHUNK, expand) {
            space.add_work(expansion.work);
            let mut transitions = expansion.transitions.into_iter();
            for (seen, count) in expansion.states {
                if at == level_ends {
                    levels.push(short(at));
                    level_ends = space.states();
                }
                let transitions = transitions.by_ref().take(count);
                add(space, limits, short(at), &seen, transitions)?;
                at += 1;
            }
        }
        if space.is_enough() {
            return Err(CutOff::FoundBroken);
        }
    }
    Ok(())
}

/// Adds what the state `from` leads to; says why not all of it is added, where it is not.
fn add<S: Space>(
    space: &mut S,
    limits: &ExplorationLimits,
    from: u32,
    seen: &S::Seen,
    transitions: impl Iterator<Item = (Next<S::State>, S::Way)>,
) -> Result<(), CutOff> {
    space.begin(from, seen);
    for (next, way) in transitions {
        let states = space.states();
        let is_full = limits.states_reached(states) || states == u32::MAX as usize;
        let to = match next {
            Next::Known(number) => number,
            Next::Fresh(next) if is_full => space.find(&next).ok_or(CutOff::StateLimit)?,
            Next::Fresh(next) => space.add(next, from, way),
        };
        space.add_way(from, to, way);
    }
    space.end(seen)
}

/// What some states are found to be, and where their transitions lead.
struct Expansion<S: Space> {
    work: S::Work,
    /// Each with how many transitions it has.
    states: Vec<(S::Seen, usize)>,
    /// Of all these states, one after the other.
    transitions: Vec<(Next<S::State>, S::Way)>,
}

enum Next<T> {
    /// A state that had a number before the batch was expanded.
    Known(u32),
    /// A state that had none. An earlier one of the batch may be the same.
    Fresh(T),
}

impl<S: Space> Expansion<S> {
    fn of(space: &S, states: &[u32]) -> Self {
        let mut expansion = Self {
            work: space.work(),
            states: Vec::with_capacity(states.len()),
            transitions: Vec::new(),
        };
        for &number in states {
            let from = expansion.transitions.len();
            let lead_to = |next, way| {
                let next = match space.find(&next) {
                    Some(number) => Next::Known(number),
                    None => Next::Fresh(next),
                };
                expansion.transitions.push((next, way));
            };
            let seen = space.expand(number, &mut expansion.work, lead_to);
            let count = expansion.transitions.len() - from;
            expansion.states.push((seen, count));
        }
        expansion
    }
}

/// The number of a state.
///
/// # Panics
/// Where there are more states than can be numbered.
pub(crate) fn short(number: usize) -> u32 {
    u32::try_from(number).expect("no more states than can be numbered")
}
