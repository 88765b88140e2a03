//! The timed model: robots that are told how much time has passed.
//!
//! ```text
//!   at a tick                     between two ticks, in no time and any order
//!   ┌───────────────────────┐     ┌────────────────────────────────────────────┐
//!   │ every robot: Elapsed, │ ──► │ messages arrive, or not yet, or never      │ ──► next tick
//!   │ slow clock or fast    │     │ applications command, open; robots fail    │
//!   └───────────────────────┘     └────────────────────────────────────────────┘
//! ```
//!
//! A robot's part of a step is one call of [`Robot::step`](crossguard_protocol::Robot::step), as in
//! the untimed model. Timers are urgent because the transition function makes them so: what is due
//! fires when the robot is told of the time.

use std::sync::Arc;

use crossguard_protocol::{
    Config, Event, Input, Member, Millis, Output, Outputs, Phase, Renaming, Robot, Timer,
};
use dashmap::DashMap;
use rustc_hash::FxBuildHasher;
use smallvec::SmallVec;

use super::Timed;
use super::channel::{Channel, Flight};
use super::rules::{self, Broken};
use super::watch::{Longest, Measure, Watch};
use crate::canonical::{NameSets, Ranks, Renamable, Renamings};
use crate::intern::Interner;
use crate::network::{Message, Transmission, concerns};
use crate::node::{Node, Protocol, Rules};
use crate::scenario::{Bounds, MAX_ROBOTS, Scenario};

/// A global state between two ticks.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct State {
    nodes: [u32; MAX_ROBOTS],
    channel: Channel,
    left: Bounds,
    watch: Watch,
    /// What the step into this state broke.
    pub(super) broken: Broken,
}

impl State {
    pub(super) const fn watch(&self) -> Watch {
        self.watch
    }
}

/// One thing that can happen.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Action {
    /// A tick passes. One bit per robot: whether its clock is fast.
    Tick(u8),
    /// A message arrives.
    Deliver(Flight),
    /// A robot's application does something.
    Local(u8, Event),
    /// A robot crashes for good.
    Crash(u8),
}

/// What a robot takes in.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Cause {
    Elapsed(Millis),
    Message(u16),
    Event(Event),
}

/// What comes of a robot's step.
#[derive(Clone, Debug)]
struct Step {
    after: u32,
    sends: SmallVec<[u16; 2]>,
    is_ignored: bool,
    is_valid: bool,
}

/// The timed model of one scenario.
pub struct Model {
    scenario: Scenario,
    timed: Timed,
    rules: Box<dyn Rules>,
    nodes: Interner<Node>,
    messages: Interner<Message>,
    renamings: Arc<Renamings>,
    /// Each step of a robot is computed once.
    steps: DashMap<(u32, Cause), Step, FxBuildHasher>,
}

impl Model {
    /// The model of a timed scenario; `None` when the scenario says nothing of time.
    #[must_use]
    pub fn new(scenario: Scenario) -> Option<Self> {
        Self::with_rules(scenario, Protocol)
    }

    /// The model with another transition function in place of the kit's.
    #[must_use]
    pub fn with_rules(scenario: Scenario, rules: impl Rules + 'static) -> Option<Self> {
        let renamings = Arc::new(Renamings::new(Ranks::rank_keeping_distances));
        Some(Self {
            timed: scenario.timed.clone()?,
            scenario,
            rules: Box::new(rules),
            nodes: Interner::new(&renamings),
            messages: Interner::new(&renamings),
            renamings,
            steps: DashMap::default(),
        })
    }

    /// The scenario.
    #[must_use]
    pub const fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    pub(super) const fn timed(&self) -> &Timed {
        &self.timed
    }

    /// The state in which every run begins: all are idle, and one has just detected a pedestrian.
    #[must_use]
    pub fn initial(&self) -> State {
        let mut nodes = [0; MAX_ROBOTS];
        for (node, setup) in nodes.iter_mut().zip(&self.scenario.robots) {
            *node = self.nodes.number(Node::first_boot(setup.station));
        }
        let mut state = State {
            nodes,
            channel: Channel::EMPTY,
            left: self.scenario.bounds,
            watch: Watch::Request(0),
            broken: Broken::NOTHING,
        };
        let detected = Event::PedestrianDetected(self.scenario.request);
        self.robot_step(&mut state, self.timed.leader, Cause::Event(detected));
        self.canonicalize(&mut state);
        state
    }

    /// The robots of a state.
    pub(super) fn nodes<'a>(&'a self, state: &'a State) -> impl Iterator<Item = &'a Node> + Clone {
        let robots = self.scenario.robots.len();
        state.nodes[..robots]
            .iter()
            .map(|&number| self.nodes.value(number))
    }

    /// A robot of a state, by its place.
    pub(super) fn node(&self, state: &State, place: u8) -> &Node {
        self.nodes.value(state.nodes[usize::from(place)])
    }

    pub(super) fn message(&self, number: u16) -> &Message {
        self.messages.value(number.into())
    }

