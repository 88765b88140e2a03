//! The transition function joined to the packets of RAM and RMCM, without heap, clock, input and output.
//!
//! [`Endpoint`](crate::Endpoint) and the C library are this exchange in a [`Host`] of their own:
//!
//! ```text
//!  packet ──► stack ──► message ──► inputs ─┐                   ┌─► transmit a packet
//!  event ───────────────────────────────────┼─► Robot::step ────┼─► act
//!  time ────────────────────────────────────┘                   └─► stepped (for the log)
//! ```

mod accepted;
mod entitled;
mod host;
mod parameters;
mod pins;

use crossguard_codec::geonet::{Address, Indication, Stack};
use crossguard_codec::si::generation_delta_time;
use crossguard_codec::{
    ExecutionStatus, Heard, Identifiers, Pdu, RAM_LEN_MAX, RMCM_LEN_MAX, RobotState, Service,
    TaskParameters, ViewError, encode_into, ram_from, rmcm_from_answer, rmcm_from_commands,
};
use crossguard_protocol::{
    Command, Config, Coordination, Event, Input, Millis, Output, Outputs, Phase, Place, RequestId,
    Rmcm, Robot, SessionId, StateMachine, StationId, TaskSet, TaskType, UniqueNumber, Verdict,
};

pub use self::accepted::Accepted;
pub use self::entitled::NotEntitled;
use self::entitled::check_entitled;
pub use self::host::{Host, Moment, Outgoing};
use self::parameters::Parameters;
use self::pins::Pins;
use crate::cause::Cause;
use crate::ras::generation::{Generation, Limits, Status, Trigger};

/// An RMCM is sent when the protocol says so, or a vehicle is asked.
const RMCM: (Service, Trigger) = (Service::Rmcm, Trigger::Protocol);

/// One robot's transition function with its packets.
#[derive(Clone, Debug)]
pub struct Exchange<P = Robot> {
    protocol: P,
    config: Config,
    identifiers: Identifiers,
    pub(crate) stack: Stack,
    /// Until when the robot knows that time passed.
    elapsed_to_ms: u64,
    generation: Generation,
    parameters: Parameters,
    pins: Pins,
    accepted: Accepted,
    asked: Option<Command>,
}

impl<P: StateMachine> Exchange<P> {
    /// The exchange of a robot that has just booted, at `now_ms`, without security.
    pub fn new(protocol: P, config: Config, identifiers: Identifiers, now_ms: u64) -> Self {
        let station = protocol.robot().station();
        Self {
            protocol,
            config,
            identifiers,
            stack: Stack::of_robot(identifiers, station),
            elapsed_to_ms: now_ms,
            generation: Generation::default(),
            parameters: Parameters::default(),
            pins: Pins::default(),
            accepted: Accepted::default(),
            asked: None,
        }
    }

    /// The protocol state.
    pub fn robot(&self) -> &Robot {
        self.protocol.robot()
    }

    /// The configuration.
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// Identifiers that no standard has assigned.
    pub const fn identifiers(&self) -> &Identifiers {
        &self.identifiers
    }

    /// Until when the robot knows that time passed, on the clock of [`Moment::now_ms`].
    pub const fn elapsed_to_ms(&self) -> u64 {
        self.elapsed_to_ms
    }

    /// Lets the time pass until that of the host.
    pub fn elapse<H: Host>(&mut self, host: &mut H) {
        let now_ms = host.moment().now_ms;
        let elapsed = now_ms.saturating_sub(self.elapsed_to_ms);
        if elapsed > 0 {
            self.elapsed_to_ms = now_ms;
            let elapsed = u32::try_from(elapsed).unwrap_or(u32::MAX);
            self.step(host, Input::Elapsed(Millis(elapsed)), None);
        }
    }

    /// Something happened in the robot. A maneuver is commanded without parameters.
    pub fn event<H: Host>(&mut self, host: &mut H, event: Event) -> Outputs {
        match event {
            Event::CommandManeuver { follower, task } => {
                self.command(host, follower, task, TaskParameters::default())
            }
            Event::IdentityChanged(station, next) => self.change_identity(host, station, next),
            event => self.step(host, Input::Local(event), None),
        }
    }

