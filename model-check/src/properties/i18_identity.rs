//! I18: two members of a session never carry the same station id; the identity is locked while in a
//! session.
//!
//! What is checked is what the outputs have told whoever changes pseudonyms.

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn holds(view: &View) -> bool {
    let members = view
        .robots()
        .filter_map(|robot| Some((robot.session()?, robot.station())));
    let distinct = members
        .clone()
        .enumerate()
        .all(|(i, member)| members.clone().skip(i + 1).all(|other| other != member));
    let locked = view.nodes().all(|node| {
        let in_session = node
            .robot
            .as_ref()
            .is_some_and(|robot| robot.session().is_some());
        !in_session || node.actuation.identity_locked
    });
    distinct && locked
}

fn premise(view: &View) -> bool {
    view.leaders().next().is_some() && view.followers().next().is_some()
}
