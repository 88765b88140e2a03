//! Robots of the paper's wording, the messages under way between them, and what the properties remember.

use std::fmt;

use crossguard_protocol::State as Stage;

use super::readings::Reading;
use super::road::{Road, invites};
use super::robot::{PaperInput, PaperRam, PaperRmcm, PaperRobot, RobotIndex};

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) struct PaperFlight {
    pub(super) from: RobotIndex,
    pub(super) to: RobotIndex,
    pub(super) kind: FlightKind,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum FlightKind {
    Ram,
    Command,
    Acknowledgement,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Content {
    Ram(PaperRam),
    Rmcm(PaperRmcm),
}

/// Robots, messages under way, and what the properties remember.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperWorld {
    /// It never changes in a run.
    pub(super) reading: Reading,
    /// `None` where a robot has broken down.
    pub(super) robots: Vec<Option<PaperRobot>>,
    /// In order, at most one for each flight.
    pub(super) flying: Vec<(PaperFlight, Content)>,
    pub(super) memory: Memory,
    /// `None` where nothing is asked about the road.
    pub(super) road: Option<Road>,
    pub(super) detections: u8,
    pub(super) crashes: u8,
}

/// Memory of the properties; sets of commands are bits by serial number.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Memory {
    pub(super) given: u8,
    pub(super) started: u8,
    pub(super) fallen_back: u8,
    pub(super) finished: u8,
    /// Hazards that the newest step has brought about, by their place in the list.
    pub(super) brought_about: u32,
}

impl PaperWorld {
    pub(super) fn robots(&self) -> impl Iterator<Item = (RobotIndex, &PaperRobot)> + Clone {
        self.robots
            .iter()
            .enumerate()
            .filter_map(|(i, robot)| Some((i, robot.as_ref()?)))
    }

    pub(super) fn robot(&self, place: RobotIndex) -> Option<&PaperRobot> {
        self.robots[place].as_ref()
    }

    pub(super) fn content(&self, flight: PaperFlight) -> Option<Content> {
        let found = self.flying.iter().find(|(other, _)| *other == flight)?;
        Some(found.1)
    }

    /// Whether nothing goes on by itself: nothing is under way, no timeout and no maneuver runs, no
    /// application has anything to say, and no RAM tells anybody anything new.
    pub(super) fn is_stuck(&self) -> bool {
        self.flying.is_empty()
            && !self.robots().any(|(_, robot)| self.acts(robot))
            && self.telling_links().next().is_none()
    }

    /// Whether a robot goes on by itself.
    fn acts(&self, robot: &PaperRobot) -> bool {
        let follows_on = robot.may_time_out() || robot.may_ask_for_leave();
        let leads_on = robot.waits_for_nothing() || robot.may_reissue() || robot.is_asked_for_leave;
        follows_on || leads_on || self.may_time_out_as_leader(robot)
    }

    /// Whether the execution timeout of a leader may run out.
    pub(super) fn may_time_out_as_leader(&self, robot: &PaperRobot) -> bool {
        self.reading == Reading::LeaderTimesOut
            && robot.follower().is_some()
            && robot.state == Stage::ManeuverExecuting
    }

    /// The links on which the sender's current RAM would change the receiver.
    pub(super) fn telling_links(&self) -> impl Iterator<Item = (RobotIndex, RobotIndex)> {
        self.links()
            .filter(|&(from, to)| self.told(from, to) != self.robots[to])
    }

    /// From every robot to every other.
    pub(super) fn links(&self) -> impl Iterator<Item = (RobotIndex, RobotIndex)> {
        self.robots().flat_map(move |(from, _)| {
            let others = self.robots().filter(move |(to, _)| *to != from);
            others.map(move |(to, _)| (from, to))
        })
    }

    /// The robot at `to` if it heard the current RAM of the robot at `from`.
    pub(super) fn told(&self, from: RobotIndex, to: RobotIndex) -> Option<PaperRobot> {
        let mut robot = self.robots[to]?;
        let heard = PaperInput::Ram(from, self.robots[from]?.ram());
        robot.step(self.reading, to, heard);
        Some(robot)
    }

    pub(super) fn send(
        &mut self,
        from: RobotIndex,
        to: RobotIndex,
        content: Content,
    ) -> Option<()> {
        let kind = content.kind();
        let flight = PaperFlight { from, to, kind };
        let place = self.flying.binary_search_by_key(&flight, |(f, _)| *f);
        self.flying.insert(place.err()?, (flight, content));
        Some(())
    }

    pub(super) fn land(&mut self, flight: PaperFlight) {
        self.flying.retain(|(other, _)| *other != flight);
    }

    /// The robots that let people cross a road that their followers block.
    pub(super) fn inviting(&self) -> impl Iterator<Item = RobotIndex> {
        let invites = |(_, robot): &(RobotIndex, &PaperRobot)| invites(robot);
        self.robots().filter(invites).map(|(place, _)| place)
    }
}

impl Content {
    const fn kind(self) -> FlightKind {
        match self {
            Self::Ram(_) => FlightKind::Ram,
            Self::Rmcm(PaperRmcm::Command(_)) => FlightKind::Command,
            Self::Rmcm(PaperRmcm::Acknowledgement(_)) => FlightKind::Acknowledgement,
        }
    }

    pub(super) const fn input(self, from: RobotIndex) -> PaperInput {
        match self {
            Self::Ram(ram) => PaperInput::Ram(from, ram),
            Self::Rmcm(rmcm) => PaperInput::Rmcm(from, rmcm),
        }
    }
}

impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ram(ram) => ram.fmt(f),
            Self::Rmcm(rmcm) => rmcm.fmt(f),
        }
    }
}
