//! One robot's endpoint: the [`Exchange`] with a map, clusters of people and security.
//!
//! It does no input or output and reads no clock. Its driver says what time it is, hands it datagrams and
//! events, and carries out the effects in order. The README lists the functions on the way of a RAM.

mod act;
mod answers;
mod turn;

use std::collections::BTreeSet;

use crossguard_codec::geonet::{EgoPosition, Envelope};
use crossguard_codec::security::{HashedId8, TrustedTime};
use crossguard_codec::{Identifiers, RobotState, Service, TaskParameters};
use crossguard_protocol::{
    Config, Event, Identity, Input, Outputs, Robot, StateMachine, StationId, TaskType, Timer,
};

pub use self::act::Act;
use self::answers::Answers;
use self::turn::Turn;
use crate::cause::Cause;
use crate::counters::Counters;
use crate::exchange::{Arrived, Exchange, Host as _, Moment};
use crate::ras::cam::{CamGeneration, cam};
use crate::ras::clustering::PerceivedVru;
use crate::ras::generation::{INTERVAL_MIN_MS, Limits, Trigger};
use crate::ras::surroundings::{Awareness, Surroundings};
use crate::station::{LocalDynamicMap, Neighbours, Pseudonyms, Security};

/// An input of an endpoint.
#[derive(Clone, Copy, Debug)]
pub enum Stimulus<'a> {
    /// A datagram was received: a `GeoNetworking` packet. One that has waited for longer than
    /// [`delay_max`](crossguard_protocol::Settings::delay_max) is dropped.
    Datagram {
        /// The packet.
        packet: &'a [u8],
        /// When it arrived, on the clock of [`Moment::now_ms`].
        arrived_ms: u64,
    },
    /// The application tells an event. A maneuver is commanded without parameters.
    Event(Event),
    /// The application commands a maneuver, with parameters.
    Order {
        /// Who is to do it.
        follower: StationId,
        /// What.
        task: TaskType,
        /// Where and how.
        parameters: TaskParameters,
    },
    /// All road users that the robot's sensors have now. Places are metres to the east and to the
    /// north of the robot's reference position.
    Perceived(&'a [PerceivedVru]),
    /// One timer runs out, whatever the time: for runs in which any armed timer may.
    Timer(Timer),
    /// Nothing but that time has passed.
    Time,
}

/// What an endpoint wants to be done.
#[derive(Clone, Debug)]
pub enum Effect {
    /// The transition function took a step; for the log.
    Stepped {
        /// What it took in.
        input: Input,
        /// What it put out.
        outputs: Box<Outputs>,
        /// The state after it.
        state: Box<Robot>,
    },
    /// A message was understood; for the log.
    Heard {
        /// Which message.
        kind: Service,
        /// Who sent it.
        from: StationId,
        /// When it arrived, on the clock of [`Moment::now_ms`].
        arrived_ms: u64,
        /// When it was handed to the robot, on that clock.
        told_ms: u64,
        /// Its octets.
        octets: Vec<u8>,
    },
    /// Send this packet.
    Transmit {
        /// Which message they are.
        kind: Service,
        /// Why it is sent.
        trigger: Trigger,
        /// The message.
        octets: Vec<u8>,
        /// The `GeoNetworking` packet with the message, which is what goes out.
        packet: Vec<u8>,
    },
    /// The application is to do something.
    Act(Act),
    /// A datagram was dropped, or a message could not be sent.
    Dropped {
        /// Why.
        cause: Cause,
        /// What exactly.
        detail: String,
        /// The datagram.
        octets: Vec<u8>,
    },
}

/// One robot's endpoint, around the transition function of the kit unless a test brings another one along.
#[derive(Clone, Debug)]
pub struct Endpoint<P = Robot> {
    exchange: Exchange<P>,
    around: Around,
    pseudonyms: Pseudonyms,
    /// When CAM are sent, if they are.
    cam: Option<CamGeneration>,
    /// Shortest interval that congestion control allows, in ms.
    congestion_ms: u64,
}

/// What an endpoint knows besides the protocol, and what it counts.
#[derive(Clone, Debug)]
struct Around {
    neighbours: Neighbours,
    /// The people around.
    surroundings: Surroundings,
    /// Who has answered a request.
    answers: Answers,
    counters: Counters,
}

impl<P: StateMachine> Endpoint<P> {
    /// The endpoint of a robot that has just booted, at `now_ms`.
    #[must_use]
    pub fn new(protocol: P, config: Config, identifiers: Identifiers, now_ms: u64) -> Self {
        Self {
            around: Around {
                surroundings: Surroundings::new(
                    Awareness::default(),
                    cluster_seed(protocol.robot()),
                ),
                neighbours: Neighbours::new(identifiers),
                answers: Answers::default(),
                counters: Counters::default(),
            },
            exchange: Exchange::new(protocol, config, identifiers, now_ms),
            pseudonyms: Pseudonyms::default(),
            cam: None,
            congestion_ms: INTERVAL_MIN_MS,
        }
    }

