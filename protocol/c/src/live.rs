//! A robot: the transition function, its packets and what is counted, without input and output.
//!
//! ```text
//!  packet ──► stack ──► message ──► inputs ─┐                   ┌─► packets: RAM and RMCM, ready to send
//!  event ───────────────────────────────────┼─► Robot::step ────┼─► outputs, in order
//!  elapsed time ────────────────────────────┘                   └─► log lines
//! ```

use core::ffi::c_char;
use core::fmt::Display;

use crossguard_codec::geonet::{Address, EgoPosition, Envelope, PACKET_LEN_MAX, Stack};
use crossguard_codec::si::generation_delta_time;
use crossguard_codec::{
    ExecutionStatus, Heard, Identifiers, RAM_LEN_MAX, RMCM_LEN_MAX, RobotState, Service,
    TaskParameters, encode_into, ram_from, rmcm_from_answer, rmcm_from_commands,
};
use crossguard_protocol::{
    Config, Event, Input, MAX_FOLLOWERS, MAX_OUTPUTS, Millis, Output, Outputs, Phase, Rmcm, Robot,
    StationId,
};

use crate::abi::{
    CROSSGUARD_FOLLOWERS_MAX, CROSSGUARD_NONE_MS, CROSSGUARD_OUTPUTS_MAX, CROSSGUARD_PACKETS_LEN,
    CrossguardHeard, CrossguardMessage, CrossguardOutput, CrossguardOutputKind, CrossguardTurn,
};
use crate::cause::{Cause, Counters, Text};
use crate::config::{Checked, Name};
use crate::trace::{Entry, Lines};

/// Milliseconds between two low-frequency containers of a RAM.
const LOW_FREQUENCY_MS: u64 = 500;
/// Headers of a single-hop broadcast with BTP-B, in octets.
const HEADERS_LEN: usize = 44;

// A message of several commands is one step for each of them, and one of them at most is for this robot:
// the others are ignored with one output.
const _: () = assert!(CROSSGUARD_OUTPUTS_MAX >= MAX_OUTPUTS + MAX_FOLLOWERS);
const _: () = assert!(CROSSGUARD_FOLLOWERS_MAX == MAX_FOLLOWERS);
// At most one RAM and one RMCM to each follower leave one step.
const _: () = assert!(
    CROSSGUARD_PACKETS_LEN
        >= 2 * (HEADERS_LEN + RAM_LEN_MAX) + MAX_FOLLOWERS * (HEADERS_LEN + RMCM_LEN_MAX)
);

/// What a call works with.
pub(crate) struct Turn<'a> {
    pub(crate) plain: &'a mut CrossguardTurn,
    pub(crate) packets: &'a mut [u8],
    pub(crate) lines: Lines<'a>,
    /// What the robot knows of its body.
    pub(crate) state: RobotState,
}

impl Turn<'_> {
    fn ego(&self) -> EgoPosition {
        EgoPosition::of(&self.state, self.plain.timestamp_its)
    }

    fn push(&mut self, output: CrossguardOutput) {
        let length = self.plain.outputs_length as usize;
        // There is always room, see above.
        if let Some(slot) = self.plain.outputs.get_mut(length) {
            *slot = output;
            self.plain.outputs_length += 1;
        }
    }
}

/// One robot.
pub(crate) struct Live {
    robot: Robot,
    config: Config,
    identifiers: Identifiers,
    name: Name,
    stack: Stack,
    /// Parameters of each follower's newest command, for its repetition.
    orders: [Option<(StationId, TaskParameters)>; MAX_FOLLOWERS],
    /// For how long the robot has been running, by what it was told.
    told_ms: u64,
    /// When the last low-frequency container went out.
    low_frequency_ms: Option<u64>,
    counters: Counters,
}

impl Live {
    pub(crate) fn new(station: u32, boot: u16, checked: Checked) -> Self {
        let Checked {
            config,
            identifiers,
            name,
        } = checked;
        let address = Address::of_station(station, identifiers.robot_station_type);
        Self {
            robot: Robot::new(StationId(station), boot),
            config,
            identifiers,
            name,
            stack: Stack::new(identifiers, address, Envelope::Off),
            orders: [None; MAX_FOLLOWERS],
            told_ms: 0,
            low_frequency_ms: None,
            counters: Counters::NONE,
        }
    }

