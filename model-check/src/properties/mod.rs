//! The properties, one file each, under the ids of the table in
//! `doc/verification.md`.
//!
//! A property counts only when its premise is reachable: a state rule or step rule says what must
//! hold, and its premise says when the rule says anything at all.

mod i01_one_leader;
mod i02_confirmed;
mod i03_commanded;
mod i04_started_once;
mod i05_requests_grow;
mod i06_acknowledged;
mod i07_stray_answer;
mod i08_completed;
mod i09_fallback_is_final;
mod i11_corridor;
mod i12_no_deadlock;
mod i13_total;
mod i14_idle_is_idle;
mod i15_reboot;
mod i16_limits;
mod i17_independent_followers;
mod i18_identity;
mod l1_help_ends;
mod l2_commands_end;
mod l3_help_helps;
mod l4_ended_is_left;
mod l5_crash_is_survived;
mod l6_requesters_agree;

use std::fmt;
use std::str::FromStr;

use crossguard_protocol::{
    Config, Event, Following, Input, Leading, Maneuver, Notice, Output, Outputs, Phase, Robot,
    SessionId, StationId,
};
use serde::Serialize;

use crate::history::{History, told_end};
use crate::node::Node;
use crate::road::{w2_guards_stay, w3_one_sign, w4_nothing_new_on_duty, w7_crossing_gets_done};

/// A property's id.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[allow(missing_docs, reason = "the ids are those of the table in `statement`")]
pub enum PropertyId {
    I1,
    I2,
    I3,
    I4,
    I5,
    I6,
    I7,
    I8,
    I9,
    I11,
    I12,
    I13,
    I14,
    I15,
    I16,
    I17,
    I18,
    L1,
    L2,
    L3,
    L4,
    L5,
    L6,
    L7,
    W1,
    W2,
    W3,
    W4,
    W7,
}

/// What a property speaks about.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
pub enum Kind {
    /// Safety: of every reachable state.
    S,
    /// Of every transition.
    T,
    /// Liveness: of every fair run.
    L,
}

/// Something that holds of every reachable state that meets its premise.
#[derive(Clone, Copy)]
pub(crate) struct StateRule {
    pub(crate) holds: fn(&View) -> bool,
    pub(crate) premise: fn(&View) -> bool,
}

/// Something that holds of every robot's step that meets its premise.
#[derive(Clone, Copy)]
pub(crate) struct StepRule {
    pub(crate) holds: fn(&StepView) -> bool,
    pub(crate) premise: fn(&StepView) -> bool,
    /// Whether the two look at the history.
    pub(crate) looks_back: bool,
}

/// The robots that a liveness property speaks about, one at a time.
#[derive(Clone, Copy)]
pub(crate) enum LivenessSubjects {
    /// Each robot.
    Robots,
    /// Each two robots, either way round.
    Pairs,
}

/// One of them, by their places in the scenario; `other` means nothing where only one is meant.
#[derive(Clone, Copy)]
pub(crate) struct LivenessSubject {
    pub(crate) robot: usize,
    pub(crate) other: usize,
}

impl LivenessSubjects {
    pub(crate) fn among(self, robots: usize) -> Vec<LivenessSubject> {
        let pairs = (0..robots).flat_map(|robot| (0..robots).map(move |other| (robot, other)));
        pairs
            .filter(|(robot, other)| match self {
                Self::Robots => robot == other,
                Self::Pairs => robot != other,
            })
            .map(|(robot, other)| LivenessSubject { robot, other })
            .collect()
    }
}

/// Something that leads to something on every fair run.
#[derive(Clone, Copy)]
pub(crate) struct LivenessRule {
    pub(crate) subjects: LivenessSubjects,
    pub(crate) from: fn(&View, LivenessSubject) -> bool,
    pub(crate) to: fn(&View, LivenessSubject) -> bool,
}

impl PropertyId {
    /// All properties, in order.
    pub const ALL: [Self; 29] = [
        Self::I1,
        Self::I2,
        Self::I3,
        Self::I4,
        Self::I5,
        Self::I6,
        Self::I7,
        Self::I8,
        Self::I9,
        Self::I11,
        Self::I12,
        Self::I13,
        Self::I14,
        Self::I15,
        Self::I16,
        Self::I17,
        Self::I18,
        Self::L1,
        Self::L2,
        Self::L3,
        Self::L4,
        Self::L5,
        Self::L6,
        Self::L7,
        Self::W1,
        Self::W2,
        Self::W3,
        Self::W4,
        Self::W7,
    ];

