//! Drives real endpoints along a run of the model: real octets, and every armed timer may run out at any
//! moment, as in the model.
//!
//! ```text
//!  run of the model ──► action ──► endpoint ──► octets ──► on their way ──► endpoint
//!          │                          │
//!          └──── state of the model ──┴── are they the same?  after every step
//! ```
//!
//! The model gives numbers and heartbeats names that keep it finite, so states are compared up to names:
//! a robot of the model and the one of the endpoint are the same if they differ in names alone, and one
//! renaming that keeps the order of names makes all robots of the one all robots of the other.

use std::collections::{BTreeMap, VecDeque};

use crossguard_codec::{Identifiers, Position, RobotState};
use crossguard_model_check::model::{Action, Delivery, Model, ModelState};
use crossguard_model_check::network::{Message, Transmission, concerns};
use crossguard_model_check::replay::{Followed, Replay};
use crossguard_protocol::{
    Event, Heartbeat, Input, Millis, Phase, Renaming, Robot, SessionId, StationId, Timer,
    UniqueNumber,
};

use crossguard_endpoint::station::listen::overhear;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};

/// All robots of the model are equally far apart; here all are at one place.
fn state() -> RobotState {
    RobotState {
        position: Position::at(0.0, 0.0),
        ..RobotState::default()
    }
}

/// What came of driving endpoints along a run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Driven {
    /// How far the model can follow the run.
    pub followed: Followed,
    /// After how many steps the endpoints were compared with the model, and were as it says.
    pub steps: usize,
    /// How many datagrams the endpoints sent.
    pub datagrams: usize,
    /// Where an endpoint did something else than the model.
    pub disagreement: Option<Disagreement>,
}

/// An endpoint does something else than the model.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Disagreement {
    /// The robot is in another state.
    #[error("robot {station} is in the state\n  {endpoint}\nand in the model in\n  {model}")]
    State {
        /// Its station id in the scenario.
        station: StationId,
        /// The endpoint's robot.
        endpoint: String,
        /// The model's.
        model: String,
    },
    /// No renaming makes the robots those of the model.
    #[error(
        "the names of {0} and {1} are not those of the model, in whatever way they are renamed"
    )]
    Names(String, String),
    /// The model has a message on its way that no endpoint sent.
    #[error("no datagram on its way says: {0}")]
    NotSent(String),
    /// An endpoint cannot make sense of a datagram, or cannot send one.
    #[error("robot {station} drops a datagram: {detail}")]
    Dropped {
        /// Its station id in the scenario.
        station: StationId,
        /// Why.
        detail: String,
    },
    /// An insider that lies is no robot, and has no endpoint.
    #[error(
        "robot {0} lies: it has no endpoint, so its runs are followed in the model only, without endpoints"
    )]
    Lies(StationId),
    /// The model has a robot do something that its endpoint cannot do.
    #[error("robot {0} is down")]
    Down(StationId),
}

/// Follows a run through `model`, and drives an endpoint for each robot along it as far as that goes.
#[must_use]
pub fn drive(model: &Model, replay: &Replay) -> Driven {
    let mut driven = DrivenRobots::new(model);
    let (mut steps, mut disagreement) = (0, None);
    let followed = replay.follow_with(model, &mut |action, after| {
        if disagreement.is_some() {
            return;
        }
        let taken = driven.take(action).and_then(|()| driven.compare(after));
        match taken {
            Ok(()) => steps += 1,
            Err(why) => disagreement = Some(why),
        }
    });
    Driven {
        followed,
        steps,
        datagrams: driven.datagrams,
        disagreement,
    }
}

/// A robot with its endpoint.
struct Driver {
    /// `None` while it is down.
    endpoint: Option<Endpoint>,
    /// Its station id in the scenario.
    station: StationId,
    /// The one that it had when it went down.
    last: StationId,
    hangs: bool,
    boot: u16,
}

/// A datagram on its way to one receiver.
#[derive(Clone)]
struct Flight {
    from: usize,
    to: usize,
    message: Message,
    packet: Vec<u8>,
}

/// The robots, and what is on its way between them.
struct DrivenRobots<'a> {
    model: &'a Model,
    robots: Vec<Driver>,
    on_air: VecDeque<Flight>,
    delayed: Vec<Flight>,
    datagrams: usize,
    /// Whether a message may arrive long after it was sent.
    keeps: bool,
    /// How many robots may boot again.
    restarts_left: u8,
}

impl<'a> DrivenRobots<'a> {
    fn new(model: &'a Model) -> Self {
        let channel = model.scenario().channel;
        let robots = model.scenario().robots.iter().map(|setup| Driver {
            endpoint: None,
            station: setup.station,
            last: setup.station,
            hangs: false,
            boot: 0,
        });
        let mut driven = Self {
            model,
            robots: robots.collect(),
            on_air: VecDeque::new(),
            delayed: Vec::new(),
            datagrams: 0,
            keeps: channel.monotone || channel.delayed > 0,
            restarts_left: model.scenario().bounds.restarts,
        };
        for robot in &mut driven.robots {
            robot.boot(model);
        }
        driven
    }

