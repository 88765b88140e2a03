//! One robot against everything: every state that it can be brought into by any messages, events and
//! timers, and what every input does there.
//!
//! The scenarios show how robots behave together; this shows that a single robot is safe against
//! peers that say anything at all. Inputs are representatives: of the numbers that a message can
//! carry the robot only asks whether they are its own, known, newer or older, so one of each kind
//! stands for all.

use std::collections::HashSet;

use crossguard_protocol::{
    Answer, Availability, Config, Coordination, Decimetres, Event, EventKind, Farewell, Heartbeat,
    HelpRequest, Input, Millis, OfferNumber, Phase, Place, Ram, RequestId, Rmcm, Robot, SessionId,
    SessionNumber, Settings, StationId, TaskSet, TaskType, Timer, Unavailability, UniqueNumber,
    Urgency, Verdict,
};

use crate::canonical::{Names, Ranks, Renamable};
use crate::network::Message;
use crate::network::concerns;
use crate::node::{Node, Protocol};
use crate::road::{Body, Heard};
use crate::transitions::Transitions;
use crate::utterances;

/// The robot, its two peers, and a station that is none of them.
const ME: StationId = StationId(2);
const PEERS: [StationId; 2] = [StationId(1), StationId(3)];
const STRANGER: StationId = StationId(9);

/// An offer that nobody remembers.
const OLD_OFFER: OfferNumber = OfferNumber(number(0, 5));

/// Findings on one robot among any others.
#[derive(Clone, Debug, Default)]
pub struct Universe {
    /// Distinct states.
    pub states: usize,
    /// Steps: every input in every state.
    pub steps: usize,
    /// The transitions of the state diagram.
    pub transitions: Transitions,
    /// Steps after which the state was not valid, or that were ignored and changed something.
    pub invalid: Vec<String>,
    /// Messages that the model leaves out because they concern no robot, and that had an effect.
    pub wrongly_left_out: Vec<String>,
}

/// The configuration under which the universe is explored: the defaults, with one repeat, so that
/// the last one is near.
///
/// # Panics
/// Never: the settings are valid.
#[must_use]
pub fn config() -> Config {
    Config::new(Settings {
        n_ack: 1,
        ..Settings::default()
    })
    .expect("valid settings")
}

/// Explores all states of one robot.
#[must_use]
pub fn explore(config: &Config) -> Universe {
    let mut universe = Universe::default();
    let mut todo = vec![Node::first_boot(ME), out_of_requests(config)];
    let mut seen: HashSet<Node> = todo.iter().cloned().collect();
    while let Some(node) = todo.pop() {
        let Some(robot) = &node.robot else { continue };
        for input in inputs(robot) {
            universe.steps += 1;
            let Some((after, outputs)) = node.step(&Protocol, config, input) else {
                continue;
            };
            let is_ignored = outputs.ignored().is_some();
            universe.judge(config, &node, input, &after, is_ignored);
            if is_ignored {
                // The state is the same, or else `judge` has noted it.
                continue;
            }
            let next = canonical(&after);
            if seen.insert(next.clone()) {
                todo.push(next);
            }
        }
    }
    universe.states = seen.len();
    universe
}

/// A leader that has used up the request numbers of its only follower; the next command renews the
/// session.
fn out_of_requests(config: &Config) -> Node {
    let mut node = Node::first_boot(ME);
    let mut take = |input| {
        let (after, outputs) = node
            .step(&Protocol, config, input)
            .expect("the robot is up");
        assert_eq!(outputs.ignored(), None, "{input}");
        node = after;
        node.robot.clone().expect("the robot is up")
    };
    let robot = take(Input::Local(Event::PedestrianDetected(request(
        1,
        Urgency::Medium,
    ))));
    let session = robot.session().expect("it leads one");
    let (station, offer) = (PEERS[0], OfferNumber(number(1, 0)));
    let capabilities = TaskSet::of(&[TaskType::MOVE]);
    take(ram(
        station,
        Coordination::OfferHelp {
            session,
            offer,
            capabilities,
            echo: config.settings().first_heartbeat,
            t_safety: config.settings().t_safety,
        },
        None,
    ));
    take(Input::Expired(Timer::Selection));
    let echo = config.settings().first_heartbeat;
    take(ram(
        station,
        Coordination::Follower {
            session,
            echo,
            last: None,
        },
        None,
    ));
    let mut request = config.settings().first_request;
    for _ in 0..RequestId::MAX_PER_SESSION {
        take(Input::Local(Event::CommandManeuver {
            follower: station,
            task: TaskType::MOVE,
        }));
        let verdict = Verdict::Accepted;
        take(Input::Rmcm(Rmcm::Answer(Answer {
            from: station,
            session,
            request,
            verdict,
        })));
        request = request.next();
    }
    canonical(&node)
}

