//! The security envelope between basic and common header (EN 302 636-4-1, clause 9.4; TS 103 097).

use std::borrow::Cow;

use super::EgoPosition;

/// What stands around a packet behind its basic header.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub enum Envelope {
    /// Nothing. Packets go out as they are, and secured ones are not understood.
    #[default]
    Off,
}

/// Who vouches for a packet: the digest of its certificate (`HashedId8`).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Signer(pub [u8; 8]);

/// What was in an envelope.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Opened<'a> {
    /// Common header, extended header, BTP and message.
    pub plain: Cow<'a, [u8]>,
    /// The ITS-AID under which it was sent.
    pub its_aid: u32,
    /// Who vouches for it.
    pub signer: Signer,
}

/// Why an envelope cannot be made or opened, or a packet is not taken without one.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EnvelopeError {
    /// A secured packet, and security is off.
    #[error("the packet is secured, and security is off")]
    SecurityIsOff,
}

impl EnvelopeError {
    /// Its name among the causes for which packets are dropped.
    #[must_use]
    pub const fn cause(self) -> &'static str {
        match self {
            Self::SecurityIsOff => "secured, and security is off",
        }
    }
}

impl Envelope {
    /// Puts `plain` (common header to message), which is sent with the permission `its_aid`, into an
    /// envelope at the front of `secured`, and tells how long that is. `None` where it is to go
    /// without.
    ///
    /// # Errors
    /// Why it cannot be sent.
    pub fn seal(
        &mut self,
        _ego: &EgoPosition,
        _its_aid: u32,
        _plain: &[u8],
        _secured: &mut [u8],
    ) -> Result<Option<usize>, EnvelopeError> {
        match self {
            Self::Off => Ok(None),
        }
    }

    /// Opens the envelope that follows a basic header.
    ///
    /// # Errors
    /// Why its content cannot be relied on.
    pub fn open<'a>(
        &mut self,
        _ego: &EgoPosition,
        _secured: &'a [u8],
    ) -> Result<Opened<'a>, EnvelopeError> {
        match self {
            Self::Off => Err(EnvelopeError::SecurityIsOff),
        }
    }

    /// Whether a packet without an envelope is taken.
    ///
    /// # Errors
    /// Why not.
    pub fn admit_plain(&mut self) -> Result<(), EnvelopeError> {
        match self {
            Self::Off => Ok(()),
        }
    }
}
