//! I10: while the lease on a follower stands, the follower has not fallen back for lack of contact.
//!
//! Nothing but lack of contact and crashes takes a follower out of a session in the timed model, so there the
//! follower has contact. Runs in which robots leave sessions for all kinds of reasons are judged by
//! [`has_lease_on_lost`].

use crossguard_protocol::{Contact, Following, Lease, Phase, Robot, SessionId, StationId};

use super::prelude::*;

property! {
    "I10", Authentication::truth_of(&[Insider::Follower]);
    timed S "while the lease on a follower stands, the follower has not fallen back for lack of contact",
        Some("a lease stands; and a follower falls back for lack of contact"),
        Rule::Timed(TimedRule { holds, premise: &[TimedPremise::State(lease_stands), TimedPremise::State(falls_back)], ends_run: false }),
        "TakesAnyTimers";
}

/// A robot may act on the last input until it takes in the tick, so the leader's lease before the tick is
/// compared with the follower after it.
fn holds(step: &TimedStepView) -> bool {
    lease_theorem(step.before, step.after) && lease_theorem(step.after, step.after)
}

/// Of the leaders of one state and the followers of another. A leader that hangs does nothing for a lease that
/// it still knows; what its sign does meanwhile is W1 and W5.
fn lease_theorem(leaders: &TimedView, followers: &TimedView) -> bool {
    if leaders.leader_hangs() {
        return true;
    }
    let robots = leaders.nodes().filter_map(|node| node.robot.as_ref());
    robots.flat_map(leases).all(|(session, station)| {
        let follower = followers
            .nodes()
            .find(|node| node.persisted.station == station);
        let has_contact = |following: &Following| {
            following.session == session && matches!(following.contact, Contact::Fresh(_))
        };
        follower
            .is_none_or(|node| node.robot.is_none() || node.following().is_some_and(has_contact))
    })
}

fn lease_stands(view: &TimedView) -> bool {
    let leader = view.leader().robot.iter();
    leader.flat_map(leases).next().is_some()
}

fn falls_back(view: &TimedView) -> bool {
    view.leader().robot.is_some() && view.nodes().any(Node::has_lost_contact)
}

/// The followers on which a leader's lease stands.
pub fn leases(robot: &Robot) -> impl Iterator<Item = (SessionId, StationId)> {
    let leading = match robot.phase() {
        Phase::Leading(leading) => robot.session().map(|session| (session, leading)),
        _ => None,
    };
    leading.into_iter().flat_map(|(session, leading)| {
        let stands = leading
            .members
            .iter()
            .filter(|member| matches!(member.lease, Lease::Stands(_)));
        stands.map(move |member| (session, member.station))
    })
}

/// Whether a leader's lease stands on a follower that has lost contact in that very session.
pub fn has_lease_on_lost<'a>(robots: &(impl Iterator<Item = &'a Robot> + Clone)) -> bool {
    robots.clone().flat_map(leases).any(|(session, station)| {
        robots.clone().any(|robot| {
            let is_meant = robot.station() == station && robot.session() == Some(session);
            is_meant && matches!(robot.phase(), Phase::Following(it) if it.contact.is_lost())
        })
    })
}
