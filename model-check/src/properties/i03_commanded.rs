//! I3: a follower executes `(s,q)` only if its leader sent exactly that command to it.

use super::prelude::*;

property! {
    "I3", Authentication::truth_of(&[Insider::Leader]);
    untimed S "a follower starts only what its leader commanded it",
        Some("a follower starts a maneuver"),
        Rule::Step(StepRule { holds, premise: |step| step.started().is_some(), looks_back: true, of_two: true }),
        "ObeysCommandsOfAnySession";
}

fn holds(step: &StepView) -> bool {
    step.started().is_none_or(|maneuver| {
        let station = step.after.persisted.station;
        let commanded = step.history.command(station, maneuver.id);
        commanded.is_some_and(|command| command.task == maneuver.task)
    })
}
