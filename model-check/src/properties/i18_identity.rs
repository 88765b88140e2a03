//! I18: the identity is locked while in a session.
//!
//! Checked are the outputs to the part of the endpoint that changes pseudonyms. That two members of a session
//! never carry the same station id needs no rule: the robots of a scenario differ, and a locked id does not
//! change. A robot that takes its leader's id breaks I1.

use super::prelude::*;

property! {
    "I18", Authentication::NONE;
    untimed S "the identity is locked while the robot is in a session",
        Some("one robot leads and another follows"),
        Rule::State(StateRule { holds, premise, of_two: false }),
        "NEVER_LOCKS_ITS_IDENTITY";
}

fn holds(view: &View) -> bool {
    view.nodes().all(|node| {
        let in_session = node
            .robot
            .as_ref()
            .is_some_and(|robot| robot.session().is_some());
        !in_session || node.actuation.identity_locked
    })
}

fn premise(view: &View) -> bool {
    view.leaders().next().is_some() && view.followers().next().is_some()
}
