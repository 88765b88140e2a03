//! I4: `(s,q)` is started at most once, whatever is duplicated.

use super::prelude::*;

property! {
    "I4", Authentication::NAMES;
    untimed S "a command is started at most once",
        Some("a follower starts a maneuver"),
        Rule::Step(StepRule { holds, premise: |step| step.started().is_some(), looks_back: true, of_two: false }),
        "StartsRepeatedWhileRunning";
}

fn holds(step: &StepView) -> bool {
    step.started().is_none_or(|maneuver| {
        let station = step.after.persisted.station;
        let commanded = step.history.command(station, maneuver.id);
        commanded.is_none_or(|command| !command.started)
    })
}
