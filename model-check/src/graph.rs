//! The states of a model, judged while they are found, and facts about all runs that are read off their transitions.

mod build;
mod edges;

use self::edges::Edges;
use crate::fair::{Classes, Edge};
use crate::model::{Model, ModelState};
use crate::node::Node;
use crate::properties::PropertyId;
use crate::report::CutOff;
use crate::store::States;

/// What is kept of an exploration.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Keep {
    /// States alone, which is enough to judge states and steps.
    States,
    /// The transitions between them too, which say what can be reached.
    Transitions,
    /// And the classes of the transitions, which say what fair runs do.
    Classes,
}

/// Every reachable state, and every transition between them where those are kept.
pub(crate) struct Graph {
    states: States,
    edges: Option<Edges>,
    transitions: usize,
    /// The number of the first state of each level, breadth first.
    levels: Vec<u32>,
    /// Whether each state can reach one in which all robots are idle.
    resettable: Vec<bool>,
    /// For each property of states or steps, in the order of [`PropertyId::ALL`], the first state that
    /// breaks it.
    broken: [Option<u32>; PropertyId::ALL.len()],
    cut_off: Option<CutOff>,
}

impl Graph {
    /// Notes what the state of this number breaks, one bit per property. States come in their order.
    fn note_broken(&mut self, number: u32, broken: u32) {
        if broken == 0 {
            return;
        }
        for property in PropertyId::ALL {
            if broken & property.bit() != 0 {
                self.broken[property as usize].get_or_insert(number);
            }
        }
    }

    /// The first state that breaks a property of states or steps: no other is nearer.
    pub(crate) const fn broken(&self, property: PropertyId) -> Option<u32> {
        self.broken[property as usize]
    }

    pub(crate) fn states(&self) -> usize {
        self.states.len()
    }

    /// Steps from the initial state to the farthest state.
    pub(crate) const fn depth(&self) -> usize {
        self.levels.len() - 1
    }

    pub(crate) const fn transitions(&self) -> usize {
        self.transitions
    }

    pub(crate) const fn cut_off(&self) -> Option<CutOff> {
        self.cut_off
    }

    pub(crate) fn state(&self, number: u32) -> ModelState {
        self.states.get(number)
    }

    /// The number of `next`, which is a successor of state `number`; none where transitions are not kept.
    pub(crate) fn successor_number(&self, number: u32, next: &ModelState) -> Option<u32> {
        let targets = self.edges.as_ref()?.targets(number as usize);
        let mut targets = targets.iter().copied();
        targets.find(|&target| self.state(target) == *next)
    }

    /// The transition with this place among those out of a state, with its classes where those are kept.
    pub(crate) fn edge(&self, state: u32, place: usize) -> Option<Edge> {
        self.edges.as_ref()?.edge(state, place)
    }

    /// The classes that are enabled in a state, where they are kept.
    pub(crate) fn enabled(&self, state: u32) -> Classes {
        let edges = self.edges.as_ref();
        edges.map_or(Classes::NONE, |edges| edges.enabled(state))
    }

    /// A shortest run of `model` from the initial state, both ends included.
    pub(crate) fn run_to(&self, model: &Model, number: u32) -> Vec<u32> {
        let mut run = vec![number];
        while let Some(before) = self.first_source(model, run[run.len() - 1]) {
            run.push(before);
        }
        run.reverse();
        run
    }

    /// The state from which a state was found; the initial one was found from none. Where transitions are not kept, the
    /// level before is expanded anew.
    fn first_source(&self, model: &Model, number: u32) -> Option<u32> {
        if number == 0 {
            return None;
        }
        if let Some(edges) = &self.edges {
            return edges.first_source(number);
        }
        let level = self.levels.partition_point(|&first| first <= number) - 1;
        let state = self.state(number);
        let leads_there = |&source: &u32| {
            let source = self.state(source);
            model.action_between(&source, &state).is_some()
        };
        (self.levels[level - 1]..self.levels[level]).find(leads_there)
    }

    /// For each state, whether it can reach one in which all robots are idle, on a monotone channel without the help of
    /// any message. What comes after a broken step property was not explored, so that counts as well.
    fn can_be_reset(&self, model: &Model) -> Vec<bool> {
        let Some(edges) = &self.edges else {
            return Vec::new();
        };
        let is_reset = |number| {
            let state = self.states.get(number);
            model.nodes(&state).all(Node::is_idle) || state.is_broken()
        };
        let mut can: Vec<bool> = (0..).take(self.states()).map(is_reset).collect();
        // Most transitions lead to a state that was found later: few rounds are enough, and need no memory.
        let mut has_changed = true;
        while std::mem::take(&mut has_changed) {
            for state in (0..can.len()).rev() {
                if !can[state] && edges.sure_targets(state).any(|target| can[target as usize]) {
                    can[state] = true;
                    has_changed = true;
                }
            }
        }
        can
    }

    /// A state from which the robots cannot all get idle any more, as near as possible.
    pub(crate) fn stuck(&self) -> Option<u32> {
        let stuck = self.resettable.iter().position(|&resettable| !resettable)?;
        u32::try_from(stuck).ok()
    }
}