    /// The application commands a maneuver.
    pub fn command<H: Host>(
        &mut self,
        host: &mut H,
        follower: StationId,
        task: TaskType,
        parameters: TaskParameters,
    ) -> Outputs {
        let before = self.parameters;
        let phase = self.protocol.robot().phase();
        let follows = |it| matches!(phase, Phase::Leading(leading) if leading.member(it).is_some());
        self.parameters.put(follower, parameters, follows);
        let event = Event::CommandManeuver { follower, task };
        let outputs = self.step(host, Input::Local(event), None);
        if outputs.ignored().is_some() {
            // The command that is outstanding keeps its own parameters.
            self.parameters = before;
        }
        outputs
    }

    /// Asks a vehicle that does not follow whether it will stop: a command to block its direction, which it accepts or rejects as a
    /// follower does. Each question has a number of its own, so that an answer to an older one is none. A robot that does not lead
    /// asks nobody.
    pub fn ask<H: Host>(&mut self, host: &mut H, vehicle: StationId, parameters: TaskParameters) {
        let Phase::Leading(leading) = self.robot().phase() else {
            return;
        };
        let number = self.asked.map_or(0, |it| it.request.0.wrapping_add(1));
        let command = Command {
            session: SessionId {
                leader: self.robot().station(),
                number: leading.number,
            },
            to: vehicle,
            request: RequestId(number),
            task: TaskType::BLOCK,
        };
        self.asked = Some(command);
        self.send_commands(host, &[(command, parameters)]);
    }

    /// Whether a message answers the newest question to a vehicle, and what it says.
    fn answers_question(&self, input: &Input) -> Option<bool> {
        let (Input::Rmcm(Rmcm::Answer(answer)), Some(asked)) = (input, self.asked) else {
            return None;
        };
        let is_own = (answer.from, answer.session, answer.request)
            == (asked.to, asked.session, asked.request);
        is_own.then_some(answer.verdict == Verdict::Accepted)
    }

    /// The robot goes by another station id and address. Its session and offer numbers begin at `next`, or go on
    /// without one.
    pub fn change_identity<H: Host>(
        &mut self,
        host: &mut H,
        station: StationId,
        next: Option<UniqueNumber>,
    ) -> Outputs {
        let changed = Input::Local(Event::IdentityChanged(station, next));
        let outputs = self.step(host, changed, None);
        if outputs.ignored().is_none() {
            let address = Address::of_station(station.0, self.identifiers.robot_station_type);
            self.stack.change_address(address);
        }
        outputs
    }

    /// A packet arrived, at this time on the clock of [`Moment::now_ms`].
    pub fn receive<H: Host>(&mut self, host: &mut H, packet: &[u8], arrived_ms: u64) {
        if self.has_waited_too_long(host, packet, arrived_ms) {
            return;
        }
        let ego = host.ego();
        match self.stack.receive(&ego, packet) {
            Ok(indication) => match indication.service {
                Service::Ram | Service::Rmcm => {
                    self.understand(host, packet, arrived_ms, Some(&indication));
                }
                _ => host.other(self.protocol.robot(), &indication, packet, arrived_ms),
            },
            Err(discarded) => host.dropped(discarded.into(), &discarded, packet),
        }
    }

    /// A message arrived, which another stack has taken out of its packet.
    pub fn receive_message<H: Host>(&mut self, host: &mut H, message: &[u8], arrived_ms: u64) {
        if !self.has_waited_too_long(host, message, arrived_ms) {
            self.understand(host, message, arrived_ms, None);
        }
    }

    /// Drops octets that waited for longer than the timers allow.
    fn has_waited_too_long<H: Host>(&self, host: &mut H, octets: &[u8], arrived_ms: u64) -> bool {
        let delay_max_ms = self.config.settings().delay_max.0;
        let waited_ms = host.moment().now_ms.saturating_sub(arrived_ms);
        let is_too_long = waited_ms > u64::from(delay_max_ms);
        if is_too_long {
            let detail = format_args!("for {waited_ms} ms; delay_max is {delay_max_ms} ms");
            host.dropped(Cause::WaitedTooLong, &detail, octets);
        }
        is_too_long
    }

