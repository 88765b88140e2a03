//! Runs of the untimed model without end, and its dead ends.

use crate::explore::{Graph, RunOf};
use crate::fair::Lasso;
use crate::fairness::Classifier;
use crate::model::{Action, Model};
use crate::node::Node;

impl Graph<'_, Model> {
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
            let (from, to) = (self.state(at), self.state(edge.to));
            let is_taken = |&action: &Action| {
                let made = self.system.successor_up_to_symmetry(&from, action);
                let taken = |step| Classifier(self.system).taken(action, step);
                made.is_some_and(|(next, step)| next == to && taken(step) == edge.taken)
            };
            let mut actions = Vec::new();
            self.system.actions_in(&from, &mut actions);
            let action = actions.into_iter().find(is_taken);
            run.push((from, action));
            at = edge.to;
        }
        run.push((self.state(at), None));
        run
    }
}
