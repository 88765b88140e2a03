//! One robot's endpoint: the transition function joined to the wire and to generation rules.
//!
//! It does no input or output and reads no clock. Its driver says what time it is, hands it
//! datagrams and events, and carries out the effects in order:
//!
//! ```text
//!  packet ──► station ──► wire ──► inputs ─┐                    ┌─► transmit a packet
//!  event ──────────────────────────────────┼─► Robot::step ─────┼─► act (start, stop, corridor, notice)
//!  time passes ────────────────────────────┘                    └─► stepped (for the log)
//! ```

mod act;
mod answers;

use std::collections::BTreeMap;

use crossguard_codec::geonet::{EgoPosition, Indication};
use crossguard_codec::si::generation_delta_time;
use crossguard_codec::{ControlMode, RobotState, Service, TaskParameters};
use crossguard_protocol::{
    Config, Event, Identity, Input, Millis, Output, Outputs, Rmcm, Robot, StateMachine, StationId,
    TaskType, Timer,
};

pub use self::act::Act;
use self::act::act;
use self::answers::Answers;
use crate::counters::{Cause, Counters};
use crate::ras::clustering::PerceivedVru;
use crate::ras::containers;
use crate::ras::generation::{Generation, INTERVAL_MIN_MS, Limits, Status, Trigger};
use crate::ras::surroundings::{Awareness, Surroundings};
use crate::station::{Security, Station};
use crate::wire::{Heard, MessageKind, Wire};

/// What time it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Moment {
    /// Milliseconds since any fixed moment, on a clock that never goes back.
    pub now_ms: u64,
    /// `TimestampIts`: milliseconds since 2004, leap seconds counted.
    pub timestamp_its: u64,
}

/// What an endpoint is told.
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
        kind: MessageKind,
        /// Who sent it.
        from: StationId,
        /// When it arrived, on the clock of [`Moment::now_ms`].
        arrived_ms: u64,
        /// When the robot was told of it, on that clock.
        told_ms: u64,
        /// Its octets.
        octets: Vec<u8>,
    },
    /// Send this packet.
    Transmit {
        /// Which message they are.
        kind: MessageKind,
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
    protocol: P,
    config: Config,
    wire: Wire,
    station: Station,
    /// Until when the robot has been told that time passed.
    told_ms: u64,
    generation: Generation,
    /// Parameters of each follower's newest command, for its repetition.
    orders: BTreeMap<StationId, TaskParameters>,
    /// Who is around the robot.
    surroundings: Surroundings,
    /// Who has answered a request.
    answers: Answers,
    /// Shortest interval that congestion control allows, in ms.
    congestion_ms: u64,
    counters: Counters,
}

impl<P: StateMachine> Endpoint<P> {
    /// The endpoint of a robot that has just booted, at `now_ms`.
    #[must_use]
    pub fn new(protocol: P, config: Config, wire: Wire, now_ms: u64) -> Self {
        let robot = protocol.robot();
        Self {
            surroundings: Surroundings::new(Awareness::default(), cluster_seed(robot)),
            station: Station::new(&wire.identifiers, robot.station()),
            protocol,
            config,
            wire,
            told_ms: now_ms,
            generation: Generation::default(),
            orders: BTreeMap::new(),
            answers: Answers::default(),
            congestion_ms: INTERVAL_MIN_MS,
            counters: Counters::default(),
        }
    }

    /// Says how people around the robot are announced; those known so far are forgotten.
    #[must_use]
    pub fn with_awareness(mut self, awareness: Awareness) -> Self {
        self.surroundings = Surroundings::new(awareness, cluster_seed(self.robot()));
        self
    }

    /// Congestion control says that two RAM outside of a session are at least so many ms apart.
    pub fn hold_back(&mut self, congestion_ms: u64) {
        self.congestion_ms = congestion_ms;
    }

    /// The same with security.
    #[must_use]
    pub fn with_security(mut self, security: Security) -> Self {
        self.station = self.station.with_security(security, self.told_ms);
        self
    }

    /// The protocol state.
    #[must_use]
    pub fn robot(&self) -> &Robot {
        self.protocol.robot()
    }

    /// The configuration.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// What encodes and decodes its messages.
    #[must_use]
    pub const fn wire(&self) -> &Wire {
        &self.wire
    }

    /// The ITS station under it.
    #[must_use]
    pub const fn station(&self) -> &Station {
        &self.station
    }

    /// What was dropped or ignored so far.
    #[must_use]
    pub const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Whether the robot asks for help, has offers enough, and has heard an answer of every robot that it heard
    /// in the last second: then [`Event::AllAnswered`] may be told.
    #[must_use]
    pub fn all_have_answered(&self) -> bool {
        self.answers.are_all_in(self.told_ms, self.robot())
    }

