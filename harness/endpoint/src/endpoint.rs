//! One robot's endpoint: the [`Exchange`] with a map, clusters of people and security.
//!
//! It does no input or output and reads no clock. Its driver says what time it is, hands it datagrams and
//! events, and carries out the effects in order. The README lists the functions on the way of a RAM.

mod answers;
#[cfg_attr(not(feature = "foreign"), path = "endpoint/no_others.rs")]
mod others;
#[cfg_attr(not(feature = "security"), path = "endpoint/no_pseudonyms.rs")]
mod pseudonyms;
mod served;
mod turn;

use crossguard_codec::{Identifiers, RobotState, Service, TaskParameters};
use crossguard_protocol::{
    Config, Event, Identity, Ignored, Input, Output, Outputs, Robot, StateMachine, StationId,
    TaskSet, TaskType,
};

use self::answers::Answers;
use self::others::Others;
use self::pseudonyms::Pseudonyms;
pub use self::served::Served;
use self::turn::Turn;
use crate::cause::Cause;
use crate::counters::Counters;
use crate::exchange::{Exchange, Host as _, Moment};
use crate::ras::clustering::PerceivedVru;
use crate::ras::generation::{INTERVAL_MIN_MS, Limits, Trigger};
use crate::ras::surroundings::{Awareness, Surroundings};
use crate::station::{LocalDynamicMap, Neighbours};

/// An input of an endpoint.
#[derive(Clone, Copy, PartialEq, Debug)]
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
    Command {
        /// The station that carries it out.
        follower: StationId,
        /// Its task.
        task: TaskType,
        /// Place and manner of the task.
        parameters: TaskParameters,
    },
    /// The application asks a vehicle whether it will stop: see [`Exchange::ask`].
    Ask {
        /// Which.
        vehicle: StationId,
        /// Where its front is to stand.
        parameters: TaskParameters,
    },
    /// All road users that the robot's sensors have now. Places are metres to the east and to the
    /// north of the robot's reference position.
    Perceived(&'a [PerceivedVru]),
    /// Nothing but that time has passed.
    Time,
}

