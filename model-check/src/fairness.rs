//! The graph of a model as a system under fairness: which transitions belong to which class.
//!
//! A robot's timer is treated *weakly* fair: an armed timer expires at some time, unless it is
//! stopped or restarted again and again. A timer that a step restarts counts as taken in that step, so
//! that a safety timer which heartbeats keep restarting need never expire. The fate of a message
//! on air is decided at some time. A robot that hangs goes on at some time. These hold of every robot that
//! keeps its own time. The arrival of a message of a monotone channel is never assumed.
//!
//! In a cooperative scenario there is more: delivery is *strongly* fair for each way and kind of
//! message, so that of what is sent again and again something arrives; and applications do at some
//! time what is theirs to do.

use std::ops::Range;

use crossguard_protocol::{Coordination, Event, StationId, Timer};

use crate::fair::{Classes, Fairness};
use crate::model::{Action, Delivery, Model, ModelState, RobotStep};
use crate::network::{Message, Transmission};
use crate::scenario::Scenario;

/// Timers of which a robot has one.
const OWN_TIMERS: u32 = 8;
/// Timers of which a leader has one per follower.
const TIMERS_PER_FOLLOWER: u32 = 5;
/// Events of the application that are treated fair.
const EVENTS: u32 = 8;
/// Kinds of RAM that differ here.
const RAM_KINDS: u32 = 5;

/// Numbers for the classes of a scenario's transitions.
#[derive(Clone, Copy)]
struct Numbers<'a> {
    scenario: &'a Scenario,
}

impl Numbers<'_> {
    fn robots(self) -> u32 {
        u32::try_from(self.scenario.robots.len()).expect("at most MAX_ROBOTS")
    }

    fn timers_per_robot(self) -> u32 {
        OWN_TIMERS + TIMERS_PER_FOLLOWER * self.robots()
    }

    fn place(self, station: StationId) -> u32 {
        let place = self.scenario.place_of(station).expect("a robot's station");
        u32::try_from(place).expect("at most MAX_ROBOTS")
    }

    fn timer(self, robot: u32, timer: Timer) -> Classes {
        let of_follower =
            |kind: u32, station| OWN_TIMERS + TIMERS_PER_FOLLOWER * self.place(station) + kind;
        let number = match timer {
            Timer::Safety => 0,
            Timer::Leave => 1,
            Timer::Help => 2,
            Timer::Selection => 3,
            Timer::Reservation => 4,
            Timer::IdentityLock => 5,
            Timer::Farewell => 6,
            Timer::Ram => 7,
            Timer::Lease(station) => of_follower(0, station),
            Timer::Lost(station) => of_follower(1, station),
            Timer::Execution(station) => of_follower(2, station),
            Timer::Acknowledgement(station) => of_follower(3, station),
            Timer::Offer(station) => of_follower(4, station),
        };
        Classes::one(robot * self.timers_per_robot() + number)
    }

    fn on_air(self) -> u32 {
        self.robots() * self.timers_per_robot()
    }

    fn resume(self, robot: u32) -> Classes {
        Classes::one(self.on_air() + 1 + robot)
    }

    /// Before it are the classes that hold of every robot: its timers, messages on air, and to go on.
    fn first_event(self) -> u32 {
        self.on_air() + 1 + self.robots()
    }

    fn first_delivery(self) -> u32 {
        self.first_event() + self.robots() * EVENTS
    }

    fn event(self, robot: u32, event: Event) -> Option<Classes> {
        let number = match event {
            Event::CommandManeuver { .. } => 0,
            Event::ManeuverCompleted(_) => 1,
            Event::TaskCompleted => 2,
            Event::InPosition(_) => 3,
            Event::OpenCorridor => 4,
            Event::RoadClear => 5,
            _ => return None,
        };
        Some(self.of_application(robot, number))
    }

    /// An event of this number, or what the pedestrian does at the sign of a robot.
    fn of_application(self, robot: u32, number: u32) -> Classes {
        Classes::one(self.first_event() + robot * EVENTS + number)
    }

    fn delivery(self, transmission: Transmission, message: &Message) -> Option<Classes> {
        let Message::Ram(ram) = message else {
            return None;
        };
        let kind = match ram.coordination {
            Coordination::None => 0,
            Coordination::NeedHelp { .. } => 1,
            Coordination::OfferHelp { .. } => 2,
            Coordination::Leader { .. } => 3,
            Coordination::Follower { .. } => 4,
        };
        // No robot sends to itself.
        let to = u32::from(transmission.to - u8::from(transmission.to > transmission.from));
        let way = u32::from(transmission.from) * (self.robots() - 1) + to;
        Some(Classes::one(self.first_delivery() + way * RAM_KINDS + kind))
    }
}

