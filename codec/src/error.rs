//! Faults of messages, for people to act on.

use ::core::fmt;

use crossguard_protocol::{MAX_FOLLOWERS, Millis, SessionId, StationId};
use thiserror::Error;

use crate::core::ram::{HelpStatus, RequestedFollowers};
use crate::core::{self, Fault, Field, Uper};
use crate::state::TaskProgression;

/// Why octets are not a message.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum DecodeError {
    /// Not even a header.
    #[error("{length} octets are too few for the header of a message, which has 6")]
    TooShort {
        /// How many octets there are.
        length: usize,
    },
    /// More than any packet carries.
    #[error("{length} octets are too many for a message, the limit is {max}")]
    TooLong {
        /// How many octets there are.
        length: usize,
        /// How many there may be.
        max: usize,
    },
    /// The header names a message that is not expected.
    #[error("messageId {found} is not that of {expected}")]
    MessageId {
        /// The value in the header.
        found: u8,
        /// The message that is expected.
        expected: &'static str,
    },
    /// The header names a version of the message that this crate does not know.
    #[error("protocolVersion {found} of {message} is unknown, {known} is known")]
    ProtocolVersion {
        /// The message that the header names.
        message: &'static str,
        /// The value in the header.
        found: u8,
        /// The value that is known.
        known: u8,
    },
    /// The bits of one field are wrong.
    #[error("{field}: {fault} (bit {bit})")]
    Malformed {
        /// The field.
        field: FieldPath,
        /// Where its bits are, counted from the start of the message.
        bit: usize,
        /// Their fault.
        fault: Fault,
    },
    /// There is more behind the message.
    #[error("{count} octets follow the end of the message")]
    TrailingOctets {
        /// How many octets.
        count: usize,
    },
    /// A message of another station is wrong in one field, as rasn says.
    #[cfg(feature = "foreign")]
    #[error("{field}: {detail}")]
    Foreign {
        /// The field.
        field: FieldPath,
        /// The name of the cause, for counters.
        cause: &'static str,
        /// Its fault.
        detail: String,
    },
}

impl DecodeError {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(&self) -> &'static str {
        match self {
            Self::TooShort { .. } => "too short",
            Self::TooLong { .. } => "too long",
            Self::MessageId { .. } => "unknown messageId",
            Self::ProtocolVersion { .. } => "unknown protocolVersion",
            Self::TrailingOctets { .. } => "trailing octets",
            #[cfg(feature = "foreign")]
            Self::Foreign { cause, .. } => cause,
            Self::Malformed { fault, .. } => match fault {
                Fault::Truncated => "truncated",
                Fault::Value { .. } => "value out of range",
                Fault::Size { .. } | Fault::BeyondRoot => "size out of range",
                Fault::TooMany { .. } | Fault::AbsentAlternative => "broken rule",
                Fault::DefaultSpelledOut => "not canonical",
                Fault::UnknownAlternative => "unknown alternative",
                Fault::Padding => "padding not zero",
                _ => "malformed extension",
            },
        }
    }

    /// The error of the core, with the names of the fields of `T`.
    pub(crate) fn of_core<T: Uper>(error: core::Error) -> Self {
        match error.fault {
            Fault::Trailing { octets: count } => Self::TrailingOctets { count },
            fault => Self::Malformed {
                field: FieldPath::of_core::<T>(error),
                bit: error.bit,
                fault,
            },
        }
    }
}

/// Why a message cannot be encoded.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// A number or a size is not one of its type, as rasn says of a message of another station. The
    /// conversions of [`si`](crate::si) never produce such a number.
    #[cfg(feature = "foreign")]
    #[error("not encodable: {0}")]
    Other(String),
    /// The header is not the one of this message.
    #[error("the header of {message} has {field} {found} instead of {expected}")]
    Header {
        /// The message.
        message: &'static str,
        /// The field of the header.
        field: &'static str,
        /// Its value.
        found: u8,
        /// The configured value.
        expected: u8,
    },
    /// A field is one that no receiver takes: a list is too long, or its size or value is behind an
    /// extension marker. Or the buffer ends too early.
    #[error("{field}: {fault}")]
    Malformed {
        /// The field.
        field: FieldPath,
        /// Its fault.
        fault: Fault,
    },
}

impl EncodeError {
    /// The error of the core, with the names of the fields of `T`.
    pub(crate) fn of_core<T: Uper>(error: core::Error) -> Self {
        Self::Malformed {
            field: FieldPath::of_core::<T>(error),
            fault: error.fault,
        }
    }
}

