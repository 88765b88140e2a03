//! Queries on a graph.

use super::{Graph, RunOf, TransitionSystem};
use crate::fair::{Classes, Edge, System};
use crate::properties::PropertyId;
use crate::report::CutOff;
use crate::store::Store;

impl<S: TransitionSystem> Graph<'_, S> {
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

    pub(crate) fn state(&self, number: u32) -> S::State {
        self.states.get(number)
    }

    /// Targets of the marked transitions out of a state, or of its other ones. There are none where transitions are not kept.
    pub(crate) fn targets(&self, state: usize, are_marked: bool) -> impl Iterator<Item = u32> {
        let edges = self.edges.iter();
        edges.flat_map(move |edges| edges.targets_with_mark(state, are_marked))
    }

    /// A shortest run into a state, with its actions.
    pub(crate) fn run_into(&self, number: u32) -> RunOf<S> {
        self.run_along(&self.run_to(number))
    }

    /// A run along these states. It needs neither classes, which a scenario without liveness may have too many of, nor
    /// transitions that are kept.
    pub(crate) fn run_along(&self, states: &[u32]) -> RunOf<S> {
        let steps = states.windows(2).map(|pair| {
            let (from, to) = (self.state(pair[0]), self.state(pair[1]));
            let action = self.system.action_between(&from, &to);
            (from, action)
        });
        let last = states.last().map(|&last| (self.state(last), None));
        steps.chain(last).collect()
    }

    /// The state from which a state was found; the initial one was found from none. Where transitions are not kept, the
    /// level before is expanded anew.
    fn first_source(&self, number: u32) -> Option<u32> {
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
            self.system.action_between(&source, &state).is_some()
        };
        (self.levels[level - 1]..self.levels[level]).find(leads_there)
    }
}

/// Under fairness. It has neither transitions nor classes where those are not kept.
impl<S: TransitionSystem> System for Graph<'_, S> {
    fn states(&self) -> u32 {
        u32::try_from(self.states()).expect("no more than can be numbered")
    }

    fn edge(&self, state: u32, place: usize) -> Option<Edge> {
        self.edges.as_ref()?.edge(state, place)
    }

    fn enabled(&self, state: u32) -> Classes {
        let edges = self.edges.as_ref();
        edges.map_or(Classes::NONE, |edges| edges.enabled(state))
    }

    fn run_to(&self, number: u32) -> Vec<u32> {
        let mut run = vec![number];
        while let Some(before) = self.first_source(run[run.len() - 1]) {
            run.push(before);
        }
        run.reverse();
        run
    }
}
