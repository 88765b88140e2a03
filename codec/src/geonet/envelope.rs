//! The security envelope between basic and common header (EN 302 636-4-1, clause 9.4; TS 103 097).

#[cfg(feature = "security")]
use super::secured::Secured;
use super::{Admitted, Discarded, EgoPosition, EnvelopeError, Opened};

/// The envelope around a packet behind its basic header.
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

    /// Opens the envelope that follows a basic header. `admit` takes apart what is in it, sent under an ITS-AID, and is
    /// asked before the signature is looked at.
    ///
    /// # Errors
    /// Why the packet is not taken, or cannot be relied on.
    #[cfg_attr(not(feature = "security"), expect(unused_variables))]
    pub fn open<'a>(
        &mut self,
        ego: &EgoPosition,
        secured: &'a [u8],
        admit: impl FnOnce(&'a [u8], u32) -> Result<Admitted<'a>, Discarded>,
    ) -> Result<(Admitted<'a>, Opened), Discarded> {
        match self {
            Self::Off => Err(EnvelopeError::SecurityIsOff.into()),
            #[cfg(feature = "security")]
            Self::Secured(station) => station.open(ego, secured, admit),
        }
    }

    /// Checks that a packet without an envelope is taken.
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
