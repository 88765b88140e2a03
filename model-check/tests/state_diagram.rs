//! The state diagram of the protocol's page is the one that robots draw by what they do in shipped scenarios. It is in Mermaid;
//! `CROSSGUARD_BLESS=1` writes it anew.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fmt::{Debug, Write as _};

use crossguard_model_check::model::Model;
use crossguard_model_check::node::{Node, Protocol};
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::{
    Availability, Coordination, Event, EventKind, Input, Role, State, Unavailability,
};

/// The scenarios whose robots are watched.
const WATCHED: [&str; 3] = ["contention", "lying-follower", "two-teams"];

/// A robot's role and its state of the paper's model.
type Mode = (Role, State);

/// The inputs that lead from one mode to another, by their kind.
type Transitions = BTreeMap<(Mode, Mode), BTreeMap<&'static str, BTreeSet<String>>>;

#[test]
fn the_state_diagram_of_the_protocols_page_is_the_one_that_robots_draw() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../protocol/doc/protocol.md");
    let page = std::fs::read_to_string(path).unwrap();
    let (head, rest) = page.split_once("```mermaid\n").expect("a diagram");
    let (_, tail) = rest.split_once("```").expect("it ends");
    let current = format!("{head}```mermaid\n{}```{tail}", diagram());
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(path, &current).unwrap();
    } else {
        assert!(page == current, "run: cargo xtask bless protocol.md");
    }
}

fn diagram() -> String {
    let mut transitions = Transitions::new();
    for name in WATCHED {
        let model = Model::new(Scenario::load(name).unwrap());
        note(&model, &mut transitions);
    }
    let ways = transitions.keys().flat_map(|&(from, to)| [from, to]);
    let modes: BTreeSet<Mode> = ways.collect();
    let mut text = String::from("stateDiagram-v2\n    direction LR\n    [*] --> Idle\n");
    for mode @ (role, state) in modes {
        if role != Role::None {
            let (state, role, name) = (state.name(), role.name(), name(mode));
            let _ = writeln!(text, "    state \"{state} ({role})\" as {name}");
        }
    }
    for ((from, to), labels) in transitions {
        let lines = labels.into_iter().map(|(kind, words)| {
            let words: Vec<_> = words.into_iter().collect();
            format!("{kind} {}", words.join(", ")).trim().to_owned()
        });
        let lines: Vec<_> = lines.collect();
        let (from, to) = (name(from), name(to));
        let _ = writeln!(text, "    {from} --> {to}: {}", lines.join("<br>"));
    }
    text
}

/// The mode's name, one word.
fn name((role, state): Mode) -> String {
    match role {
        Role::None => state.name().to_owned(),
        _ => format!("{}_{}", state.name(), role.name()),
    }
}

/// What a robot is doing; one that is down does nothing.
fn mode(node: &Node) -> Mode {
    let robot = node.robot.as_ref();
    robot.map_or((Role::None, State::Idle), |it| (it.role(), it.state()))
}

/// Notes what leads a robot from one mode to another: actions in all states of a model, and events that no scenario has.
fn note(model: &Model, transitions: &mut Transitions) {
    let bare = EventKind::ALL.into_iter().filter_map(Event::bare);
    let fault = Availability::Unavailable(Unavailability::LocalFault);
    let events: Vec<_> = bare.chain([Event::AvailabilityChanged(fault)]).collect();
    let mut note = |before: &Node, input, after: &Node| {
        let (from, to) = (mode(before), mode(after));
        if from != to
            && let Some((kind, word)) = label(input)
        {
            let kinds = transitions.entry((from, to)).or_default();
            kinds.entry(kind).or_default().insert(word);
        }
    };
    let (mut nodes, mut actions) = (HashSet::new(), Vec::new());
    for state in model.reachable() {
        nodes.extend(model.nodes(&state).cloned());
        actions.clear();
        model.actions_in(&state, &mut actions);
        for &action in &actions {
            if let Some((next, Some(step))) = model.successor(&state, action)
                && let Some(before) = model.nodes(&state).nth(step.robot)
                && let Some(after) = model.nodes(&next).nth(step.robot)
            {
                note(before, step.input(), after);
            }
        }
    }
    for node in &nodes {
        let failed = node.actuation.running().map(Event::ManeuverFailed);
        for event in events.iter().copied().chain(failed) {
            let input = Input::Local(event);
            if let Some((after, _)) = node.step(&Protocol, &model.scenario().config, input) {
                note(node, input, &after);
            }
        }
    }
}

/// A transition's label: the kind of its input, and what the code names it. `None` for a RAM with a farewell and more, which
/// does two things one after the other.
fn label(input: Input) -> Option<(&'static str, String)> {
    let word = |value: &dyn Debug| {
        let text = format!("{value:?}");
        text.split(['(', ' ']).next().unwrap_or_default().to_owned()
    };
    Some(match input {
        Input::Ram { ram, .. } => match (ram.coordination, ram.farewell) {
            (Coordination::Follower { last: Some(it), .. }, None) => ("RAM", word(&it.progress)),
            (part, None) => ("RAM", word(&part)),
            (Coordination::None, Some(farewell)) => ("RAM", word(&farewell)),
            (_, Some(_)) => return None,
        },
        Input::Rmcm(rmcm) => ("RMCM", word(&rmcm)),
        Input::Elapsed(_) => ("", "time".to_owned()),
        Input::Expired(timer) => ("timer", word(&timer)),
        Input::Local(Event::AvailabilityChanged(_)) => ("", "unavailable".to_owned()),
        Input::Local(event) => ("", word(&event)),
    })
}
