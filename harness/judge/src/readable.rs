//! Messages and packets as JSON, for people and scripts.
//!
//! ```text
//!   octets ──► Decoded ──► JSON: packet (headers), message, and what is known about both
//!   JSON ────► encode ───► octets
//! ```
//!
//! A signed packet is taken apart as well, with who signed it; what it takes to make one is not in JSON.

use crossguard_codec::geonet::{BasicHeader, Discarded, GeonetError, Headers};
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{DecodeError, EncodeError, Identifiers};
use crossguard_endpoint::station::listen::peek;
use serde::Serialize;

use crate::signature::{Signature, Signatures};

/// A message with what is known about its octets.
#[derive(Clone, Debug, Serialize)]
pub struct Decoded {
    /// How many octets there are, headers included.
    pub octets: usize,
    /// How many parts had extension additions that this version does not know.
    #[serde(skip_serializing_if = "is_zero")]
    pub extended: usize,
    /// Whether the message is encoded canonically; told where it is not.
    #[serde(skip_serializing_if = "is_true")]
    pub canonical: bool,
    /// The standard that the message is of.
    pub standard: &'static str,
    /// The headers of the packet, if it was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub packet: Option<Headers>,
    /// Signer of the packet, and whether the signature was verified.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub signature: Option<Signature>,
    /// The message.
    pub message: ItsMessage,
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde calls it with a reference"
)]
const fn is_zero(n: &usize) -> bool {
    *n == 0
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde calls it with a reference"
)]
const fn is_true(is_so: &bool) -> bool {
    *is_so
}

/// Why octets cannot be read.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unreadable {
    /// They begin like a packet and are none.
    #[error("a GeoNetworking packet: {0}")]
    Packet(Discarded),
    /// They are no message.
    #[error(transparent)]
    Message(#[from] DecodeError),
}

impl Unreadable {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(&self) -> &'static str {
        match self {
            Self::Packet(discarded) => discarded.cause(),
            Self::Message(error) => error.cause(),
        }
    }
}

impl Decoded {
    /// Content of `octets`: a message, or a packet with one, whose signature is looked at.
    ///
    /// # Errors
    /// Why they say nothing.
    pub fn of(
        identifiers: &Identifiers,
        signatures: &mut Signatures,
        octets: &[u8],
    ) -> Result<Self, Unreadable> {
        // No message has the protocolVersion that the first octet of a packet would be.
        let (packet, message) = match BasicHeader::decode(octets) {
            Ok(_) => {
                let (headers, message) = peek(octets).map_err(Unreadable::Packet)?;
                (Some(headers), message)
            }
            Err(_) => (None, octets),
        };
        let received = ItsMessage::decode(identifiers, message)?;
        Ok(Self {
            octets: octets.len(),
            extended: received.extended,
            canonical: received.is_canonical,
            standard: received.message.standard(),
            packet,
            signature: signatures.of(identifiers, octets, None),
            message: received.message,
        })
    }
}

/// Why JSON has no octets.
#[derive(Debug, thiserror::Error)]
pub enum Unwritable {
    /// It is no JSON.
    #[error("not JSON: {0}")]
    NotJson(serde_json::Error),
    /// The JSON in place of the headers describes none.
    #[error("not the headers of a packet: {0}")]
    NotHeaders(serde_json::Error),
    /// The JSON in place of the message describes none.
    #[error("not a message: {0}")]
    NotAMessage(serde_json::Error),
    /// It stands for a signed packet.
    #[error(
        "the packet was signed, and nobody here has the key; without 'signature' it is made without a \
         security envelope"
    )]
    Signed,
    /// The message has no encoding.
    #[error(transparent)]
    Message(#[from] EncodeError),
    /// The headers cannot stand before the message.
    #[error(transparent)]
    Headers(#[from] GeonetError),
}

/// The octets of a message in JSON, alone or as [`Decoded`] has it, with the headers of its packet.
///
/// # Errors
/// Why it has none.
pub fn encode(identifiers: &Identifiers, json: &[u8]) -> Result<Vec<u8>, Unwritable> {
    let value: serde_json::Value = serde_json::from_slice(json).map_err(Unwritable::NotJson)?;
    let (packet, message) = match value {
        serde_json::Value::Object(mut object) if object.contains_key("message") => {
            if object.contains_key("signature") {
                return Err(Unwritable::Signed);
            }
            let message = object.remove("message").unwrap_or_default();
            (object.remove("packet"), message)
        }
        other => (None, other),
    };
    let packet: Option<Headers> = packet
        .map(serde_json::from_value)
        .transpose()
        .map_err(Unwritable::NotHeaders)?;
    let message: ItsMessage = serde_json::from_value(message).map_err(Unwritable::NotAMessage)?;
    let mut octets = message.encode(identifiers)?;
    if let Some(packet) = packet {
        let headers = packet.encode(octets.len())?;
        octets.splice(..0, headers.as_ref().iter().copied());
    }
    Ok(octets)
}
