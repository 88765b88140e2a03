//! The state diagram of the protocol in Mermaid, drawn from what the transition function does.
//!
//! No rule is written here: the edges are the transitions that [`universe`](crate::universe) has seen one
//! robot take among peers that say anything.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use crate::transitions::{Mode, Transitions, mode_name, mode_parts};

/// A `stateDiagram-v2` of what robots have been seen to do.
#[must_use]
pub fn diagram(transitions: &Transitions) -> String {
    let modes: BTreeSet<Mode> = transitions
        .0
        .keys()
        .flat_map(|&(from, to)| [from, to])
        .collect();
    let edges: BTreeMap<(Mode, Mode), Vec<String>> = transitions
        .0
        .iter()
        .map(|(way, labels)| (*way, condense(labels)))
        .collect();
    mermaid(&modes, &edges)
}

/// Labels of one kind in one line: `timer Help, Lock` rather than `timer Help`, `timer Lock`.
fn condense(labels: &BTreeSet<String>) -> Vec<String> {
    let mut kinds: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for label in labels {
        match label.split_once(' ') {
            Some((kind @ ("RAM" | "timer"), rest)) => kinds.entry(kind).or_default().push(rest),
            _ => kinds.entry("").or_default().push(label),
        }
    }
    kinds
        .iter()
        .map(|(kind, rest)| format!("{kind} {}", rest.join(", ")).trim().to_owned())
        .collect()
}

fn mermaid(modes: &BTreeSet<Mode>, edges: &BTreeMap<(Mode, Mode), Vec<String>>) -> String {
    let mut text = String::from("stateDiagram-v2\n    direction LR\n    [*] --> Idle\n");
    for &mode in modes {
        let (state, side) = mode_parts(mode);
        if !side.is_empty() {
            let _ = writeln!(
                text,
                "    state \"{state} ({side})\" as {}",
                mode_name(mode)
            );
        }
    }
    for ((from, to), labels) in edges {
        let _ = writeln!(
            text,
            "    {} --> {}: {}",
            mode_name(*from),
            mode_name(*to),
            labels.join("<br>")
        );
    }
    text
}