    /// Everything that may happen in `state`.
    pub fn actions_in(&self, state: &State, actions: &mut Vec<Action>) {
        if rules::is_over(self, state) {
            return;
        }
        if let Some(event) = self.leader_event(state) {
            actions.push(Action::Local(self.timed.leader, event));
            return;
        }
        let robots = self.scenario.robots.len();
        let corners = if self.timed.clock.drifts() {
            1 << robots
        } else {
            1
        };
        let must_arrive = |flight: Flight| flight.ticks == self.timed.delay_ticks;
        if self.scenario.channel.loss || !state.channel.flights().any(must_arrive) {
            actions.extend((0..corners).map(Action::Tick));
        }
        actions.extend(state.channel.flights().map(Action::Deliver));
        if state.watch == Watch::Off {
            self.failures(state, actions);
        }
    }

    /// What the application of the leader does at once: it commands a follower as soon as that has
    /// joined, and opens the corridor as soon as it may.
    fn leader_event(&self, state: &State) -> Option<Event> {
        let robot = self.node(state, self.timed.leader).robot.as_ref()?;
        let Phase::Leading(leading) = robot.phase() else {
            return None;
        };
        if state.left.commands > 0 {
            let free = |member: &&Member| {
                member.has_joined() && member.outstanding.is_none() && member.order.is_none()
            };
            if let (Some(member), Some(task)) = (
                leading.members.iter().find(free),
                self.scenario.request.tasks.iter().next(),
            ) {
                return Some(Event::CommandManeuver {
                    follower: member.station,
                    task,
                });
            }
        }
        let may_open = self.scenario.corridor
            && !leading.corridor_open
            && leading.corridor_obstacle(&self.scenario.config).is_none();
        may_open.then_some(Event::OpenCorridor)
    }

    /// One robot fails: the leader crashes, or a follower crashes or fails its maneuver while it
    /// executes.
    fn failures(&self, state: &State, actions: &mut Vec<Action>) {
        for (i, node) in (0..).zip(self.nodes(state)) {
            let (leads, running) = (i == self.timed.leader, node.actuation.running);
            if state.left.crashes > 0 && node.robot.is_some() && (leads || running.is_some()) {
                actions.push(Action::Crash(i));
            }
            if state.left.disturbances > 0
                && let Some(maneuver) = running
            {
                actions.push(Action::Local(i, Event::ManeuverFailed(maneuver)));
            }
        }
    }

    /// What comes of `action` in `state`; `None` if the action changes nothing. The stop-watches
    /// that it stops are noted in `longest`.
    pub(super) fn successor(
        &self,
        state: &State,
        action: Action,
        longest: &mut Longest,
    ) -> Option<State> {
        let mut next = state.clone();
        next.broken = Broken::NOTHING;
        match action {
            Action::Tick(fast) => self.tick(&mut next, fast),
            Action::Deliver(flight) => {
                next.channel.take(flight);
                let Transmission { to, message, .. } = flight.transmission;
                let is_ignored = self.robot_step(&mut next, to, Cause::Message(message));
                if is_ignored && self.scenario.channel.loss {
                    // It might as well never have arrived.
                    return None;
                }
            }
            Action::Local(i, event) => {
                spend(&mut next, event);
                if self.robot_step(&mut next, i, Cause::Event(event)) {
                    return None;
                }
            }
            Action::Crash(i) => {
                next.left.crashes -= 1;
                next.watch = if i == self.timed.leader {
                    Watch::LeaderDown(0)
                } else {
                    Watch::FollowerFailed(0)
                };
                next.nodes[usize::from(i)] = self.nodes.number(self.node(state, i).crashed());
                next.channel.forget_receiver(i);
            }
        }
        self.measure(state, &mut next, longest);
        next.broken.add(rules::broken(self, state, &next));
        self.canonicalize(&mut next);
        Some(next)
    }

    /// A tick passes: messages grow older, every robot is told of the time by its own clock.
    fn tick(&self, next: &mut State, fast: u8) {
        next.watch.tick();
        next.channel.tick(self.timed.delay_ticks);
        for i in (0..).take(self.scenario.robots.len()) {
            let elapsed = self.timed.clock.elapsed(fast, i);
            self.robot_step(next, i, Cause::Elapsed(elapsed));
        }
    }

    /// Stops the stop-watches.
    fn measure(&self, before: &State, next: &mut State, longest: &mut Longest) {
        let robots = || self.nodes(before).zip(self.nodes(next));
        match next.watch {
            Watch::Off => {}
            Watch::Request(ticks) => {
                if !rules::is_requesting(self.node(next, self.timed.leader)) {
                    longest.note(Measure::Roles, ticks);
                    next.watch = Watch::Off;
                }
            }
            Watch::LeaderDown(ticks) => {
                if robots()
                    .any(|(b, n)| b.actuation.running.is_some() && n.actuation.running.is_none())
                {
                    longest.note(Measure::Stopped, ticks);
                }
                if robots().any(|(b, n)| rules::is_following(b) && !rules::is_following(n)) {
                    longest.note(Measure::Left, ticks);
                }
            }
            Watch::FollowerFailed(ticks) => {
                if robots().any(|(b, n)| b.actuation.corridor_open && !n.actuation.corridor_open) {
                    longest.note(Measure::CorridorClosed, ticks);
                }
            }
        }
    }

