//! The messages of other stations: CAM, VAM and CPM, in the versions that are on the road.
//!
//! | message | standard | dictionary (TS 102 894-2) |
//! |---|---|---|
//! | [`CAM`] | TS 103 900 v2.3.1; EN 302 637-2 v1.4.1 has the same bits | v2.4.1 |
//! | the same, `protocolVersion` 1 | EN 302 637-2 v1.3.2, read without the special vehicle container | v1.2.1 |
//! | [`VAM`] | TS 103 300-3 v2.3.1 | v2.4.1 |
//! | [`VAM211`] | TS 103 300-3 v2.2.1 | v2.1.1 |
//! | [`CPM`] | TS 103 324 v2.1.1 | v2.4.1 or v2.1.1 |
//!
//! Their headers do not tell one dictionary from another: [`Identifiers::dictionary`] says which one
//! the stations on the channel use. They are read as rasn reads them: in every encoding of a value,
//! also one that spells out a DEFAULT or has extension additions that this crate does not know, which
//! [`Received::is_canonical`] tells. A value outside of its range is an error with its field. The extension containers of a CAM (two-wheelers, paths, lanes and the like, which release 2
//! adds) are kept as the octets that they are on the wire, and not looked into.
//!
//! Not read are events (DENM): nothing that a robot does would follow from one.

mod cpm;
mod release1;
mod road_user;

use serde::{Deserialize, Serialize};

use crate::asn1;
use crate::asn1::cam::CAM;
use crate::asn1::cdd211::VAM211;
use crate::asn1::vam::VAM;
use crate::core::Fault;
use crate::core::cdd::{ItsPduHeader, MessageId, OrdinalNumber1B, StationId};
use crate::core::ram::RAM;
use crate::core::rmcm::RMCM;
use crate::error::{DecodeError, EncodeError, FieldPath};
use crate::identifiers::{Dictionary, Identifiers};
use crate::message::sealed::Sealed;
use crate::message::{Pdu, Received, decode, encode, header_of};
use crate::size::MESSAGE_LEN_MAX;

pub use cpm::{CPM, CpmContainer};

/// `protocolVersion` and `messageId` of CAM.
const CAM_HEADER: (u8, u8) = (2, 2);
/// `protocolVersion` of CAM before 2018.
const RELEASE_1: u8 = 1;
/// Protocol version and message id of CPM.
const CPM_HEADER: (u8, u8) = (2, 14);
/// Protocol version and message id of VAM.
const VAM_HEADER: (u8, u8) = (3, 16);

/// A message of a robot or of another station.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum ItsMessage {
    /// Robot awareness.
    Ram(Box<RAM>),
    /// Robot maneuver coordination.
    Rmcm(Box<RMCM>),
    /// Cooperative awareness.
    Cam(Box<CAM>),
    /// Awareness of a vulnerable road user.
    Vam(Box<VAM>),
    /// The same on the dictionary v2.1.1.
    Vam211(Box<VAM211>),
    /// Collective perception.
    Cpm(Box<CPM>),
}

impl ItsMessage {
    /// The message that `octets` encode; its header says which it is.
    ///
    /// # Errors
    /// Why the octets are not such a message, and which field says so.
    pub fn decode(identifiers: &Identifiers, octets: &[u8]) -> Result<Received<Self>, DecodeError> {
        fn of<M: Pdu>(
            identifiers: &Identifiers,
            octets: &[u8],
            wrap: impl FnOnce(Box<M>) -> ItsMessage,
        ) -> Result<Received<ItsMessage>, DecodeError> {
            Ok(decode::<M>(identifiers, octets)?.map(Box::new).map(wrap))
        }
        let header = header_of(octets)?;
        let found = header.message_id.0;
        let is_release_1 = header.protocol_version.0 == RELEASE_1;
        match (found, identifiers.dictionary) {
            (id, _) if id == identifiers.ram.message_id => of(identifiers, octets, Self::Ram),
            (id, _) if id == identifiers.rmcm.message_id => of(identifiers, octets, Self::Rmcm),
            (id, _) if id == CAM_HEADER.1 && is_release_1 => {
                Ok(release1::cam(octets)?.map(Box::new).map(Self::Cam))
            }
            (id, _) if id == CAM_HEADER.1 => of(identifiers, octets, Self::Cam),
            (id, _) if id == CPM_HEADER.1 => of(identifiers, octets, Self::Cpm),
            (id, Dictionary::V2_4_1) if id == VAM_HEADER.1 => of(identifiers, octets, Self::Vam),
            (id, Dictionary::V2_1_1) if id == VAM_HEADER.1 => of(identifiers, octets, Self::Vam211),
            _ => Err(DecodeError::MessageId {
                found,
                expected: "RAM, RMCM, CAM, VAM or CPM",
            }),
        }
    }