    /// Takes in a message, which stands in a packet if there is an indication.
    fn understand<H: Host>(
        &mut self,
        host: &mut H,
        octets: &[u8],
        arrived_ms: u64,
        indication: Option<&Indication<'_>>,
    ) {
        let message = indication.map_or(octets, |indication| indication.message);
        let me = self.protocol.robot();
        let position = &host.state().position;
        let heard = match Heard::of(&self.identifiers, me.station(), position, message) {
            Ok(heard) => heard,
            Err(unheard) => return host.dropped((&unheard).into(), &unheard, octets),
        };
        if let Some(indication) = indication {
            if indication.service != heard.service {
                let (found, port) = (heard.service.name(), indication.service.name());
                let detail = format_args!("{found} at the port of {port}");
                let cause = Cause::Discarded("message of another port");
                return host.dropped(cause, &detail, octets);
            }
            let entitled = check_entitled(host, &self.identifiers, indication, &heard);
            if let Err(why) = entitled {
                return host.dropped(why.into(), &why, octets);
            }
        }
        let signer = indication.and_then(|indication| indication.signer);
        if !self.pins.allow(self.protocol.robot(), heard.from, signer) {
            let why = NotEntitled::Unpinned(heard.from);
            return host.dropped(why.into(), &why, octets);
        }
        if let Some((place, leads)) = claimed(me, &heard)
            && !host.is_here(place, leads, &heard)
        {
            let does = if leads { "leads" } else { "asks" };
            let detail = format_args!("station {} {does} at {place}", heard.from);
            return host.dropped(Cause::OtherCrossing, &detail, octets);
        }
        let lacking = host.lacks(unoffered(me, &heard), &heard);
        if !lacking.is_empty() {
            let detail = format_args!("station {} cannot {lacking}", heard.from);
            return host.dropped(Cause::Unfit, &detail, octets);
        }
        host.heard(me, &heard, message, arrived_ms);
        for input in heard.inputs.iter() {
            let me = self.protocol.robot();
            if self.accepted.is_contradicted(me, input, heard.parameters) {
                let cause = Cause::Contradictory("another command under its requestID");
                let detail =
                    "a command that differs from one that was accepted takes the next requestID";
                host.dropped(cause, &detail, message);
                continue;
            }
            if let Some(promises) = self.answers_question(input) {
                host.answered(heard.from, promises);
                continue;
            }
            self.step(host, *input, heard.parameters);
            let me = self.protocol.robot();
            self.accepted.learn(me, input, heard.parameters);
        }
        self.pins.keep(self.protocol.robot(), heard.from, signer);
    }

    /// Sends a RAM outside of a session, where the protocol does not say when, if the generation rules do.
    pub fn generate<H: Host>(&mut self, host: &mut H, limits: Limits) {
        if self.robot().next_ram().is_none() {
            let (state, status) = self.said(host);
            let trigger = self
                .generation
                .trigger(host.moment().now_ms, limits, &state, &status);
            if let Some(trigger) = trigger {
                self.send_ram(host, trigger, &state, status);
            }
        }
    }

    /// Sends a RAM outside of a session now.
    pub fn announce<H: Host>(&mut self, host: &mut H) {
        if self.robot().next_ram().is_none() {
            let (state, status) = self.said(host);
            self.send_ram(host, Trigger::Interval, &state, status);
        }
    }

    /// A step of the transition function, and what follows from it. `parameters` are those of the command
    /// that the input may be.
    fn step<H: Host>(
        &mut self,
        host: &mut H,
        input: Input,
        parameters: Option<TaskParameters>,
    ) -> Outputs {
        let outputs = self.protocol.step(&self.config, input);
        host.stepped(&input, &outputs, self.protocol.robot());
        for output in outputs.iter() {
            match output {
                Output::SendRam => {
                    let (state, status) = self.said(host);
                    let event = self.generation.event(&status);
                    let trigger = event.unwrap_or(Trigger::Heartbeat);
                    self.send_ram(host, trigger, &state, status);
                }
                Output::SendRmcm(rmcm) => self.send_rmcm(host, rmcm),
                output => {
                    if let Output::Ignored(why) = output {
                        host.ignored((*why).into());
                    }
                    host.act(output, parameters.unwrap_or_default());
                }
            }
        }
        outputs
    }

    fn send_ram<H: Host>(
        &mut self,
        host: &mut H,
        trigger: Trigger,
        state: &RobotState,
        status: Status,
    ) {
        let Moment {
            now_ms,
            timestamp_its,
        } = host.moment();
        let low_frequency = self.generation.low_frequency_due(now_ms, state);
        let time = generation_delta_time(timestamp_its);
        let (ids, availability) = (&self.identifiers, status.availability);
        let ram = ram_from(ids, state, &status.view, availability, time, low_frequency);
        let ram = ram.map(|mut ram| {
            host.complete(&mut ram);
            ram
        });
        self.generation
            .sent(now_ms, trigger, state, status, low_frequency);
        self.send::<_, _, RAM_LEN_MAX>(host, (Service::Ram, trigger), ram);
    }