fn canonical(node: &Node) -> Node {
    let mut node = node.untimed();
    // Nothing of this makes a difference to what the robot does next.
    node.actuation.heard = Heard::Nothing;
    node.actuation.road_unsure = false;
    if node.actuation.body.running().is_none() {
        node.actuation.body = Body::Parked;
    }
    let mut ranks = Ranks::default();
    ranks.add(&Names::of(&node));
    if ranks.rank() {
        node.renamed(&mut &ranks)
    } else {
        node
    }
}

impl Universe {
    fn judge(&mut self, config: &Config, before: &Node, input: Input, after: &Node, ignored: bool) {
        let valid = after
            .robot
            .as_ref()
            .is_some_and(|robot| robot.is_valid(config));
        // The record of messages that it heard may change: it is no state of the robot.
        let mut own = after.clone();
        own.actuation.heard = before.actuation.heard;
        if !valid || !after.actuation_agrees() || (ignored && *before != own) {
            self.invalid.push(format!("{input} in {before:?}"));
        }
        let message = match input {
            Input::Ram { ram, .. } => Some(Message::Ram(ram)),
            Input::Rmcm(rmcm) => Some(Message::Rmcm(rmcm)),
            _ => None,
        };
        if message.is_some_and(|message| !concerns(&message, ME)) && !ignored {
            self.wrongly_left_out.push(format!("{input} in {before:?}"));
        }
        self.transitions.note(before, input, after);
    }
}

// Representatives of all inputs.

const fn number(boot: u16, count: u16) -> UniqueNumber {
    UniqueNumber { boot, count }
}

fn inputs(robot: &Robot) -> Vec<Input> {
    let timers = robot.timers();
    let timers = timers.iter().map(|(timer, _)| Input::Expired(*timer));
    let mut inputs: Vec<_> = timers.collect();
    inputs.extend(events(robot).into_iter().map(Input::Local));
    let (sessions, requests, heartbeats) = (sessions(robot), requests(robot), heartbeats(robot));
    for station in [ME, PEERS[0], PEERS[1]] {
        let (own, others): (Vec<SessionId>, Vec<SessionId>) = sessions
            .iter()
            .copied()
            .partition(|session| session.leader == station);
        let numbers: Vec<_> = own.iter().map(|session| session.number).collect();
        let with_beats = numbers.iter();
        let with_beats =
            with_beats.flat_map(|&number| heartbeats.iter().map(move |&it| (number, it)));
        let with_beats: Vec<_> = with_beats.collect();
        let mut offers = vec![OLD_OFFER];
        offers.extend(utterances::standing_offer(robot).filter(|_| station == ME));
        let lists = utterances::follower_lists(robot, Some(OLD_OFFER));
        let urgencies = [Urgency::Low, Urgency::Medium, Urgency::High];
        let safety_timers = [Millis(2_000), Millis(1)];
        let move_alone = TaskSet::of(&[TaskType::MOVE]);
        let parts = [
            vec![Coordination::None],
            utterances::asking(&with_beats, &urgencies, request(1, Urgency::Low)),
            utterances::leading(&with_beats, &lists, Place::default()),
            utterances::offering(&others, &offers, &heartbeats, &safety_timers, move_alone),
            utterances::following(&others, &heartbeats, &requests),
        ];
        let parts = parts.into_iter().flatten();
        inputs.extend(parts.map(|coordination| ram(station, coordination, None)));
        let around = [(0, 5), (2, 5)].map(|(boot, count)| OfferNumber(number(boot, count)));
        for farewell in utterances::ended(&numbers).chain(utterances::left(&others, &around)) {
            // A farewell alone, and together with the request for the next session.
            let next = Coordination::NeedHelp {
                number: SessionNumber(number(1, 8)),
                heartbeat: Heartbeat(0),
                request: request(1, Urgency::High),
            };
            for coordination in [Coordination::None, next] {
                inputs.push(ram(station, coordination, Some(farewell)));
            }
        }
    }
    let tasks = [TaskType::MOVE, TaskType::new(9).unwrap_or(TaskType::BLOCK)];
    let commands = utterances::commands(&sessions, &[ME, STRANGER], &requests, &tasks);
    let stations = [ME, PEERS[0], PEERS[1], STRANGER];
    let answers = utterances::answers(&stations, &sessions, &requests);
    let commands = commands.into_iter().map(Rmcm::Command);
    let rmcms = commands.chain(answers.into_iter().map(Rmcm::Answer));
    inputs.extend(rmcms.map(Input::Rmcm));
    inputs
}

