//! I4: `(s,q)` is started at most once, whatever is duplicated.

use super::authentication::Authentication;
use super::property::{Claim, Kind, Property, Rule, StepRule};
use super::view::StepView;

pub(super) const PROPERTY: Property = Property {
    id: "I4",
    authentication: Authentication::NAMES,
    untimed: Some(Claim {
        kind: Kind::S,
        statement: "a command is started at most once",
        premise: Some("a follower starts a maneuver"),
        rule: Rule::Step(StepRule {
            holds,
            premise,
            looks_back: true,
            of_two: false,
        }),
        weakening: "StartsRepeatedWhileRunning",
    }),
    timed: None,
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