    /// What the property speaks about.
    #[must_use]
    pub const fn kind(self) -> Kind {
        match self {
            Self::I5 | Self::I7 | Self::I17 | Self::W1 | Self::W2 | Self::W4 => Kind::T,
            Self::L1 | Self::L2 | Self::L3 | Self::L4 | Self::L5 | Self::L6 | Self::W7 => Kind::L,
            _ => Kind::S,
        }
    }

    /// What the property says.
    #[must_use]
    pub const fn statement(self) -> &'static str {
        match self {
            Self::I1 => "nobody is leader and follower at once; a session has one leader",
            Self::I2 => "a follower in a session was confirmed by its leader",
            Self::I3 => "a follower starts only what its leader commanded it",
            Self::I4 => "a command is started at most once",
            Self::I5 => "the started requestID only grows within a session",
            Self::I6 => {
                "what a leader counts as acknowledged, the follower accepted; who starts has said so before"
            }
            Self::I7 => "an answer that is not for the outstanding command changes nothing",
            Self::I8 => {
                "what a leader counts as completed or in position, the follower's body has done"
            }
            Self::I9 => "after fallback a command is never executed again",
            Self::I11 => "the corridor is open only while every required follower is engaged",
            Self::I12 => {
                "who has a part in a session can make progress, by more than a periodic RAM"
            }
            Self::I13 => "every input in every state yields a valid state",
            Self::I14 => "a released or idle robot executes nothing",
            Self::I15 => "a rebooted robot takes part in no session from before",
            Self::I16 => "commands are repeated at most N_ack times",
            Self::I17 => "dropping one follower leaves the others' records unchanged",
            Self::I18 => "the identity is locked while in a session",
            Self::L1 => "HelpRequested leads to RoleEstablished or Idle",
            Self::L2 => "an outstanding command leads to acknowledged or given up",
            Self::L3 => "where all around it cooperate, a request leads to a completed task",
            Self::L4 => "an ended session leads to every former member being idle",
            Self::L5 => "a leader's crash for good leads to its followers being stopped and idle",
            Self::L6 => "two that ask or lead at one place lead to at most one of them doing so",
            Self::L7 => "from every state some run leads to all robots being idle",
            Self::W1 => {
                "who steps on the road finds every guard in place, or one is gone and the leader was not told"
            }
            Self::W2 => "while somebody is on the road, no guard that is able to stays away",
            Self::W3 => "of two leaders at one place that hear each other, one alone shows go",
            Self::W4 => "a robot begins nothing new before its duty on the road is over",
            Self::W7 => "where all around it cooperate, a request leads to a finished crossing",
        }
    }

    /// When the property says anything at all; `None` for one that speaks about every state.
    #[must_use]
    pub const fn premise(self) -> Option<&'static str> {
        Some(match self {
            Self::I1 | Self::I18 => "one robot leads and another follows",
            Self::I2 => "a robot follows",
            Self::I3 | Self::I4 => "a follower starts a maneuver",
            Self::I5 => "a follower starts a second maneuver in the same session",
            Self::I6 => "a leader counts a command as acknowledged",
            Self::I7 => "an answer arrives that is not for the outstanding command",
            Self::I8 => "a leader counts a command as completed or in position",
            Self::I9 => "a follower has fallen back",
            Self::I11 => "the corridor is open",
            Self::I12 => "a robot has a part in a session",
            Self::I13 | Self::L7 => return None,
            Self::I14 => "a maneuver runs",
            Self::I15 => "a robot that crashed in a role has a role again",
            Self::I16 => "a command has been repeated N_ack times",
            Self::I17 => "a follower is dropped while another one stays",
            Self::L1 => "a robot is in HelpRequested",
            Self::L2 => "a command is outstanding",
            Self::L3 | Self::W7 => "a robot asks for help",
            Self::L4 => "a robot follows in a session that nobody leads",
            Self::L5 => "a robot follows one that has crashed for good",
            Self::L6 => "two robots ask or lead",
            Self::W1 => "somebody steps on the road",
            Self::W2 => "a guard's maneuver ends while somebody is on the road",
            Self::W3 => "a leader has heard one that goes before it, twice",
            Self::W4 => "a robot has a duty on the road",
        })
    }

    pub(crate) const fn state_rule(self) -> Option<StateRule> {
        match self {
            Self::I1 => Some(i01_one_leader::RULE),
            Self::I2 => Some(i02_confirmed::RULE),
            Self::I6 => Some(i06_acknowledged::RULE),
            Self::I8 => Some(i08_completed::RULE),
            Self::I9 => Some(i09_fallback_is_final::RULE),
            Self::I11 => Some(i11_corridor::RULE),
            Self::I12 => Some(i12_no_deadlock::RULE),
            Self::I14 => Some(i14_idle_is_idle::RULE),
            Self::I15 => Some(i15_reboot::RULE),
            Self::I16 => Some(i16_limits::RULE),
            Self::I18 => Some(i18_identity::RULE),
            Self::W3 => Some(w3_one_sign::RULE),
            _ => None,
        }
    }

    pub(crate) const fn step_rule(self) -> Option<StepRule> {
        match self {
            Self::I3 => Some(i03_commanded::RULE),
            Self::I4 => Some(i04_started_once::RULE),
            Self::I5 => Some(i05_requests_grow::RULE),
            Self::I6 => Some(i06_acknowledged::STEP_RULE),
            Self::I7 => Some(i07_stray_answer::RULE),
            Self::I13 => Some(i13_total::RULE),
            Self::I17 => Some(i17_independent_followers::RULE),
            Self::W2 => Some(w2_guards_stay::RULE),
            Self::W4 => Some(w4_nothing_new_on_duty::RULE),
            _ => None,
        }
    }

    pub(crate) const fn liveness_rule(self) -> Option<LivenessRule> {
        match self {
            Self::L1 => Some(l1_help_ends::RULE),
            Self::L2 => Some(l2_commands_end::RULE),
            Self::L3 => Some(l3_help_helps::RULE),
            Self::L4 => Some(l4_ended_is_left::RULE),
            Self::L5 => Some(l5_crash_is_survived::RULE),
            Self::L6 => Some(l6_requesters_agree::RULE),
            Self::W7 => Some(w7_crossing_gets_done::RULE),
            _ => None,
        }
    }

    pub(crate) const fn bit(self) -> u32 {
        1 << self as u32
    }

    /// All ids, for a message.
    #[must_use]
    pub fn list() -> String {
        Self::ALL.map(|id| id.to_string()).join(", ")
    }
}