    /// The canonical encoding of the message.
    ///
    /// # Errors
    /// Why it has none.
    pub fn encode(&self, identifiers: &Identifiers) -> Result<Vec<u8>, EncodeError> {
        match self {
            Self::Ram(ram) => encode(identifiers, &**ram),
            Self::Rmcm(rmcm) => encode(identifiers, &**rmcm),
            Self::Cam(cam) => encode(identifiers, &**cam),
            Self::Vam(vam) => encode(identifiers, &**vam),
            Self::Vam211(vam) => encode(identifiers, &**vam),
            Self::Cpm(cpm) => encode(identifiers, &**cpm),
        }
    }

    /// The header of the message.
    #[must_use]
    pub fn header(&self) -> ItsPduHeader {
        match self {
            Self::Ram(ram) => ram.header(),
            Self::Rmcm(rmcm) => rmcm.header(),
            Self::Cam(cam) => cam.header(),
            Self::Vam(vam) => vam.header(),
            Self::Vam211(vam) => vam.header(),
            Self::Cpm(cpm) => cpm.header(),
        }
    }

    /// Which standard, in which version, the message is of.
    #[must_use]
    pub fn standard(&self) -> &'static str {
        match self {
            Self::Ram(_) => "Crossguard-RAM on TS 102 894-2 v2.4.1",
            Self::Rmcm(_) => "Crossguard-RMCM on TS 102 894-2 v2.4.1",
            Self::Cam(cam) if cam.header.protocol_version.0 == RELEASE_1 => {
                "EN 302 637-2 v1.3.2 on TS 102 894-2 v1.2.1"
            }
            Self::Cam(cam) if cam.cam.cam_parameters.extension_containers.is_some() => {
                "TS 103 900 v2.3.1 on TS 102 894-2 v2.4.1"
            }
            Self::Cam(_) => {
                "EN 302 637-2 v1.4.1 and TS 103 900 v2.3.1, which have the same bits here"
            }
            Self::Vam(_) => "TS 103 300-3 v2.3.1 on TS 102 894-2 v2.4.1",
            Self::Vam211(_) => "TS 103 300-3 v2.2.1 on TS 102 894-2 v2.1.1",
            Self::Cpm(cpm) => match cpm.dictionary() {
                Some(Dictionary::V2_1_1) => "TS 103 324 v2.1.1 on TS 102 894-2 v2.1.1",
                Some(Dictionary::V2_4_1) => "TS 103 324 v2.1.1 on TS 102 894-2 v2.4.1",
                None => "TS 103 324 v2.1.1",
            },
        }
    }
}

/// The header of the core.
const fn core_header(header: &asn1::cdd::ItsPduHeader) -> ItsPduHeader {
    ItsPduHeader {
        protocol_version: OrdinalNumber1B(header.protocol_version.0),
        message_id: MessageId(header.message_id.0),
        station_id: StationId(header.station_id.0),
    }
}

impl<M> Received<M> {
    /// A message that rasn has decoded.
    fn of_another(decoded: asn1::Decoded<M>) -> Self {
        Self {
            message: decoded.value,
            extended: 0,
            is_canonical: decoded.is_canonical,
        }
    }
}

/// Copies an encoding to where the caller wants it.
fn put(octets: &[u8], buffer: &mut [u8]) -> Result<usize, EncodeError> {
    let Some(buffer) = buffer.get_mut(..octets.len()) else {
        return Err(EncodeError::Malformed {
            field: FieldPath::default(),
            fault: Fault::BufferFull,
        });
    };
    buffer.copy_from_slice(octets);
    Ok(octets.len())
}

/// Parts of every message beside its codec.
macro_rules! pdu {
    ($message:ident, $name:literal, $header:expr) => {
        impl Pdu for $message {
            const NAME: &'static str = $name;
            const LEN_MAX: usize = MESSAGE_LEN_MAX;
            fn header(&self) -> ItsPduHeader {
                core_header(&self.header)
            }
            fn expected_header(_: &Identifiers) -> (u8, u8) {
                $header
            }
        }
    };
}

/// The codec of messages that are one rasn type.
macro_rules! by_rasn {
    ($message:ident, $name:literal, $header:expr) => {
        impl Sealed for $message {
            fn write(&self, buffer: &mut [u8]) -> Result<usize, EncodeError> {
                put(&asn1::encode(self)?, buffer)
            }

            fn read(_: &Identifiers, octets: &[u8]) -> Result<Received<Self>, DecodeError> {
                Ok(Received::of_another(asn1::decode(octets)?))
            }
        }

        pdu!($message, $name, $header);
    };
}

by_rasn!(CAM, "CAM", CAM_HEADER);
by_rasn!(VAM, "VAM", VAM_HEADER);
by_rasn!(VAM211, "VAM", VAM_HEADER);
pdu!(CPM, "CPM", CPM_HEADER);
