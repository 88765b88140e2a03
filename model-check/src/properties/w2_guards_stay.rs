//! W2: while a pedestrian is on the road, every guard that is able to stay does.
//!
//! No output stops a guard that is in place or makes it do something else, whatever arrives, expires or reboots.
//! It may fall back, and then holds its place or brings its person off the road; its leader may let it go on with the same. Its own fault may end what it
//! does, and so may its own application, which is truthful.

use crossguard_protocol::{FallbackPolicy, ManeuverId, Output, StopReason, TaskType};

use super::prelude::*;

property! {
    "W2", Authentication::NAMES;
    untimed T "while a pedestrian is on the road, every guard that is able to stay does",
        Some("a guard's maneuver ends while a pedestrian is on the road"),
        Rule::Step(StepRule { holds, premise, looks_back: true, of_two: false }),
        "StopsInPlace";
}

/// The maneuver by which the body guards the pedestrian on the road, also while it falls back.
fn guarding(step: &StepView) -> Option<ManeuverId> {
    let session = step.history.pedestrian.on_road()?;
    let body = step.before.actuation.body;
    let guards = match body {
        Body::FallingBack(maneuver, _) => Some(maneuver),
        _ => body.guards(step.config.settings()),
    };
    let id = guards?.id;
    (id.session == session).then_some(id)
}

fn holds(step: &StepView) -> bool {
    let Some(guarding) = guarding(step) else {
        return true;
    };
    let stays = |policy, task: TaskType| {
        if step.config.settings().holding.contains(task) {
            policy == FallbackPolicy::HoldUntilClear
        } else {
            matches!(
                policy,
                FallbackPolicy::HoldUntilClear | FallbackPolicy::EscortToKerb
            )
        }
    };
    step.outputs.iter().all(|output| match *output {
        Output::StopManeuver(maneuver, why) => {
            maneuver.id != guarding || matches!(why, StopReason::Unavailable(_))
        }
        Output::FallBack(maneuver, policy) => {
            maneuver.id != guarding || stays(policy, maneuver.task)
        }
        Output::StartManeuver(maneuver) => step.before.actuation.body.resumes(maneuver),
        _ => true,
    })
}

fn premise(step: &StepView) -> bool {
    let ends = |output: &Output| matches!(output, Output::StopManeuver(..) | Output::FallBack(..));
    guarding(step).is_some() && step.outputs.iter().any(ends)
}