impl fmt::Display for PropertyId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::I1 => "I1",
            Self::I2 => "I2",
            Self::I3 => "I3",
            Self::I4 => "I4",
            Self::I5 => "I5",
            Self::I6 => "I6",
            Self::I7 => "I7",
            Self::I8 => "I8",
            Self::I9 => "I9",
            Self::I11 => "I11",
            Self::I12 => "I12",
            Self::I13 => "I13",
            Self::I14 => "I14",
            Self::I15 => "I15",
            Self::I16 => "I16",
            Self::I17 => "I17",
            Self::I18 => "I18",
            Self::L1 => "L1",
            Self::L2 => "L2",
            Self::L3 => "L3",
            Self::L4 => "L4",
            Self::L5 => "L5",
            Self::L6 => "L6",
            Self::L7 => "L7",
            Self::W1 => "W1",
            Self::W2 => "W2",
            Self::W3 => "W3",
            Self::W4 => "W4",
            Self::W7 => "W7",
        })
    }
}

impl FromStr for PropertyId {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL
            .into_iter()
            .find(|id| id.to_string() == name)
            .ok_or(())
    }
}

/// A state as the state rules see it.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    /// The robots, in the order of their places.
    pub(crate) nodes: &'a [&'a Node],
    pub(crate) history: &'a History,
    pub(crate) world: &'a dyn Surroundings,
}

