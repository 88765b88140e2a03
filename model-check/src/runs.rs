//! The graph of the untimed model as a system under fairness, and its runs without end.

use crate::explore::{Graph, RunOf};
use crate::fair::{Classes, Edge, Lasso, System};
use crate::fairness::Classifier;
use crate::model::{Action, Model};
use crate::node::Node;

impl Graph<'_, Model> {
    /// Every action that is possible in a state, with the transition that it makes. Panics where transitions are not kept.
    fn actions_of(&self, state: u32) -> impl Iterator<Item = (Action, Edge)> {
        let from = self.state(state);
        let mut actions = Vec::new();
        self.system.actions_in(&from, &mut actions);
        actions.into_iter().filter_map(move |action| {
            let (next, step) = self.system.successor_up_to_symmetry(&from, action)?;
            let number = self.successor_number(state, &next);
            let edge = Edge {
                to: number.expect("its transitions are kept"),
                taken: Classifier(self.system).taken(action, step),
            };
            Some((action, edge))
        })
    }

    /// A state from which the robots cannot all get idle any more, as near as possible; on a monotone channel they have to
    /// without the help of any message. States behind a broken step property were not explored, so such a state counts as
    /// one in which all are idle.
    pub(crate) fn stuck(&self) -> Option<u32> {
        if self.cut_off().is_some() {
            return None;
        }
        let is_reset = |number| {
            let state = self.state(number);
            self.system.nodes(&state).all(Node::is_idle) || state.is_broken()
        };
        let mut can_be_reset: Vec<bool> = (0..).take(self.states()).map(is_reset).collect();
        // Most transitions lead to a state that was found later: few rounds are enough, and need no memory.
        let mut has_changed = true;
        while std::mem::take(&mut has_changed) {
            for state in (0..can_be_reset.len()).rev() {
                let mut sure = self.targets(state, false);
                if !can_be_reset[state] && sure.any(|target| can_be_reset[target as usize]) {
                    can_be_reset[state] = true;
                    has_changed = true;
                }
            }
        }
        let stuck = can_be_reset.iter().position(|can| !can)?;
        u32::try_from(stuck).ok()
    }

    /// A run that ends in a cycle.
    pub(crate) fn lasso(&self, lasso: &Lasso) -> RunOf<Model> {
        let mut run = self.run_along(&lasso.stem);
        let Some(&(mut at)) = lasso.stem.last() else {
            return run;
        };
        run.pop();
        for edge in &lasso.cycle {
            let mut actions = self.actions_of(at);
            let action = actions.find(|(_, taken)| taken == edge);
            run.push((self.state(at), action.map(|(action, _)| action)));
            at = edge.to;
        }
        run.push((self.state(at), None));
        run
    }
}

impl System for Graph<'_, Model> {
    fn states(&self) -> u32 {
        u32::try_from(self.states()).expect("no more than can be numbered")
    }

    fn edge(&self, state: u32, place: usize) -> Option<Edge> {
        self.edge(state, place)
    }

    fn enabled(&self, state: u32) -> Classes {
        self.enabled(state)
    }

    fn run_to(&self, state: u32) -> Vec<u32> {
        self.run_to(state)
    }
}
