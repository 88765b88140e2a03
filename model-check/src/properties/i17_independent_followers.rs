//! I17: dropping one follower leaves the others' records unchanged.

use crossguard_protocol::{
    Coordination, Countdown, EndReason, Input, Lease, Member, Millis, Notice, StationId,
};

use super::prelude::*;

property! {
    "I17", Authentication::NAMES;
    untimed T "dropping one follower leaves the others' records unchanged",
        Some("a follower is dropped while another one stays"),
        Rule::Step(StepRule { holds, premise, looks_back: false, of_two: false }),
        "LosesTwoForOne";
}

fn dropped(step: &StepView) -> Option<StationId> {
    step.notices().find_map(|notice| match notice {
        Notice::FollowerGone(station, _) => Some(station),
        _ => None,
    })
}

/// Whether the session ends for another leader: a RAM may say both, that its sender has left and that it claims
/// the place.
fn withdraws(step: &StepView) -> bool {
    let Input::Ram { ram, .. } = step.input else {
        return false;
    };
    let claims = matches!(
        ram.coordination,
        Coordination::NeedHelp { .. } | Coordination::Leader { .. }
    );
    let for_another = |notice| matches!(notice, Notice::SessionEnded(_, EndReason::Withdrawn(_)));
    claims && step.notices().any(for_another)
}

fn holds(step: &StepView) -> bool {
    if withdraws(step) {
        return true;
    }
    let (Some(dropped), Some(before)) = (dropped(step), step.before.leading()) else {
        return true;
    };
    let elapsed = match step.input {
        Input::Elapsed(elapsed) => elapsed,
        _ => Millis::ZERO,
    };
    let members = before.members.iter();
    let mut others = members.filter(|member| member.station != dropped);
    others.all(|member| {
        let after = step
            .after
            .leading()
            .and_then(|after| after.member(member.station));
        aged(member, elapsed).is_none_or(|expected| after == Some(&expected))
    })
}

/// The record after so much time in which nothing happens; `None` where one of its own timers is due.
fn aged(member: &Member, elapsed: Millis) -> Option<Member> {
    let age = |countdown: Countdown| match countdown.left() {
        None => Some(countdown),
        Some(left) if elapsed == Millis::ZERO || left > elapsed => {
            Some(Countdown::armed(left.saturating_sub(elapsed)))
        }
        Some(_) => None,
    };
    let mut aged = *member;
    aged.lease = match member.lease {
        Lease::Stands(left) => Lease::Stands(age(left)?),
        Lease::Expired(left) => Lease::Expired(age(left)?),
    };
    if let Some(order) = &mut aged.order {
        order.execution = age(order.execution)?;
    }
    if let Some(outstanding) = &mut aged.outstanding {
        outstanding.acknowledgement = age(outstanding.acknowledgement)?;
    }
    Some(aged)
}

fn premise(step: &StepView) -> bool {
    dropped(step).is_some()
        && !withdraws(step)
        && step.before.leading().is_some_and(|l| l.members.len() > 1)
}