fn ram(station: StationId, coordination: Coordination, farewell: Option<Farewell>) -> Input {
    Input::Ram {
        ram: Ram {
            station,
            coordination,
            farewell,
            on_duty: false,
        },
        distance: Decimetres(0),
    }
}

fn request(followers: u8, urgency: Urgency) -> HelpRequest {
    HelpRequest {
        urgency,
        followers,
        tasks: TaskSet::of(&[TaskType::MOVE]),
        place: Place::default(),
    }
}

fn events(robot: &Robot) -> Vec<Event> {
    let bare = EventKind::ALL.into_iter().filter_map(Event::bare);
    let mut events: Vec<_> = bare.collect();
    events.extend([
        Event::PedestrianDetected(request(1, Urgency::Medium)),
        Event::PedestrianDetected(request(0, Urgency::Medium)),
        Event::AvailabilityChanged(Availability::Available),
        Event::AvailabilityChanged(Availability::Unavailable(Unavailability::LocalFault)),
        Event::IdentityChanged(ME, None),
    ]);
    for follower in [PEERS[0], PEERS[1], STRANGER] {
        // Three commands show everything that more would, up to the last one.
        let used = requests(robot).last().map_or(0, |request| request.0);
        if (3..RequestId::MAX_PER_SESSION).contains(&used) {
            continue;
        }
        events.push(Event::CommandManeuver {
            follower,
            task: TaskType::MOVE,
        });
    }
    for session in sessions(robot) {
        for request in requests(robot) {
            let id = crossguard_protocol::ManeuverId { session, request };
            events.extend([
                Event::InPosition(id),
                Event::OutOfPosition(id),
                Event::ManeuverCompleted(id),
                Event::ManeuverFailed(id),
            ]);
        }
    }
    events
}

/// The session that the robot is in, one of its own that is over, one of each peer, and that of its rival.
fn sessions(robot: &Robot) -> Vec<SessionId> {
    let of = |leader, boot, count| SessionId {
        leader,
        number: SessionNumber(number(boot, count)),
    };
    let mut sessions = vec![of(ME, 0, 7), of(PEERS[0], 1, 7), of(PEERS[1], 1, 7)];
    let rival = match robot.phase() {
        Phase::Requesting(requesting) => requesting.rival,
        Phase::Leading(leading) => leading.rival,
        Phase::Idle | Phase::Offering(_) | Phase::Following(_) => None,
    };
    for known in [robot.session(), rival.map(|rival| rival.session)] {
        sessions.extend(known.filter(|session| !sessions.contains(session)));
    }
    sessions
}

/// Heartbeats around the newest that the robot knows of.
fn heartbeats(robot: &Robot) -> Vec<Heartbeat> {
    let newest = match robot.phase() {
        Phase::Leading(leading) => leading.heartbeat,
        Phase::Requesting(requesting) => requesting.heartbeat,
        Phase::Offering(offering) => offering.heard,
        Phase::Following(following) => following.heard,
        Phase::Idle => Heartbeat(1),
    };
    // Ranks start at 0, so there is an older one only above it.
    let older = newest.0.checked_sub(1).map(Heartbeat);
    [older, Some(newest), Some(newest.after(1))]
        .into_iter()
        .flatten()
        .collect()
}

/// Request numbers around the newest that the robot knows of.
fn requests(robot: &Robot) -> Vec<RequestId> {
    let known = match robot.phase() {
        Phase::Following(following) => following.newest_request(),
        Phase::Leading(leading) => leading
            .members
            .iter()
            .next()
            .map(|member| member.next_request),
        _ => None,
    };
    let newest = known.unwrap_or(RequestId(0));
    let newer = if newest.0 < 2 {
        Some(newest.next())
    } else {
        None
    };
    let older = newest.0.checked_sub(1).map(RequestId);
    [older, Some(newest), newer].into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fsm::diagram;

    /// Up to renaming.
    const STATES: usize = 32_554;

    #[test]
    fn whatever_peers_say_every_step_of_a_robot_is_valid() {
        let universe = explore(&config());
        assert_eq!(universe.invalid, Vec::<String>::new());
        assert_eq!(universe.wrongly_left_out, Vec::<String>::new());
        assert_eq!(universe.states, STATES, "verification.md says how many");
        let diagram = diagram(&universe.transitions);
        for state in ["Idle", "HelpRequested_helper", "ManeuverExecuting_leader"] {
            assert!(diagram.contains(state), "{state} is not in:\n{diagram}");
        }
    }
}
