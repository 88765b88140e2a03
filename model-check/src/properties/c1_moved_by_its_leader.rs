//! C1: what a station says starts, stops or ends nothing at a robot that does not follow it.
//!
//! So an insider moves the robots that joined it, and no others, whatever it says in its own name.

use crossguard_protocol::{Output, StationId};

use super::prelude::*;

property! {
    "C1", Authentication::NAMES;
    untimed T "what a station says starts, stops or ends nothing at a robot that does not follow it",
        Some("a robot that executes takes in what a station says that it does not follow"),
        Rule::Step(StepRule { holds, premise, looks_back: false, of_two: false }),
        "ObeysCommandsOfAnySession";
}

fn follows(step: &StepView, sender: StationId) -> bool {
    step.before
        .following()
        .is_some_and(|following| following.session.leader == sender)
}

fn holds(step: &StepView) -> bool {
    let Some(sender) = step.sender() else {
        return true;
    };
    let moves = |output: &Output| {
        matches!(
            output,
            Output::StartManeuver(_) | Output::StopManeuver(..) | Output::FallBack(..)
        )
    };
    let session = |node: &Node| node.following().map(|following| following.session);
    let was = session(step.before);
    follows(step, sender)
        || (!step.outputs.iter().any(moves) && (was.is_none() || session(step.after) == was))
}

fn premise(step: &StepView) -> bool {
    let executes = step.before.actuation.running().is_some();
    executes && step.sender().is_some_and(|sender| !follows(step, sender))
}