    pub(crate) const fn robot(&self) -> &Robot {
        &self.robot
    }

    pub(crate) const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Lets time pass.
    pub(crate) fn elapse(&mut self, elapsed_ms: u32, turn: &mut Turn<'_>) {
        if elapsed_ms > 0 {
            self.told_ms += u64::from(elapsed_ms);
            self.step(turn, Input::Elapsed(Millis(elapsed_ms)), None);
        }
    }

    /// Tells an event; `parameters` are those of a command.
    pub(crate) fn tell(&mut self, event: Event, parameters: TaskParameters, turn: &mut Turn<'_>) {
        let input = Input::Local(event);
        match event {
            Event::CommandManeuver { follower, .. } => {
                let before = self.orders;
                self.remember(follower, parameters);
                if self.step(turn, input, None).ignored().is_some() {
                    // The command that is outstanding keeps its own parameters.
                    self.orders = before;
                }
            }
            Event::IdentityChanged(station) => {
                if self.step(turn, input, None).ignored().is_none() {
                    let station_type = self.identifiers.robot_station_type;
                    let address = Address::of_station(station.0, station_type);
                    // Only geo-broadcasts are numbered, and none is sent.
                    self.stack.change_address(address, 0);
                }
            }
            _ => {
                self.step(turn, input, None);
            }
        }
    }

    /// Keeps the parameters of a command in the place of older ones, or of those for who does not follow.
    fn remember(&mut self, follower: StationId, parameters: TaskParameters) {
        let follows = |station: StationId| match self.robot.phase() {
            Phase::Leading(leading) => leading.member(station).is_some(),
            _ => false,
        };
        let mut place = None;
        for (i, order) in self.orders.iter().enumerate() {
            match order {
                Some((station, _)) if *station == follower => {
                    place = Some(i);
                    break;
                }
                Some((station, _)) if follows(*station) => {}
                _ => place = place.or(Some(i)),
            }
        }
        if let Some(place) = place {
            self.orders[place] = Some((follower, parameters));
        }
    }

    fn parameters(&self, follower: StationId) -> TaskParameters {
        let orders = self.orders.iter().flatten();
        let mut of_follower = orders.filter(|(station, _)| *station == follower);
        of_follower
            .next()
            .map(|(_, parameters)| *parameters)
            .unwrap_or_default()
    }

    /// Takes a packet in, if it has not waited for too long.
    pub(crate) fn receive(&mut self, packet: &[u8], turn: &mut Turn<'_>) {
        if self.has_waited_too_long(packet, turn) {
            return;
        }
        let indication = match self.stack.receive(&turn.ego(), packet) {
            Ok(indication) => indication,
            Err(discarded) => return self.drop(turn, discarded.into(), &discarded, packet),
        };
        match indication.service {
            Service::Ram | Service::Rmcm => {
                self.understand(indication.message, Some(indication.service), turn);
            }
            other => self.drop(
                turn,
                Cause::NoUse(other),
                &"the robot does not take it in",
                packet,
            ),
        }
    }

    /// Takes a message in, if it has not waited for too long.
    pub(crate) fn hear(&mut self, octets: &[u8], turn: &mut Turn<'_>) {
        if !self.has_waited_too_long(octets, turn) {
            self.understand(octets, None, turn);
        }
    }

    /// Drops what has waited for longer than the timers allow.
    fn has_waited_too_long(&mut self, octets: &[u8], turn: &mut Turn<'_>) -> bool {
        let delay_max_ms = self.config.settings().delay_max.0;
        match waited_ms(turn) {
            Some(waited_ms) if waited_ms > delay_max_ms => {
                let detail = format_args!("for {waited_ms} ms; delay_max is {delay_max_ms} ms");
                self.drop(turn, Cause::WaitedTooLong, &detail, octets);
                true
            }
            _ => false,
        }
    }

