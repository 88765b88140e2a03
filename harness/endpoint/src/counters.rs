//! Every message that was dropped and every input that was ignored, counted under a named cause.

use std::collections::BTreeMap;

use crossguard_codec::geonet::Discarded;
use crossguard_codec::{DecodeError, Service, ViewError};
use crossguard_protocol::Ignored;
use serde::Serialize;

/// Why something was dropped or ignored.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Cause {
    /// A packet is not one for this station.
    Discarded(&'static str),
    /// A packet cannot be relied on.
    Rejected(&'static str),
    /// A message that this station has no use for.
    NoUse(Service),
    /// A datagram is not a message.
    Undecodable(&'static str),
    /// A message contradicts itself.
    Contradictory(&'static str),
    /// The transition function ignored an input.
    Ignored(Ignored),
    /// A datagram waited for longer than `delay_max` from its arrival until the robot was told of it.
    WaitedTooLong,
    /// A datagram arrived while the inbox was full.
    InboxFull,
    /// The robot perceived people and did not know where it is itself.
    Unplaced,
    /// The fault layer dropped a datagram on purpose.
    Simulated(Loss),
    /// The operating system did not take a datagram.
    NotSent,
    /// The operating system gave no datagrams any more.
    LinkFailed,
    /// Datagrams came faster than they were taken off the link.
    LinkFull,
    /// The next boot counter could not be persisted; the robot goes on with the one that it has.
    EpochNotRenewed,
    /// The log's reader was too slow; the log ended before this record.
    LogFull,
    /// A reader of records that need not have all was too slow.
    OutputFull,
}

impl Cause {
    /// The cause's name: layer and reason.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Discarded(why) => format!("packet: {why}"),
            Self::Rejected(why) => format!("security: {why}"),
            Self::NoUse(service) => format!("no use for: {}", service.name()),
            Self::Undecodable(why) => format!("undecodable: {why}"),
            Self::Contradictory(why) => format!("contradictory: {why}"),
            // Not which robot it was about; that is in the log.
            Self::Ignored(Ignored::NotEngaged(..)) => "ignored: not engaged".to_owned(),
            Self::Ignored(why) => format!("ignored: {why}"),
            Self::WaitedTooLong => "waited too long".to_owned(),
            Self::InboxFull => "inbox full".to_owned(),
            Self::Unplaced => "perceived without a position".to_owned(),
            Self::Simulated(how) => how.name().to_owned(),
            Self::NotSent => "not sent".to_owned(),
            Self::LinkFailed => "link failed".to_owned(),
            Self::LinkFull => "link full".to_owned(),
            Self::EpochNotRenewed => "boot counter not renewed".to_owned(),
            Self::LogFull => "log full".to_owned(),
            Self::OutputFull => "output full".to_owned(),
        }
    }
}

/// How a datagram was lost on purpose.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
pub enum Loss {
    /// By itself.
    Random,
    /// In a burst.
    Burst,
    /// In an outage.
    Outage,
    /// Too many datagrams were under way already.
    Overflow,
}

impl Loss {
    /// The cause that it is counted under.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Random => "simulated loss",
            Self::Burst => "simulated burst loss",
            Self::Outage => "simulated outage",
            Self::Overflow => "simulated overflow",
        }
    }
}

impl From<Discarded> for Cause {
    fn from(discarded: Discarded) -> Self {
        match discarded {
            Discarded::Envelope(_) | Discarded::WrongPermission { .. } => {
                Self::Rejected(discarded.cause())
            }
            _ => Self::Discarded(discarded.cause()),
        }
    }
}

impl From<&DecodeError> for Cause {
    fn from(error: &DecodeError) -> Self {
        Self::Undecodable(error.cause())
    }
}

impl From<&ViewError> for Cause {
    fn from(error: &ViewError) -> Self {
        Self::Contradictory(error.cause())
    }
}

/// How often each cause occurred, by its name.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Counters(BTreeMap<String, u64>);

impl Counters {
    /// Counts one occurrence.
    pub fn count(&mut self, cause: Cause) {
        *self.0.entry(cause.name()).or_default() += 1;
    }

    /// How often `cause` occurred.
    #[must_use]
    pub fn of(&self, cause: Cause) -> u64 {
        self.0.get(&cause.name()).copied().unwrap_or_default()
    }

    /// The names of the causes that occurred, with how often.
    #[must_use]
    pub const fn by_name(&self) -> &BTreeMap<String, u64> {
        &self.0
    }
}
