//! The exploration of the timed model: what is noted of its states and transitions while they are found.

use std::num::NonZeroUsize;

use super::measure::Longest;
use super::model::TimedModel;
use super::premises::Premises;
use super::state::{TimedAction, TimedState};

use crate::exploration::{CheckProgress, ExplorationLimits};
use crate::explorer::{Space, explore, short};
use crate::numbered::Numbered;
use crate::properties::PropertyId;
use crate::properties::timed_view::{RobotSteps, TimedStepView, TimedView};
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

/// An exploration under way.
struct Exploring<'a> {
    model: &'a TimedModel,
    states: Numbered<TimedState>,
    explored: Explored,
}

/// What some states and their transitions show.
struct Shown {
    longest: Longest,
    premises: Premises,
    /// Used anew for each state.
    actions: Vec<TimedAction>,
}

#[derive(Clone, Copy)]
struct Way {
    /// The place of its action among those of its state.
    action: u16,
    /// Whether no time passes.
    is_instant: bool,
}

impl Space for Exploring<'_> {
    type State = TimedState;
    /// Whether nothing that is about to happen can.
    type Seen = bool;
    type Way = Way;
    type Work = Shown;

    fn states(&self) -> usize {
        self.states.len()
    }

    fn find(&self, state: &TimedState) -> Option<u32> {
        self.states.find(state)
    }

    fn add(&mut self, state: TimedState, from: u32, way: Way) -> u32 {
        let number = self.states.add(state);
        let explored = &mut self.explored;
        if number as usize == explored.states() {
            explored.parents.push((from, way.action));
            let state = self.states.get(number);
            if !explored.premises.are_met() {
                let note = |state: &TimedView<'_>| explored.premises.note(state);
                self.model.look(state, note);
            }
            let broken = PropertyId::ALL.into_iter();
            for property in broken.filter(|&property| state.broken.has(property)) {
                explored.broken[property as usize].get_or_insert(number);
            }
        }
        number
    }

    fn work(&self) -> Shown {
        Shown {
            longest: Longest::default(),
            premises: self.explored.premises.clone(),
            actions: Vec::new(),
        }
    }

    fn expand(
        &self,
        number: u32,
        shown: &mut Shown,
        mut lead_to: impl FnMut(TimedState, Way),
    ) -> bool {
        let (model, state) = (self.model, self.states.get(number));
        shown.actions.clear();
        model.actions_in(state, &mut shown.actions);
        let mut is_stuck = !shown.actions.is_empty();
        for (i, &action) in (0..).zip(&shown.actions) {
            let Some(next) = model.successor(state, action, &mut shown.longest) else {
                continue;
            };
            if !shown.premises.are_met() {
                let note = |step: &TimedStepView<'_>| shown.premises.note_step(step);
                model.look_at_step(state, &next, RobotSteps::NONE, note);
            }
            let way = Way {
                action: i,
                is_instant: !matches!(action, TimedAction::Tick(_)),
            };
            lead_to(next, way);
            is_stuck = false;
        }
        is_stuck
    }

    fn add_work(&mut self, shown: Shown) {
        self.explored.longest.add(shown.longest);
        self.explored.premises.add(&shown.premises);
    }

    fn begin(&mut self, number: u32, is_stuck: &bool) {
        if *is_stuck {
            self.explored.broken[PropertyId::I12 as usize].get_or_insert(number);
        }
    }

    fn add_way(&mut self, from: u32, to: u32, way: Way) {
        self.explored.transitions += 1;
        if way.is_instant {
            self.explored.instant.push((from, to));
        }
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
            states: Numbered::default(),
            explored: Self {
                transitions: 0,
                depth: 0,
                cut_off: None,
                longest: Longest::default(),
                premises: Premises::of(&model.timed().properties),
                parents: Vec::new(),
                broken: [None; PropertyId::ALL.len()],
                instant: Vec::new(),
            },
        };
        let none = Way {
            action: 0,
            is_instant: false,
        };
        exploring.add(model.initial(), 0, none);
        let expected = model.scenario().expected.map(|size| size.unique_states);
        let mut tell = |reached| {
            watch(CheckProgress {
                expected,
                ..reached
            });
        };
        let (levels, cut_off) = explore(&mut exploring, threads, limits, &mut tell);
        drop(exploring.states);
        let mut explored = exploring.explored;
        (explored.depth, explored.cut_off) = (levels.len() - 1, cut_off);
        if explored.cut_off.is_none() {
            explored.note_time_standing_still();
        }
        explored
    }

    /// I12: a cycle of transitions in which no time passes would hold time up for ever. Takes away
    /// states that no such transition leads to until none is left, or only those behind a cycle.
    fn note_time_standing_still(&mut self) {
        self.instant.sort_unstable();
        let mut incoming = vec![0_u32; self.states()];
        for &(_, to) in &self.instant {
            incoming[to as usize] += 1;
        }
        let mut free: Vec<u32> = (0..short(self.states()))
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
            self.broken[PropertyId::I12 as usize].get_or_insert(short(held));
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
