//! The model: robots that run the transition function, joined by a radio channel.
//!
//! Untimed: any armed timer may expire at any moment, so what holds here holds for all timer
//! settings. Nothing of the protocol is written here a second time; a robot's part of a step is one
//! call of [`Robot::step`](crossguard_protocol::Robot::step).

mod actions;
mod canonical;
mod forget;
mod lies;
mod parts;
mod reachable;
mod successor;
mod system;
mod world;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crossguard_protocol::{Event, Input, Outputs, Timer};
use serde::{Deserialize, Serialize};

pub(crate) use self::parts::Backdrop;
pub use self::reachable::Reachable;
use crate::canonical::{GivenOut, Ranks, Renamings};
use crate::exploration::Stop;
use crate::history::History;
use crate::intern::Interner;
use crate::memo::Memo;
use crate::monotone::Sets;
use crate::names::Names;
use crate::network::{Message, Network, PackedNetwork, Transmission};
use crate::node::{Node, Protocol, Rules};
use crate::properties::{PropertyId, StateRule, View};
use crate::robots::Robots;
use crate::scenario::{Bounds, MAX_ROBOTS, Scenario};
use crate::steps::{Cause, ComputedStep, Steps};
use crate::symmetry::Symmetry;

/// A global state: numbers of interned parts, and what may still happen. It means something to the model that made it
/// alone, also where it was written down.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub struct ModelState {
    nodes: [u32; MAX_ROBOTS],
    history: u32,
    /// One bit per step property that the step into this state broke.
    broken: u64,
    left: Bounds,
    /// One bit per robot that hangs.
    hung: u8,
    network: u32,
}

/// A state that is being made up, its network not interned yet.
struct Draft {
    state: ModelState,
    network: Network,
}

impl ModelState {
    /// How often what may still happen.
    #[must_use]
    pub const fn left(&self) -> Bounds {
        self.left
    }

    /// Whether the robot at this place hangs.
    #[must_use]
    pub const fn hangs(&self, place: usize) -> bool {
        self.hung & 1 << place != 0
    }

    /// Whether the step into this state broke a step property. States behind it are not
    /// explored.
    #[must_use]
    pub const fn is_broken(&self) -> bool {
        self.broken != 0
    }
}

/// One thing that can happen.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Action {
    /// A message arrives.
    Deliver {
        /// The message and its way.
        transmission: Transmission,
        /// When, and whether it stays on its way.
        how: Delivery,
    },
    /// A message gets lost on its way to one receiver.
    Lose(Transmission),
    /// A message is delayed.
    Delay(Transmission),
    /// A timer expires.
    Expire(u8, Timer),
    /// A robot's application does something.
    Local(u8, Event),
    /// A robot loses its volatile state.
    Crash(u8),
    /// A robot boots again.
    Restart(u8),
    /// The pedestrian steps on the road, because the sign of this robot shows go.
    StepOnRoad(u8),
    /// The pedestrian who stepped on the road at this robot's sign is off it.
    Across(u8),
    /// A robot stops: it hears nothing, no timer expires, its application does nothing. Its state stays,
    /// and its body goes on with what it was last told.
    Hang(u8),
    /// A robot that hangs goes on.
    Resume(u8),
    /// An insider says something in its own name that one robot hears.
    Lie(Transmission),
}

/// How a message arrives.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Delivery {
    /// At once.
    AtOnce,
    /// Late.
    Late,
    /// Late, and it will arrive once more or get lost.
    LateAndAgain,
    /// At any time after it was sent, and it may arrive again: the channel is monotone.
    AnyTime,
}

/// The model of one scenario. Clones share their results. An observer may ask to give up.
#[derive(Clone)]
pub struct Model(Arc<Shared>, Stop);

struct Shared {
    names: Names,
    scenario: Scenario,
    symmetry: Symmetry,
    steps: Steps,
    histories: Interner<History>,
    networks: Interner<PackedNetwork>,
    /// Sets of messages on a monotone channel.
    sets: Sets,
    /// The messages of an insider that change something in a robot, by insider, robot and the numbers that the insider has
    /// given out.
    lies: Memo<(u8, u32, GivenOut), Box<[u16]>>,
    /// One bit per property whose premise has been met.
    premises_met: AtomicU64,
}

/// A step of one robot.
#[derive(Clone, Copy)]
pub struct RobotStep<'a> {
    /// Its place in the scenario.
    pub robot: usize,
    step: &'a ComputedStep,
}

impl RobotStep<'_> {
    /// The robot's input.
    #[must_use]
    pub const fn input(&self) -> Input {
        self.step.input
    }

    /// The robot's outputs.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.step.outputs
    }

    /// The timers that the step armed, whether or not they had been armed before.
    pub(crate) fn restarted(&self) -> impl Iterator<Item = Timer> {
        self.step.restarted.iter().copied()
    }
}

impl Model {
    /// The model of `scenario`.
    #[must_use]
    pub fn new(scenario: Scenario) -> Self {
        Self::with_rules(scenario, Protocol)
    }

    /// The model of `scenario` with another transition function in place of the kit's.
    #[must_use]
    pub fn with_rules(scenario: Scenario, rules: impl Rules + 'static) -> Self {
        let renamings = Arc::new(Renamings::new(Ranks::rank));
        let shared = Shared {
            symmetry: Symmetry::of(&scenario),
            names: Names::of(&scenario),
            scenario,
            steps: Steps::new(Box::new(rules), &renamings),
            histories: Interner::new(&renamings),
            networks: Interner::new(&renamings),
            sets: Sets::new(&renamings),
            lies: Memo::default(),
            premises_met: AtomicU64::new(0),
        };
        Self(Arc::new(shared), Stop::default())
    }

