//! The exploration of the timed model: every reachable state, breadth first. Threads expand states, a batch at a
//! time; then one numbers what is new, in the order of a single thread.

use std::collections::{HashMap, VecDeque};
use std::num::NonZeroUsize;

use rustc_hash::FxBuildHasher;

use super::measure::Longest;
use super::model::TimedModel;
use super::premises::Premises;
use super::state::{TimedAction, TimedState};

use crate::exploration::{BATCH, CHUNK, CheckProgress, ExplorationLimits};
use crate::parallel::map_chunks;
use crate::properties::PropertyId;
use crate::properties::timed_view::{RobotSteps, TimedStepView};
use crate::report::CutOff;

/// What an exploration found.
pub(super) struct Explored {
    pub(super) transitions: usize,
    pub(super) depth: usize,
    pub(super) cut_off: Option<CutOff>,
    pub(super) longest: Longest,
    pub(super) premises: Premises,
    /// For each state the one through which it was first reached, and by which of its actions.
    parents: Vec<(u32, u16)>,
    /// For each property, in the order of [`PropertyId::ALL`], the first state that breaks it.
    broken: [Option<u32>; PropertyId::ALL.len()],
    /// Transitions in which no time passes.
    instant: Vec<(u32, u32)>,
}

/// Numbers of states, by what the states are.
type StateNumbers = HashMap<TimedState, u32, FxBuildHasher>;

/// Where the transitions of some states lead, and what they show.
struct TimedExpansion {
    longest: Longest,
    premises: Premises,
    /// For each state, how many transitions it has, and whether nothing that is about to happen can.
    states: Vec<(usize, bool)>,
    /// Of all these states, one after the other.
    transitions: Vec<TimedTransition>,
}

struct TimedTransition {
    /// The place of its action among those of its state.
    action: u16,
    /// Whether no time passes.
    is_instant: bool,
    next: TimedNext,
}

#[expect(
    clippy::large_enum_variant,
    reason = "it lives as long as a batch, and a box for each would cost more"
)]
enum TimedNext {
    /// A state that had a number before the batch was expanded.
    Known(u32),
    /// A state that had none. An earlier one of the batch may be the same.
    Fresh(TimedState),
}

impl TimedExpansion {
    fn of(
        model: &TimedModel,
        states: &[TimedState],
        numbers: &StateNumbers,
        met: &Premises,
    ) -> Self {
        let mut found = Self {
            longest: Longest::default(),
            premises: met.clone(),
            states: Vec::with_capacity(states.len()),
            transitions: Vec::new(),
        };
        let mut actions = Vec::new();
        for state in states {
            actions.clear();
            model.actions_in(state, &mut actions);
            let before = found.transitions.len();
            for (i, &action) in (0..).zip(&actions) {
                let Some(next) = model.successor(state, action, &mut found.longest) else {
                    continue;
                };
                if !found.premises.are_met() {
                    let note = |step: &TimedStepView<'_>| found.premises.note_step(step);
                    model.look_at_step(state, &next, RobotSteps::NONE, note);
                }
                found.transitions.push(TimedTransition {
                    action: i,
                    is_instant: !matches!(action, TimedAction::Tick(_)),
                    next: match numbers.get(&next) {
                        Some(&known) => TimedNext::Known(known),
                        None => TimedNext::Fresh(next),
                    },
                });
            }
            let transitions = found.transitions.len() - before;
            let stuck = !actions.is_empty() && transitions == 0;
            found.states.push((transitions, stuck));
        }
        found
    }
}

/// An exploration under way.
struct Exploring<'a> {
    model: &'a TimedModel,
    limits: &'a ExplorationLimits,
    explored: Explored,
    numbers: StateNumbers,
    /// States that are still to be expanded.
    waiting: VecDeque<TimedState>,
    /// The number of the next state to be expanded.
    at: usize,
    /// The first number behind the level that is being expanded.
    level_ends: usize,
}

impl Exploring<'_> {
    /// Expands the next states.
    fn expand_batch(&mut self, threads: NonZeroUsize) -> Vec<TimedExpansion> {
        let batch = self.waiting.len().min(BATCH);
        let batch: Vec<_> = self.waiting.drain(..batch).collect();
        map_chunks(threads, &batch, CHUNK, |states| {
            TimedExpansion::of(self.model, states, &self.numbers, &self.explored.premises)
        })
    }

    /// Adds what an expansion found; says why not all of it is added, where it is not.
    fn add_all(&mut self, expansion: TimedExpansion) -> Option<CutOff> {
        self.explored.longest.add(expansion.longest);
        self.explored.premises.add(&expansion.premises);
        let mut transitions = expansion.transitions.into_iter();
        for (count, stuck) in expansion.states {
            if self.at == self.level_ends {
                self.explored.depth += 1;
                self.level_ends = self.numbers.len();
            }
            let from = number(self.at);
            for transition in transitions.by_ref().take(count) {
                let to = match transition.next {
                    TimedNext::Known(known) => known,
                    TimedNext::Fresh(next) => match self.numbers.get(&next) {
                        Some(&known) => known,
                        None if self.limits.states_reached(self.numbers.len()) => {
                            return Some(CutOff::StateLimit);
                        }
                        None => self.add(next, (from, transition.action)),
                    },
                };
                self.explored.transitions += 1;
                if transition.is_instant {
                    self.explored.instant.push((from, to));
                }
            }
            if stuck {
                self.explored.broken[PropertyId::I12 as usize].get_or_insert(from);
            }
            self.at += 1;
        }
        None
    }

    fn add(&mut self, state: TimedState, parent: (u32, u16)) -> u32 {
        let fresh = number(self.numbers.len());
        self.explored.note(self.model, &state, parent, fresh);
        self.waiting.push_back(state.clone());
        self.numbers.insert(state, fresh);
        fresh
    }
}

