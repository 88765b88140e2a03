//! The model as a system that is explored.

use super::{Action, Delivery, Model, ModelState};
use crate::explore::{Judged, Keep, Label, TransitionSystem};
use crate::fair::Classes;
use crate::fairness::Classifier;
use crate::store::States;

impl TransitionSystem for Model {
    type State = ModelState;
    type Action = Action;
    type States = States;
    type Notes = ();

    const COUNTS_ACTIONS: bool = false;

    fn initial(&self) -> ModelState {
        self.initial()
    }

    fn actions_in(&self, state: &ModelState, actions: &mut Vec<Action>) {
        self.actions_in(state, actions);
    }

    fn state_after(&self, state: &ModelState, action: Action) -> Option<ModelState> {
        let (next, _) = self.successor_up_to_symmetry(state, action)?;
        Some(next)
    }

    fn expand(
        &self,
        state: &ModelState,
        actions: &[Action],
        keep: Keep,
        (): &mut (),
        mut lead_to: impl FnMut(ModelState, Label),
    ) -> Judged {
        let classifier = (keep == Keep::Classes).then_some(Classifier(self));
        let broken = self.broken_in(state);
        // While the fate of messages on air is decided first.
        let off_air = classifier.filter(|_| self.is_on_air(state));
        let mut enabled = off_air.map_or(Classes::NONE, |it| it.enabled_off_air(state));
        for &action in actions {
            let Some((next, step)) = self.successor_up_to_symmetry(state, action) else {
                continue;
            };
            let classes = classifier.map(|it| (it.enabled_by(action), it.taken(action, step)));
            let (enabled_by, taken) = classes.unwrap_or_default();
            enabled |= enabled_by;
            let is_marked = is_by_chance(action);
            lead_to(next, Label { is_marked, taken });
        }
        Judged { broken, enabled }
    }

    fn no_notes(&self) {}

    fn add_notes((): &mut (), (): ()) {}

    fn has_marks(&self) -> bool {
        self.scenario().channel.monotone
    }
}

/// Whether an action is an arrival on a monotone channel, which may never happen.
const fn is_by_chance(action: Action) -> bool {
    matches!(
        action,
        Action::Deliver {
            how: Delivery::AnyTime,
            ..
        }
    )
}
