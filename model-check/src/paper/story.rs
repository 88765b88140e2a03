//! The physical story of a counterexample, to be told to robots that run the real protocol.
//!
//! A counterexample says what the robots of the paper's wording do; a story leaves that out. It says
//! what happens *to* robots: detections, what applications ask for, finished maneuvers, breakdowns,
//! and what the radio does. The radio carries everything except
//!
//! - RAM on the links that are *silent*: to hear one there, before or after the step, would have made
//!   it another story;
//! - the messages that are *held*: the messages that are under way in the story.

use serde::{Deserialize, Serialize};

use super::model::{Cast, PaperAction};
use super::robot::{PaperRobot, RobotIndex};
use super::world::{FlightKind, PaperFlight, PaperWorld};
use super::{Counterexample, Transition, counterexamples};

/// The story of one counterexample.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Story {
    /// Id of the broken property.
    pub property: String,
    /// What happens, in a few words.
    pub title: String,
    /// The robots.
    pub robots: Vec<Party>,
    /// What happens, in order.
    pub steps: Vec<StoryStep>,
}

/// A robot of the story.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Party {
    /// Its name.
    pub name: String,
    /// Its station id.
    pub station: u32,
}

/// One step of the story.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoryStep {
    /// What happens.
    pub what: Happening,
    /// Links that carry no RAM from now on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub silent: Vec<Link>,
    /// Messages that are under way from now on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<StoryMessage>,
}

/// What happens to robots and to messages. Robots are named by their station ids.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Happening {
    /// It detects a pedestrian.
    Detect(u32),
    /// The newest RAM of one robot is heard by the other.
    Hear(Link),
    /// The newest RAM of one robot to the other is delayed.
    Delay(Link),
    /// The application of one robot wants the other one to move along with the pedestrian.
    Command(Link),
    /// The application of one robot gives the other one its command anew.
    Reissue(Link),
    /// What is held arrives.
    Arrive(StoryMessage),
    /// What is held arrives, and a copy of it stays under way.
    ArriveAgain(StoryMessage),
    /// What is held is lost.
    Lose(StoryMessage),
    /// Its body has finished the maneuver.
    Finish(u32),
    /// Its application says that the task is done.
    CompleteTask(u32),
    /// As much time passes as its safety timer runs.
    SafetyTimeout(u32),
    /// Its application asks for leave.
    AskForLeave(u32),
    /// Its application grants it.
    GrantLeave(u32),
    /// It breaks down for good.
    Crash(u32),
}

/// From one robot to another.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Link {
    /// The sender's station id.
    pub from: u32,
    /// The receiver's.
    pub to: u32,
}

/// A message on a link.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum StoryMessage {
    /// A RAM.
    Ram(Link),
    /// An RMCM with a command.
    Command(Link),
    /// An RMCM with an answer.
    Answer(Link),
}

/// The stories of all counterexamples, in the order of their hazards.
#[must_use]
pub fn stories() -> Vec<Story> {
    counterexamples()
        .iter()
        .map(Counterexample::story)
        .collect()
}

impl Counterexample {
    fn story(&self) -> Story {
        let text = self.text;
        let steps = self.steps.iter().enumerate().map(|(i, step)| StoryStep {
            what: happening(&step.before, step.action),
            silent: self.silent(i),
            held: step.after.flying.iter().map(|(f, _)| message(*f)).collect(),
        });
        Story {
            property: text.id.to_owned(),
            title: text.title.to_owned(),
            robots: parties(&self.cast),
            steps: steps.collect(),
        }
    }

    /// The links that are silent in a step.
    fn silent(&self, step: usize) -> Vec<Link> {
        let Transition {
            before,
            action,
            after,
        } = &self.steps[step];
        // That the leader was heard matters only to a safety timeout.
        let is_timeout = |step: &Transition| matches!(step.action, PaperAction::SafetyTimeout(_));
        let times_out = self.steps[step..].iter().any(is_timeout);
        let tells = |world: &PaperWorld, from, to| {
            let (robot, mut told) = (world.robots[to], world.told(from, to));
            if let (Some(robot), Some(told), false) = (robot, &mut told, times_out) {
                told.heard_leader = robot.heard_leader;
            }
            told != robot
        };
        let is_silent = |&(from, to): &(RobotIndex, RobotIndex)| {
            let is_heard = *action == PaperAction::Hear { from, to };
            tells(after, from, to) || !is_heard && tells(before, from, to)
        };
        after
            .links()
            .filter(is_silent)
            .map(|(from, to)| link(from, to))
            .collect()
    }
}

fn parties(cast: &Cast) -> Vec<Party> {
    let party = |(place, name): (RobotIndex, &&str)| Party {
        name: (*name).to_owned(),
        station: station(place),
    };
    cast.names.iter().enumerate().map(party).collect()
}

fn station(place: RobotIndex) -> u32 {
    u32::try_from(place + 1).expect("a cast has a handful of robots")
}

fn link(from: RobotIndex, to: RobotIndex) -> Link {
    let (from, to) = (station(from), station(to));
    Link { from, to }
}

fn message(PaperFlight { from, to, kind }: PaperFlight) -> StoryMessage {
    let link = link(from, to);
    match kind {
        FlightKind::Ram => StoryMessage::Ram(link),
        FlightKind::Command => StoryMessage::Command(link),
        FlightKind::Acknowledgement => StoryMessage::Answer(link),
    }
}

fn happening(before: &PaperWorld, action: PaperAction) -> Happening {
    match action {
        PaperAction::Detect(place) => Happening::Detect(station(place)),
        PaperAction::Hear { from, to } => Happening::Hear(link(from, to)),
        PaperAction::Delay { from, to } => Happening::Delay(link(from, to)),
        PaperAction::Command(place) => Happening::Command(led(before, place)),
        PaperAction::Reissue(place) => Happening::Reissue(led(before, place)),
        PaperAction::Arrive { flight, again } if again => Happening::ArriveAgain(message(flight)),
        PaperAction::Arrive { flight, .. } => Happening::Arrive(message(flight)),
        PaperAction::Lose(flight) => Happening::Lose(message(flight)),
        PaperAction::Finish(place) => Happening::Finish(station(place)),
        PaperAction::CompleteTask(place) => Happening::CompleteTask(station(place)),
        PaperAction::SafetyTimeout(place) => Happening::SafetyTimeout(station(place)),
        PaperAction::AskForLeave(place) => Happening::AskForLeave(station(place)),
        PaperAction::GrantLeave(place) => Happening::GrantLeave(station(place)),
        PaperAction::Crash(place) => Happening::Crash(station(place)),
        PaperAction::LeaderTimeout(_) | PaperAction::Road(_) => {
            unreachable!("stories are of the literal reading, without a road")
        }
    }
}

/// From a leader to its follower.
fn led(world: &PaperWorld, leader: RobotIndex) -> Link {
    let follower = world.robot(leader).and_then(PaperRobot::follower);
    link(leader, follower.expect("only a leader commands"))
}