impl Explored {
    /// Explores `model`. `watch` receives the progress now and then.
    pub(super) fn of(
        model: &TimedModel,
        threads: NonZeroUsize,
        limits: &ExplorationLimits,
        watch: &mut dyn FnMut(CheckProgress),
    ) -> Self {
        let mut exploring = Exploring {
            model,
            limits,
            explored: Self::new(Premises::of(&model.timed().properties)),
            numbers: StateNumbers::default(),
            waiting: VecDeque::new(),
            at: 0,
            level_ends: 1,
        };
        exploring.add(model.initial(), (0, 0));
        while !exploring.waiting.is_empty() {
            let frontier = exploring.waiting.len();
            exploring.explored.tell(model, frontier, watch);
            let cut_off = limits.time_reached().or_else(|| {
                let expansions = exploring.expand_batch(threads);
                expansions
                    .into_iter()
                    .find_map(|expansion| exploring.add_all(expansion))
            });
            if cut_off.is_some() {
                exploring.explored.cut_off = cut_off;
                return exploring.explored;
            }
        }
        let mut explored = exploring.explored;
        drop(exploring.numbers);
        explored.note_time_standing_still();
        explored
    }

    fn new(premises: Premises) -> Self {
        Self {
            transitions: 0,
            depth: 0,
            cut_off: None,
            longest: Longest::default(),
            premises,
            parents: Vec::new(),
            broken: [None; PropertyId::ALL.len()],
            instant: Vec::new(),
        }
    }

    /// Notes what a new state is, and how it was reached.
    fn note(&mut self, model: &TimedModel, state: &TimedState, parent: (u32, u16), fresh: u32) {
        self.parents.push(parent);
        if !self.premises.are_met() {
            model.look(state, |state| self.premises.note(state));
        }
        for property in PropertyId::ALL {
            if state.broken.has(property) {
                self.broken[property as usize].get_or_insert(fresh);
            }
        }
    }

    fn tell(&self, model: &TimedModel, frontier: usize, watch: &mut dyn FnMut(CheckProgress)) {
        let states = self.states();
        watch(CheckProgress {
            checked: states,
            explored: states,
            frontier,
            depth: self.depth,
            expected: model.scenario().expected.map(|size| size.unique_states),
        });
    }

    /// I12: a cycle of transitions in which no time passes would hold time up for ever. Takes away
    /// states that no such transition leads to until none is left, or only those behind a cycle.
    fn note_time_standing_still(&mut self) {
        self.instant.sort_unstable();
        let mut incoming = vec![0_u32; self.states()];
        for &(_, to) in &self.instant {
            incoming[to as usize] += 1;
        }
        let mut free: Vec<u32> = (0..number(self.states()))
            .filter(|&state| incoming[state as usize] == 0)
            .collect();
        while let Some(state) = free.pop() {
            let first = self.instant.partition_point(|&(from, _)| from < state);
            for &(_, to) in self.instant[first..]
                .iter()
                .take_while(|&&(from, _)| from == state)
            {
                incoming[to as usize] -= 1;
                if incoming[to as usize] == 0 {
                    free.push(to);
                }
            }
        }
        if let Some(held) = incoming.iter().position(|&left| left > 0) {
            self.broken[PropertyId::I12 as usize].get_or_insert(number(held));
        }
    }

    pub(super) const fn states(&self) -> usize {
        self.parents.len()
    }

    /// The actions of a shortest run to a state that breaks a property, if one does.
    pub(super) fn path_to_broken(&self, property: PropertyId) -> Option<Vec<u16>> {
        let mut at = self.broken[property as usize]?;
        let mut path = Vec::new();
        while at != 0 {
            let (parent, action) = self.parents[at as usize];
            path.push(action);
            at = parent;
        }
        path.reverse();
        Some(path)
    }
}

/// A state's number.
///
/// # Panics
/// When there are 2^32 states or more, far beyond what fits in memory.
fn number(place: usize) -> u32 {
    u32::try_from(place).expect("fewer than 2^32 states")
}
