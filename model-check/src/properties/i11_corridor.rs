//! I11: the corridor is open only while every required follower is engaged.
//!
//! What is checked is what the outputs have told the application, not what the protocol believes.

use super::{StateRule, View, leading_of};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn holds(view: &View) -> bool {
    view.configured().all(|(node, config)| {
        let engaged = leading_of(node).is_some_and(|l| l.corridor_obstacle(config).is_none());
        let believed = leading_of(node).is_some_and(|leading| leading.corridor_open);
        node.actuation.corridor_open == believed && (!believed || engaged)
    })
}

fn premise(view: &View) -> bool {
    view.nodes().any(|node| node.actuation.corridor_open)
}
