//! I3: a follower executes `(s,q)` only if its leader sent exactly that command to it.

use super::authentication::{Authentication, Insider};
use super::property::{Claim, Kind, Property, Rule, StepRule};
use super::view::StepView;

pub(super) const PROPERTY: Property = Property {
    id: "I3",
    authentication: Authentication::truth_of(&[Insider::Leader]),
    untimed: Some(Claim {
        kind: Kind::S,
        statement: "a follower starts only what its leader commanded it",
        premise: Some("a follower starts a maneuver"),
        rule: Rule::Step(StepRule {
            holds,
            premise,
            looks_back: true,
            of_two: true,
        }),
        weakening: "ObeysCommandsOfAnySession",
    }),
    timed: None,
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
