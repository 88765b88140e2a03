//! A scenario in stateright's own `ActorModel`: robots as actors around the transition function.
//!
//! What an application may do is a timer of its actor. The nearest of stateright's networks is the
//! unordered one that loses messages: it has no radio on which a message arrives at once or never, so
//! every message may wait, and at most [`IN_FLIGHT_MAX`] do.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};
use std::sync::Arc;
use std::time::Duration;

use crossguard_model_check::network::Message;
use crossguard_model_check::node::{Node, Protocol};
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::{
    Coordination, Event, Farewell, Heartbeat, Input, Output, Phase, Ram, Rmcm, Robot, StationId,
    Timer,
};
use rustc_hash::FxHasher;
use stateright::actor::{
    Actor, ActorModel, ActorModelState, Id, LossyNetwork, Network, Out, model_timeout,
};
use stateright::{Checker, Expectation, Model as _};

/// Messages that may be under way at a time: what one step of the trio's leader sends.
const IN_FLIGHT_MAX: usize = 2;

/// The newest heartbeat.
const HEARTBEAT_MAX: u16 = 3;

/// A robot of the scenario.
struct RobotActor {
    scenario: Arc<Scenario>,
    place: usize,
}

/// Its state, and what its application may still do.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct RobotState {
    node: Node,
    detections: u8,
    commands: u8,
}

/// stateright sorts messages and timers; these are sorted by fingerprint.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct Sorted<T>(T);

impl<T: Hash> Sorted<T> {
    fn fingerprint(&self) -> u64 {
        let mut hasher = FxHasher::default();
        self.0.hash(&mut hasher);
        hasher.finish()
    }
}

impl<T: Hash + Eq> Ord for Sorted<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.fingerprint().cmp(&other.fingerprint())
    }
}

impl<T: Hash + Eq> PartialOrd for Sorted<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What happens to a robot without a message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Happening {
    Expired(Timer),
    Local(Event),
}

impl RobotActor {
    fn step(&self, state: &mut Cow<RobotState>, input: Input, out: &mut Out<Self>) {
        let before = happenings(&self.scenario, self.place, state);
        let stepped = state.node.step(&Protocol, &self.scenario.config, input);
        let Some((after, outputs)) = stepped else {
            return;
        };
        if outputs.ignored().is_none() {
            let state = state.to_mut();
            state.node = after.untimed();
            match input {
                Input::Local(Event::PedestrianDetected(_)) => state.detections -= 1,
                Input::Local(Event::CommandManeuver { .. }) => state.commands -= 1,
                _ => {}
            }
            for output in outputs.iter() {
                self.send(&after, output, out);
            }
        }
        let after = happenings(&self.scenario, self.place, state);
        for gone in before.iter().filter(|happening| !after.contains(happening)) {
            out.cancel_timer(Sorted(*gone));
        }
        // stateright takes a timer that fired for gone.
        let fired = |happening: &Happening| match input {
            Input::Expired(timer) => *happening == Happening::Expired(timer),
            Input::Local(event) => *happening == Happening::Local(event),
            _ => false,
        };
        for armed in after.iter().filter(|h| fired(h) || !before.contains(h)) {
            out.set_timer(Sorted(*armed), model_timeout());
        }
    }

    /// Puts a message under way to the robots that it can concern.
    fn send(&self, node: &Node, output: &Output, out: &mut Out<Self>) {
        let message = match (output, &node.robot) {
            (Output::SendRam, Some(robot)) => Message::Ram(robot.ram()),
            (Output::SendRmcm(rmcm), _) => Message::Rmcm(*rmcm),
            _ => return,
        };
        for (i, setup) in self.scenario.robots.iter().enumerate() {
            if i != self.place && concerns(&message, setup.station) {
                out.send(Id::from(i), Sorted(message));
            }
        }
    }
}

fn concerns(message: &Message, receiver: StationId) -> bool {
    match message {
        Message::Rmcm(Rmcm::Command(command)) => command.to == receiver,
        Message::Rmcm(Rmcm::Answer(answer)) => answer.session.leader == receiver,
        Message::Ram(Ram {
            coordination,
            farewell,
            ..
        }) => match (coordination, farewell) {
            (Coordination::NeedHelp { .. } | Coordination::Leader { .. }, _)
            | (_, Some(Farewell::Ended(..))) => true,
            (_, Some(Farewell::Left(session, _)))
            | (
                Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. },
                None,
            ) => session.leader == receiver,
            (Coordination::None, None) => false,
        },
    }
}

