//! I18: the identity is locked while in a session.
//!
//! Checked are the outputs to the part of the endpoint that changes pseudonyms. No rule is needed for two members
//! of a session never to carry the same station id: the robots of a scenario differ, and a locked id does not
//! change. A robot that takes its leader's id breaks I1.

use super::prelude::*;

property! {
    "I18", Authentication::NONE;
    untimed S "the identity is locked while the robot is in a session",
        Some("one robot leads and another follows"),
        Rule::State(StateRule { holds, premise: is_team, of_two: false }),
        "NEVER_LOCKS_ITS_IDENTITY";
}

fn holds(view: &View) -> bool {
    view.nodes()
        .all(|node| node.session().is_none() || node.actuation.identity_locked)
}
