//! Whole messages as octets: the header first, then the codec. Octets of a RAM and an RMCM go through
//! the [core](crate::core), which decides what is one; those of a VAM through the reference and its
//! rules.

use serde::{Deserialize, Serialize};

use crate::asn1::cdd::{ItsPduHeader, MessageId, OrdinalNumber1B, StationId};
use crate::asn1::ram::RAM;
use crate::asn1::rmcm::RMCM;
use crate::asn1::vam::VAM;
use crate::error::{DecodeError, EncodeError};
use crate::identifiers::Identifiers;
use crate::size::{MESSAGE_LEN_MAX, RAM_LEN_MAX, RMCM_LEN_MAX};
use crate::{core, rules, uper};

/// A complete message that this crate encodes and decodes: [`RAM`], [`RMCM`] or [`VAM`].
pub trait Pdu: rasn::Encode + rasn::Decode + sealed::Sealed {
    /// Name of the message.
    const NAME: &'static str;
    /// The largest encoding of the message, in octets.
    const LEN_MAX: usize;
    /// Its header.
    fn header(&self) -> &ItsPduHeader;
    /// `protocolVersion` and `messageId` that its header has.
    fn expected_header(identifiers: &Identifiers) -> (u8, u8);
}

mod sealed {
    use super::{DecodeError, EncodeError, Received};

    /// Keeps the set of messages closed, and their codec out of sight.
    pub trait Sealed: Sized {
        fn to_octets(&self) -> Result<Vec<u8>, EncodeError>;
        fn from_octets(octets: &[u8]) -> Result<Received<Self>, DecodeError>;
    }
}

/// The codec of a message that the core has.
macro_rules! by_the_core {
    ($message:ty, $core:ty) => {
        impl sealed::Sealed for $message {
            fn to_octets(&self) -> Result<Vec<u8>, EncodeError> {
                let octets = uper::encode(self)?;
                // What the core does not take, no receiver does.
                let accepted = core::decode::<$core>(&octets);
                accepted.map_err(EncodeError::of_core::<$core>)?;
                Ok(octets)
            }

            fn from_octets(octets: &[u8]) -> Result<Received<Self>, DecodeError> {
                let decoded = core::decode::<$core>(octets);
                let (value, extended) = decoded.map_err(DecodeError::of_core::<$core>)?;
                let message = Self::try_from(&value)?;
                Ok(Received { message, extended })
            }
        }

        /// By way of the encoding, on which core and reference agree.
        impl TryFrom<&$core> for $message {
            type Error = DecodeError;

            fn try_from(value: &$core) -> Result<Self, DecodeError> {
                let mut buffer = [0; core::max_octets::<$core>()];
                let length = core::encode(value, &mut buffer);
                let length = length.map_err(DecodeError::of_core::<$core>)?;
                rasn::uper::decode(&buffer[..length]).map_err(|_| DecodeError::Disagreement)
            }
        }

        /// By way of the encoding, on which core and reference agree.
        impl TryFrom<&$message> for $core {
            type Error = EncodeError;

            fn try_from(message: &$message) -> Result<Self, EncodeError> {
                let octets = uper::encode(message)?;
                let decoded = core::decode(&octets);
                let (value, _) = decoded.map_err(EncodeError::of_core::<$core>)?;
                Ok(value)
            }
        }
    };
}

by_the_core!(RAM, core::ram::RAM);
by_the_core!(RMCM, core::rmcm::RMCM);

impl Pdu for RAM {
    const NAME: &'static str = "RAM";
    const LEN_MAX: usize = RAM_LEN_MAX;
    fn header(&self) -> &ItsPduHeader {
        &self.header
    }
    fn expected_header(identifiers: &Identifiers) -> (u8, u8) {
        (identifiers.ram.protocol_version, identifiers.ram.message_id)
    }
}

impl Pdu for RMCM {
    const NAME: &'static str = "RMCM";
    const LEN_MAX: usize = RMCM_LEN_MAX;
    fn header(&self) -> &ItsPduHeader {
        &self.header
    }
    fn expected_header(identifiers: &Identifiers) -> (u8, u8) {
        (
            identifiers.rmcm.protocol_version,
            identifiers.rmcm.message_id,
        )
    }
}

impl Pdu for VAM {
    const NAME: &'static str = "VAM";
    const LEN_MAX: usize = MESSAGE_LEN_MAX;
    fn header(&self) -> &ItsPduHeader {
        &self.header
    }
    /// Assigned by TS 103 300-3 v2.3.1.
    fn expected_header(_: &Identifiers) -> (u8, u8) {
        (3, 16)
    }
}

impl sealed::Sealed for VAM {
    fn to_octets(&self) -> Result<Vec<u8>, EncodeError> {
        rules::check_vam(self)?;
        uper::encode(self)
    }