    /// Counts something that was dropped outside of the endpoint.
    pub fn count(&mut self, cause: Cause) {
        self.counters.count(cause);
    }

    /// When the endpoint must be told at the latest that time has passed, in ms on its clock.
    #[must_use]
    pub fn next_wakeup_ms(&self) -> u64 {
        let by_protocol = self
            .robot()
            .next_due()
            .map(|due| self.told_ms + u64::from(due.0));
        let by_generation = self.told_ms + INTERVAL_MIN_MS;
        match self.robot().next_ram() {
            Some(_) => by_protocol.unwrap_or(by_generation),
            None => by_protocol.map_or(by_generation, |due| due.min(by_generation)),
        }
    }

    /// Takes in what happened at `moment` to a robot in `state`; the effects, in order.
    pub fn handle(
        &mut self,
        moment: Moment,
        state: &RobotState,
        stimulus: Stimulus<'_>,
    ) -> Vec<Effect> {
        let mut turn = Turn {
            moment,
            control_mode: state.control_mode,
            state: state.clone(),
            effects: Vec::new(),
        };
        self.complete(&mut turn);
        self.elapse(&mut turn);
        self.renew_pseudonym(&mut turn);
        match stimulus {
            Stimulus::Datagram { packet, arrived_ms } => {
                self.hear(&mut turn, packet, arrived_ms);
            }
            Stimulus::Event(Event::CommandManeuver { follower, task }) => {
                self.order(&mut turn, follower, task, TaskParameters::default());
            }
            Stimulus::Event(event) => self.tell(&mut turn, event),
            Stimulus::Order {
                follower,
                task,
                parameters,
            } => {
                self.order(&mut turn, follower, task, parameters);
            }
            Stimulus::Perceived(people) => self.perceive(&mut turn, people),
            Stimulus::Timer(timer) => {
                self.step(&mut turn, Input::Expired(timer), None);
            }
            Stimulus::Time => {}
        }
        self.generate(&mut turn);
        turn.effects
    }

    /// Puts into the application's state what the protocol knows better now.
    fn complete(&self, turn: &mut Turn) {
        turn.state.control_mode = turn.control_mode;
        turn.state.correct(self.robot(), &self.config);
    }

    /// Tells the robot how much time has passed since it was told the last time.
    fn elapse(&mut self, turn: &mut Turn) {
        let elapsed = turn.moment.now_ms.saturating_sub(self.told_ms);
        if elapsed == 0 {
            return;
        }
        self.told_ms = turn.moment.now_ms;
        self.station.elapse(turn.moment.now_ms);
        self.surroundings.elapse(turn.moment.now_ms);
        let elapsed = u32::try_from(elapsed).unwrap_or(u32::MAX);
        self.step(turn, Input::Elapsed(Millis(elapsed)), None);
    }

    /// Changes the pseudonym when that is due and no session knows the robot by its old one.
    fn renew_pseudonym(&mut self, turn: &mut Turn) {
        let lock_ms = u64::from(self.config.settings().t_lock.0);
        if self.robot().identity() != Identity::Unlocked {
            return;
        }
        let (ego, now_ms) = (turn.ego(), turn.moment.now_ms);
        if let Some(station) = self.station.renew_pseudonym(&ego, now_ms, lock_ms) {
            let changed = Input::Local(Event::IdentityChanged(station));
            self.step(turn, changed, None);
        }
    }

    /// Takes a packet in, if it is for this station and has not waited for too long.
    fn hear(&mut self, turn: &mut Turn, packet: &[u8], arrived_ms: u64) {
        let waited_ms = turn.moment.now_ms.saturating_sub(arrived_ms);
        let delay_max_ms = self.config.settings().delay_max.0;
        if waited_ms > u64::from(delay_max_ms) {
            let detail = format!("for {waited_ms} ms; delay_max is {delay_max_ms} ms");
            return self.drop(turn, Cause::WaitedTooLong, detail, packet.to_vec());
        }
        let ego = turn.ego();
        match self.station.receive(&ego, packet) {
            Ok(indication) => self.hear_message(turn, packet, arrived_ms, &indication),
            Err(discarded) => {
                let detail = discarded.to_string();
                self.drop(turn, discarded.into(), detail, packet.to_vec());
            }
        }
    }

