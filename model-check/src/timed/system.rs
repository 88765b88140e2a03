//! The timed model as a system that is explored: what is noted of its states and transitions.

use super::measure::Longest;
use super::model::TimedModel;
use super::premises::Premises;
use super::state::{TimedAction, TimedState};
use crate::explore::{Graph, Judged, Keep, Label, TransitionSystem};
use crate::fair::Classes;
use crate::numbered::Numbered;
use crate::properties::PropertyId;
use crate::properties::timed_view::{RobotSteps, TimedStepView, TimedView};

#[derive(Clone)]
pub(crate) struct Shown {
    pub(super) longest: Longest,
    pub(super) premises: Premises,
}

impl TransitionSystem for TimedModel {
    type State = TimedState;
    type Action = TimedAction;
    type States = Numbered<TimedState>;
    type Notes = Shown;

    const COUNTS_ACTIONS: bool = true;

    fn initial(&self) -> TimedState {
        self.initial()
    }

    fn actions_in(&self, state: &TimedState, actions: &mut Vec<TimedAction>) {
        self.actions_in(state, actions);
    }

    fn state_after(&self, state: &TimedState, action: TimedAction) -> Option<TimedState> {
        self.successor(state, action, &mut Longest::default())
    }

    fn expand(
        &self,
        state: &TimedState,
        actions: &[TimedAction],
        _: Keep,
        shown: &mut Shown,
        mut lead_to: impl FnMut(TimedState, Label),
    ) -> Judged {
        if !shown.premises.are_met() {
            self.look(state, |state: &TimedView<'_>| shown.premises.note(state));
        }
        // Whether nothing that is about to happen can.
        let mut is_stuck = !actions.is_empty();
        for &action in actions {
            let Some(next) = self.successor(state, action, &mut shown.longest) else {
                continue;
            };
            if !shown.premises.are_met() {
                let note = |step: &TimedStepView<'_>| shown.premises.note_step(step);
                self.look_at_step(state, &next, RobotSteps::NONE, note);
            }
            let label = Label {
                is_marked: !matches!(action, TimedAction::Tick(_)),
                taken: Classes::NONE,
            };
            lead_to(next, label);
            is_stuck = false;
        }
        let stuck = if is_stuck { PropertyId::I12.bit() } else { 0 };
        Judged {
            broken: state.broken | stuck,
            enabled: Classes::NONE,
        }
    }

    fn no_notes(&self) -> Shown {
        Shown {
            longest: Longest::default(),
            premises: Premises::of(&self.timed.properties),
        }
    }

    fn add_notes(all: &mut Shown, more: Shown) {
        all.longest.add(more.longest);
        all.premises.add(&more.premises);
    }

    fn has_marks(&self) -> bool {
        true
    }
}

/// I12: a cycle of transitions in which no time passes would hold time up for ever. Takes away states that no such
/// transition leads to until none is left, or only those behind a cycle; the first one of these.
pub(super) fn where_time_stands_still(graph: &Graph<'_, TimedModel>) -> Option<u32> {
    let mut incoming = vec![0_u32; graph.states()];
    for state in 0..graph.states() {
        for to in graph.targets(state, true) {
            incoming[to as usize] += 1;
        }
    }
    let states = 0..graph.states();
    let mut free: Vec<usize> = states.filter(|&state| incoming[state] == 0).collect();
    while let Some(state) = free.pop() {
        for to in graph.targets(state, true) {
            incoming[to as usize] -= 1;
            if incoming[to as usize] == 0 {
                free.push(to as usize);
            }
        }
    }
    let held = incoming.iter().position(|&left| left > 0)?;
    u32::try_from(held).ok()
}