    /// The names of its robots.
    pub(crate) fn names(&self) -> &Names {
        &self.0.names
    }

    /// The same model, in which nothing happens any more once `stop` is requested.
    pub(crate) fn stopping_at(self, stop: &Stop) -> Self {
        Self(self.0, stop.clone())
    }

    /// Whether an observer asked to give up.
    pub(crate) fn has_to_stop(&self) -> bool {
        self.1.is_requested()
    }

    /// The scenario.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.0.scenario
    }

    /// The state in which every run begins: all robots idle, nothing in flight.
    #[must_use]
    pub fn initial(&self) -> ModelState {
        let mut nodes = [0; MAX_ROBOTS];
        for (node, setup) in nodes.iter_mut().zip(&self.0.scenario.robots) {
            let first = match setup.lies {
                Some(_) => Node::down(setup.station),
                None => Node::first_boot(setup.station),
            };
            *node = self.robots().nodes.number(first);
        }
        ModelState {
            nodes,
            history: self.0.histories.number(History::default()),
            broken: 0,
            left: self.0.scenario.bounds,
            hung: 0,
            network: self.number_of(&Network::EMPTY),
        }
    }

    fn robots(&self) -> &Robots {
        &self.0.steps.robots
    }

    /// The robot with a number.
    fn node(&self, number: u32) -> &Node {
        self.robots().nodes.value(number)
    }

    /// The step that a robot takes; `None` where it is down.
    fn step(&self, node: u32, cause: Cause) -> Option<&ComputedStep> {
        self.0.steps.step(self.scenario(), node, cause)
    }

    fn network(&self, state: &ModelState) -> Network {
        self.0.networks.value(state.network).unpacked()
    }

    fn number_of(&self, network: &Network) -> u32 {
        self.0.networks.number_nameless(PackedNetwork::of(network))
    }

    /// The robots of a state.
    pub fn nodes<'a>(&'a self, state: &'a ModelState) -> impl Iterator<Item = &'a Node> + Clone {
        let nodes = state.nodes[..self.0.scenario.robots.len()].iter();
        nodes.map(|&number| self.node(number))
    }

    /// The history of a state.
    #[must_use]
    pub fn history(&self, state: &ModelState) -> &History {
        self.0.histories.value(state.history)
    }

    /// An interned message.
    #[must_use]
    pub fn message(&self, number: u16) -> &Message {
        self.robots().message(number)
    }

    /// The properties of states or steps that a state breaks. Notes the premises that it meets.
    pub fn broken_by(&self, state: &ModelState) -> impl Iterator<Item = PropertyId> {
        let broken = self.broken_in(state);
        let properties = self.scenario().properties.iter().copied();
        properties.filter(move |id| broken & id.bit() != 0)
    }

    /// Whether a state keeps a property of states or steps. Notes the premise where the state meets it.
    pub(crate) fn keeps(&self, state: &ModelState, property: PropertyId) -> bool {
        let keeps_rule = |rule| self.look(state, |view| self.judge(property, rule, view));
        state.broken & property.bit() == 0 && property.state_rule().is_none_or(keeps_rule)
    }

    /// The broken properties of states or steps, as a bit for each. Notes the premises that the state meets.
    pub(crate) fn broken_in(&self, state: &ModelState) -> u64 {
        let rules = self.scenario().properties.iter();
        let rules = rules.filter_map(|&id| Some((id, id.state_rule()?)));
        self.look(state, |view| {
            let mut broken = state.broken;
            for (property, rule) in rules {
                if !self.judge(property, rule, view) {
                    broken |= property.bit();
                }
            }
            broken
        })
    }

    /// Whether a rule holds in a state. Notes its premise where the state meets it.
    fn judge(&self, property: PropertyId, rule: StateRule, view: &View) -> bool {
        if !self.premise_met(property) && (rule.premise)(view) {
            self.note_premises(property.bit());
        }
        (rule.holds)(view)
    }

    /// Whether the premise of a property has been met so far.
    #[must_use]
    pub fn premise_met(&self, property: PropertyId) -> bool {
        self.0.premises_met.load(Ordering::Relaxed) & property.bit() != 0
    }

    /// The properties whose premises have been met since this was asked last.
    pub(crate) fn newly_met(&self) -> Vec<PropertyId> {
        let met = self.0.premises_met.swap(0, Ordering::Relaxed);
        let properties = self.0.scenario.properties.iter().copied();
        properties.filter(|id| met & id.bit() != 0).collect()
    }

    /// The messages on air, and the ones that are delayed.
    pub(crate) fn on_their_way(
        &self,
        state: &ModelState,
    ) -> (Vec<Transmission>, Vec<Transmission>) {
        let network = self.network(state);
        (network.on_air().collect(), network.delayed().collect())
    }

    /// Notes that the premises of properties have been met, one bit each.
    pub(crate) fn note_premises(&self, met: u64) {
        if met & !self.0.premises_met.load(Ordering::Relaxed) != 0 {
            self.0.premises_met.fetch_or(met, Ordering::Relaxed);
        }
    }
}
