//! I5: the executed requestID only grows within a session.

use crate::serial::request_is_newer;

use super::prelude::*;

property! {
    "I5", Authentication::NAMES;
    untimed T "the started requestID only grows within a session",
        Some("a follower starts a second maneuver in the same session"),
        Rule::Step(StepRule { holds, premise: starts_another, looks_back: true, of_two: false }),
        "StartsOlderCommands";
}

fn newest_before(step: &StepView) -> Option<crossguard_protocol::RequestId> {
    let session = step.started()?.id.session;
    step.history
        .newest_started(step.after.persisted.station, session)
}

fn holds(step: &StepView) -> bool {
    match (step.started(), newest_before(step)) {
        (Some(maneuver), Some(newest)) => request_is_newer(maneuver.id.request, newest),
        _ => true,
    }
}

fn starts_another(step: &StepView) -> bool {
    let started = step.started().map(|maneuver| maneuver.id.session);
    let before = step.before.actuation.body.maneuver();
    started.is_some() && before.map(|id| id.session) == started
}
