//! Whole messages as octets: the header first, then the codec. RAM and RMCM are those of the
//! [core](crate::core), which is their codec; those of other stations are in `its`.

use crate::core::cdd::{ItsPduHeader, MessageId, OrdinalNumber1B};
use crate::core::ram::RAM;
use crate::core::rmcm::RMCM;
use crate::core::{Reader, Uper};
use crate::error::{DecodeError, EncodeError};
use crate::identifiers::Identifiers;
use crate::size::{MESSAGE_LEN_MAX, RAM_LEN_MAX, RMCM_LEN_MAX};
use crate::{core, wire};

/// A complete message that this crate encodes and decodes: [`RAM`], [`RMCM`] or one of
/// `its`.
pub trait Pdu: sealed::Sealed {
    /// Name of the message.
    const NAME: &'static str;
    /// The largest encoding of the message, in octets.
    const LEN_MAX: usize;
    /// Its header.
    fn header(&self) -> ItsPduHeader;
    /// `protocolVersion` and `messageId` that its header has.
    fn expected_header(identifiers: &Identifiers) -> (u8, u8);
}

pub(crate) mod sealed {
    use super::{DecodeError, EncodeError, Identifiers, Received};

    /// Keeps the set of messages closed, and their codec out of sight.
    pub trait Sealed: Sized {
        fn write(&self, buffer: &mut [u8]) -> Result<usize, EncodeError>;
        fn read(identifiers: &Identifiers, octets: &[u8]) -> Result<Received<Self>, DecodeError>;
    }
}

/// The codec of the messages that the core has.
macro_rules! by_the_core {
    ($message:ty, $name:literal, $len_max:ident, $identifiers:ident) => {
        impl sealed::Sealed for $message {
            fn write(&self, buffer: &mut [u8]) -> Result<usize, EncodeError> {
                core::encode(self, buffer).map_err(EncodeError::of_core::<Self>)
            }

            fn read(_: &Identifiers, octets: &[u8]) -> Result<Received<Self>, DecodeError> {
                let decoded = core::decode(octets);
                let (message, extended) = decoded.map_err(DecodeError::of_core::<Self>)?;
                Ok(Received {
                    message,
                    extended,
                    is_canonical: true,
                })
            }
        }

        impl Pdu for $message {
            const NAME: &'static str = $name;
            const LEN_MAX: usize = $len_max;
            fn header(&self) -> ItsPduHeader {
                self.header
            }
            fn expected_header(identifiers: &Identifiers) -> (u8, u8) {
                let own = &identifiers.$identifiers;
                (own.protocol_version, own.message_id)
            }
        }
    };
}

by_the_core!(RAM, "RAM", RAM_LEN_MAX, ram);
by_the_core!(RMCM, "RMCM", RMCM_LEN_MAX, rmcm);

/// A message as it was received.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Received<M> {
    /// Its part that this crate knows.
    pub message: M,
    /// How many SEQUENCEs of it had extension additions that this crate does not know. They were
    /// skipped; their sender speaks a newer version of the message. Not counted in a message of another
    /// station than robots.
    pub extended: usize,
    /// True if the octets are the canonical encoding. A RAM or RMCM has no other one, but for additions;
    /// other stations may spell out a DEFAULT, or know additions that this crate does not.
    pub is_canonical: bool,
}

impl<M> Received<M> {
    /// The same with another message.
    pub(crate) fn map<N>(self, wrap: impl FnOnce(M) -> N) -> Received<N> {
        Received {
            message: wrap(self.message),
            extended: self.extended,
            is_canonical: self.is_canonical,
        }
    }
}

/// The canonical encoding of `message`.
///
/// # Errors
/// When the header is not that of the message. Every other RAM and RMCM has an encoding; other messages
/// may hold numbers and sizes that have none.
#[cfg(feature = "std")]
pub fn encode<M: Pdu>(identifiers: &Identifiers, message: &M) -> Result<Vec<u8>, EncodeError> {
    let mut octets = vec![0; M::LEN_MAX];
    let length = encode_into(identifiers, message, &mut octets)?;
    octets.truncate(length);
    Ok(octets)
}