    fn from_octets(octets: &[u8]) -> Result<Received<Self>, DecodeError> {
        let uper::Decoded { value, extended } = uper::decode::<Self>(octets)?;
        rules::check_vam(&value)?;
        let message = value;
        Ok(Received { message, extended })
    }
}

/// A message as it was received.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Received<M> {
    /// What this crate knows of it.
    pub message: M,
    /// How many SEQUENCEs of it had extension additions that this crate does not know. They were
    /// skipped; their sender speaks a newer version of the message.
    pub extended: usize,
}

/// The canonical encoding of `message`.
///
/// # Errors
/// When the header is not that of the message, a value is not one of its type, or a rule is broken.
pub fn encode<M: Pdu>(identifiers: &Identifiers, message: &M) -> Result<Vec<u8>, EncodeError> {
    let (protocol_version, message_id) = M::expected_header(identifiers);
    let ItsPduHeader {
        protocol_version: OrdinalNumber1B(version_found),
        message_id: MessageId(id_found),
        ..
    } = *message.header();
    let header = |field, found, expected| EncodeError::Header {
        message: M::NAME,
        field,
        found,
        expected,
    };
    if version_found != protocol_version {
        return Err(header("protocolVersion", version_found, protocol_version));
    }
    if id_found != message_id {
        return Err(header("messageId", id_found, message_id));
    }
    message.to_octets()
}

/// The message whose canonical encoding `octets` are.
///
/// Exactly the canonical encodings are accepted, with or without extension additions that this crate
/// does not know. No input makes it panic; what it allocates is bounded by [`MESSAGE_LEN_MAX`].
///
/// # Errors
/// Why the octets are not such a message, and which field says so.
pub fn decode<M: Pdu>(
    identifiers: &Identifiers,
    octets: &[u8],
) -> Result<Received<M>, DecodeError> {
    let header = Header::read(octets)?;
    let (known, message_id) = M::expected_header(identifiers);
    if header.message_id != message_id {
        return Err(DecodeError::MessageId {
            found: header.message_id,
            expected: M::NAME,
        });
    }
    if header.protocol_version != known {
        let found = header.protocol_version;
        return Err(DecodeError::ProtocolVersion {
            message: M::NAME,
            found,
            known,
        });
    }
    M::from_octets(octets)
}

/// The header that begins every message, in six octets that need no decoder (TS 102 894-2,
/// `ItsPduHeader`).
struct Header {
    protocol_version: u8,
    message_id: u8,
}

impl Header {
    fn read(octets: &[u8]) -> Result<Self, DecodeError> {
        let length = octets.len();
        if length > MESSAGE_LEN_MAX {
            return Err(DecodeError::TooLong {
                length,
                max: MESSAGE_LEN_MAX,
            });
        }
        match *octets {
            [protocol_version, message_id, _, _, _, _, ..] => Ok(Self {
                protocol_version,
                message_id,
            }),
            _ => Err(DecodeError::TooShort { length }),
        }
    }
}

/// The header of a message from `station`.
pub(crate) fn header<M: Pdu>(identifiers: &Identifiers, station: u32) -> ItsPduHeader {
    let (protocol_version, message_id) = M::expected_header(identifiers);
    ItsPduHeader::new(
        OrdinalNumber1B(protocol_version),
        MessageId(message_id),
        StationId(station),
    )
}

/// A message of the robots, told apart by its header.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Message {
    /// Robot awareness message.
    Ram(Box<RAM>),
    /// Robot maneuver coordination message.
    Rmcm(Box<RMCM>),
}

impl Message {
    /// The canonical encoding of the message.
    ///
    /// # Errors
    /// As for [`encode`].
    pub fn encode(&self, identifiers: &Identifiers) -> Result<Vec<u8>, EncodeError> {
        match self {
            Self::Ram(ram) => encode(identifiers, &**ram),
            Self::Rmcm(rmcm) => encode(identifiers, &**rmcm),
        }
    }

    /// The message whose canonical encoding `octets` are; its header says which it is.
    ///
    /// # Errors
    /// As for [`decode`].
    pub fn decode(identifiers: &Identifiers, octets: &[u8]) -> Result<Received<Self>, DecodeError> {
        let found = Header::read(octets)?.message_id;
        if found == identifiers.ram.message_id {
            let Received { message, extended } = decode(identifiers, octets)?;
            Ok(Received {
                message: Self::Ram(Box::new(message)),
                extended,
            })
        } else if found == identifiers.rmcm.message_id {
            let Received { message, extended } = decode(identifiers, octets)?;
            Ok(Received {
                message: Self::Rmcm(Box::new(message)),
                extended,
            })
        } else {
            Err(DecodeError::MessageId {
                found,
                expected: "RAM or RMCM",
            })
        }
    }
}