/// The armed timers of a robot and what its application may do, as in the kit's model.
fn happenings(scenario: &Scenario, place: usize, state: &RobotState) -> Vec<Happening> {
    let Some(robot) = &state.node.robot else {
        return Vec::new();
    };
    let timers = robot.timers();
    let mut all: Vec<_> = timers
        .iter()
        .map(|(timer, _)| Happening::Expired(*timer))
        .collect();
    let mut local = |event| all.push(Happening::Local(event));
    if state.detections > 0 && scenario.robots[place].detects {
        local(Event::PedestrianDetected(scenario.request_of(place)));
    }
    match robot.phase() {
        Phase::Leading(leading) => {
            local(Event::TaskCompleted);
            for member in leading.members.iter().filter(|_| state.commands > 0) {
                for task in scenario.request.tasks.iter() {
                    local(Event::CommandManeuver {
                        follower: member.station,
                        task,
                    });
                }
            }
        }
        Phase::Following(following) => {
            if let Some(maneuver) = following.executing() {
                local(Event::ManeuverCompleted(maneuver.id));
            }
        }
        Phase::Idle | Phase::Requesting(_) | Phase::Offering(_) => {}
    }
    all
}

impl Actor for RobotActor {
    type Msg = Sorted<Message>;
    type Timer = Sorted<Happening>;
    type State = RobotState;

    fn on_start(&self, _: Id, out: &mut Out<Self>) -> RobotState {
        let bounds = self.scenario.bounds;
        let state = RobotState {
            node: Node::first_boot(self.scenario.robots[self.place].station),
            detections: bounds.detections,
            commands: bounds.commands,
        };
        for happening in happenings(&self.scenario, self.place, &state) {
            out.set_timer(Sorted(happening), model_timeout());
        }
        state
    }

    fn on_msg(
        &self,
        _: Id,
        state: &mut Cow<RobotState>,
        _: Id,
        message: Sorted<Message>,
        out: &mut Out<Self>,
    ) {
        self.step(state, message.0.input(), out);
    }

    fn on_timeout(
        &self,
        _: Id,
        state: &mut Cow<RobotState>,
        timer: &Sorted<Happening>,
        out: &mut Out<Self>,
    ) {
        let input = match timer.0 {
            Happening::Expired(timer) => Input::Expired(timer),
            Happening::Local(event) => Input::Local(event),
        };
        self.step(state, input, out);
    }
}

type Robots = ActorModel<RobotActor, (), ()>;

fn model(scenario: &Scenario) -> Robots {
    let scenario = Arc::new(scenario.clone());
    let actors = (0..scenario.robots.len()).map(|place| RobotActor {
        scenario: Arc::clone(&scenario),
        place,
    });
    Robots::new((), ())
        .actors(actors)
        .init_network(Network::new_unordered_nonduplicating([]))
        .lossy_network(LossyNetwork::Yes)
        .within_boundary(within_boundary)
        .property(Expectation::Always, "I14", |_, state| {
            state
                .actor_states
                .iter()
                .all(|actor| actor.node.actuation_agrees())
        })
        .property(Expectation::Always, "I1", |_, state| {
            state
                .actor_states
                .iter()
                .all(|actor| !follows_itself(&actor.node))
        })
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "stateright wants it so")]
fn within_boundary((): &(), state: &ActorModelState<RobotActor>) -> bool {
    let young = |node: &Node| match node.robot.as_ref().map(Robot::phase) {
        Some(Phase::Leading(leading)) => {
            leading.heartbeat.distance_from(Heartbeat(0)) <= HEARTBEAT_MAX
        }
        _ => true,
    };
    state.network.len() <= IN_FLIGHT_MAX
        && state.actor_states.iter().all(|actor| young(&actor.node))
}

fn follows_itself(node: &Node) -> bool {
    node.robot
        .as_ref()
        .is_some_and(|robot| match robot.phase() {
            Phase::Following(following) => following.session.leader == robot.station(),
            _ => false,
        })
}

/// Explores until `limit` distinct states are found or there are no more; how many were found.
pub(crate) fn explore(scenario: &Scenario, limit: usize) -> usize {
    let checker = model(scenario).checker().threads(1).spawn_bfs();
    while !checker.is_done() && checker.unique_state_count() < limit {
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(
        checker.discoveries().is_empty(),
        "the kit's model finds no violation"
    );
    checker.unique_state_count()
}
