//! I9: after fallback of `(s,q)` that command is never executed again.

use super::prelude::*;

property! {
    "I9", Authentication::NAMES;
    untimed S "after its fallback a command is never executed again",
        Some("a follower has fallen back"),
        Rule::State(StateRule { holds, premise: falls_back, of_two: false }),
        "StartsRepeatedCommands";
}

fn holds(view: &View) -> bool {
    view.nodes().all(|node| {
        node.actuation.running().is_none_or(|id| {
            let command = view.history().command(node.persisted.station, id);
            command.is_none_or(|command| !command.fell_back)
        })
    })
}

fn falls_back(view: &View) -> bool {
    view.nodes()
        .any(|node| matches!(node.actuation.body, Body::FallingBack(..)))
}