    /// Takes a message in, which came by `service` if that is known.
    fn understand(&mut self, octets: &[u8], service: Option<Service>, turn: &mut Turn<'_>) {
        let me = self.robot.station();
        let heard = match Heard::of(&self.identifiers, me, &turn.state.position, octets) {
            Ok(heard) => heard,
            Err(unheard) => return self.drop(turn, (&unheard).into(), &unheard, octets),
        };
        if service.is_some_and(|service| service != heard.service) {
            let cause = Cause::Discarded("message of another port");
            return self.drop(turn, cause, &heard.service.name(), octets);
        }
        turn.plain.heard = CrossguardHeard::of(&heard);
        self.write(
            turn,
            &Entry::Heard {
                message: heard.service,
                from: heard.from,
                waited_ms: waited_ms(turn),
                octets,
            },
        );
        for input in heard.inputs.iter() {
            self.step(turn, *input, heard.parameters);
        }
    }

    /// Sends a RAM outside of a session, where the protocol does not say when.
    pub(crate) fn announce(&mut self, turn: &mut Turn<'_>) {
        if self.robot.next_ram().is_none() {
            self.send_ram(turn, "interval");
        }
    }

    /// A step of the transition function, and what follows from it.
    fn step(
        &mut self,
        turn: &mut Turn<'_>,
        input: Input,
        parameters: Option<TaskParameters>,
    ) -> Outputs {
        let outputs = self.robot.step(&self.config, input);
        if let Some(why) = outputs.ignored() {
            self.counters.count(Cause::ignored(why));
        }
        let lost = {
            let entry = Entry::Step {
                input: &input,
                outputs: &outputs,
                state: &self.robot,
            };
            turn.lines
                .write(turn.plain.log_at_us, self.name.as_str(), &entry)
        };
        self.count_lost(lost);
        let parameters = parameters.unwrap_or_default();
        for output in outputs.iter() {
            match output {
                Output::SendRam => self.send_ram(turn, trigger(&input)),
                Output::SendRmcm(rmcm) => self.send_rmcm(turn, rmcm),
                output => {
                    let plain = CrossguardOutput::from_protocol(output, &parameters);
                    if let Some(plain) = plain {
                        turn.push(plain);
                    }
                }
            }
        }
        outputs
    }

    fn send_ram(&mut self, turn: &mut Turn<'_>, trigger: &'static str) {
        let due = self
            .low_frequency_ms
            .is_none_or(|last| self.told_ms - last >= LOW_FREQUENCY_MS);
        if due {
            self.low_frequency_ms = Some(self.told_ms);
        }
        turn.state.correct(&self.robot, &self.config);
        let ram = ram_from(
            &self.identifiers,
            &turn.state,
            &self.robot.ram(),
            self.robot.availability(),
            generation_delta_time(turn.plain.timestamp_its),
            due,
        );
        let ram = match ram {
            Ok(ram) => ram,
            Err(error) => return self.drop(turn, Cause::NotSent, &error, &[]),
        };
        let mut octets = [0; RAM_LEN_MAX];
        match encode_into(&self.identifiers, &ram, &mut octets) {
            Ok(length) => self.transmit(turn, Service::Ram, trigger, &octets[..length]),
            Err(error) => self.drop(turn, Cause::NotSent, &error, &[]),
        }
    }

    fn send_rmcm(&mut self, turn: &mut Turn<'_>, rmcm: &Rmcm) {
        turn.state.correct(&self.robot, &self.config);
        let (ids, position) = (&self.identifiers, &turn.state.position);
        let time = generation_delta_time(turn.plain.timestamp_its);
        let message = match rmcm {
            Rmcm::Command(command) => {
                let commands = [(*command, self.parameters(command.to))];
                rmcm_from_commands(ids, position, None, &commands, time)
            }
            Rmcm::Answer(answer) => {
                let status = ExecutionStatus {
                    progression: turn.state.task_progression,
                    time_to_completion: None,
                };
                rmcm_from_answer(ids, position, answer, status, time)
            }
        };
        let message = match message {
            Ok(message) => message,
            Err(error) => return self.drop(turn, Cause::NotSent, &error, &[]),
        };
        let mut octets = [0; RMCM_LEN_MAX];
        match encode_into(&self.identifiers, &message, &mut octets) {
            Ok(length) => self.transmit(turn, Service::Rmcm, "protocol", &octets[..length]),
            Err(error) => self.drop(turn, Cause::NotSent, &error, &[]),
        }
    }

