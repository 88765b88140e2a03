//! I11: the corridor is open only while every required follower is engaged.
//!
//! The outputs to the application are compared with each record that the leader has of its followers. When a
//! follower is engaged is written here once more: of the protocol, only the records are read.

use crossguard_protocol::{Config, Corridor, Leading, Member, Progress};

use super::prelude::*;

property! {
    "I11", Authentication::NAMES;
    untimed S "the corridor is open only while every required follower is engaged",
        Some("the corridor is open"),
        Rule::State(StateRule { holds, premise, of_two: false }),
        "NEVER_CLOSES_THE_CORRIDOR";
    timed S "after a follower's own failure the corridor closes within the bound",
        Some("a follower fails while the corridor is open"),
        Rule::Timed(TimedRule { holds: closes_in_time, premise: &[TimedPremise::State(fails_while_open)], ends_run: true }),
        "SHOWS_GO_TOO_LONG";
}

fn holds(view: &View) -> bool {
    view.configured().all(|(node, config)| {
        let leading = node.leading();
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

fn closes_in_time(step: &TimedStepView) -> bool {
    let after = step.after;
    !matches!(after.watch, StopWatch::FollowerFailed(place, ticks) if after.shows_go_too_long(place, ticks))
}

fn fails_while_open(view: &TimedView) -> bool {
    matches!(view.watch, StopWatch::FollowerFailed(place, 0) if view.shows_go_at(place))
}
