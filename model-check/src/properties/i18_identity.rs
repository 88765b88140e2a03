//! I18: the identity is locked while in a session.
//!
//! What is checked is what the outputs have told the part of the endpoint that changes pseudonyms. That two
//! members of a session never carry the same station id needs no rule: the robots of a scenario differ, and
//! who is locked does not change. A robot that takes its leader's id breaks I1.

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

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