    /// Puts a message into a packet among those of the turn.
    fn transmit(
        &mut self,
        turn: &mut Turn<'_>,
        service: Service,
        trigger: &'static str,
        message: &[u8],
    ) {
        let request = service.request(&self.identifiers);
        let ego = turn.ego();
        let start = turn.plain.packets_length;
        let room = turn.packets.get_mut(start..).unwrap_or_default();
        match self.stack.send(&ego, &request, message, room) {
            Ok(length) => {
                turn.plain.packets_length = start + length;
                turn.push(sent(service, start, length, message.len(), &request));
                self.write(
                    turn,
                    &Entry::Sent {
                        message: service,
                        trigger,
                        octets: message,
                    },
                );
            }
            Err(error) => self.drop(turn, Cause::NotSent, &error, &[]),
        }
    }

    /// Counts a drop, and reports it.
    fn drop(&mut self, turn: &mut Turn<'_>, cause: Cause, detail: &dyn Display, octets: &[u8]) {
        self.counters.count(cause);
        let name = Text::<{ crate::abi::CROSSGUARD_CAUSE_LEN }>::of(&cause);
        copy_text(name.as_str(), &mut turn.plain.dropped);
        self.write(
            turn,
            &Entry::Dropped {
                cause,
                detail,
                octets,
            },
        );
    }

    fn write(&mut self, turn: &mut Turn<'_>, entry: &Entry<'_>) {
        let lost = turn
            .lines
            .write(turn.plain.log_at_us, self.name.as_str(), entry);
        self.count_lost(lost);
    }

    fn count_lost(&mut self, lost: bool) {
        if lost {
            self.counters.count(Cause::LogFull);
        }
    }

    /// Begins the log of the robot.
    pub(crate) fn start_log(&mut self, unix_ms: u64, turn: &mut Turn<'_>) {
        let entry = Entry::Started {
            robot: &self.robot,
            settings: self.config.settings(),
            identifiers: &self.identifiers,
            unix_ms,
        };
        let lost = turn
            .lines
            .write(turn.plain.log_at_us, self.name.as_str(), &entry);
        self.count_lost(lost);
    }

    /// Ends the log of the robot.
    pub(crate) fn stop_log(&mut self, turn: &mut Turn<'_>) {
        let entry = Entry::Stopped {
            counters: &self.counters,
        };
        let lost = turn
            .lines
            .write(turn.plain.log_at_us, self.name.as_str(), &entry);
        self.count_lost(lost);
    }
}

/// For how long what is given has waited, where the caller knows.
const fn waited_ms(turn: &Turn<'_>) -> Option<u32> {
    match turn.plain.waited_ms {
        CROSSGUARD_NONE_MS => None,
        waited_ms => Some(waited_ms),
    }
}

/// Why a RAM of the protocol goes out.
const fn trigger(input: &Input) -> &'static str {
    match input {
        Input::Elapsed(_) | Input::Expired(_) => "heartbeat",
        _ => "role",
    }
}

/// The output for a packet; `message` octets are at its end.
#[expect(
    clippy::cast_possible_truncation,
    reason = "a packet has at most 1500 octets"
)]
fn sent(
    service: Service,
    start: usize,
    length: usize,
    message: usize,
    request: &crossguard_codec::geonet::Request,
) -> CrossguardOutput {
    const _: () = assert!(CROSSGUARD_PACKETS_LEN + PACKET_LEN_MAX < u32::MAX as usize);
    let message_kind = match service {
        Service::Rmcm => CrossguardMessage::Rmcm,
        _ => CrossguardMessage::Ram,
    };
    CrossguardOutput {
        message: message_kind as u8,
        packet_offset: start as u32,
        packet_length: length as u32,
        message_offset: (start + length - message) as u32,
        message_length: message as u32,
        port: request.port,
        traffic_class: request.traffic_class.id.into(),
        ..CrossguardOutput::of(CrossguardOutputKind::Send)
    }
}

/// Copies a text with NUL at its end, as far as there is room.
pub(crate) fn copy_text(text: &str, room: &mut [c_char]) {
    let Some((last, places)) = room.split_last_mut() else {
        return;
    };
    *last = 0;
    places.fill(0);
    for (place, octet) in places.iter_mut().zip(text.bytes()) {
        #[allow(clippy::cast_possible_wrap, reason = "a char is an octet")]
        {
            *place = octet as c_char;
        }
    }
}
