//! A robot: the exchange of the endpoint crate with the caller's memory around it.

use core::ffi::c_char;
use core::fmt::Display;

use crossguard_codec::geonet::{Indication, PACKET_LEN_MAX};
use crossguard_codec::{Heard, RAM_LEN_MAX, RMCM_LEN_MAX, RobotState, Service, TaskParameters};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::exchange::{Exchange, Host, Moment, Outgoing};
use crossguard_protocol::{
    Event, Input, MAX_FOLLOWERS, MAX_OUTPUTS, Output, Outputs, Robot, StationId,
};

use crate::abi::{
    CROSSGUARD_CAUSE_LEN, CROSSGUARD_FOLLOWERS_MAX, CROSSGUARD_NONE_MS, CROSSGUARD_OUTPUTS_MAX,
    CROSSGUARD_PACKETS_LEN, CrossguardHeard, CrossguardMessage, CrossguardOutput,
    CrossguardOutputKind, CrossguardTurn,
};
use crate::config::{Checked, Name};
use crate::counters::{Counters, Text};
use crate::trace::{ByName, Entry, Hex, Lines, Reception};

/// Headers of a single-hop broadcast with BTP-B, in octets.
const HEADERS_LEN: usize = 44;
/// Time on a robot's clock when it boots, in ms: a packet may have waited for longer than the robot runs.
const BOOT_MS: u64 = CROSSGUARD_NONE_MS as u64;
/// A longer time, 24 days, is that of a clock that went back, in 32 bits.
const WENT_BACK_MS: u32 = u32::MAX / 2;

// A message of several commands is one step for each of them, and one of them at most is for this robot:
// the others are ignored with one output.
const _: () = assert!(CROSSGUARD_OUTPUTS_MAX >= MAX_OUTPUTS + MAX_FOLLOWERS);
const _: () = assert!(CROSSGUARD_FOLLOWERS_MAX == MAX_FOLLOWERS);
// At most one RAM and one RMCM to each follower leave one step.
const _: () = assert!(
    CROSSGUARD_PACKETS_LEN
        >= 2 * (HEADERS_LEN + RAM_LEN_MAX) + MAX_FOLLOWERS * (HEADERS_LEN + RMCM_LEN_MAX)
);

pub(crate) struct Turn<'a> {
    pub(crate) plain: &'a mut CrossguardTurn,
    pub(crate) packets: &'a mut [u8],
    pub(crate) lines: Lines<'a>,
    /// State of the robot's body.
    pub(crate) state: RobotState,
}

pub(crate) struct Live {
    exchange: Exchange,
    name: Name,
    counters: Counters,
}

impl Live {
    pub(crate) fn new(station: u32, boot: u16, checked: Checked) -> Self {
        let Checked {
            config,
            identifiers,
            name,
        } = checked;
        let robot = Robot::new(StationId(station), boot);
        Self {
            exchange: Exchange::new(robot, config, identifiers, BOOT_MS),
            name,
            counters: Counters::NONE,
        }
    }

    pub(crate) fn robot(&self) -> &Robot {
        self.exchange.robot()
    }

    pub(crate) const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// The exchange, and what it is embedded in for this call: `elapsed_ms` after the last one.
    fn parts<'a, 'b>(
        &'a mut self,
        turn: &'a mut Turn<'b>,
        elapsed_ms: u32,
    ) -> (&'a mut Exchange, Call<'a, 'b>) {
        let moment = Moment {
            now_ms: self.exchange.elapsed_to_ms() + u64::from(elapsed_ms),
            timestamp_its: turn.plain.timestamp_its,
        };
        let call = Call {
            turn,
            moment,
            name: &self.name,
            counters: &mut self.counters,
        };
        (&mut self.exchange, call)
    }

    pub(crate) fn elapse(&mut self, elapsed_ms: u32, turn: &mut Turn<'_>) {
        // The difference of two readings of a clock that went back. The time passes all the same: leases end, and nothing is left open.
        if elapsed_ms > WENT_BACK_MS {
            self.counters.count(Cause::ClockWentBack);
        }
        let (exchange, mut call) = self.parts(turn, elapsed_ms);
        exchange.elapse(&mut call);
    }

    /// Takes in an event; `parameters` are those of a command.
    pub(crate) fn tell(&mut self, event: Event, parameters: TaskParameters, turn: &mut Turn<'_>) {
        let (exchange, mut call) = self.parts(turn, 0);
        match event {
            Event::CommandManeuver { follower, task } => {
                exchange.command(&mut call, follower, task, parameters);
            }
            event => {
                exchange.event(&mut call, event);
            }
        }
    }

    /// Takes in a packet, if it has not waited for too long.
    pub(crate) fn receive(&mut self, packet: &[u8], turn: &mut Turn<'_>) {
        let (exchange, mut call) = self.parts(turn, 0);
        let arrived_ms = call.arrived_ms();
        exchange.receive(&mut call, packet, arrived_ms);
    }

    /// Takes in a message, if it has not waited for too long.
    pub(crate) fn hear(&mut self, message: &[u8], turn: &mut Turn<'_>) {
        let (exchange, mut call) = self.parts(turn, 0);
        let arrived_ms = call.arrived_ms();
        exchange.receive_message(&mut call, message, arrived_ms);
    }

    /// Sends a RAM outside of a session, where the protocol does not say when.
    pub(crate) fn announce(&mut self, turn: &mut Turn<'_>) {
        let (exchange, mut call) = self.parts(turn, 0);
        exchange.announce(&mut call);
    }