/// What the robots of a state are part of.
pub(crate) trait Surroundings {
    /// The configuration of the robot at this place.
    fn config(&self, place: usize) -> &Config;

    /// Whether some message or timer changes the state, without any application's help.
    fn can_progress(&self) -> bool;

    /// Place of the robot that has this station id, or had it before it changed its pseudonym.
    fn place_of(&self, station: StationId) -> Option<usize>;

    /// Whether no robot that is down boots again.
    fn restarts_are_over(&self) -> bool;
}

impl<'a> View<'a> {
    pub(crate) fn nodes(&self) -> impl Iterator<Item = &'a Node> + Clone + use<'a> {
        self.nodes.iter().copied()
    }

    /// The robots with their configurations.
    pub(crate) fn configured(
        &self,
    ) -> impl Iterator<Item = (&'a Node, &'a Config)> + Clone + use<'a> {
        let world = self.world;
        let places = self.nodes.iter().enumerate();
        places.map(move |(place, node)| (*node, world.config(place)))
    }

    /// The robot at this place of the scenario.
    pub(crate) fn node(&self, place: usize) -> &'a Node {
        self.nodes[place]
    }

    /// The robots that are up.
    pub(crate) fn robots(&self) -> impl Iterator<Item = &'a Robot> + Clone + use<'a> {
        self.nodes().filter_map(|node| node.robot.as_ref())
    }

    /// The robots that lead, with their sessions.
    pub(crate) fn leaders(
        &self,
    ) -> impl Iterator<Item = (SessionId, &'a Leading)> + Clone + use<'a> {
        self.robots().filter_map(|robot| match robot.phase() {
            Phase::Leading(leading) => Some((robot.session()?, leading)),
            _ => None,
        })
    }

    /// The robots that follow.
    pub(crate) fn followers(
        &self,
    ) -> impl Iterator<Item = (&'a Robot, &'a Following)> + Clone + use<'a> {
        self.robots().filter_map(|robot| match robot.phase() {
            Phase::Following(following) => Some((robot, following)),
            _ => None,
        })
    }

    fn history(&self) -> &'a History {
        self.history
    }
}

/// A robot's step as the step rules see it.
#[derive(Clone, Copy)]
pub(crate) struct StepView<'a> {
    pub(crate) config: &'a Config,
    /// The history before the step.
    pub(crate) history: &'a History,
    pub(crate) before: &'a Node,
    pub(crate) after: &'a Node,
    pub(crate) input: Input,
    pub(crate) outputs: &'a Outputs,
}

impl<'a> StepView<'a> {
    /// The maneuver that the step starts.
    fn started(&self) -> Option<Maneuver> {
        self.outputs.iter().find_map(|output| match output {
            Output::StartManeuver(maneuver) => Some(*maneuver),
            _ => None,
        })
    }

    /// Whether the step is one that the history records, or that a rule may look back from.
    pub(crate) fn is_historic(&self) -> bool {
        let reports = matches!(
            self.input,
            Input::Local(Event::ManeuverCompleted(_) | Event::InPosition(_))
        );
        reports
            || told_end(self.before.persisted.station, self.input).is_some()
            || self.outputs.iter().any(|output| {
                matches!(
                    output,
                    Output::SendRmcm(_)
                        | Output::StartManeuver(_)
                        | Output::StopManeuver(..)
                        | Output::FallBack(..)
                        | Output::Notify(Notice::RolesEstablished(_) | Notice::FollowerGone(..))
                )
            })
    }

    /// The history after the step.
    pub(crate) fn history_after(&self) -> History {
        let mut history = self.history.clone();
        if let (Some(before), Some(after)) = (&self.before.robot, &self.after.robot) {
            history.record_step(before, after, self.input, self.outputs);
        }
        history
    }

    fn notices(&self) -> impl Iterator<Item = Notice> + use<'_, 'a> {
        self.outputs.notices()
    }
}

fn leading_of(node: &Node) -> Option<&Leading> {
    match node.robot.as_ref()?.phase() {
        Phase::Leading(leading) => Some(leading),
        _ => None,
    }
}

fn following_of(node: &Node) -> Option<&Following> {
    match node.robot.as_ref()?.phase() {
        Phase::Following(following) => Some(following),
        _ => None,
    }
}