/// Why a message contradicts itself or says what no message can.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A requester, a leader or a command names a session that its sender does not lead.
    #[error("station {sender} speaks as the leader of session {session}")]
    NotOwnSession {
        /// The sender.
        sender: StationId,
        /// The session.
        session: SessionId,
    },
    /// A helper, a follower or an answer names a session that its sender leads, or a sender has left
    /// its own session instead of ending it.
    #[error("station {0} speaks as a follower in its own session")]
    OwnSession(StationId),
    /// `helpStatus` is not the one that goes with the role.
    #[error("helpStatus is {found:?}, and its role goes with {expected:?}")]
    HelpStatus {
        /// The status.
        found: HelpStatus,
        /// The one that goes with the role.
        expected: HelpStatus,
    },
    /// `taskProgression` is not the one that goes with the progress of the last command.
    #[error("taskProgression is {found:?}, and its command is {expected:?}")]
    TaskProgression {
        /// The progress in the status.
        found: TaskProgression,
        /// The progress in the report.
        expected: TaskProgression,
    },
    /// A number of followers that cannot be asked for.
    #[error("{0} followers are asked for, and 1 to {max} can be", max = RequestedFollowers::MAX)]
    FollowerCount(u8),
    /// A leader has more followers than this robot has room for.
    #[error("a leader names {0} followers, and there is room for {MAX_FOLLOWERS}")]
    MemberCount(usize),
    /// A `t_safety` that no offer can tell.
    #[error("an offer tells a safety timeout of {0}, and from 1 ms to one day can be told")]
    SafetyTimeout(Millis),
    /// The crossing is named as 0:0, which is how the protocol holds an unknown one. A message that
    /// does not know the crossing leaves it out.
    #[error("the crossing is 0:0 instead of absent")]
    UnknownCrossing,
    /// A leader without followers.
    #[error("a leader names no follower")]
    NoFollowers,
    /// A leader names this follower twice, or a message commands it twice.
    #[error("station {0} is named twice")]
    NamedTwice(StationId),
    /// A leader follows itself or commands itself.
    #[error("leader {0} is its own follower")]
    OwnFollower(StationId),
    /// The session that is named as over is the one that the sender takes part in.
    #[error("session {0} is over, and its sender takes part in it")]
    FarewellToPresent(SessionId),
    /// A report says that the leader's execution limit ran out, which only the leader can know.
    #[error("a follower's report cannot say that the leader's execution limit ran out")]
    ExecutionLimit,
    /// A message commands nobody, or more followers than a session has.
    #[error("{0} commands are in one message, and 1 to {MAX_FOLLOWERS} can be")]
    CommandCount(usize),
    /// The commands of one message belong to different sessions.
    #[error("commands of sessions {0} and {1} are in one message")]
    SessionsDiffer(SessionId, SessionId),
    /// The command to this follower is for another place of the map than the first of its message.
    #[error("the command to station {0} is for another place of the map than those before it")]
    MapPlacesDiffer(StationId),
    /// The target of a command is not a place, or too far away.
    #[error("the target of the command for station {0} cannot be expressed")]
    Target(StationId),
}

impl ViewError {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(&self) -> &'static str {
        match self {
            Self::NotOwnSession { .. } => "leads a session that is not its own",
            Self::OwnSession(_) => "follows in its own session",
            Self::HelpStatus { .. } => "helpStatus does not fit the role",
            Self::TaskProgression { .. } => "taskProgression does not fit the report",
            Self::NamedTwice(_) | Self::OwnFollower(_) => "impossible followers",
            Self::FarewellToPresent(_) => "farewell to the present session",
            Self::UnknownCrossing => "crossing 0:0",
            Self::MemberCount(_) | Self::CommandCount(_) => "too many followers",
            _ => "other",
        }
    }
}

/// The way from a message to one of its fields, in Rust's spelling.
#[derive(Clone)]
pub struct FieldPath(Way);

#[derive(Clone)]
enum Way {
    /// Names that nobody has read yet, so that hostile input costs no allocation.
    OfCore(core::Path, &'static [Field]),
    /// Names that rasn gave, outermost first.
    #[cfg(feature = "foreign")]
    Named(Vec<&'static str>),
}

#[cfg(feature = "foreign")]
impl Default for FieldPath {
    fn default() -> Self {
        Self(Way::Named(Vec::new()))
    }
}

impl FieldPath {
    fn of_core<T: Uper>(error: core::Error) -> Self {
        Self(Way::OfCore(error.path(), T::FIELDS))
    }

    /// The field to which rasn gives these names, each with its type, as `Type.field`.
    #[cfg(feature = "foreign")]
    pub(crate) fn named(mut names: Vec<&'static str>) -> Self {
        for name in &mut names {
            *name = name.rsplit('.').next().unwrap_or(name);
        }
        Self(Way::Named(names))
    }

    /// The names of the fields, outermost first.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        let (of_core, named): (_, &[&'static str]) = match &self.0 {
            Way::OfCore(path, fields) => (Some(path.names(fields)), &[]),
            #[cfg(feature = "foreign")]
            Way::Named(names) => (None, names),
        };
        of_core.into_iter().flatten().chain(named.iter().copied())
    }
}

impl PartialEq for FieldPath {
    fn eq(&self, other: &Self) -> bool {
        self.names().eq(other.names())
    }
}

impl Eq for FieldPath {}

impl fmt::Display for FieldPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut names = self.names();
        f.write_str(names.next().unwrap_or("message"))?;
        names.try_for_each(|name| write!(f, ".{name}"))
    }
}

impl fmt::Debug for FieldPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