    pub(crate) fn start_log(&mut self, unix_ms: u64, turn: &mut Turn<'_>) {
        let (exchange, mut call) = self.parts(turn, 0);
        call.write(&Entry::Started {
            station: exchange.robot().station(),
            boot: exchange.robot().boot(),
            settings: exchange.config().settings(),
            identifiers: exchange.identifiers(),
            unix_ms,
        });
    }

    pub(crate) fn stop_log(&mut self, turn: &mut Turn<'_>) {
        let counters = ByName(&self.counters);
        let (at_us, name) = (turn.plain.log_at_us, self.name.as_str());
        if turn.lines.write(at_us, name, &Entry::Stopped { counters }) {
            self.counters.count(Cause::LogFull);
        }
    }
}

/// One call: its effects go into the turn of the caller.
struct Call<'a, 'b> {
    turn: &'a mut Turn<'b>,
    moment: Moment,
    name: &'a Name,
    counters: &'a mut Counters,
}

impl Call<'_, '_> {
    /// For how long the octets of this call waited, if the caller says so.
    fn waited_ms(&self) -> Option<u64> {
        let waited_ms = self.turn.plain.waited_ms;
        (waited_ms != CROSSGUARD_NONE_MS).then(|| waited_ms.into())
    }

    /// When they arrived; now, unless the caller says that they waited.
    fn arrived_ms(&self) -> u64 {
        self.moment.now_ms - self.waited_ms().unwrap_or(0)
    }

    fn push(&mut self, output: CrossguardOutput) {
        let plain = &mut *self.turn.plain;
        let length = plain.outputs_length as usize;
        // There is always room, see above.
        if let Some(slot) = plain.outputs.get_mut(length) {
            *slot = output;
            plain.outputs_length += 1;
        }
    }

    fn write(&mut self, entry: &Entry<'_>) {
        let (lines, at_us) = (&mut self.turn.lines, self.turn.plain.log_at_us);
        if lines.write(at_us, self.name.as_str(), entry) {
            self.counters.count(Cause::LogFull);
        }
    }
}

impl Host for Call<'_, '_> {
    fn moment(&self) -> Moment {
        self.moment
    }

    fn state(&self) -> &RobotState {
        &self.turn.state
    }

    fn room(&mut self) -> &mut [u8] {
        let start = self.turn.plain.packets_length;
        self.turn.packets.get_mut(start..).unwrap_or_default()
    }

    fn transmit(&mut self, outgoing: Outgoing<'_>) {
        let start = self.turn.plain.packets_length;
        self.turn.plain.packets_length = start + outgoing.packet_len;
        self.push(sent(start, &outgoing));
        self.write(&Entry::Sent {
            message: outgoing.service,
            trigger: outgoing.trigger,
            octets: Hex(outgoing.message),
        });
    }

    fn stepped(&mut self, input: &Input, outputs: &Outputs, after: &Robot) {
        self.write(&Entry::Step {
            input,
            outputs,
            state: after,
        });
    }

    fn act(&mut self, output: &Output, parameters: TaskParameters) {
        if let Some(plain) = CrossguardOutput::from_protocol(output, &parameters) {
            self.push(plain);
        }
    }

    fn heard(&mut self, _me: &Robot, heard: &Heard, message: &[u8], _: u64) {
        self.turn.plain.heard = CrossguardHeard::of(heard);
        let told_us = self.turn.plain.log_at_us;
        let reception = self.waited_ms().map(|waited_ms| Reception {
            arrived_us: told_us.saturating_sub(waited_ms * 1_000),
            told_us,
        });
        self.write(&Entry::Heard {
            message: heard.service,
            from: heard.from,
            reception,
            octets: Hex(message),
        });
    }

    fn other(&mut self, _me: &Robot, indication: &Indication<'_>, packet: &[u8], _: u64) {
        let cause = Cause::NoUse(indication.service);
        self.dropped(cause, &"the robot does not take it in", packet);
    }

    fn dropped(&mut self, cause: Cause, detail: &dyn Display, octets: &[u8]) {
        self.counters.count(cause);
        let name = Text::<CROSSGUARD_CAUSE_LEN>::of(&cause);
        copy_text(name.as_str(), &mut self.turn.plain.dropped);
        self.write(&Entry::Dropped {
            layer: cause.layer(),
            cause: cause.reason(),
            detail,
            octets: Hex(octets),
        });
    }

    fn ignored(&mut self, cause: Cause) {
        self.counters.count(cause);
    }
}

/// The output for a packet; `message` octets are at its end.
#[expect(
    clippy::cast_possible_truncation,
    reason = "a packet has at most 1500 octets"
)]
fn sent(start: usize, outgoing: &Outgoing<'_>) -> CrossguardOutput {
    const _: () = assert!(CROSSGUARD_PACKETS_LEN + PACKET_LEN_MAX < u32::MAX as usize);
    let message = outgoing.message.len();
    let message_kind = match outgoing.service {
        Service::Rmcm => CrossguardMessage::Rmcm,
        _ => CrossguardMessage::Ram,
    };
    CrossguardOutput {
        message: message_kind as u8,
        packet_offset: start as u32,
        packet_length: outgoing.packet_len as u32,
        message_offset: (start + outgoing.packet_len - message) as u32,
        message_length: message as u32,
        port: outgoing.request.port,
        traffic_class: outgoing.request.traffic_class.id.into(),
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