/// Writes the canonical encoding of `message` into the front of `buffer`, and tells how many octets
/// that takes. [`Pdu::LEN_MAX`] are enough for every message. A RAM or an RMCM takes no heap.
///
/// # Errors
/// When the header is not that of the message, and when the buffer is too small. The buffer may have
/// been written to.
pub fn encode_into<M: Pdu>(
    identifiers: &Identifiers,
    message: &M,
    buffer: &mut [u8],
) -> Result<usize, EncodeError> {
    let (protocol_version, message_id) = M::expected_header(identifiers);
    let found = message.header();
    let header = |field, found, expected| EncodeError::Header {
        message: M::NAME,
        field,
        found,
        expected,
    };
    if found.protocol_version.0 != protocol_version {
        let found = found.protocol_version.0;
        return Err(header("protocolVersion", found, protocol_version));
    }
    if found.message_id.0 != message_id {
        return Err(header("messageId", found.message_id.0, message_id));
    }
    message.write(buffer)
}

/// The message that `octets` encode.
///
/// Of a RAM and an RMCM exactly the canonical encodings are accepted, with or without extension additions
/// that this crate does not know; of other messages every encoding. No input makes it panic. A RAM or an RMCM takes no heap, neither when it is accepted
/// nor when it is refused; what another message allocates is bounded by [`MESSAGE_LEN_MAX`].
///
/// # Errors
/// Why the octets are not such a message, and which field says so.
pub fn decode<M: Pdu>(
    identifiers: &Identifiers,
    octets: &[u8],
) -> Result<Received<M>, DecodeError> {
    let header = header_of(octets)?;
    let (known, message_id) = M::expected_header(identifiers);
    if header.message_id.0 != message_id {
        return Err(DecodeError::MessageId {
            found: header.message_id.0,
            expected: M::NAME,
        });
    }
    if header.protocol_version.0 != known {
        let found = header.protocol_version.0;
        return Err(DecodeError::ProtocolVersion {
            message: M::NAME,
            found,
            known,
        });
    }
    M::read(identifiers, octets)
}

/// The header that begins every message.
pub(crate) fn header_of(octets: &[u8]) -> Result<ItsPduHeader, DecodeError> {
    let length = octets.len();
    if length > MESSAGE_LEN_MAX {
        return Err(DecodeError::TooLong {
            length,
            max: MESSAGE_LEN_MAX,
        });
    }
    match ItsPduHeader::decode(Reader::new(octets)) {
        Ok((header, _)) => Ok(header),
        Err(_) => Err(DecodeError::TooShort { length }),
    }
}

/// The header of a message from `station`.
pub(crate) fn header<M: Pdu>(
    identifiers: &Identifiers,
    station: crossguard_protocol::StationId,
) -> ItsPduHeader {
    let (protocol_version, message_id) = M::expected_header(identifiers);
    ItsPduHeader {
        protocol_version: OrdinalNumber1B(protocol_version),
        message_id: MessageId(message_id),
        station_id: wire::station(station),
    }
}

/// A message of the robots, told apart by its header.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "foreign", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "foreign", serde(rename_all = "lowercase"))]
#[allow(clippy::large_enum_variant, reason = "there is no heap")]
pub enum Message {
    /// Robot awareness message.
    Ram(RAM),
    /// Robot maneuver coordination message.
    Rmcm(RMCM),
}

impl Message {
    /// The canonical encoding of the message.
    ///
    /// # Errors
    /// As for [`encode`].
    #[cfg(feature = "std")]
    pub fn encode(&self, identifiers: &Identifiers) -> Result<Vec<u8>, EncodeError> {
        match self {
            Self::Ram(ram) => encode(identifiers, ram),
            Self::Rmcm(rmcm) => encode(identifiers, rmcm),
        }
    }

    /// The message whose canonical encoding `octets` are; its header says which it is.
    ///
    /// # Errors
    /// As for [`decode`].
    pub fn decode(identifiers: &Identifiers, octets: &[u8]) -> Result<Received<Self>, DecodeError> {
        let found = header_of(octets)?.message_id.0;
        if found == identifiers.ram.message_id {
            Ok(decode(identifiers, octets)?.map(Self::Ram))
        } else if found == identifiers.rmcm.message_id {
            Ok(decode(identifiers, octets)?.map(Self::Rmcm))
        } else {
            Err(DecodeError::MessageId {
                found,
                expected: "RAM or RMCM",
            })
        }
    }
}
