//! The state diagram of the protocol in Mermaid, drawn from what the transition function does.
//!
//! No rule is written here: the edges are the transitions that [`universe`](crate::universe) has seen one
//! robot take among peers that say anything.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use crossguard_protocol::Role;

use crate::transitions::{Mode, Transitions, mode_name};

/// A `stateDiagram-v2` of what robots have been seen to do.
#[must_use]
pub fn diagram(transitions: &Transitions) -> String {
    let ways = transitions.0.keys();
    let modes: BTreeSet<Mode> = ways.flat_map(|&(from, to)| [from, to]).collect();
    let mut text = String::from("stateDiagram-v2\n    direction LR\n    [*] --> Idle\n");
    for mode @ (role, state) in modes {
        if role != Role::None {
            let (state, side, name) = (state.name(), role.name(), mode_name(mode));
            let _ = writeln!(text, "    state \"{state} ({side})\" as {name}");
        }
    }
    for (&(from, to), labels) in &transitions.0 {
        let (from, to, labels) = (mode_name(from), mode_name(to), condense(labels));
        let _ = writeln!(text, "    {from} --> {to}: {labels}");
    }
    text
}

/// Labels of one kind in one line: `timer Help, Lock` rather than `timer Help`, `timer Lock`.
fn condense(labels: &BTreeSet<String>) -> String {
    let mut kinds: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for label in labels {
        match label.split_once(' ') {
            Some((kind @ ("RAM" | "timer"), rest)) => kinds.entry(kind).or_default().push(rest),
            _ => kinds.entry("").or_default().push(label),
        }
    }
    let lines = kinds
        .iter()
        .map(|(kind, rest)| format!("{kind} {}", rest.join(", ")).trim().to_owned());
    lines.collect::<Vec<_>>().join("<br>")
}