    fn send_rmcm<H: Host>(&mut self, host: &mut H, rmcm: &Rmcm) {
        match rmcm {
            Rmcm::Command(command) => {
                self.send_commands(host, &[(*command, self.parameters.of(command.to))]);
            }
            Rmcm::Answer(answer) => {
                let state = self.state(host);
                let status = ExecutionStatus {
                    progression: state.task_progression,
                    time_to_completion: None,
                };
                let time = generation_delta_time(host.moment().timestamp_its);
                let (ids, position) = (&self.identifiers, &state.position);
                let message = rmcm_from_answer(ids, position, answer, status, time);
                self.send::<_, _, RMCM_LEN_MAX>(host, RMCM, message);
            }
        }
    }

    fn send_commands<H: Host>(&mut self, host: &mut H, commands: &[(Command, TaskParameters)]) {
        let time = generation_delta_time(host.moment().timestamp_its);
        let (ids, position) = (&self.identifiers, &host.state().position);
        let message = rmcm_from_commands(ids, position, commands, time);
        self.send::<_, _, RMCM_LEN_MAX>(host, RMCM, message);
    }

    fn send<H: Host, M: Pdu, const LEN: usize>(
        &mut self,
        host: &mut H,
        kind: (Service, Trigger),
        message: Result<M, ViewError>,
    ) {
        let message = match message {
            Ok(message) => message,
            Err(error) => return host.dropped(Cause::NotSent, &error, &[]),
        };
        let mut octets = [0; LEN];
        match encode_into(&self.identifiers, &message, &mut octets) {
            Ok(length) => self.transmit(host, kind, &octets[..length]),
            Err(error) => host.dropped(Cause::NotSent, &error, &[]),
        }
    }

    /// Sends a message of a service in a packet.
    pub fn transmit<H: Host>(
        &mut self,
        host: &mut H,
        (service, trigger): (Service, Trigger),
        message: &[u8],
    ) {
        let request = &service.request(&self.identifiers);
        let ego = host.ego();
        match self.stack.send(&ego, request, message, host.room()) {
            Ok(packet_len) => host.transmit(Outgoing {
                service,
                trigger,
                message,
                request,
                packet_len,
            }),
            Err(error) => host.dropped(Cause::NotSent, &error, &[]),
        }
    }

    /// The application's state, with what the protocol knows better.
    fn state<H: Host>(&self, host: &H) -> RobotState {
        let mut state = host.state().clone();
        state.correct(self.robot(), &self.config);
        state
    }

    /// Content of a RAM now: the state, and the status that events compare.
    fn said<H: Host>(&self, host: &H) -> (RobotState, Status) {
        let state = self.state(host);
        let status = Status {
            view: self.robot().ram(),
            availability: self.robot().availability(),
            progression: state.task_progression,
        };
        (state, status)
    }
}

/// The crossing that a message is about, by which it may make this robot help or withdraw: it asks for help there, or leads there
/// (`true`).
fn claimed(me: &Robot, heard: &Heard) -> Option<(Place, bool)> {
    let claim = |input: &Input| match input {
        Input::Ram { ram, .. } => match (ram.coordination, me.phase()) {
            (Coordination::NeedHelp { request, .. }, Phase::Idle | Phase::Requesting(_)) => {
                Some((request.place, false))
            }
            // One that lists this robot is answered, wherever it leads.
            (
                Coordination::Leader {
                    place, followers, ..
                },
                Phase::Requesting(_) | Phase::Leading(_),
            ) if followers.iter().all(|it| it.station != me.station()) => Some((place, true)),
            _ => None,
        },
        Input::Rmcm(_) | Input::Elapsed(_) | Input::Expired(_) | Input::Local(_) => None,
    };
    heard.inputs.iter().find_map(claim)
}

/// The tasks that this robot has asked for and that are not in an offer to it.
fn unoffered(me: &Robot, heard: &Heard) -> TaskSet {
    let Phase::Requesting(requesting) = me.phase() else {
        return TaskSet::EMPTY;
    };
    let own = SessionId::of(me.station(), requesting.number);
    let unoffered = heard.inputs.iter().find_map(|input| match input {
        Input::Ram { ram, .. } => match ram.coordination {
            Coordination::OfferHelp {
                session,
                capabilities,
                ..
            } if session == own => Some(requesting.request.tasks.without(capabilities)),
            _ => None,
        },
        _ => None,
    });
    unoffered.unwrap_or(TaskSet::EMPTY)
}
