//! L3: if the network is reliable and a helper is available, a request leads to a completed task.
//!
//! [`Scenario::cooperative`](crate::scenario::Scenario::cooperative) defines both conditions.

use crossguard_protocol::Member;

use super::prelude::*;

property! {
    "L3", Authentication::truth_of(&[Insider::Follower, Insider::Leader, Insider::Stranger]);
    untimed L "if everything around the robots cooperates, a request leads to a completed task",
        Some("a robot asks for help"),
        Rule::Live(LivenessRule {
            to: Some(has_completed),
            needs_cooperation: true,
            ..LivenessRule::ends(LivenessSubjects::Robots, asks)
        }),
        "ReadsNoProgress";
}

pub(super) fn asks(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    view.node(robot).is_requesting()
}

fn has_completed(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    view.node(robot)
        .leading()
        .is_some_and(|leading| leading.members.iter().any(Member::has_completed))
}
