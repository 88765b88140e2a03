//! I14: a released or idle robot executes nothing.
//!
//! Checked is what the outputs have made the robot's body do, not what the protocol state says.

use crossguard_protocol::Phase;

use super::authentication::Authentication;
use super::property::{Claim, Kind, Property, Rule, StateRule};
use super::view::View;

pub(super) const PROPERTY: Property = Property {
    id: "I14",
    authentication: Authentication::NONE,
    untimed: Some(Claim {
        kind: Kind::S,
        statement: "a released or idle robot executes nothing",
        premise: Some("a maneuver runs"),
        rule: Rule::State(StateRule {
            holds,
            premise,
            of_two: false,
        }),
        weakening: "NEVER_STOPS",
    }),
    timed: None,
};

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
