//! W4: a robot begins nothing new before its last duty's fallback is finished and its application says that
//! the road is clear.
//!
//! To go on with what it falls back from, for the same leader, is nothing new.
//! A robot has a duty while its body falls back, and from when its sign has shown go until its application says
//! that the road is clear or the task done. A reboot is exempt: the protocol persists no duty.

use crossguard_protocol::{Coordination, Output, SessionId};

use super::prelude::*;

property! {
    "W4", Authentication::NAMES;
    untimed T "a robot begins nothing new before its duty on the road is over",
        Some("a robot has a duty on the road"),
        Rule::Step(StepRule { holds, premise: |step| has_duty(step.before), looks_back: false, of_two: false }),
        "ForgetsItsDuty";
}

fn has_duty(node: &Node) -> bool {
    matches!(node.actuation.body, Body::FallingBack(..)) || node.actuation.road_unsure
}

/// The session that a robot asks or offers for.
fn begun(node: &Node) -> Option<SessionId> {
    let ram = node.robot.as_ref()?.ram();
    match ram.coordination {
        Coordination::NeedHelp { number, .. } => {
            let leader = ram.station;
            Some(SessionId { leader, number })
        }
        Coordination::OfferHelp { session, .. } => Some(session),
        _ => None,
    }
}

fn holds(step: &StepView) -> bool {
    let body = step.before.actuation.body;
    let starts = |output: &Output| matches!(output, Output::StartManeuver(m) if !body.resumes(*m));
    let (before, after) = (begun(step.before), begun(step.after));
    let begins = step.outputs.iter().any(starts) || (after.is_some() && after != before);
    !has_duty(step.before) || !begins
}
