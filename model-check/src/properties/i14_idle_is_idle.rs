//! I14: a released or idle robot executes nothing.
//!
//! What is checked is what the outputs have told the robot's body, not what the protocol believes.

use crossguard_protocol::Phase;

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn holds(view: &View) -> bool {
    view.nodes().all(|node| {
        let executing = node.robot.as_ref().and_then(|robot| match robot.phase() {
            Phase::Following(following) => following.executing().map(|maneuver| maneuver.id),
            _ => None,
        });
        node.actuation.running == executing
    })
}

fn premise(view: &View) -> bool {
    view.nodes().any(|node| node.actuation.running.is_some())
}