    /// Says how people around the robot are announced, and whether it sends CAM; people known so far are
    /// forgotten.
    #[must_use]
    pub fn with_awareness(mut self, awareness: Awareness) -> Self {
        self.cam = awareness.cam.then(CamGeneration::default);
        self.around.surroundings = Surroundings::new(awareness, cluster_seed(self.robot()));
        self
    }

    /// Congestion control says that two CAM, or two RAM outside of a session, are at least this many ms apart.
    pub const fn hold_back(&mut self, congestion_ms: u64) {
        self.congestion_ms = congestion_ms;
    }

    /// The wall clock is right to this many ms, or nothing is known of it: packets that outlived their lifetime by it are
    /// dropped, or none are.
    pub const fn keep_time(&mut self, error_ms: Option<u32>) {
        self.exchange.stack_mut().keep_time(error_ms);
    }

    /// The same with security.
    #[must_use]
    pub fn with_security(mut self, security: Security) -> Self {
        self.pseudonyms = Pseudonyms::new(security.secret, security.pseudonym_period_ms);
        *self.exchange.stack_mut().envelope_mut() = security.envelope;
        self
    }

    /// The time that packets are verified by, and whether the clock is trusted. `None` without security.
    #[must_use]
    pub const fn trusted_time(&self) -> Option<&TrustedTime> {
        match self.exchange.stack().envelope() {
            Envelope::Secured(secured) => Some(secured.station().verifier().time()),
            _ => None,
        }
    }

    /// Trusts none of these certificates from now on, instead of the ones that were revoked before.
    pub fn set_revoked(&mut self, revoked: BTreeSet<HashedId8>) {
        if let Envelope::Secured(secured) = self.exchange.stack_mut().envelope_mut() {
            secured.set_revoked(revoked);
        }
    }

    /// The protocol state.
    #[must_use]
    pub fn robot(&self) -> &Robot {
        self.exchange.robot()
    }

    /// The configuration.
    #[must_use]
    pub const fn config(&self) -> &Config {
        self.exchange.config()
    }

    /// What no standard has assigned.
    #[must_use]
    pub const fn identifiers(&self) -> &Identifiers {
        self.exchange.identifiers()
    }

    /// Who is around.
    #[must_use]
    pub const fn map(&self) -> &LocalDynamicMap {
        self.around.neighbours.map()
    }

    /// What was dropped or ignored so far.
    #[must_use]
    pub const fn counters(&self) -> &Counters {
        &self.around.counters
    }

    /// Whether the robot asks for help, has offers enough, and has heard an answer of every robot that it heard
    /// in the last second: then [`Event::AllAnswered`] may be put in.
    #[must_use]
    pub fn all_have_answered(&self) -> bool {
        let now_ms = self.exchange.elapsed_to_ms();
        self.around.answers.are_all_in(now_ms, self.robot())
    }

    /// Counts something that was dropped outside of the endpoint.
    pub fn count(&mut self, cause: Cause) {
        self.around.counters.count(cause);
    }

    /// When the time must be put in at the latest, in ms on the endpoint's clock.
    #[must_use]
    pub fn next_wakeup_ms(&self) -> u64 {
        let robot = self.robot();
        let elapsed_to_ms = self.exchange.elapsed_to_ms();
        let by_protocol = robot.next_due();
        let by_protocol = by_protocol.map(|due| elapsed_to_ms + u64::from(due.0));
        let by_generation = elapsed_to_ms + INTERVAL_MIN_MS;
        match robot.next_ram() {
            Some(_) if self.cam.is_none() => by_protocol.unwrap_or(by_generation),
            _ => by_protocol.map_or(by_generation, |due| due.min(by_generation)),
        }
    }

