//! The security envelope between basic and common header (EN 302 636-4-1, clause 9.4; TS 103 097).

use super::{BasicHeader, EgoPosition, Opened};
#[cfg(feature = "security")]
use super::{Headers, secured::Secured};
#[cfg(feature = "security")]
use crate::security::{Rejected, Unsigned};

/// What stands around a packet behind its basic header.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub enum Envelope {
    /// Nothing. Packets go out as they are, and secured ones are not understood.
    #[default]
    Off,
    /// Packets are signed, and those of others verified.
    #[cfg(feature = "security")]
    Secured(Box<Secured>),
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

    /// Whether the packet is signed with a ticket of the own station, which has heard itself.
    pub(super) const fn is_own_ticket(self) -> bool {
        #[cfg(feature = "security")]
        return matches!(self, Self::Rejected(Rejected::OwnTicket));
        #[cfg(not(feature = "security"))]
        return false;
    }
}

impl Envelope {
    /// Puts `plain` (common header to message), which is sent with the permission `its_aid`, into an
    /// envelope at the front of `secured`, and tells how long that is. `None` where it is to go
    /// without.
    ///
    /// # Errors
    /// Why it cannot be sent.
    #[cfg_attr(not(feature = "security"), expect(unused_variables))]
    pub fn seal(
        &mut self,
        ego: &EgoPosition,
        its_aid: u32,
        plain: &[u8],
        secured: &mut [u8],
    ) -> Result<Option<usize>, EnvelopeError> {
        match self {
            Self::Off => Ok(None),
            #[cfg(feature = "security")]
            Self::Secured(station) => {
                let envelope = station.seal(ego, its_aid, plain)?;
                let room = secured.get_mut(..envelope.len());
                room.ok_or(EnvelopeError::NoRoom)?
                    .copy_from_slice(&envelope);
                Ok(Some(envelope.len()))
            }
        }
    }

    /// Opens the envelope that follows a basic header.
    ///
    /// # Errors
    /// Why its content cannot be relied on.
    #[cfg_attr(not(feature = "security"), expect(unused_variables))]
    pub fn open<'a>(
        &mut self,
        ego: &EgoPosition,
        basic: BasicHeader,
        secured: &'a [u8],
    ) -> Result<Opened<'a>, EnvelopeError> {
        match self {
            Self::Off => Err(EnvelopeError::SecurityIsOff),
            #[cfg(feature = "security")]
            Self::Secured(station) => Ok(station.open(ego, secured, |plain| {
                let (headers, _) = Headers::decode_behind(basic, plain).ok()?;
                Some(headers.source)
            })?),
        }
    }

    /// Whether a packet without an envelope is taken.
    ///
    /// # Errors
    /// Why not.
    pub fn admit_plain(&self) -> Result<(), EnvelopeError> {
        match self {
            Self::Off => Ok(()),
            #[cfg(feature = "security")]
            Self::Secured(station) => Ok(station.admit_plain()?),
        }
    }
}
