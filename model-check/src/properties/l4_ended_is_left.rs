//! L4: an ended session leads to every former member being `Idle`.
//!
//! A follower has no way out of its session but to `Idle`, so it is enough to show that it leaves.

use super::prelude::*;

property! {
    "L4", Authentication::NAMES;
    untimed L "the end of a session leads to every former member being idle",
        Some("a robot follows in a session that no robot leads"),
        Rule::Live(LivenessRule::ends(LivenessSubjects::Robots, is_orphaned)),
        "FollowersWaitForEver";
}

fn is_orphaned(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    view.node(robot).following().is_some_and(|following| {
        view.leaders()
            .all(|(session, _)| session != following.session)
    })
}