/// Effect of an input, for the caller to carry out or log.
#[derive(Clone, Debug)]
pub enum Effect {
    /// The transition function took a step; for the log.
    Stepped {
        /// Input of the step.
        input: Input,
        /// Outputs of the step.
        outputs: Box<Outputs>,
        /// The state after it.
        state: Box<Robot>,
    },
    /// A message was understood; for the log.
    Heard {
        /// Which message.
        kind: Service,
        /// Sender of the message.
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
    /// The application is to do this, or to know it; a maneuver starts with these parameters of its command. Never
    /// [`Output::SendRam`], [`Output::SendRmcm`] and [`Output::Ignored`].
    Act(Output, TaskParameters),
    /// A vehicle says whether it will stop, as it was asked the last time.
    VehicleAnswered(StationId, bool),
    /// The event that was told had no effect.
    Ignored(Event, Ignored),
    /// A datagram was dropped, or a message could not be sent.
    Dropped {
        /// Why.
        cause: Cause,
        /// Details of the cause.
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
    others: Others,
    /// Shortest interval that congestion control allows, in ms.
    congestion_ms: u64,
}

/// Knowledge of an endpoint besides the protocol, and its counters.
#[derive(Clone, Debug)]
struct Around {
    neighbours: Neighbours,
    surroundings: Surroundings,
    answers: Answers,
    counters: Counters,
    /// The crossing at which the robot helps; without one, at any.
    served: Option<Served>,
    /// The tasks that each follower of its plan is to do.
    needs: TaskSet,
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
                served: None,
                needs: TaskSet::EMPTY,
            },
            exchange: Exchange::new(protocol, config, identifiers, now_ms),
            pseudonyms: Pseudonyms::default(),
            others: Others::default(),
            congestion_ms: INTERVAL_MIN_MS,
        }
    }

    /// Says how people around the robot are announced, and whether it sends CAM; people known so far are
    /// forgotten.
    #[must_use]
    pub fn with_awareness(mut self, awareness: Awareness) -> Self {
        self.others = Others::new(&awareness);
        self.around.surroundings = Surroundings::new(awareness, cluster_seed(self.robot()));
        self
    }

    /// From now on the robot helps at this crossing alone; without one, at any. Requests for another one are dropped.
    pub const fn serve(&mut self, served: Option<Served>) {
        self.around.served = served;
    }

    /// From now on offers to help count that have each of these tasks, where it was asked for.
    pub const fn needs(&mut self, needs: TaskSet) {
        self.around.needs = needs;
    }

    /// Congestion control says that two CAM, or two RAM outside of a session, are at least this many ms apart.
    pub const fn hold_back(&mut self, congestion_ms: u64) {
        self.congestion_ms = congestion_ms;
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

    /// Identifiers that no standard has assigned.
    #[must_use]
    pub const fn identifiers(&self) -> &Identifiers {
        self.exchange.identifiers()
    }

    /// Local dynamic map of the road users around.
    #[must_use]
    pub const fn map(&self) -> &LocalDynamicMap {
        &self.around.neighbours.map
    }

    /// Counters of dropped and ignored inputs.
    #[must_use]
    pub const fn counters(&self) -> &Counters {
        &self.around.counters
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
        let by_protocol = by_protocol.map(|due| elapsed_to_ms.saturating_add(due.0.into()));
        let by_generation = elapsed_to_ms.saturating_add(INTERVAL_MIN_MS);
        match robot.next_ram() {
            Some(_) if !self.others.are_told() => by_protocol.unwrap_or(by_generation),
            _ => by_protocol.map_or(by_generation, |due| due.min(by_generation)),
        }
    }

    /// Takes in what happened at `moment` to a robot in `state`; the effects, in order.
    ///
    /// A clock that goes back is dropped as [`Cause::ClockWentBack`] with every call until it has caught up. Leases stand still with
    /// it, so [`Event::OpenCorridor`] has no effect meanwhile.
    pub fn handle(
        &mut self,
        moment: Moment,
        state: &RobotState,
        stimulus: Stimulus<'_>,
    ) -> Vec<Effect> {
        let mut turn = Turn::new(&mut self.around, state, moment);
        let exchange = &mut self.exchange;
        if moment.now_ms > exchange.elapsed_to_ms() {
            turn.elapse();
            exchange.elapse(&mut turn);
        }
        let behind_ms = exchange.elapsed_to_ms().saturating_sub(moment.now_ms);
        if behind_ms > 0 {
            let detail =
                format_args!("by {behind_ms} ms: give the time of a clock that is never put");
            turn.dropped(Cause::ClockWentBack, &detail, &[]);
        }
        self.pseudonyms.renew(exchange, &mut turn);
        match stimulus {
            Stimulus::Event(Event::OpenCorridor) if behind_ms > 0 => {}
            Stimulus::Datagram { packet, arrived_ms } => {
                exchange.receive(&mut turn, packet, arrived_ms);
            }
            Stimulus::Event(event) => {
                let event = self.pseudonyms.disguise(exchange, event);
                let outputs = exchange.event(&mut turn, event);
                turn.answer(event, &outputs);
            }
            Stimulus::Command {
                follower,
                task,
                parameters,
            } => {
                let outputs = exchange.command(&mut turn, follower, task, parameters);
                turn.answer(Event::CommandManeuver { follower, task }, &outputs);
            }
            Stimulus::Ask {
                vehicle,
                parameters,
            } => exchange.ask(&mut turn, vehicle, parameters),
            Stimulus::Perceived(people) => turn.perceive(people),
            Stimulus::Time => {}
        }
        let answers = &turn.around.answers;
        if answers.are_all_in(exchange.elapsed_to_ms(), exchange.robot()) {
            exchange.event(&mut turn, Event::AllAnswered);
        }
        self.others.tell_of_people(exchange, &mut turn);
        // A robot that protects somebody is not silent.
        let robot = exchange.robot();
        if robot.identity() != Identity::Unlocked
            || robot.duty().is_some()
            || turn.around.surroundings.announces()
        {
            self.pseudonyms.break_silence();
        }
        if self.pseudonyms.is_silent(moment.now_ms) {
            return turn.into_effects();
        }
        let limits = Limits {
            congestion_ms: self.congestion_ms,
            max_ms: turn.around.surroundings.ram_interval_max_ms(),
        };
        exchange.generate(&mut turn, limits);
        // After a RAM, so that robots know it is one of theirs.
        self.others
            .tell_of_robot(exchange, &mut turn, self.congestion_ms);
        turn.into_effects()
    }
}

/// Ids of clusters differ from robot to robot and from boot to boot.
fn cluster_seed(robot: &Robot) -> u64 {
    u64::from(robot.station().0) << 16 ^ u64::from(robot.boot())
}
