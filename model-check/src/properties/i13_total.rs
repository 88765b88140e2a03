//! I13: every input in every state yields a valid state, and an ignored input changes nothing.

use super::prelude::*;

property! {
    "I13", Authentication::NONE;
    untimed S "every input in every state yields a valid state",
        None,
        Rule::Step(StepRule { holds, premise: |_| true, looks_back: false, of_two: false }),
        "ReportsTheLeadersLimit";
}

fn holds(step: &StepView) -> bool {
    let robot = step.after.robot.as_ref();
    let valid = robot.is_none_or(|robot| robot.is_valid(step.config));
    // The record of messages that it heard may change: it is no state of the robot.
    let changes = || {
        let mut after = step.after.clone();
        after.actuation.heard = step.before.actuation.heard;
        after != *step.before
    };
    let ignored_in_silence =
        step.outputs.ignored().is_none() || (step.outputs.len() == 1 && !changes());
    valid && ignored_in_silence
}
