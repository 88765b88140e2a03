//! I17: dropping one follower leaves the others' records unchanged.

use crossguard_protocol::{Notice, StationId};

use super::{StepRule, StepView, leading_of};

pub(super) const RULE: StepRule = StepRule {
    holds,
    premise,
    looks_back: false,
};

fn dropped(step: &StepView) -> Option<StationId> {
    step.notices().find_map(|notice| match notice {
        Notice::FollowerGone(station, _) => Some(station),
        _ => None,
    })
}

fn holds(step: &StepView) -> bool {
    let (Some(dropped), Some(before)) = (dropped(step), leading_of(step.before)) else {
        return true;
    };
    before
        .members
        .iter()
        .filter(|member| member.station != dropped)
        .all(|member| {
            leading_of(step.after).and_then(|after| after.member(member.station)) == Some(member)
        })
}

/// A follower is dropped and another one stays.
fn premise(step: &StepView) -> bool {
    dropped(step).is_some() && leading_of(step.before).is_some_and(|l| l.members.len() > 1)
}