    /// Takes in what happened at `moment` to a robot in `state`; the effects, in order.
    pub fn handle(
        &mut self,
        moment: Moment,
        state: &RobotState,
        stimulus: Stimulus<'_>,
    ) -> Vec<Effect> {
        let mut turn = Turn::new(&mut self.around, state);
        let exchange = &mut self.exchange;
        if moment.now_ms > exchange.elapsed_to_ms() {
            turn.elapse(moment.now_ms);
            exchange.elapse(&mut turn, moment);
        }
        if let Envelope::Secured(secured) = exchange.stack_mut().envelope_mut() {
            let ego = EgoPosition::of(state, moment.timestamp_its);
            secured.look_at_clock(&ego, moment.now_ms);
        }
        renew_pseudonym(&mut self.pseudonyms, exchange, &mut turn, moment);
        match stimulus {
            Stimulus::Datagram { packet, arrived_ms } => {
                let arrived = Arrived {
                    octets: packet,
                    at_ms: Some(arrived_ms),
                };
                exchange.receive(&mut turn, moment, arrived);
            }
            Stimulus::Event(event) => {
                let event = match (event, exchange.stack().envelope()) {
                    (Event::EpochRenewed(boot), Envelope::Secured(_)) => {
                        let station = exchange.robot().station();
                        Event::EpochRenewed(self.pseudonyms.epoch(station, boot))
                    }
                    (event, _) => event,
                };
                let outputs = exchange.event(&mut turn, moment, event);
                turn.answer(event, &outputs);
            }
            Stimulus::Order {
                follower,
                task,
                parameters,
            } => {
                let outputs = exchange.command(&mut turn, moment, follower, task, parameters);
                turn.answer(Event::CommandManeuver { follower, task }, &outputs);
            }
            Stimulus::Perceived(people) => turn.perceive(moment.now_ms, people),
            Stimulus::Timer(timer) => exchange.expire(&mut turn, moment, timer),
            Stimulus::Time => {}
        }
        send_cluster_vams(exchange, &mut turn, moment);
        // Who protects somebody is not silent.
        if exchange.robot().identity() != Identity::Unlocked || turn.announces_people() {
            self.pseudonyms.break_silence();
        }
        if self.pseudonyms.is_silent(moment.now_ms) {
            return turn.into_effects();
        }
        let limits = Limits {
            congestion_ms: self.congestion_ms,
            max_ms: turn.ram_interval_max_ms(),
        };
        exchange.generate(&mut turn, moment, limits);
        if let Some(generation) = &mut self.cam {
            send_cam(generation, exchange, &mut turn, moment, self.congestion_ms);
        }
        turn.into_effects()
    }
}

/// Changes the pseudonym when that is due and no session knows the robot by its old one.
fn renew_pseudonym<P: StateMachine>(
    pseudonyms: &mut Pseudonyms,
    exchange: &mut Exchange<P>,
    turn: &mut Turn<'_>,
    moment: Moment,
) {
    if exchange.robot().identity() != Identity::Unlocked {
        return;
    }
    let lock_ms = u64::from(exchange.config().settings().t_lock.0);
    let ego = EgoPosition::of(turn.state(), moment.timestamp_its);
    let (identifiers, robot) = (*exchange.identifiers(), exchange.robot().clone());
    let envelope = exchange.stack_mut().envelope_mut();
    if let Some(taken) = pseudonyms.renew(envelope, &identifiers, &ego, &robot, lock_ms) {
        let numbers = (Some(taken.next), taken.sequence_number);
        exchange.change_identity(turn, moment, taken.station, numbers);
        turn.renew_clusters(moment.now_ms, taken.clusters);
        pseudonyms.fall_silent(taken.station, moment.now_ms);
    }
}

/// Sends the cluster VAM that are due.
fn send_cluster_vams<P: StateMachine>(
    exchange: &mut Exchange<P>,
    turn: &mut Turn<'_>,
    moment: Moment,
) {
    let station = exchange.robot().station().0;
    for vam in turn.cluster_vams(exchange.identifiers(), moment, station) {
        match vam {
            Ok(vam) => {
                exchange.transmit(turn, moment, (Service::Vam, Trigger::Interval), &vam);
            }
            Err(error) => turn.not_sent(&error),
        }
    }
}

/// Sends a CAM if one is due: after a RAM, so that robots know it is one of theirs.
fn send_cam<P: StateMachine>(
    generation: &mut CamGeneration,
    exchange: &mut Exchange<P>,
    turn: &mut Turn<'_>,
    moment: Moment,
    congestion_ms: u64,
) {
    let Some(due) = generation.poll(moment.now_ms, congestion_ms, turn.state()) else {
        return;
    };
    let (ids, station) = (exchange.identifiers(), exchange.robot().station().0);
    let time = moment.timestamp_its;
    match cam(ids, station, turn.state(), time, due.low_frequency) {
        Ok(octets) => exchange.transmit(turn, moment, (Service::Cam, due.trigger), &octets),
        Err(error) => turn.not_sent(&error),
    }
}

/// Ids of clusters differ from robot to robot and from boot to boot.
fn cluster_seed(robot: &Robot) -> u64 {
    u64::from(robot.station().0) << 16 ^ u64::from(robot.boot())
}
