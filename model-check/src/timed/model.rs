//! The timed model: robots that take in how much time has passed.
//!
//! ```text
//!   at a tick                     between two ticks, in no time and any order
//!   ┌───────────────────────┐     ┌────────────────────────────────────────────┐
//!   │ every clock runs on,  │     │ messages arrive, or not yet, or never      │
//!   │ slow or fast; each    │ ──► │ free endpoints look: Elapsed               │ ──► next tick
//!   │ robot: Elapsed, unless│     │ applications command, open; robots fail,   │
//!   │ it looks when it likes│     │ hang, go on                                │
//!   └───────────────────────┘     └────────────────────────────────────────────┘
//! ```
//!
//! A robot's part of a step is one call of [`Robot::step`](crossguard_protocol::Robot::step), as in
//! the untimed model. Timers are urgent because the transition function makes them so: a timer that is
//! due fires when the robot takes in the time.

use std::sync::Arc;

use crossguard_protocol::{Event, Millis, Outputs, StationId};
use smallvec::SmallVec;

use super::channel::TimedChannel;
use super::limits::Limits;
use super::quiet::ContactChange;
use super::section::Timed;
use super::sign::Sign;
use super::state::TimedState;
use super::teams::MAX_TEAMS;
use super::told::{Telling, Told};
use super::watch::StopWatch;
use crate::canonical::{Ranks, Renamable, Renamings};
use crate::held::Held;
use crate::memo::Memo;
use crate::names::Names;
use crate::network::Message;
use crate::node::{Node, Protocol, Rules};
use crate::properties::PropertyId;
use crate::properties::timed_view::RobotSteps;
use crate::robots::{Robots, TimedCause};
use crate::scenario::{MAX_ROBOTS, Scenario};

#[derive(Clone, Debug)]
pub(super) struct TimedRobotStep {
    pub(super) after: u32,
    pub(super) sends: SmallVec<[u16; 2]>,
    /// State of the sign from then on, if an output was for it.
    pub(super) sign: Option<Sign>,
    pub(super) telling: Telling,
    /// Its effect on the contact to a leader.
    pub(super) contact: ContactChange,
    pub(super) is_ignored: bool,
    pub(super) is_valid: bool,
}

/// The timed model of one scenario.
pub struct TimedModel {
    pub(super) scenario: Scenario,
    pub(super) names: Names,
    pub(super) timed: Timed,
    pub(super) limits: Limits,
    pub(super) robots: Robots,
    /// Each step of a robot is computed once.
    steps: Memo<(u32, TimedCause), TimedRobotStep>,
}

impl TimedModel {
    /// The model of a timed scenario; `None` when the scenario says nothing of time.
    #[must_use]
    pub fn new(scenario: Scenario) -> Option<Self> {
        Self::with_rules(scenario, Protocol)
    }

    /// The model with another transition function in place of the kit's.
    #[must_use]
    pub fn with_rules(scenario: Scenario, rules: impl Rules + 'static) -> Option<Self> {
        let renamings = Arc::new(Renamings::new(Ranks::rank_keeping_distances));
        let timed = scenario.timed.clone()?;
        Some(Self {
            limits: Limits::new(&scenario.config, timed.delay),
            timed,
            names: Names::of(&scenario),
            scenario,
            robots: Robots::new(Box::new(rules), &renamings),
            steps: Memo::default(),
        })
    }

    /// The scenario.
    #[must_use]
    pub const fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The state in which every run begins: all are idle, and one of each team has just detected a pedestrian.
    /// Two teams do not reach each other yet.
    #[must_use]
    pub fn initial(&self) -> TimedState {
        let mut nodes = [0; MAX_ROBOTS];
        for (node, setup) in nodes.iter_mut().zip(&self.scenario.robots) {
            *node = self.robots.nodes.number(Node::first_boot(setup.station));
        }
        let mut state = TimedState {
            nodes,
            channel: TimedChannel::EMPTY,
            left: self.scenario.bounds,
            watch: if self.timed.teams.are_two() {
                StopWatch::Apart
            } else {
                StopWatch::Request(0)
            },
            untold: [Millis::ZERO; MAX_ROBOTS],
            rates: None,
            signs: [Sign::Stop; MAX_TEAMS],
            unguarded: [None; MAX_TEAMS],
            waiting: self.timed.claims(PropertyId::W8).then_some(0),
            told: Told::NOTHING,
            quiet: [None; MAX_ROBOTS],
            broken: 0,
        };
        let mut robots = RobotSteps::NONE;
        for &leader in self.timed.teams.leaders() {
            let detected = Event::PedestrianDetected(self.scenario.request_of(leader.into()));
            let cause = TimedCause::Event(detected);
            let _ = self.robot_step(&mut state, leader, cause, &mut robots);
        }
        state.broken = self.judge(&state, &state, robots);
        self.canonicalize(&mut state);
        state
    }

    pub(super) fn nodes<'a>(
        &'a self,
        state: &'a TimedState,
    ) -> impl Iterator<Item = &'a Node> + Clone {
        let robots = self.scenario.robots.len();
        state.nodes[..robots]
            .iter()
            .map(|&number| self.robots.nodes.value(number))
    }

    pub(super) fn node(&self, state: &TimedState, place: u8) -> &Node {
        self.robots.nodes.value(state.nodes[usize::from(place)])
    }

    pub(super) fn message(&self, number: u16) -> &Message {
        self.robots.message(number)
    }

    pub(super) fn step(&self, node: u32, cause: TimedCause) -> Option<&TimedRobotStep> {
        if let Some(known) = self.steps.get(&(node, cause)) {
            return Some(known);
        }
        let (after, outputs) = self.compute(node, cause)?;
        let robot = after.robot.as_ref()?;
        let (input, before) = (self.robots.input(cause), self.robots.nodes.value(node));
        let said = before.robot.as_ref()?.ram();
        // A run ends before they do.
        let mut held = Held {
            config: &self.scenario.config,
            robot,
            holds_help: false,
        };
        let step = TimedRobotStep {
            sends: self.robots.sends(&after, &outputs),
            sign: outputs.iter().filter_map(Sign::told).last(),
            telling: Telling::of(&outputs, |station| self.bit_of(station)),
            contact: ContactChange::of(&said, input, &outputs, &robot.ram()),
            is_ignored: outputs.ignored().is_some(),
            is_valid: robot.is_valid(&self.scenario.config),
            after: self.robots.nodes.number(after.renamed(&mut held)),
        };
        Some(self.steps.keep((node, cause), step))
    }

    pub(super) fn compute(&self, node: u32, cause: TimedCause) -> Option<(Node, Outputs)> {
        let input = self.robots.input(cause);
        self.robots.step(&self.scenario.config, node, input)
    }

    /// One bit for the place of the robot with this station id.
    fn bit_of(&self, station: StationId) -> u8 {
        let mut robots = self.scenario.robots.iter();
        let place = robots.position(|robot| robot.station == station);
        place.map_or(0, |place| 1 << place)
    }

    pub(super) fn canonicalize(&self, state: &mut TimedState) {
        let nodes = &mut state.nodes[..self.scenario.robots.len()];
        let messages = state.channel.flights();
        let messages = messages.map(|flight| flight.transmission.message);
        let sets = self.robots.name_sets(nodes, messages);
        let Some(renaming) = self.robots.renamings.of(sets) else {
            return;
        };
        self.robots.rename_nodes(nodes, renaming);
        let renamed = |message| self.robots.message_renamed(message, renaming);
        state.channel = state.channel.map(renamed);
    }
}
