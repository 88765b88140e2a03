//! The model: robots that run the transition function, joined by a radio channel.
//!
//! Untimed: any armed timer may expire at any moment, so what holds here holds for all timer
//! settings. Nothing of the protocol is written here a second time; a robot's part of a step is one
//! call of [`Robot::step`](crossguard_protocol::Robot::step).

mod canonical;
mod world;

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use crossguard_protocol::{
    Availability, Event, Input, Member, Outputs, Phase, Robot, StationId, Timer, Unavailability,
};
use smallvec::SmallVec;

use crate::canonical::{Ranks, Renamings};
use crate::check::Stop;
use crate::history::History;
use crate::intern::Interner;
use crate::network::{Message, Network, Transmission, concerns};
use crate::node::{Node, Protocol, Rules};
use crate::properties::{PropertyId, StepView};
use crate::scenario::{Bounds, MAX_ROBOTS, PSEUDONYM_STEP, Scenario};
use crate::steps::{Cause, Step, Steps, judge_historic};
use crate::symmetry::Symmetry;
use crate::transitions::Transitions;

/// A global state: numbers of interned parts, and what may still happen.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct State {
    nodes: [u32; MAX_ROBOTS],
    history: u32,
    /// One bit per step property that the step into this state broke.
    broken: u32,
    left: Bounds,
    network: u32,
}

/// A state that is being made up, its network not interned yet.
struct Draft {
    state: State,
    network: Network,
}

impl State {
    /// How often what may still happen.
    #[must_use]
    pub const fn left(&self) -> Bounds {
        self.left
    }

    /// Whether the step into this state broke a step property. What might come after it is not
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
}

/// The model of one scenario. Clones share what has been found out. Somebody may ask to give up.
#[derive(Clone)]
pub struct Model(Arc<Shared>, Stop);

struct Shared {
    scenario: Scenario,
    symmetry: Symmetry,
    steps: Steps,
    histories: Interner<History>,
    networks: Interner<Network>,
    renamings: Arc<Renamings>,
    /// One bit per property whose premise has been met.
    premises_met: AtomicU32,
}

/// A step of one robot.
#[derive(Clone, Copy)]
pub struct RobotStep<'a> {
    /// Its place in the scenario.
    pub robot: usize,
    step: &'a Step,
}

