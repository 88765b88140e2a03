//! Robots of the paper's wording, their radio channel and their applications, for stateright.
//!
//! RAM are periodic, so a robot may hear another one's *current* RAM at any moment, or not for a
//! while; one RAM at a time may be delayed. An RMCM is sent once; it arrives after any time, also
//! repeatedly, or gets lost. At most one of a kind is under way on each link.

use std::fmt;

use crossguard_protocol::State as Stage;
use stateright::Property;

use super::hazards::{self, Hazard};
use super::road::{Inquiry, Move, Road};
use super::robot::{PaperCommand, PaperInput, PaperRam, PaperRmcm, PaperRobot, RobotIndex};

/// Robots, and how often what may happen to them in one run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cast {
    /// Names; the station id of a robot is its place, counted from 1.
    pub(super) names: &'static [&'static str],
    /// The first so many robots may detect the pedestrian.
    pub(super) detecting: usize,
    /// How often a pedestrian is detected, by any of them.
    pub(super) detections: u8,
    pub(super) commands: u8,
    /// How many robots break down for good.
    pub(super) crashes: u8,
    /// Whether a RAM may be delayed.
    pub(super) delay: bool,
}

/// What stateright is asked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Question {
    pub(super) cast: Cast,
    /// The hazard to find, or what holds.
    pub(super) hazard: Option<Hazard>,
    /// What to ask about the road; without, there is none.
    pub(super) road: Option<Inquiry>,
}

/// A message under way.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) struct PaperFlight {
    pub(super) from: RobotIndex,
    pub(super) to: RobotIndex,
    pub(super) kind: FlightKind,
}

/// What a message under way is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum FlightKind {
    Ram,
    Command,
    Acknowledgement,
}

/// What a message under way says.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Content {
    Ram(PaperRam),
    Rmcm(PaperRmcm),
}

/// What happens.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperAction {
    Detect(RobotIndex),
    /// The current, periodic RAM is heard.
    Hear {
        from: RobotIndex,
        to: RobotIndex,
    },
    Command(RobotIndex),
    /// A message under way arrives; `again` if a copy of it stays under way.
    Arrive {
        flight: PaperFlight,
        again: bool,
    },
    Finish(RobotIndex),
    CompleteTask(RobotIndex),
    SafetyTimeout(RobotIndex),
    /// The current, periodic RAM is delayed.
    Delay {
        from: RobotIndex,
        to: RobotIndex,
    },
    Lose(PaperFlight),
    Crash(RobotIndex),
    /// On the road, by itself.
    Road(Move),
}

/// Robots, messages under way, and what the properties remember.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperWorld {
    /// `None` where a robot has broken down.
    pub(super) robots: Vec<Option<PaperRobot>>,
    /// In order, at most one for each flight.
    pub(super) flying: Vec<(PaperFlight, Content)>,
    pub(super) memory: Memory,
    /// `None` where nothing is asked about the road.
    pub(super) road: Option<Road>,
    detections: u8,
    crashes: u8,
}

/// What the properties remember; sets of commands are bits by serial number.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Memory {
    /// How many commands were given.
    pub(super) given: u8,
    pub(super) started: u8,
    pub(super) fallen_back: u8,
    pub(super) finished: u8,
    /// Hazards that the newest step has brought about, by their place in the list.
    pub(super) brought_about: u16,
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
        let acts = |robot: &PaperRobot| robot.leader().is_some() || robot.may_command();
        self.flying.is_empty()
            && !self.robots().any(|(_, robot)| acts(robot))
            && self.telling_links().next().is_none()
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
        robot.step(to, PaperInput::Ram(from, self.robots[from]?.ram()));
        Some(robot)
    }

    fn send(&mut self, from: RobotIndex, to: RobotIndex, content: Content) -> Option<()> {
        let kind = content.kind();
        let flight = PaperFlight { from, to, kind };
        let place = self.flying.binary_search_by_key(&flight, |(f, _)| *f);
        self.flying.insert(place.err()?, (flight, content));
        Some(())
    }

    fn land(&mut self, flight: PaperFlight) {
        self.flying.retain(|(other, _)| *other != flight);
    }

    /// A robot's step, what it sends, and what the properties remember of it.
    fn step(&mut self, place: RobotIndex, input: PaperInput) -> Option<()> {
        let before = self.clone();
        let robot = self.robots[place].as_mut()?;
        let sent = robot.step(place, input);
        let after = *robot;
        let partner = match sent {
            Some(PaperRmcm::Command(_)) => after.follower(),
            Some(PaperRmcm::Acknowledgement(_)) => after.leader(),
            None => None,
        };
        if let (Some(to), Some(rmcm)) = (partner, sent) {
            self.send(place, to, Content::Rmcm(rmcm))?;
        }
        self.memory.brought_about = hazards::brought_about(&before, place, input, &after);
        self.remember(&before, place, input, sent);
        if let (Some(road), Some(robot)) = (&mut self.road, before.robot(place)) {
            road.observe(robot, place, input, &after);
        }
        Some(())
    }

    fn remember(
        &mut self,
        before: &Self,
        place: RobotIndex,
        input: PaperInput,
        sent: Option<PaperRmcm>,
    ) {
        let bit = |command: Option<PaperCommand>| command.map_or(0, |command| 1 << command.serial);
        let executed = before.robot(place).and_then(PaperRobot::executing);
        match (input, sent) {
            (PaperInput::SafetyTimeout, _) => self.memory.fallen_back |= bit(executed),
            (PaperInput::Finished, _) => self.memory.finished |= bit(executed),
            (_, Some(PaperRmcm::Command(_))) => self.memory.given += 1,
            (_, Some(PaperRmcm::Acknowledgement(command))) => {
                self.memory.started |= bit(Some(command))
            }
            _ => {}
        }
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
}

impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ram(ram) => ram.fmt(f),
            Self::Rmcm(rmcm) => rmcm.fmt(f),
        }
    }
}

impl Cast {
    fn local_actions(&self, world: &PaperWorld, actions: &mut Vec<PaperAction>) {
        // Applications are truthful: while somebody is on the road nothing is finished.
        let is_road_free = world.road.as_ref().is_none_or(Road::is_free);
        for (place, robot) in world.robots() {
            if robot.state == Stage::Idle
                && place < self.detecting
                && world.detections < self.detections
            {
                actions.push(PaperAction::Detect(place));
            }
            if robot.may_command() && world.memory.given < self.commands {
                actions.push(PaperAction::Command(place));
            }
            if robot.executing().is_some() && is_road_free {
                actions.push(PaperAction::Finish(place));
            }
            if robot.may_complete_task() && is_road_free {
                actions.push(PaperAction::CompleteTask(place));
            }
            if robot.leader().is_some() {
                actions.push(PaperAction::SafetyTimeout(place));
            }
        }
    }

    fn channel_actions(&self, world: &PaperWorld, actions: &mut Vec<PaperAction>) {
        let hears = |(from, to)| PaperAction::Hear { from, to };
        actions.extend(world.telling_links().map(hears));
        if let Some(road) = &world.road {
            let is_noted = |&(from, to): &(RobotIndex, RobotIndex)| {
                world.told(from, to) == world.robots[to] && road.notes(world, from, to)
            };
            actions.extend(world.links().filter(is_noted).map(hears));
        }
        for &(flight, _) in &world.flying {
            if world.robot(flight.to).is_some() {
                let arrive = |again| PaperAction::Arrive { flight, again };
                actions.extend([arrive(false), arrive(true)]);
            }
        }
        for &(flight, _) in &world.flying {
            actions.push(PaperAction::Lose(flight));
        }
        let is_delayed = |(flight, _): &(PaperFlight, Content)| flight.kind == FlightKind::Ram;
        if self.delay && !world.flying.iter().any(is_delayed) {
            for (from, _) in world.robots() {
                let others = world.robots().filter(|(to, _)| *to != from);
                actions.extend(others.map(|(to, _)| PaperAction::Delay { from, to }));
            }
        }
    }
}

fn successor(world: &PaperWorld, action: PaperAction) -> Option<PaperWorld> {
    let mut next = world.clone();
    next.memory.brought_about = 0;
    if let Some(road) = &mut next.road {
        road.forget_broken();
    }
    match action {
        PaperAction::Detect(place) => {
            next.detections += 1;
            next.step(place, PaperInput::Detected)?;
        }
        PaperAction::Hear { from, to } => {
            let ram = world.robot(from)?.ram();
            next.step(to, PaperInput::Ram(from, ram))?;
        }
        PaperAction::Command(place) => {
            next.step(place, PaperInput::Commanded(world.memory.given))?
        }
        PaperAction::Arrive { flight, again } => {
            if !again {
                next.land(flight);
            }
            next.step(flight.to, world.content(flight)?.input(flight.from))?;
        }
        PaperAction::Finish(place) => next.step(place, PaperInput::Finished)?,
        PaperAction::CompleteTask(place) => next.step(place, PaperInput::TaskCompleted)?,
        PaperAction::SafetyTimeout(place) => next.step(place, PaperInput::SafetyTimeout)?,
        PaperAction::Delay { from, to } => {
            let ram = world.robot(from)?.ram();
            next.send(from, to, Content::Ram(ram))?;
        }
        PaperAction::Lose(flight) => next.land(flight),
        PaperAction::Crash(place) => {
            next.crashes += 1;
            next.robots[place] = None;
            if let Some(road) = &mut next.road {
                road.end(place);
            }
        }
        PaperAction::Road(what) => next.road.as_mut()?.happen(what),
    }
    Some(next)
}

impl Content {
    const fn input(self, from: RobotIndex) -> PaperInput {
        match self {
            Self::Ram(ram) => PaperInput::Ram(from, ram),
            Self::Rmcm(rmcm) => PaperInput::Rmcm(from, rmcm),
        }
    }
}

impl stateright::Model for Question {
    type State = PaperWorld;
    type Action = PaperAction;

    fn init_states(&self) -> Vec<PaperWorld> {
        vec![PaperWorld {
            robots: vec![Some(PaperRobot::IDLE); self.cast.names.len()],
            flying: Vec::new(),
            memory: Memory::default(),
            road: self
                .road
                .map(|inquiry| Road::new(self.cast.names.len(), inquiry.task)),
            detections: 0,
            crashes: 0,
        }]
    }

    fn actions(&self, world: &PaperWorld, actions: &mut Vec<PaperAction>) {
        // Of equally short counterexamples the first in this order is found.
        self.cast.channel_actions(world, actions);
        self.cast.local_actions(world, actions);
        if world.crashes < self.cast.crashes {
            actions.extend(world.robots().map(|(place, _)| PaperAction::Crash(place)));
        }
        if let Some(road) = &world.road {
            let mut moves = Vec::new();
            road.moves(world, &mut moves);
            actions.extend(moves.into_iter().map(PaperAction::Road));
        }
    }

    fn next_state(&self, world: &PaperWorld, action: PaperAction) -> Option<PaperWorld> {
        successor(world, action)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        hazards::properties(self)
    }
}
