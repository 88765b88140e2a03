//! W7: once messages arrive and enough helpers are there, a request leads to a finished crossing.
//!
//! What that means here is said by [`Scenario::cooperative`](crate::scenario::Scenario::cooperative).

use crossguard_protocol::Phase;

use super::prelude::*;

property! {
    "W7", Authentication::truth_of(&[Insider::Follower, Insider::Leader, Insider::Stranger]);
    untimed L "if everything around the robots cooperates, a request leads to a finished crossing",
        Some("a robot asks for help"),
        Rule::Live(LivenessRule {
            subjects: LivenessSubjects::Robots,
            from: |view, LivenessSubject { robot, .. }| {
                let robot = view.node(robot).robot.as_ref();
                robot.is_some_and(|robot| matches!(robot.phase(), Phase::Requesting(_)))
            },
            to: |view, _| view.history.pedestrian == Pedestrian::Across,
            needs_cooperation: true,
            broken_by_old_requests: false,
        }),
        "ReadsNoProgress";
}
