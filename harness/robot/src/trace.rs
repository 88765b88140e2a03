//! Logs: everything that an endpoint did, one JSON object per line.
//!
//! A log holds every input of the transition function with what it put out and the state after it, and
//! every message. `validate` of `crossguard-judge` replays it; so a log proves that the robot did what the
//! verified transition function does, or shows the first record that does not fit.

mod file;
mod reader;

pub use file::{LogFile, LogLimits, open};
pub use reader::{
    HELD_US, Lines, Log, LogError, Merged, Records, SAME_CLOCK_US, Timed, Unreadable,
};

use std::io::Write;

use crossguard_codec::{Identifiers, Service};
use crossguard_protocol::{Input, Outputs, Robot, Settings, StationId};
use serde::{Deserialize, Serialize};

use crate::around::Around;
use crate::channel::ChannelState;
use crate::clock::ClockState;
use crate::sight::{Outline, Sight};
use crossguard_endpoint::Effect;
use crossguard_endpoint::counters::{CauseName, Counts};
use crossguard_endpoint::ras::generation::Trigger;

/// One line of a log.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Record {
    /// Microseconds since the log's clock started.
    pub at_us: u64,
    /// The robot's name.
    pub robot: String,
    /// Its entry.
    #[serde(flatten)]
    pub entry: Entry,
}

#[cfg(test)]
impl Record {
    /// The last record of a robot that dropped nothing.
    pub(crate) fn stopped(robot: &str, at_us: u64) -> Self {
        let counters = Counts::default();
        Self {
            at_us,
            robot: robot.to_owned(),
            entry: Entry::Stopped { counters },
        }
    }
}

/// Entry of a robot in its log.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(
    tag = "entry",
    rename_all = "camelCase",
    rename_all_fields = "camelCase"
)]
pub enum Entry {
    /// It booted.
    Started {
        /// Its station id.
        station: StationId,
        /// Its boot counter.
        boot: u16,
        /// Stand-in for the boot counter in its first session and offer numbers, where the counter is told to nobody.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        epoch: Option<u16>,
        /// Its configuration.
        settings: Box<Settings>,
        /// Identifiers that no standard has assigned; without them its messages are not understood.
        #[serde(default)]
        identifiers: Identifiers,
        /// Milliseconds since 1970 (UTC), to line up logs of several robots.
        unix_ms: u64,
        /// How many times as fast as real its body moves, where it is known: the robot's own time passes so fast.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        speed: Option<f64>,
    },
    /// The transition function took a step.
    Step {
        /// Input of the step.
        input: Input,
        /// Outputs of the step.
        outputs: Box<Outputs>,
        /// The state after it.
        state: Box<Robot>,
    },
    /// A message went out.
    Sent {
        /// Which message.
        message: Service,
        /// Why.
        trigger: Trigger,
        /// The message.
        #[serde(with = "hex::serde")]
        octets: Vec<u8>,
    },
    /// A message came in and was understood.
    Heard {
        /// Which message.
        message: Service,
        /// Sender of the message.
        from: StationId,
        /// When; `None` in the log of a robot that does not say.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reception: Option<Reception>,
        /// The message.
        #[serde(with = "hex::serde")]
        octets: Vec<u8>,
    },
    /// Something was dropped.
    Dropped {
        /// The layer and cause that it is counted under.
        #[serde(flatten)]
        cause: CauseName,
        /// Details of the cause.
        detail: String,
        /// The datagram, if there was one.
        #[serde(with = "hex::serde", default)]
        octets: Vec<u8>,
    },
    /// So many were dropped, by cause, and have no record of their own, because more came than the log takes.
    Unrecorded {
        /// How often each cause occurred since the last such record.
        counters: Counts,
    },
    /// It watches this crossing zone from now on.
    Zone(Outline),
    /// Its sensors have these people now, and no others.
    People(Sight),
    /// These road users are on its map, told once a second while there are some, and once when there are none
    /// any more.
    Around(Around),
    /// The radio channel is like this now, where the link measures it.
    Channel(ChannelState),
    /// It trusts its clock from now on, or no longer. Of a robot that does not trust it nothing that is signed is heard.
    Clock(ClockState),
    /// An open corridor is closed, or stays closed, for this reason.
    Hindered {
        /// The reason, in words.
        why: String,
    },
    /// It stopped in order.
    Stopped {
        /// How often each cause occurred.
        counters: Counts,
    },
}

/// When a message came in, in microseconds on the log's clock.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Reception {
    /// When it arrived.
    pub arrived_us: u64,
    /// When the robot was told of it: for so long it waited. Its effects stand in the log somewhat
    /// later.
    pub told_us: u64,
}

impl Reception {
    /// For so long the message waited, in µs.
    #[must_use]
    pub const fn waited_us(&self) -> u64 {
        self.told_us.saturating_sub(self.arrived_us)
    }
}

/// Log entry of an effect, if the log's clock is that of the endpoint. Acts of the application are in the outputs of their step.
#[must_use]
pub fn recorded(effect: Effect) -> Option<Entry> {
    Some(match effect {
        Effect::Stepped {
            input,
            outputs,
            state,
        } => Entry::Step {
            input,
            outputs,
            state,
        },
        Effect::Heard {
            kind,
            from,
            arrived_ms,
            told_ms,
            octets,
        } => Entry::Heard {
            message: kind,
            from,
            reception: Some(Reception {
                arrived_us: arrived_ms * 1_000,
                told_us: told_ms * 1_000,
            }),
            octets,
        },
        Effect::Transmit {
            kind,
            trigger,
            octets,
            ..
        } => Entry::Sent {
            message: kind,
            trigger,
            octets,
        },
        Effect::Dropped {
            cause,
            detail,
            octets,
        } => Entry::Dropped {
            cause: cause.into(),
            detail,
            octets,
        },
        Effect::Act(..) | Effect::VehicleAnswered(..) | Effect::Ignored(..) => return None,
    })
}

/// Writes a record as a line.
///
/// # Errors
/// Errors of the writer.
pub fn write(to: &mut impl Write, record: &Record) -> std::io::Result<()> {
    serde_json::to_writer(&mut *to, record)?;
    to.write_all(b"\n")
}
