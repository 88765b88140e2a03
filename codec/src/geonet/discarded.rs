//! Why a packet is not taken.

use super::{GeonetError, PACKET_LEN_MAX};
#[cfg(feature = "security")]
use crate::security::{Rejected, Unsigned};

/// Why a packet was discarded.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Discarded {
    /// It is longer than any.
    #[error("{length} octets are too many for a packet, the limit is {PACKET_LEN_MAX}")]
    TooLong {
        /// How many octets there are.
        length: usize,
    },
    /// Its headers are wrong, or not supported.
    #[error("{0}")]
    Headers(#[from] GeonetError),
    /// Its security envelope is not to be relied on.
    #[error("{0}")]
    Envelope(#[from] EnvelopeError),
    /// The own station sent it.
    #[error("a packet of the own station")]
    OwnPacket,
    /// It comes from the own address, and the own station did not send it.
    #[error("another station has the own station id, or the own tickets: give one of both its own")]
    Namesake,
    /// There is no service at its port.
    #[error("no service is at port {0}")]
    UnknownPort(u16),
    /// It was sent under another permission than the service at its port needs.
    #[error("a packet for port {port} was sent with the permission {its_aid}")]
    WrongPermission {
        /// Its port.
        port: u16,
        /// The ITS-AID in its envelope.
        its_aid: u32,
    },
    /// It is a geo-broadcast: no message that is taken here is sent so.
    #[error("a geo-broadcast, by which no message is sent that is taken here")]
    GeoBroadcast,
}

impl Discarded {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(self) -> &'static str {
        match self {
            Self::TooLong { .. } => "too long",
            Self::Headers(GeonetError::Truncated { .. }) => "truncated",
            Self::Headers(GeonetError::PayloadLength { .. }) => "payload length",
            Self::Headers(_) => "not supported",
            Self::Envelope(error) => error.cause(),
            Self::OwnPacket => "own packet",
            Self::Namesake => "another station with the own station id",
            Self::UnknownPort(_) => "unknown port",
            Self::WrongPermission { .. } => "wrong permission for port",
            Self::GeoBroadcast => "geo-broadcast",
        }
    }
}

/// Why an envelope cannot be made or opened, or a packet is not taken without one.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EnvelopeError {
    /// A secured packet, and security is off.
    #[error("the packet is secured, and security is off")]
    SecurityIsOff,
    /// The envelope does not fit in the packet.
    #[error("the packet is too long with its envelope")]
    NoRoom,
    /// The packet cannot be signed.
    #[cfg(feature = "security")]
    #[error("{0}")]
    Unsigned(#[from] Unsigned),
    /// The packet cannot be relied on.
    #[cfg(feature = "security")]
    #[error("{0}")]
    Rejected(#[from] Rejected),
}

impl EnvelopeError {
    /// Its name among the causes for which packets are dropped.
    #[must_use]
    pub const fn cause(self) -> &'static str {
        match self {
            Self::SecurityIsOff => "secured, and security is off",
            Self::NoRoom => "too long with its envelope",
            #[cfg(feature = "security")]
            Self::Unsigned(_) => "cannot be signed",
            #[cfg(feature = "security")]
            Self::Rejected(rejected) => rejected.cause(),
        }
    }
}
