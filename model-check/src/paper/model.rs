//! Robots of the paper's wording, their radio channel and their applications, for stateright.
//!
//! RAM are periodic, so a robot may hear another one's *current* RAM at any moment, or not for a
//! while; one RAM at a time may be delayed. An RMCM is sent once; it arrives after any time, also
//! repeatedly, or gets lost. At most one of a kind is under way on each link.

use crossguard_protocol::State as Stage;
use stateright::Property;

use super::found::{self, HOLDS_BIT, is_crossed};
use super::hazards::Hazard;
use super::road::{Inquiry, Move, Road};
use super::robot::{PaperCommand, PaperInput, PaperRmcm, PaperRobot, RobotIndex};
use super::world::{Content, FlightKind, Memory, PaperFlight, PaperWorld};

/// P0: what holds.
pub(super) const HOLDS: &str = "P0";
/// The premise of P0.
pub(super) const PREMISE: &str = "P0-premise";
/// What is asked about the road.
pub(super) const ON_ROAD: &str = "W";

/// Robots, and how often what may happen to them in one run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cast {
    /// Names; the station id of a robot is its place, counted from 1.
    pub(super) names: &'static [&'static str],
    /// The first this many robots may detect the pedestrian.
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

impl PaperWorld {
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
        self.memory.brought_about = found::brought_about(&before, place, input, &after);
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
                self.memory.started |= bit(Some(command));
            }
            _ => {}
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
                let (Some(sender), Some(receiver)) = (world.robot(from), world.robot(to)) else {
                    return false;
                };
                world.told(from, to) == world.robots[to]
                    && road.notes((from, sender), (to, receiver))
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
            next.step(place, PaperInput::Commanded(world.memory.given))?;
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

/// What stateright looks at to answer a question.
///
/// One hazard at a time: with several, stateright goes on after the first, shortest counterexample and
/// keeps the last.
fn properties(question: &Question) -> Vec<Property<Question>> {
    let mut properties = vec![match question.hazard {
        Some(hazard) => Property::always(
            hazard.text().id,
            |question: &Question, world: &PaperWorld| {
                question.hazard.is_none_or(|hazard| !hazard.is_in(world))
            },
        ),
        None => Property::always(HOLDS, |_, world: &PaperWorld| {
            world.memory.brought_about & HOLDS_BIT == 0
        }),
    }];
    if question.road.is_some_and(|road| road.property.is_some()) {
        let holds = |question: &Question, world: &PaperWorld| !is_found(question, world);
        properties = vec![Property::always(ON_ROAD, holds)];
    }
    if question.hazard.is_none() && question.road.is_none() && question.cast.commands > 1 {
        let is_met = |_: &Question, world: &PaperWorld| is_crossed(world);
        properties.push(Property::sometimes(PREMISE, is_met));
    }
    properties
}

/// Whether a question about the road has found what it asks for.
fn is_found(question: &Question, world: &PaperWorld) -> bool {
    let asked = question.road.and_then(|inquiry| inquiry.property);
    asked.is_some_and(|property| property.is_broken(world))
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
            road.moves(world.inviting(), &mut moves);
            actions.extend(moves.into_iter().map(PaperAction::Road));
        }
    }

    fn next_state(&self, world: &PaperWorld, action: PaperAction) -> Option<PaperWorld> {
        successor(world, action)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        properties(self)
    }
}
