//! The transitions of the state diagram that robots are seen to take.

use std::collections::{BTreeMap, BTreeSet};

use crossguard_protocol::{Coordination, Event, Farewell, Input, Progress, Rmcm, Role, State};

use crate::node::Node;

/// A robot's role and its state in the paper's model.
pub type Mode = (Role, State);

/// Which inputs have led from one mode to another.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Transitions(pub BTreeMap<(Mode, Mode), BTreeSet<String>>);

impl Transitions {
    pub(crate) fn note(&mut self, before: &Node, input: Input, after: &Node) {
        let (from, to) = (mode(before), mode(after));
        if from != to
            && let Some(label) = label(input)
        {
            self.0.entry((from, to)).or_default().insert(label);
        }
    }
}

/// The mode's name, one word: the paper's state, and the role that tells its two sides apart.
#[must_use]
pub fn mode_name((role, state): Mode) -> String {
    match role {
        Role::None => state.name().to_owned(),
        side => format!("{}_{}", state.name(), side.name()),
    }
}

/// A robot's mode; one that is down has no role and is idle.
pub(crate) fn mode(node: &Node) -> Mode {
    node.robot
        .as_ref()
        .map_or((Role::None, State::Idle), |robot| {
            (robot.role(), robot.state())
        })
}

/// A transition's label: the kind of its input. `None` for a RAM with a farewell and more, which does
/// two things one after the other.
fn label(input: Input) -> Option<String> {
    let name = |debug: String| {
        debug
            .split(['(', ' '])
            .next()
            .unwrap_or_default()
            .to_owned()
    };
    Some(match input {
        Input::Ram { ram, .. } => match (ram.coordination, ram.farewell) {
            (part, None) => format!("RAM {}", part_name(part)),
            (Coordination::None, Some(Farewell::Ended(..))) => "RAM ended".to_owned(),
            (Coordination::None, Some(Farewell::Left(..))) => "RAM left".to_owned(),
            (_, Some(_)) => return None,
        },
        Input::Rmcm(Rmcm::Command(_)) => "RMCM command".to_owned(),
        Input::Rmcm(Rmcm::Answer(_)) => "RMCM acknowledgement".to_owned(),
        Input::Elapsed(_) => "time".to_owned(),
        Input::Expired(timer) => format!("timer {}", name(format!("{timer:?}"))),
        Input::Local(Event::AvailabilityChanged(_)) => "unavailable".to_owned(),
        Input::Local(event) => name(format!("{event:?}")),
    })
}

fn part_name(coordination: Coordination) -> &'static str {
    match coordination {
        Coordination::None => "none",
        Coordination::NeedHelp { .. } => "needHelp",
        Coordination::OfferHelp { .. } => "offerHelp",
        Coordination::Leader { .. } => "leader",
        Coordination::Follower { last, .. } => match last.map(|last| last.progress) {
            None => "follower",
            Some(Progress::Executing) => "executing",
            Some(Progress::InPosition) => "inPosition",
            Some(Progress::Completed) => "completed",
            Some(Progress::Failed(_)) => "failed",
            Some(Progress::SafeIdle) => "safeIdle",
        },
    }
}
