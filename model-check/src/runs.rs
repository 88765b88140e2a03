//! The graph of a model as a system under fairness, and its runs with what happens in them.

use crate::fair::{Classes, Edge, Lasso, System};
use crate::fairness::Classifier;
use crate::graph::Graph;
use crate::model::{Action, Model, ModelState};

/// The graph of a model, whose transitions are kept.
pub(crate) struct Runs<'a> {
    pub(crate) model: &'a Model,
    pub(crate) graph: &'a Graph,
}

impl Runs<'_> {
    /// Every action that is possible in a state, with the transition that it makes.
    ///
    /// # Panics
    /// Where transitions are not kept.
    fn transitions(&self, state: u32) -> impl Iterator<Item = (Action, Edge)> {
        let from = self.graph.state(state);
        let mut actions = Vec::new();
        self.model.actions_in(&from, &mut actions);
        actions.into_iter().filter_map(move |action| {
            let (next, step) = self.model.successor_up_to_symmetry(&from, action)?;
            let number = self.graph.successor_number(state, &next);
            let edge = Edge {
                to: number.expect("its transitions are kept"),
                taken: Classifier(self.model).taken(action, step),
            };
            Some((action, edge))
        })
    }

    /// A run along these states, with the action that leads to the next one. It needs neither classes, which a
    /// scenario without liveness may have too many of, nor transitions that are kept.
    pub(crate) fn stem(&self, stem: &[u32]) -> Vec<(ModelState, Option<Action>)> {
        let mut run = Vec::with_capacity(stem.len());
        for pair in stem.windows(2) {
            let (from, to) = (self.graph.state(pair[0]), self.graph.state(pair[1]));
            let action = self.model.action_between(&from, &to);
            run.push((from, action));
        }
        run.extend(stem.last().map(|&last| (self.graph.state(last), None)));
        run
    }

    /// A run that ends in a cycle.
    pub(crate) fn lasso(&self, lasso: &Lasso) -> Vec<(ModelState, Option<Action>)> {
        let mut run = self.stem(&lasso.stem);
        let Some(&(mut at)) = lasso.stem.last() else {
            return run;
        };
        run.pop();
        for edge in &lasso.cycle {
            let mut transitions = self.transitions(at);
            let action = transitions.find(|(_, taken)| taken == edge);
            run.push((self.graph.state(at), action.map(|(action, _)| action)));
            at = edge.to;
        }
        run.push((self.graph.state(at), None));
        run
    }
}

impl System for Runs<'_> {
    fn states(&self) -> u32 {
        u32::try_from(self.graph.states()).expect("no more than can be numbered")
    }

    fn edge(&self, state: u32, place: usize) -> Option<Edge> {
        self.graph.edge(state, place)
    }

    fn enabled(&self, state: u32) -> Classes {
        self.graph.enabled(state)
    }

    fn run_to(&self, state: u32) -> Vec<u32> {
        self.graph.run_to(self.model, state)
    }
}