    /// What the model's action is to endpoints.
    fn take(&mut self, action: Action) -> Result<(), Disagreement> {
        match action {
            Action::Deliver { transmission, how } => {
                let flight = match how {
                    Delivery::AtOnce => self.take_off_air(transmission)?,
                    Delivery::Late => self.take_delayed(transmission)?,
                    Delivery::LateAndAgain => {
                        let flight = self.take_delayed(transmission)?;
                        self.delayed.push(flight.clone());
                        flight
                    }
                    Delivery::AnyTime => self.ever_sent(transmission)?,
                };
                let datagram = Stimulus::Datagram {
                    packet: &flight.packet,
                    arrived_ms: 0,
                };
                self.handle(flight.to, datagram)
            }
            Action::Lose(transmission) if self.on_air.is_empty() => {
                self.take_delayed(transmission).map(drop)
            }
            Action::Lose(transmission) => self.take_off_air(transmission).map(drop),
            Action::Delay(transmission) => {
                let flight = self.take_off_air(transmission)?;
                self.delayed.push(flight);
                Ok(())
            }
            Action::Expire(robot, timer) => self.handle(robot.into(), Stimulus::Timer(timer)),
            Action::Local(robot, event) => self.tell(robot.into(), event),
            Action::Crash(robot) => {
                let driver = &mut self.robots[usize::from(robot)];
                if let Some(endpoint) = driver.endpoint.take() {
                    driver.last = endpoint.robot().station();
                }
                Ok(())
            }
            // Time stands still for all. The model gives a robot that hangs nothing to do.
            Action::Hang(robot) => {
                self.robots[usize::from(robot)].hangs = true;
                Ok(())
            }
            Action::Resume(robot) => {
                self.robots[usize::from(robot)].hangs = false;
                Ok(())
            }
            Action::Lie(Transmission { from, .. }) => {
                Err(Disagreement::Lies(self.robots[usize::from(from)].station))
            }
            // What people do concerns no endpoint.
            Action::StepOnRoad(_) | Action::Across(_) => Ok(()),
            Action::Restart(robot) => {
                self.restarts_left -= 1;
                self.robots[usize::from(robot)].boot(self.model);
                Ok(())
            }
        }
    }

    /// The model's names of sessions are not the endpoint's.
    fn tell(&mut self, robot: usize, event: Event) -> Result<(), Disagreement> {
        let executing = || match self.robots[robot].endpoint.as_ref()?.robot().phase() {
            Phase::Following(following) => Some(following.executing()?.id),
            _ => None,
        };
        let stimulus = match event {
            Event::InPosition(id) => Stimulus::Event(Event::InPosition(executing().unwrap_or(id))),
            Event::ManeuverCompleted(id) => {
                Stimulus::Event(Event::ManeuverCompleted(executing().unwrap_or(id)))
            }
            Event::ManeuverFailed(id) => {
                Stimulus::Event(Event::ManeuverFailed(executing().unwrap_or(id)))
            }
            event => Stimulus::Event(event),
        };
        self.handle(robot, stimulus)
    }