impl RobotStep<'_> {
    /// What the robot took in.
    #[must_use]
    pub const fn input(&self) -> Input {
        self.step.input
    }

    /// What the robot put out.
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
            scenario,
            steps: Steps::new(Box::new(rules), &renamings),
            histories: Interner::new(&renamings),
            networks: Interner::new(&renamings),
            renamings,
            premises_met: AtomicU32::new(0),
        };
        Self(Arc::new(shared), Stop::default())
    }

    /// The same model, in which nothing happens any more once `stop` is requested.
    pub(crate) fn stopping_at(self, stop: &Stop) -> Self {
        Self(self.0, stop.clone())
    }

    /// Whether somebody asked to give up.
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
    pub fn initial(&self) -> State {
        let mut nodes = [0; MAX_ROBOTS];
        for (node, setup) in nodes.iter_mut().zip(&self.0.scenario.robots) {
            *node = self.0.steps.nodes.number(Node::first_boot(setup.station));
        }
        State {
            nodes,
            history: self.0.histories.number(History::default()),
            broken: 0,
            left: self.0.scenario.bounds,
            network: self.0.networks.number_nameless(Network::EMPTY),
        }
    }

    fn network(&self, state: &State) -> &Network {
        self.0.networks.value(state.network)
    }

    /// The robots of a state.
    pub fn nodes<'a>(&'a self, state: &'a State) -> impl Iterator<Item = &'a Node> + Clone {
        let robots = self.0.scenario.robots.len();
        state.nodes[..robots]
            .iter()
            .map(|&number| self.0.steps.nodes.value(number))
    }

    /// The history of a state.
    #[must_use]
    pub fn history(&self, state: &State) -> &History {
        self.0.histories.value(state.history)
    }

    /// An interned message.
    #[must_use]
    pub fn message(&self, number: u16) -> &Message {
        self.0.steps.messages.value(number.into())
    }

    /// Whether the step into this state broke a step property.
    #[must_use]
    pub fn breaks(state: &State, property: PropertyId) -> bool {
        state.broken & property.bit() != 0
    }

    /// Whether a state keeps a property; true where the property is one of steps.
    #[must_use]
    pub fn state_rule_holds(&self, state: &State, property: PropertyId) -> bool {
        let Some(rule) = property.state_rule() else {
            return true;
        };
        self.look(state, |view| {
            if !self.premise_met(property) && (rule.premise)(view) {
                self.note_premises(property.bit());
            }
            (rule.holds)(view)
        })
    }

    /// Whether some message or timer changes the state, without any application's help.
    #[must_use]
    pub fn can_progress(&self, state: &State) -> bool {
        let Shared {
            scenario, steps, ..
        } = &*self.0;
        let effective = |i: usize, cause| {
            let step = steps.step(
                &scenario.config,
                &scenario.properties,
                state.nodes[i],
                cause,
            );
            step.is_some_and(|step| step.after != state.nodes[i] || !step.sends.is_empty())
        };
        let by_timer = self.nodes(state).enumerate().any(|(i, node)| {
            node.robot.as_ref().is_some_and(|robot| {
                robot
                    .timers()
                    .iter()
                    .any(|(timer, _)| effective(i, Cause::Timer(*timer)))
            })
        });
        by_timer
            || self
                .next_on_air(state)
                .into_iter()
                .chain(self.network(state).delayed())
                .any(|t| effective(t.to.into(), Cause::Message(t.message)))
    }

    /// The messages on air of which any may be the next whose fate is decided.
    fn next_on_air(&self, state: &State) -> SmallVec<[Transmission; MAX_ROBOTS]> {
        let network = self.network(state);
        if self.0.symmetry.is_trivial() {
            network.next_on_air().into_iter().collect()
        } else {
            network.first_broadcast().collect()
        }
    }

    /// Whether the premise of a property has been met so far.
    #[must_use]
    pub fn premise_met(&self, property: PropertyId) -> bool {
        self.0.premises_met.load(Ordering::Relaxed) & property.bit() != 0
    }

    /// Everything that may happen in `state`. An application's event may turn out to be ignored.
    pub fn actions_in(&self, state: &State, actions: &mut Vec<Action>) {
        if state.broken != 0 {
            return;
        }
        let on_air = self.next_on_air(state);
        if on_air.is_empty() {
            self.actions_off_air(state, actions);
        }
        for transmission in on_air {
            self.fates(state, transmission, actions);
        }
    }

    /// Whether the fate of some message is to be decided before anything else.
    pub(crate) fn is_on_air(&self, state: &State) -> bool {
        self.network(state).next_on_air().is_some()
    }

    /// Everything that may happen in `state` once nothing is on air any more.
    pub(crate) fn actions_off_air(&self, state: &State, actions: &mut Vec<Action>) {
        for transmission in self.network(state).delayed() {
            for how in [Delivery::Late, Delivery::LateAndAgain] {
                actions.push(Action::Deliver { transmission, how });
            }
            if state.left.losses != Some(0) {
                actions.push(Action::Lose(transmission));
            }
        }
        for (i, node) in (0..).zip(self.nodes(state)) {
            match &node.robot {
                Some(robot) => {
                    for (timer, _) in robot.timers().iter() {
                        if !self.0.scenario.cooperative || !guards_against_silence(*timer) {
                            actions.push(Action::Expire(i, *timer));
                        }
                    }
                    self.local_events(state, i, robot, actions);
                    if state.left.crashes > 0 {
                        actions.push(Action::Crash(i));
                    }
                }
                None if state.left.restarts > 0 => actions.push(Action::Restart(i)),
                None => {}
            }
        }
    }

    /// What may become of a message on air.
    fn fates(&self, state: &State, transmission: Transmission, actions: &mut Vec<Action>) {
        let channel = self.0.scenario.channel;
        actions.push(Action::Deliver {
            transmission,
            how: Delivery::AtOnce,
        });
        let is_rmcm = matches!(self.message(transmission.message), Message::Rmcm(_));
        if self.0.scenario.cooperative && is_rmcm {
            return;
        }
        if channel.loss && state.left.losses != Some(0) {
            actions.push(Action::Lose(transmission));
        }
        if self
            .network(state)
            .can_delay(transmission, usize::from(channel.delayed))
        {
            actions.push(Action::Delay(transmission));
        }
    }

    /// Every event that the application of a robot could come up with.
    fn local_events(&self, state: &State, i: u8, robot: &Robot, actions: &mut Vec<Action>) {
        let mut push = |event| actions.push(Action::Local(i, event));
        let (scenario, left) = (&self.0.scenario, &state.left);
        if left.detections > 0 && scenario.robots[usize::from(i)].detects {
            push(Event::PedestrianDetected(scenario.request));
        }
        if left.disturbances > 0 {
            let reason = Unavailability::LocalFault;
            push(Event::AvailabilityChanged(Availability::Unavailable(
                reason,
            )));
        }
        if robot.availability() != Availability::Available {
            push(Event::AvailabilityChanged(Availability::Available));
        }
        if left.disturbances > 0 {
            push(Event::IdentityChanged(StationId(
                robot.station().0 + PSEUDONYM_STEP,
            )));
        }
        match robot.phase() {
            Phase::Idle => {}
            Phase::Leading(leading) => {
                if left.disturbances > 0 {
                    push(Event::LeaveRequested);
                }
                let is_completed = leading.members.iter().any(Member::has_completed);
                if is_completed || !scenario.cooperative {
                    push(Event::TaskCompleted);
                }
                if left.commands > 0 {
                    for member in leading.members.iter() {
                        for task in scenario.request.tasks.iter() {
                            push(Event::CommandManeuver {
                                follower: member.station,
                                task,
                            });
                        }
                    }
                }
                if scenario.corridor {
                    push(Event::OpenCorridor);
                    push(Event::CloseCorridor);
                }
            }
            Phase::Requesting(_) | Phase::Offering(_) | Phase::Following(_) => {
                if let Phase::Following(following) = robot.phase()
                    && let Some(maneuver) = following.executing()
                {
                    push(Event::ManeuverCompleted(maneuver.id));
                    if left.disturbances > 0 {
                        push(Event::ManeuverFailed(maneuver.id));
                    }
                }
                if matches!(robot.phase(), Phase::Requesting(_)) && !scenario.cooperative {
                    push(Event::TaskCompleted);
                }
                if left.disturbances > 0 {
                    push(Event::LeaveRequested);
                }
            }
        }
    }

    /// What comes of `action` in `state`, with the robot's step if one takes a step; `None` if the
    /// action changes nothing.
    #[must_use]
    pub fn successor(
        &self,
        state: &State,
        action: Action,
    ) -> Option<(State, Option<RobotStep<'_>>)> {
        let (next, step) = self.take(state, action)?;
        Some((self.interned(next), step))
    }

    /// The same, with the state that stands for all those that differ from the successor in which of the
    /// symmetric robots is which.
    #[must_use]
    pub fn successor_up_to_symmetry(
        &self,
        state: &State,
        action: Action,
    ) -> Option<(State, Option<RobotStep<'_>>)> {
        let (next, step) = self.take(state, action)?;
        Some((self.interned(self.representative_of(next)), step))
    }

    fn take(&self, state: &State, action: Action) -> Option<(Draft, Option<RobotStep<'_>>)> {
        let mut next = Draft {
            state: state.clone(),
            network: *self.network(state),
        };
        let step = match action {
            Action::Deliver { transmission, how } => {
                match how {
                    Delivery::AtOnce => next.network.take_off_air(transmission),
                    Delivery::Late => next.network.forget(transmission),
                    Delivery::LateAndAgain => {}
                }
                let cause = Cause::Message(transmission.message);
                let step = self.robot_step(&mut next, transmission.to.into(), cause)?;
                if how == Delivery::LateAndAgain && step.step.is_ignored {
                    return None;
                }
                Some(step)
            }
            Action::Lose(transmission) => {
                if let Some(left) = &mut next.state.left.losses {
                    *left -= 1;
                }
                if next.network.next_on_air().is_some() {
                    next.network.take_off_air(transmission);
                } else {
                    next.network.forget(transmission);
                }
                None
            }
            Action::Delay(transmission) => {
                next.network.take_off_air(transmission);
                next.network.delay(transmission);
                None
            }
            Action::Expire(i, timer) => {
                Some(self.robot_step(&mut next, i.into(), Cause::Timer(timer))?)
            }
            Action::Local(i, event) => {
                next.state.left.spend(event);
                let step = self.robot_step(&mut next, i.into(), Cause::Event(event))?;
                if step.step.is_ignored {
                    return None;
                }
                Some(step)
            }
            Action::Crash(i) => {
                next.state.left.crashes -= 1;
                self.crash(&mut next.state, i.into());
                None
            }
            Action::Restart(i) => {
                next.state.left.restarts -= 1;
                let node = self
                    .0
                    .steps
                    .nodes
                    .value(next.state.nodes[usize::from(i)])
                    .restarted();
                next.state.nodes[usize::from(i)] = self.0.steps.nodes.number(node);
                None
            }
        };
        Some((self.ranked(next), step))
    }

    fn crash(&self, next: &mut State, i: usize) {
        let node = self.0.steps.nodes.value(next.nodes[i]);
        if let Some(robot) = &node.robot {
            let mut history = self.history(next).clone();
            history.record_crash(robot);
            next.history = self.0.histories.number(history);
        }
        next.nodes[i] = self.0.steps.nodes.number(node.crashed());
    }

    fn robot_step(&self, next: &mut Draft, i: usize, cause: Cause) -> Option<RobotStep<'_>> {
        let Shared {
            scenario, steps, ..
        } = &*self.0;
        let before = next.state.nodes[i];
        let step = steps.step(&scenario.config, &scenario.properties, before, cause)?;
        let (mut premises, mut broken) = (step.premises, step.broken);
        if step.is_historic {
            let view = StepView {
                config: &scenario.config,
                history: self.0.histories.value(next.state.history),
                before: steps.nodes.value(before),
                after: steps.nodes.value(step.after),
                input: step.input,
                outputs: &step.outputs,
            };
            let historic = judge_historic(&scenario.properties, &view);
            premises |= historic.0;
            broken |= historic.1;
            next.state.history = self.0.histories.number(view.history_after());
        }
        next.state.broken |= broken;
        if !step.taken.load(Ordering::Relaxed) {
            step.taken.store(true, Ordering::Relaxed);
        }
        self.note_premises(premises);
        self.transmit(next, i, step);
        next.state.nodes[i] = step.after;
        Some(RobotStep { robot: i, step })
    }

    /// The transitions of the state diagram that robots have taken so far.
    #[must_use]
    pub fn transitions_taken(&self) -> Transitions {
        let mut taken = Transitions::default();
        for (before, step) in self.0.steps.taken() {
            let after = self.0.steps.nodes.value(step.after);
            taken.note(before, step.input, after);
        }
        taken
    }

    /// Notes that the premise of a property has been met.
    pub(crate) fn note_premise(&self, property: PropertyId) {
        self.note_premises(property.bit());
    }

    fn note_premises(&self, met: u32) {
        if met & !self.0.premises_met.load(Ordering::Relaxed) != 0 {
            self.0.premises_met.fetch_or(met, Ordering::Relaxed);
        }
    }

    fn transmit(&self, next: &mut Draft, from: usize, step: &Step) {
        for &number in &step.sends {
            let message = self.message(number);
            for to in (0..self.0.scenario.robots.len()).filter(|&to| to != from) {
                let receiver = self.0.steps.nodes.value(next.state.nodes[to]);
                if receiver.robot.is_some() && concerns(message, receiver.persisted.station) {
                    let place = |i: usize| u8::try_from(i).expect("at most MAX_ROBOTS");
                    let (from, to) = (place(from), place(to));
                    next.network.send(Transmission {
                        from,
                        to,
                        message: number,
                    });
                }
            }
        }
    }
}

/// Whether a timer does not run out when what is sent arrives and everybody does their part. The
/// others pace the robot's own work.
const fn guards_against_silence(timer: Timer) -> bool {
    !matches!(timer, Timer::Ram | Timer::Selection | Timer::Farewell)
}
