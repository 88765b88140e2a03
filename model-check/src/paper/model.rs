//! Robots of the paper's wording, their radio channel and their applications, for stateright.
//!
//! RAM are periodic, so a robot may hear another one's *current* RAM at any moment, or not for a
//! while; one RAM at a time may be delayed. An RMCM arrives after any time, also repeatedly, or gets
//! lost. At most one of a kind is under way on each link.

use crossguard_protocol::State as Stage;
use stateright::Property;

use super::found::{self, HOLDS_BIT, is_closed, is_crossed};
use super::hazards::Hazard;
use super::readings::Reading;
use super::road::{Move, Road};
use super::robot::{PaperCommand, PaperInput, PaperRmcm, PaperRobot, PaperTask, RobotIndex};
use super::world::{Content, FlightKind, Memory, PaperFlight, PaperWorld};

/// P0: what holds.
pub(super) const HOLDS: &str = "P0";
/// The premise of P0.
pub(super) const PREMISE: &str = "P0-premise";
/// P10: what the text closes itself.
pub(super) const CLOSED: &str = "P10";

/// Robots, and how often what may happen to them in one run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cast {
    /// Names; the station id of a robot is its place, counted from 1.
    pub(super) names: &'static [&'static str],
    /// The first this many robots may detect the pedestrian.
    pub(super) detecting: usize,
    /// How often a pedestrian is detected, by any of them.
    pub(super) detections: u8,
    /// The maneuvers of a task, in order.
    pub(super) plan: &'static [PaperTask],
    /// How often a command is sent, by anybody.
    pub(super) commands: u8,
    /// How many robots break down for good.
    pub(super) crashes: u8,
    /// Whether an RMCM gets lost or repeated, and timeouts run out.
    pub(super) faults: bool,
    /// Whether a RAM may be delayed.
    pub(super) delay: bool,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Question {
    pub(super) cast: Cast,
    pub(super) reading: Reading,
    /// The hazard to find; or else what holds is asked.
    pub(super) about: Option<Hazard>,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperAction {
    /// A robot's application, body or timer does something.
    Local(RobotIndex, PaperInput),
    /// The current, periodic RAM is heard.
    Hear {
        from: RobotIndex,
        to: RobotIndex,
    },
    /// A message under way arrives; `again` if a copy of it stays under way.
    Arrive {
        flight: PaperFlight,
        again: bool,
    },
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
        let sent = robot.step(self.reading, place, input);
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
            (PaperInput::Finished, _) => {
                let original = executed.map(|command| 1 << command.original);
                self.memory.finished |= original.unwrap_or(0);
            }
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
        let may_send = world.memory.given < self.commands;
        for (place, robot) in world.robots() {
            let may_detect = place < self.detecting && world.detections < self.detections;
            let planned = self.plan.get(usize::from(robot.commanded)).copied();
            let waits = robot.waits_for_nothing();
            let given = world.memory.given;
            let mut may = |is_so: bool, input: PaperInput| {
                actions.extend(is_so.then_some(PaperAction::Local(place, input)));
            };
            may(
                robot.state == Stage::Idle && may_detect,
                PaperInput::Detected,
            );
            if let Some(task) = planned {
                may(waits && may_send, PaperInput::Commanded(task, given));
            }
            may(robot.may_reissue() && may_send, PaperInput::Reissued(given));
            let finishes = robot.executing().is_some();
            may(finishes && is_road_free, PaperInput::Finished);
            let is_done = waits && planned.is_none();
            may(is_done && is_road_free, PaperInput::TaskCompleted);
            let times_out = robot.may_time_out() && self.faults;
            may(times_out, PaperInput::SafetyTimeout);
            let leader_does = world.may_time_out_as_leader(robot);
            may(leader_does, PaperInput::LeaderTimeout);
            may(robot.may_ask_for_leave(), PaperInput::LeaveAsked);
            let grants = robot.is_asked_for_leave && is_road_free;
            may(grants, PaperInput::LeaveGranted);
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
                actions.push(arrive(false));
                actions.extend(self.faults.then(|| arrive(true)));
            }
        }
        if self.faults {
            let lose = |(flight, _): &(PaperFlight, Content)| PaperAction::Lose(*flight);
            actions.extend(world.flying.iter().map(lose));
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
        PaperAction::Local(place, input) => {
            next.detections += u8::from(input == PaperInput::Detected);
            next.step(place, input)?;
        }
        PaperAction::Hear { from, to } => {
            let ram = world.robot(from)?.ram();
            if world.reading == Reading::OlderRamIgnored {
                let kind = FlightKind::Ram;
                next.land(PaperFlight { from, to, kind });
            }
            next.step(to, PaperInput::Ram(from, ram))?;
        }
        PaperAction::Arrive { flight, again } => {
            if !again {
                next.land(flight);
            }
            next.step(flight.to, world.content(flight)?.input(flight.from))?;
        }
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
        PaperAction::Road(what) => next.road.as_mut()?.happen(what, &world.robots),
    }
    Some(next)
}

impl stateright::Model for Question {
    type State = PaperWorld;
    type Action = PaperAction;

    fn init_states(&self) -> Vec<PaperWorld> {
        let has_road = self.about.is_some_and(Hazard::is_on_road);
        let guard = self.cast.plan.last().filter(|_| has_road);
        vec![PaperWorld {
            reading: self.reading,
            robots: vec![Some(PaperRobot::IDLE); self.cast.names.len()],
            flying: Vec::new(),
            memory: Memory::default(),
            road: guard.map(|guard| Road::new(self.cast.names.len(), *guard)),
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

    /// One hazard at a time: with several, stateright goes on after the first, shortest counterexample and
    /// keeps the last.
    fn properties(&self) -> Vec<Property<Self>> {
        if let Some(hazard) = self.about {
            let is_absent = |question: &Self, world: &PaperWorld| {
                question.about.is_none_or(|hazard| !hazard.is_in(world))
            };
            return vec![Property::always(&hazard.text().id, is_absent)];
        }
        vec![
            Property::always(HOLDS, |_, world: &PaperWorld| {
                world.memory.brought_about & HOLDS_BIT == 0
            }),
            Property::always(CLOSED, |_, world| is_closed(world)),
            Property::sometimes(PREMISE, |_, world| is_crossed(world)),
        ]
    }
}
