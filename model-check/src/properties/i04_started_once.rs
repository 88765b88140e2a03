//! I4: `(s,q)` is started at most once, whatever is duplicated.

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
        commanded.is_none_or(|command| !command.started)
    })
}

fn premise(step: &StepView) -> bool {
    step.started().is_some()
}
