//! I11: the corridor is open only while every required follower is engaged.
//!
//! What is checked is what the outputs have told the application, against each record that the leader has of
//! its followers. What is engaged is said here once more: this asks nothing of the protocol but the records.

use crossguard_protocol::{Config, Corridor, Leading, Member, Progress};

use super::{StateRule, View, leading_of};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn holds(view: &View) -> bool {
    view.configured().all(|(node, config)| {
        let leading = leading_of(node);
        let believed = leading.is_some_and(|leading| leading.corridor == Corridor::Open);
        let engaged = leading.is_some_and(|leading| is_engaged(leading, config));
        node.actuation.corridor_open == believed && (!believed || engaged)
    })
}

fn is_engaged(leading: &Leading, config: &Config) -> bool {
    let required = usize::from(leading.request.followers);
    let engaged = |member: &&Member| {
        let guards = member.order.is_some_and(|order| {
            let settings = config.settings();
            let in_place = match order.progress {
                Some(Progress::InPosition) => true,
                Some(Progress::Executing) => !settings.holding.contains(order.task),
                _ => false,
            };
            in_place && settings.guarding.contains(order.task)
        });
        guards && member.outstanding.is_none() && member.lease.stands()
    };
    let members = leading.members.iter();
    members.clone().count() >= required
        && members.clone().filter(engaged).count() == members.count()
}

fn premise(view: &View) -> bool {
    view.nodes().any(|node| node.actuation.corridor_open)
}