    fn handle(&mut self, robot: usize, stimulus: Stimulus<'_>) -> Result<(), Disagreement> {
        // Time stands still: timers run out when the run says so.
        let moment = Moment {
            now_ms: 0,
            timestamp_its: 0,
        };
        let station = self.robots[robot].station;
        let Some(endpoint) = &mut self.robots[robot].endpoint else {
            return Err(Disagreement::Down(station));
        };
        for effect in endpoint.handle(moment, &state(), stimulus) {
            match effect {
                // What the generation rules send out of a session concerns nobody.
                Effect::Transmit { octets, packet, .. } => {
                    self.transmit(robot, &octets, &packet)?;
                }
                Effect::Dropped { detail, .. } => {
                    return Err(Disagreement::Dropped { station, detail });
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn transmit(&mut self, from: usize, octets: &[u8], packet: &[u8]) -> Result<(), Disagreement> {
        self.datagrams += 1;
        let heard = overhear(&Identifiers::default(), octets).map_err(|unheard| {
            let (station, detail) = (self.robots[from].station, unheard.to_string());
            Disagreement::Dropped { station, detail }
        })?;
        let messages = heard
            .inputs
            .iter()
            .copied()
            .filter_map(|input| match input {
                Input::Ram { ram, .. } => Some(Message::Ram(ram)),
                Input::Rmcm(rmcm) => Some(Message::Rmcm(rmcm)),
                _ => None,
            });
        for message in messages {
            for (to, robot) in self.robots.iter().enumerate().filter(|(to, _)| *to != from) {
                let station = match &robot.endpoint {
                    Some(endpoint) => endpoint.robot().station(),
                    None => robot.last,
                };
                let may_hear = match robot.endpoint {
                    None => self.keeps && self.restarts_left > 0,
                    Some(_) => self.keeps || !robot.hangs,
                };
                if may_hear && concerns(&message, station) {
                    self.on_air.push_back(Flight {
                        from,
                        to,
                        message,
                        packet: packet.to_vec(),
                    });
                }
            }
        }
        Ok(())
    }

    /// Whether a datagram is, but for names, the message that the model means.
    fn is_meant(&self, flight: &Flight, transmission: Transmission) -> bool {
        let (from, to) = (transmission.from.into(), transmission.to.into());
        let message = *self.model.message(transmission.message);
        (flight.from, flight.to) == (from, to) && nameless(&flight.message) == nameless(&message)
    }

    fn take_off_air(&mut self, transmission: Transmission) -> Result<Flight, Disagreement> {
        let at = self
            .on_air
            .iter()
            .position(|f| self.is_meant(f, transmission));
        let flight = at.and_then(|at| self.on_air.remove(at));
        flight.ok_or_else(|| self.not_sent(transmission))
    }

    fn take_delayed(&mut self, transmission: Transmission) -> Result<Flight, Disagreement> {
        let at = self
            .delayed
            .iter()
            .position(|f| self.is_meant(f, transmission));
        let at = at.ok_or_else(|| self.not_sent(transmission))?;
        Ok(self.delayed.remove(at))
    }

    /// A message of a monotone channel, on which everything that was ever sent stays.
    fn ever_sent(&self, transmission: Transmission) -> Result<Flight, Disagreement> {
        let mut sent = self.on_air.iter();
        let flight = sent.find(|flight| self.is_meant(flight, transmission));
        flight.cloned().ok_or_else(|| self.not_sent(transmission))
    }

    fn not_sent(&self, transmission: Transmission) -> Disagreement {
        let message = self.model.message(transmission.message);
        Disagreement::NotSent(message.input().to_string())
    }

    /// Whether all robots are as the model says.
    fn compare(&self, state: &ModelState) -> Result<(), Disagreement> {
        let mut names = BTreeMap::new();
        for (driver, node) in self.robots.iter().zip(self.model.nodes(state)) {
            let real = driver.endpoint.as_ref().map(Endpoint::robot);
            let (mut ours, mut theirs) = (Names::default(), Names::default());
            let nameless_real = real.map(|robot| robot.renamed(&mut ours));
            let nameless_model = node.robot.as_ref().map(|robot| robot.renamed(&mut theirs));
            if nameless_real != nameless_model || ours.0.len() != theirs.0.len() {
                let words = |robot: Option<&Robot>| {
                    robot.map_or_else(|| "down".to_owned(), |robot| format!("{robot:?}"))
                };
                return Err(Disagreement::State {
                    station: driver.station,
                    endpoint: words(real),
                    model: words(node.robot.as_ref()),
                });
            }
            for (model, real) in theirs.0.into_iter().zip(ours.0) {
                let known = *names.entry(model).or_insert(real);
                if known != real {
                    return Err(Disagreement::Names(
                        format!("{known:?}"),
                        format!("{real:?}"),
                    ));
                }
            }
        }
        // Names of the same owner stand in their order, on both sides.
        let pairs: Vec<_> = names.values().collect();
        match pairs.windows(2).find(|pair| pair[0] >= pair[1]) {
            Some(pair) => Err(Disagreement::Names(
                format!("{:?}", pair[0]),
                format!("{:?}", pair[1]),
            )),
            None => Ok(()),
        }
    }
}

impl Driver {
    fn boot(&mut self, model: &Model) {
        self.boot += 1;
        let robot = Robot::new(self.station, self.boot);
        let config = model.scenario().config.clone();
        self.endpoint = Some(Endpoint::new(robot, config, Identifiers::default(), 0));
    }
}

/// A name, in the order of its owner and then of its own.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Name {
    Number(StationId, UniqueNumber),
    Heartbeat(SessionId, u16),
}

/// Takes the names and times out of something, and keeps the names.
#[derive(Default)]
struct Names(Vec<Name>);

impl Renaming for Names {
    fn countdown(&mut self, _: Timer, _: Millis) -> Millis {
        Millis(1)
    }

    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        self.0.push(Name::Heartbeat(session, heartbeat.0));
        Heartbeat(0)
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        self.0.push(Name::Number(owner, number));
        UniqueNumber { count: 0, ..number }
    }
}

fn nameless(message: &Message) -> Message {
    let mut names = Names::default();
    match message {
        Message::Ram(ram) => Message::Ram(ram.renamed(&mut names)),
        Message::Rmcm(rmcm) => Message::Rmcm(rmcm.renamed(&mut names)),
    }
}
