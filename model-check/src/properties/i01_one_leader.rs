//! I1: no robot is leader and follower at once; a follower has one leader; a session has one leader.
//!
//! The type of a robot's state allows one part in one session. The rest is checked: no two robots lead the same
//! session, and no robot follows itself.

use super::prelude::*;

property! {
    "I1", Authentication::NAMES;
    untimed S "no robot is leader and follower at once; a session has one leader",
        Some("one robot leads and another follows"),
        Rule::State(StateRule { holds, premise: is_team, of_two: false }),
        "TakesItsLeadersPseudonym";
}

fn holds(view: &View) -> bool {
    let mut leaders = view.leaders().map(|(session, _)| session);
    let one_each = {
        let all = leaders.clone();
        leaders.all(|session| all.clone().filter(|&other| other == session).count() == 1)
    };
    one_each
        && view
            .followers()
            .all(|(robot, following)| following.session.leader != robot.station())
}
