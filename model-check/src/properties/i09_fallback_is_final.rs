//! I9: after fallback of `(s,q)` that command is never executed again.

use super::authentication::Authentication;
use super::property::{Claim, Kind, Property, Rule, StateRule};
use super::view::View;

pub(super) const PROPERTY: Property = Property {
    id: "I9",
    authentication: Authentication::NAMES,
    untimed: Some(Claim {
        kind: Kind::S,
        statement: "after its fallback a command is never executed again",
        premise: Some("a follower has fallen back"),
        rule: Rule::State(StateRule {
            holds,
            premise,
            of_two: false,
        }),
        weakening: "StartsRepeatedCommands",
    }),
    timed: None,
};

fn holds(view: &View) -> bool {
    view.nodes().all(|node| {
        node.actuation.running.is_none_or(|id| {
            let command = view.history().command(node.persisted.station, id);
            command.is_none_or(|command| !command.fell_back)
        })
    })
}

fn premise(view: &View) -> bool {
    view.history().has_fallback()
}