fn all(numbers: Range<u32>) -> Classes {
    numbers.fold(Classes::NONE, |all, number| all | Classes::one(number))
}

#[derive(Clone, Copy)]
pub(crate) struct Classifier<'a>(pub(crate) &'a Model);

impl Classifier<'_> {
    fn numbers(&self) -> Numbers<'_> {
        Numbers {
            scenario: self.0.scenario(),
        }
    }

    pub(crate) fn fairness(self) -> Fairness {
        let numbers = self.numbers();
        if !self.0.scenario().cooperative {
            let weak = all(0..numbers.first_event());
            return Fairness {
                weak,
                ..Fairness::default()
            };
        }
        let (first, ways) = (
            numbers.first_delivery(),
            numbers.robots() * (numbers.robots() - 1),
        );
        Fairness {
            weak: all(0..first),
            strong: all(first..first + ways * RAM_KINDS),
        }
    }

    /// The classes that an action is enabled in where it is possible.
    pub(crate) fn enabled_by(self, action: Action) -> Classes {
        let numbers = self.numbers();
        let cooperative = self.0.scenario().cooperative;
        let on_air = Classes::one(numbers.on_air());
        match action {
            Action::Deliver {
                transmission,
                how: Delivery::AtOnce,
            } if cooperative => {
                let message = self.0.message(transmission.message);
                on_air | numbers.delivery(transmission, message).unwrap_or_default()
            }
            Action::Deliver {
                how: Delivery::AtOnce,
                ..
            }
            | Action::Lose(_)
            | Action::Delay(_) => on_air,
            Action::Expire(robot, timer) => numbers.timer(robot.into(), timer),
            Action::Local(robot, event) if cooperative => {
                numbers.event(robot.into(), event).unwrap_or_default()
            }
            Action::StepOnRoad(robot) if cooperative => numbers.of_application(robot.into(), 6),
            Action::Across(robot) if cooperative => numbers.of_application(robot.into(), 7),
            Action::Resume(robot) => numbers.resume(robot.into()),
            Action::Local(..)
            | Action::Deliver { .. }
            | Action::Crash(_)
            | Action::Restart(_)
            | Action::StepOnRoad(_)
            | Action::Across(_)
            | Action::Hang(_)
            // Nobody has to lie.
            | Action::Lie(_) => Classes::NONE,
        }
    }

    /// Classes that are enabled in a state, apart from messages on air, whose fate is decided first. A timer goes on
    /// running while they are on their way.
    pub(crate) fn enabled_off_air(self, state: &ModelState) -> Classes {
        let mut actions = Vec::new();
        self.0.actions_off_air(state, &mut actions);
        let is_possible = |action: &Action| match action {
            Action::Local(..) => self.0.successor(state, *action).is_some(),
            _ => true,
        };
        actions
            .into_iter()
            .map(|action| (action, self.enabled_by(action)))
            .filter(|(action, classes)| !classes.is_empty() && is_possible(action))
            .fold(Classes::NONE, |all, (_, classes)| all | classes)
    }

    /// The classes that a transition belongs to: those of its action, and of the timers that its step restarts.
    pub(crate) fn taken(self, action: Action, step: Option<RobotStep<'_>>) -> Classes {
        let restarted = step.map_or(Classes::NONE, |step| {
            let robot = u32::try_from(step.robot).expect("at most MAX_ROBOTS");
            let timers = step.restarted();
            timers.fold(Classes::NONE, |all, timer| {
                all | self.numbers().timer(robot, timer)
            })
        });
        self.enabled_by(action) | restarted
    }
}