    fn hear_message(
        &mut self,
        turn: &mut Turn,
        packet: &[u8],
        arrived_ms: u64,
        indication: &Indication<'_>,
    ) {
        let (service, octets) = (indication.service, indication.message);
        let dropped = match service {
            Service::Ram | Service::Rmcm => {
                match self.wire.hear(self.robot().station(), &turn.state, octets) {
                    Ok(heard) if heard.service == service => {
                        let sender = (indication.signer, indication.permits);
                        let now_ms = turn.moment.now_ms;
                        match self.station.check_entitled(sender, &heard, now_ms) {
                            Ok(()) => return self.heed(turn, octets, arrived_ms, &heard),
                            Err(why) => (Cause::Rejected(why.cause()), why.to_string()),
                        }
                    }
                    Ok(heard) => (
                        Cause::Discarded("message of another port"),
                        format!("{} at the port of {}", heard.service.name(), service.name()),
                    ),
                    Err(unheard) => ((&unheard).into(), unheard.to_string()),
                }
            }
            Service::Cam | Service::Denm | Service::Vam | Service::Cpm => {
                let (ego, now_ms) = (turn.ego(), turn.moment.now_ms);
                match self.station.observe(service, octets, &ego, now_ms) {
                    // An event is nobody for the map, and changes nothing that the robot does.
                    Ok(message) => match message.event() {
                        Some(event) => (Cause::NoUse(service), event.to_string()),
                        None => return,
                    },
                    Err(unobserved) => ((&unobserved).into(), unobserved.to_string()),
                }
            }
        };
        self.drop(turn, dropped.0, dropped.1, packet.to_vec());
    }

    /// What a robot's message means to the transition function.
    fn heed(&mut self, turn: &mut Turn, octets: &[u8], arrived_ms: u64, heard: &Heard) {
        turn.effects.push(Effect::Heard {
            kind: heard.service,
            from: heard.from,
            arrived_ms: arrived_ms.min(turn.moment.now_ms),
            told_ms: turn.moment.now_ms,
            octets: octets.to_vec(),
        });
        if let Some(state) = &heard.state {
            let (ego, now_ms) = (turn.ego(), turn.moment.now_ms);
            self.station.observe_robot(heard, &ego, now_ms);
            let (from, position) = (heard.from.0, &state.position);
            if let Some(plane) = self.surroundings.plane() {
                let cluster = heard.cluster.as_ref();
                let cluster = cluster.and_then(|it| containers::on_plane(it, position, plane));
                let own = self.robot().station().0;
                self.surroundings.hear(now_ms, own, from, cluster.as_ref());
            }
        }
        for input in heard.inputs.iter() {
            if let Input::Ram { ram, .. } = input {
                self.answers.hear(turn.moment.now_ms, ram);
            }
            self.step(turn, *input, heard.parameters);
        }
    }

    fn perceive(&mut self, turn: &mut Turn, people: &[PerceivedVru]) {
        let (now_ms, position) = (turn.moment.now_ms, turn.state.position);
        if let Err(unplaced) = self.surroundings.perceive(now_ms, &position, people) {
            self.drop(turn, Cause::Unplaced, unplaced.to_string(), Vec::new());
        }
    }

    fn tell(&mut self, turn: &mut Turn, event: Event) {
        let outputs = self.step(turn, Input::Local(event), None);
        if let Some(reason) = outputs.ignored() {
            turn.effects.push(Effect::Act(Act::Ignored(event, reason)));
        }
    }

    fn order(
        &mut self,
        turn: &mut Turn,
        follower: StationId,
        task: TaskType,
        parameters: TaskParameters,
    ) {
        let before = self.orders.insert(follower, parameters);
        let event = Event::CommandManeuver { follower, task };
        self.tell(turn, event);
        let is_ignored = matches!(turn.effects.last(), Some(Effect::Act(Act::Ignored(ignored, _))) if *ignored == event);
        if is_ignored && let Some(before) = before {
            // The command that is outstanding keeps its own parameters.
            self.orders.insert(follower, before);
        }
    }

    /// A step of the transition function, and what follows from it. `parameters` are those of the
    /// command that `input` may be.
    fn step(
        &mut self,
        turn: &mut Turn,
        input: Input,
        parameters: Option<TaskParameters>,
    ) -> Outputs {
        let outputs = self.protocol.step(&self.config, input);
        // What is sent with a step says how the robot is after it.
        self.complete(turn);
        let state = Box::new(self.robot().clone());
        turn.effects.push(Effect::Stepped {
            input,
            outputs: Box::new(outputs),
            state,
        });
        for output in outputs.iter() {
            match *output {
                Output::SendRam => {
                    let event = self.generation.event(&self.status(&turn.state));
                    self.send_ram(turn, event.unwrap_or(Trigger::Heartbeat));
                }
                Output::SendRmcm(rmcm) => self.send_rmcm(turn, rmcm),
                Output::Ignored(reason) => self.counters.count(Cause::Ignored(reason)),
                output => {
                    let act = act(output, parameters.unwrap_or_default());
                    turn.effects.extend(act.map(Effect::Act));
                }
            }
        }
        outputs
    }

