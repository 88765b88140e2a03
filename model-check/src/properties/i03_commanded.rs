//! I3: a follower executes `(s,q)` only if its leader sent exactly that command to it.

use super::{StepRule, StepView};

pub(super) const RULE: StepRule = StepRule {
    holds,
    premise,
    looks_back: true,
};

fn holds(step: &StepView) -> bool {
    step.started().is_none_or(|maneuver| {
        let commanded = step
            .history
            .command(step.after.persisted.station, maneuver.id);
        commanded.is_some_and(|command| command.task == maneuver.task)
    })
}

fn premise(step: &StepView) -> bool {
    step.started().is_some()
}
