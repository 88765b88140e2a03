//! I14: a released or idle robot executes nothing.
//!
//! Checked is what the outputs have made the robot's body do, not what the protocol state says.

use crossguard_protocol::Following;

use super::prelude::*;

property! {
    "I14", Authentication::NONE;
    untimed S "a released or idle robot executes nothing",
        Some("a maneuver runs"),
        Rule::State(StateRule { holds, premise: |view| view.nodes().any(|node| node.actuation.running().is_some()), of_two: false }),
        "NEVER_STOPS";
}

fn holds(view: &View) -> bool {
    view.nodes().all(|node| {
        let executing = node.following().and_then(Following::executing);
        node.actuation.running() == executing.map(|maneuver| maneuver.id)
    })
}
