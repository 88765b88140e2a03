//! L3: if the network is reliable and a helper is available, a request leads to a completed task.
//!
//! What that means here is said by [`Scenario::cooperative`](crate::scenario::Scenario::cooperative).

use crossguard_protocol::{Member, Phase};

use super::prelude::*;

property! {
    "L3", Authentication::truth_of(&[Insider::Follower, Insider::Leader, Insider::Stranger]);
    untimed L "if everything around the robots cooperates, a request leads to a completed task",
        Some("a robot asks for help"),
        Rule::Live(LivenessRule {
            subjects: LivenessSubjects::Robots,
            from: asks,
            to: has_completed,
            needs_cooperation: true,
            broken_by_old_requests: false,
        }),
        "ReadsNoProgress";
}

fn asks(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    let robot = view.node(robot).robot.as_ref();
    robot.is_some_and(|robot| matches!(robot.phase(), Phase::Requesting(_)))
}

fn has_completed(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    leading_of(view.node(robot))
        .is_some_and(|leading| leading.members.iter().any(Member::has_completed))
}