    /// Lets a robot take a step; whether that changed nothing.
    fn robot_step(&self, next: &mut State, i: u8, cause: Cause) -> bool {
        let Some(step) = self.step(next.nodes[usize::from(i)], cause) else {
            return true;
        };
        next.nodes[usize::from(i)] = step.after;
        if !step.is_valid {
            next.broken.add(Broken::INVALID);
        }
        for &message in &step.sends {
            for to in (0..).take(self.scenario.robots.len()).filter(|&to| to != i) {
                let receiver = self.node(next, to);
                if receiver.robot.is_some()
                    && concerns(self.message(message), receiver.persisted.station)
                {
                    next.channel.send(Transmission {
                        from: i,
                        to,
                        message,
                    });
                }
            }
        }
        step.is_ignored
    }

    fn step(&self, node: u32, cause: Cause) -> Option<Step> {
        if let Some(known) = self.steps.get(&(node, cause)) {
            return Some(known.clone());
        }
        let (after, outputs) = self.compute(node, cause)?;
        let robot = after.robot.as_ref()?;
        let sends = outputs.iter().filter_map(|output| match *output {
            Output::SendRam => Some(Message::Ram(robot.ram())),
            Output::SendRmcm(rmcm) => Some(Message::Rmcm(rmcm)),
            _ => None,
        });
        let mut held = Held {
            config: &self.scenario.config,
            robot,
        };
        let step = Step {
            sends: sends.map(|message| self.message_number(message)).collect(),
            is_ignored: outputs.ignored().is_some(),
            is_valid: robot.is_valid(&self.scenario.config),
            after: self.nodes.number(after.renamed(&mut held)),
        };
        self.steps.insert((node, cause), step.clone());
        Some(step)
    }

    fn compute(&self, node: u32, cause: Cause) -> Option<(Node, Outputs)> {
        let input = match cause {
            Cause::Elapsed(elapsed) => Input::Elapsed(elapsed),
            Cause::Message(number) => self.message(number).input(),
            Cause::Event(event) => Input::Local(event),
        };
        self.nodes
            .value(node)
            .step(&*self.rules, &self.scenario.config, input)
    }

    /// The number of a message.
    ///
    /// # Panics
    /// When there are more than 65,536 distinct messages.
    fn message_number(&self, message: Message) -> u16 {
        let number = self.messages.number(message);
        u16::try_from(number).expect("fewer than 65,536 distinct messages")
    }

    /// What each robot puts out when `action` happens in `state`, for a chart.
    pub(super) fn outputs(&self, state: &State, action: Action) -> Vec<(u8, Outputs)> {
        let all = (0..).take(self.scenario.robots.len());
        let causes: Vec<(u8, Cause)> = match action {
            Action::Tick(fast) => all
                .map(|i| (i, Cause::Elapsed(self.timed.clock.elapsed(fast, i))))
                .collect(),
            Action::Deliver(flight) => {
                vec![(
                    flight.transmission.to,
                    Cause::Message(flight.transmission.message),
                )]
            }
            Action::Local(i, event) => vec![(i, Cause::Event(event))],
            Action::Crash(i) => return vec![(i, Outputs::default())],
        };
        let outputs = |(i, cause)| Some((i, self.compute(state.nodes[usize::from(i)], cause)?.1));
        causes.into_iter().filter_map(outputs).collect()
    }

    fn canonicalize(&self, state: &mut State) {
        let robots = self.scenario.robots.len();
        let mut sets = NameSets::default();
        for &node in &state.nodes[..robots] {
            sets.add(self.nodes.names(node));
        }
        for flight in state.channel.flights() {
            sets.add(self.messages.names(flight.transmission.message.into()));
        }
        let Some(renaming) = self.renamings.of(sets) else {
            return;
        };
        for node in &mut state.nodes[..robots] {
            *node = self.nodes.renamed(*node, renaming);
        }
        state.channel = state.channel.map(|message| {
            let renamed = self.messages.renamed(message.into(), renaming);
            u16::try_from(renamed).expect("fewer than 65,536 distinct messages")
        });
    }
}

/// Takes an event off what may still happen, and starts the stop-watch of a failure.
fn spend(next: &mut State, event: Event) {
    match event {
        Event::CommandManeuver { .. } => next.left.commands -= 1,
        Event::ManeuverFailed(_) => {
            next.left.disturbances -= 1;
            next.watch = Watch::FollowerFailed(0);
        }
        _ => {}
    }
}

/// The two timers that are longer than anything that is measured are held at the time that they are
/// started with: a run ends before they do.
struct Held<'a> {
    config: &'a Config,
    robot: &'a Robot,
}

impl Renaming for Held<'_> {
    fn countdown(&mut self, timer: Timer, left: Millis) -> Millis {
        match (timer, self.robot.phase()) {
            (Timer::IdentityLock, _) => self.config.t_lock_session(),
            (Timer::Execution(station), Phase::Leading(leading)) => {
                let order = leading.member(station).and_then(|member| member.order);
                order.map_or(left, |order| self.config.t_exec(order.task))
            }
            _ => left,
        }
    }
}