    fn send_ram(&mut self, turn: &mut Turn, trigger: Trigger) {
        let now_ms = turn.moment.now_ms;
        let low_frequency = self.generation.low_frequency_due(now_ms);
        let cluster = self.surroundings.next_cluster();
        let status = self.status(&turn.state);
        let octets = self.wire.ram(
            &turn.state,
            &status.view,
            status.availability,
            turn.generation_delta_time(),
            low_frequency,
            cluster.as_ref().zip(self.surroundings.plane()),
        );
        self.generation
            .sent(now_ms, trigger, &turn.state, status, low_frequency);
        self.transmit(turn, MessageKind::Ram, trigger, octets);
    }

    fn send_rmcm(&mut self, turn: &mut Turn, rmcm: Rmcm) {
        let time = turn.generation_delta_time();
        let octets = match rmcm {
            Rmcm::Command(command) => {
                let parameters = self.orders.get(&command.to).copied().unwrap_or_default();
                self.wire.command(&turn.state, command, parameters, time)
            }
            Rmcm::Answer(answer) => self.wire.answer(&turn.state, answer, time),
        };
        self.transmit(turn, MessageKind::Rmcm, Trigger::Protocol, octets);
    }

    fn transmit(
        &mut self,
        turn: &mut Turn,
        kind: MessageKind,
        trigger: Trigger,
        octets: Result<Vec<u8>, impl std::fmt::Display>,
    ) {
        let outcome = octets
            .map_err(|error| error.to_string())
            .and_then(|octets| {
                let packet = self.station.send(&turn.ego(), kind, &octets);
                let packet = packet.map_err(|error| error.to_string())?;
                Ok((octets, packet))
            });
        match outcome {
            Ok((octets, packet)) => turn.effects.push(Effect::Transmit {
                kind,
                trigger,
                octets,
                packet,
            }),
            Err(error) => self.drop(turn, Cause::NotSent, error, Vec::new()),
        }
    }

    fn drop(&mut self, turn: &mut Turn, cause: Cause, detail: String, octets: Vec<u8>) {
        self.counters.count(cause);
        turn.effects.push(Effect::Dropped {
            cause,
            detail,
            octets,
        });
    }

    /// Sends what is due by the generation rules: cluster VAM, and outside of a session RAM.
    fn generate(&mut self, turn: &mut Turn) {
        let (moment, own) = (turn.moment, self.robot().station().0);
        let position = turn.state.position;
        let ids = &self.wire.identifiers;
        let (now_ms, now_its) = (moment.now_ms, moment.timestamp_its);
        let vams = self
            .surroundings
            .cluster_vams(ids, now_ms, now_its, own, &position);
        for (_, vam) in vams {
            self.transmit(turn, MessageKind::Vam, Trigger::Interval, vam);
        }
        if self.robot().next_ram().is_some() {
            return;
        }
        let (now_ms, status) = (turn.moment.now_ms, self.status(&turn.state));
        let limits = Limits {
            congestion_ms: self.congestion_ms,
            max_ms: self.surroundings.ram_interval_max_ms(),
        };
        if let Some(trigger) = self
            .generation
            .trigger(now_ms, limits, &turn.state, &status)
        {
            self.send_ram(turn, trigger);
        }
    }

    /// What a RAM says now that events are about.
    fn status(&self, state: &RobotState) -> Status {
        Status {
            view: self.robot().ram(),
            availability: self.robot().availability(),
            progression: state.task_progression,
        }
    }
}

/// What one call of [`Endpoint::handle`] works with.
struct Turn {
    moment: Moment,
    /// How the application says that the robot is steered.
    control_mode: ControlMode,
    /// The application's state, completed.
    state: RobotState,
    effects: Vec<Effect>,
}

impl Turn {
    fn generation_delta_time(&self) -> u16 {
        generation_delta_time(self.moment.timestamp_its)
    }

    /// Where the robot is, for its packets.
    fn ego(&self) -> EgoPosition {
        EgoPosition::of(&self.state, self.moment.timestamp_its)
    }
}

/// Ids of clusters differ from robot to robot and from boot to boot.
fn cluster_seed(robot: &Robot) -> u64 {
    u64::from(robot.station().0) << 16 ^ u64::from(robot.boot())
}
