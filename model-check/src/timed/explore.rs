//! The exploration of the timed model: every reachable state, breadth first.

use std::collections::{HashMap, VecDeque};

use rustc_hash::FxBuildHasher;

use super::measure::Longest;
use super::model::TimedModel;
use super::premises::Premises;
use super::state::{TimedAction, TimedState};

use crate::exploration::{CheckProgress, ExplorationLimits};
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

impl Explored {
    /// Explores `model`. `watch` receives the progress now and then.
    pub(super) fn of(
        model: &TimedModel,
        limits: &ExplorationLimits,
        watch: &mut dyn FnMut(CheckProgress),
    ) -> Self {
        let mut explored = Self::new(Premises::of(&model.timed().properties));
        let mut numbers: HashMap<TimedState, u32, FxBuildHasher> = HashMap::default();
        let mut waiting = VecDeque::new();
        explored.add(model, model.initial(), (0, 0), &mut numbers, &mut waiting);
        let (mut at, mut level_ends) = (0, 1);
        let mut actions = Vec::new();
        while let Some(state) = waiting.pop_front() {
            if at == level_ends {
                (explored.depth, level_ends) = (explored.depth + 1, numbers.len());
            }
            if at % 16_384 == 0 {
                explored.tell(model, waiting.len(), watch);
                explored.cut_off = limits.time_reached();
                if explored.cut_off.is_some() {
                    return explored;
                }
            }
            let from = number(at);
            actions.clear();
            model.actions_in(&state, &mut actions);
            let mut stuck = !actions.is_empty();
            for (i, &action) in (0..).zip(&actions) {
                let Some(next) = model.successor(&state, action, &mut explored.longest) else {
                    continue;
                };
                if !explored.premises.are_met() {
                    let note = |step: &TimedStepView<'_>| explored.premises.note_step(step);
                    model.look_at_step(&state, &next, RobotSteps::NONE, note);
                }
                let to = match numbers.get(&next) {
                    Some(&known) => known,
                    None if limits.states_reached(numbers.len()) => {
                        explored.cut_off = Some(CutOff::StateLimit);
                        return explored;
                    }
                    None => explored.add(model, next, (from, i), &mut numbers, &mut waiting),
                };
                stuck = false;
                explored.transitions += 1;
                if !matches!(action, TimedAction::Tick(_)) {
                    explored.instant.push((from, to));
                }
            }
            if stuck {
                explored.broken[PropertyId::I12 as usize].get_or_insert(from);
            }
            at += 1;
        }
        drop(numbers);
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

    fn add(
        &mut self,
        model: &TimedModel,
        state: TimedState,
        parent: (u32, u16),
        numbers: &mut HashMap<TimedState, u32, FxBuildHasher>,
        waiting: &mut VecDeque<TimedState>,
    ) -> u32 {
        let fresh = number(numbers.len());
        self.parents.push(parent);
        if !self.premises.are_met() {
            model.look(&state, |state| self.premises.note(state));
        }
        for property in PropertyId::ALL {
            if state.broken.has(property) {
                self.broken[property as usize].get_or_insert(fresh);
            }
        }
        waiting.push_back(state.clone());
        numbers.insert(state, fresh);
        fresh
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
