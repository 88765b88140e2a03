//! Layers under a message: `GeoNetworking` and BTP-B.
//!
//! Basic header, common header, the extended headers of single-hop broadcast (SHB) and geo-broadcast
//! (GBC) of EN 302 636-4-1, and BTP-B of EN 302 636-5-1.
//!
//! ```text
//!  octet 0        4         12                    36        40      44
//!        ├ basic ─┼ common ─┼ source position ────┼ media ──┼ BTP-B ┼ payload     SHB
//!        ├ basic ─┼ common ─┼ number ┼ source position ┼ area ──┼ BTP-B ┼ payload  GBC
//!                 │         12       16                40       56      60
//!                 └── what a security envelope covers, and stands around
//! ```
//!
//! - [`Headers::decode`] accepts what [`Headers::encode`] gives, whatever the reserved bits are: they are sent as zero and
//!   ignored. The payload length is that of what follows. All integers are big-endian.
//! - [`Stack`] makes whole packets of messages and messages of packets, without input and output. It
//!   is an end point: it forwards nothing, and takes no geo-broadcast, since no message that it takes is sent by one.
//! - [`ethernet`] frames a packet for a link that is no UDP socket.
//!
//! Without heap, but for what a security envelope takes.

mod codec;
mod discarded;
mod ego;
mod envelope;
mod error;
pub mod ethernet;
#[cfg(feature = "laws")]
#[doc(hidden)]
pub mod laws;
mod opened;
mod request;
#[cfg(feature = "security")]
mod secured;
mod stack;

use serde::{Deserialize, Serialize};

pub use codec::Encoded;
pub use discarded::{Discarded, EnvelopeError};
pub use ego::EgoPosition;
pub use envelope::Envelope;
pub use error::{GeonetError, HeaderField};
pub use opened::{Admitted, Opened, Permits, Signer};
pub use request::Request;
#[cfg(feature = "security")]
pub use secured::{Demand, Secured, origin, station_of};
pub use stack::{Indication, SendError, Stack};

/// Octets of the basic header.
pub const BASIC_LEN: usize = 4;

/// The longest headers, those of a geo-broadcast, in octets.
pub const HEADERS_LEN_MAX: usize = 60;

/// The longest packet, in octets: what an Ethernet frame carries.
pub const PACKET_LEN_MAX: usize = 1_500;

/// The first header of a packet, which no security envelope covers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct BasicHeader {
    /// The header that follows it.
    pub next: NextHeader,
    /// How long the packet may live.
    pub lifetime: Lifetime,
    /// Over how many hops it may yet go.
    pub remaining_hop_limit: u8,
}

/// Headers that follow a basic header.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NextHeader {
    /// The common header.
    Common,
    /// A security envelope with the common header in it.
    Secured,
}

/// The headers of a packet.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Headers {
    /// How long the packet may live.
    pub lifetime: Lifetime,
    /// Over how many hops it may yet go, at most [`maximum_hop_limit`](Self::maximum_hop_limit).
    pub remaining_hop_limit: u8,
    /// Over how many hops it could go when it was sent; 1 for single-hop broadcast.
    pub maximum_hop_limit: u8,
    /// Its traffic class.
    pub traffic_class: TrafficClass,
    /// True if its source can move, `itsGnIsMobile`.
    pub is_mobile: bool,
    /// Where its source is.
    pub source: LongPositionVector,
    /// Its destination.
    pub transport: Transport,
    /// BTP-B destination port; see TS 103 248 for assigned ports.
    pub port: u16,
    /// BTP-B destination port info, 0 unless the port defines it.
    pub port_info: u16,
}

/// The lifetime of a packet, a multiple of its base: 50 ms to 6300 s (EN 302 636-4-1, basic header).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Lifetime {
    /// How many times the base, 0..63.
    pub multiplier: u8,
    /// The unit.
    pub base: LifetimeBase,
}

/// Units of a [`Lifetime`] (EN 302 636-4-1, basic header).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum LifetimeBase {
    /// 50 ms.
    FiftyMilliseconds,
    /// 1 s.
    OneSecond,
    /// 10 s.
    TenSeconds,
    /// 100 s.
    HundredSeconds,
}

/// The traffic class of a packet.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct TrafficClass {
    /// True if a forwarder keeps it until there is a neighbour (SCF).
    pub store_carry_forward: bool,
    /// True if it may go over another channel.
    pub channel_offload: bool,
    /// 0..63; 0..3 are the DCC profiles DP0..DP3.
    pub id: u8,
}

/// A `GeoNetworking` address.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Address {
    /// True if it was configured by hand.
    pub is_manual: bool,
    /// `StationType` of the common data dictionary, 0..31.
    pub station_type: u8,
    /// 10 bits that are reserved, and a country code in older versions: 0..1023.
    pub country_code: u16,
    /// Link-layer address.
    pub link_layer: [u8; 6],
}

/// Where and how fast a station was at a time.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LongPositionVector {
    /// The station.
    pub address: Address,
    /// `TimestampIts` modulo 2^32, in milliseconds.
    pub timestamp: u32,
    /// 10^-7 degree, north positive.
    pub latitude: i32,
    /// 10^-7 degree, east positive.
    pub longitude: i32,
    /// Position accuracy indicator (PAI).
    pub is_accurate: bool,
    /// 0.01 m/s, -16384..16383.
    pub speed: i16,
    /// 0.1 degree, clockwise from north.
    pub heading: u16,
}

/// Destination of a packet.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all_fields = "camelCase", rename_all = "camelCase")]
pub enum Transport {
    /// To everybody who hears it.
    SingleHop {
        /// Media-dependent data; that of ITS-G5 is in TS 102 636-4-2, zeros are fine.
        media: [u8; 4],
    },
    /// To everybody in an area.
    GeoBroadcast {
        /// Number of the packet, for the detection of duplicates.
        sequence_number: u16,
        /// The area.
        area: Area,
    },
}

/// A destination area.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Area {
    /// Its shape.
    pub shape: Shape,
    /// Latitude of its centre, 10^-7 degree, north positive.
    pub latitude: i32,
    /// Longitude of its centre, 10^-7 degree, east positive.
    pub longitude: i32,
    /// Radius, or half of the long side or axis, in metres.
    pub distance_a: u16,
    /// 0, or half of the short side or axis, in metres.
    pub distance_b: u16,
    /// Of the long side or axis, in degrees clockwise from north.
    pub angle: u16,
}

/// The shape of an [`Area`] (EN 302 931).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Shape {
    /// A circle.
    Circle,
    /// A rectangle.
    Rectangle,
    /// An ellipse.
    Ellipse,
}

impl Address {
    /// The address of a station that goes by its station id: a link-layer address that is locally
    /// administered, `02:00` and the four octets of the id. So it changes with the pseudonym.
    ///
    /// Of the station type the address has 5 bits; a larger one is `unknown`.
    #[must_use]
    pub const fn of_station(station: u32, station_type: u8) -> Self {
        let [a, b, c, d] = station.to_be_bytes();
        Self {
            is_manual: false,
            station_type: if station_type < 32 { station_type } else { 0 },
            country_code: 0,
            link_layer: [0x02, 0x00, a, b, c, d],
        }
    }
}

impl TrafficClass {
    /// The class with this DCC profile, 0..3 for DP0..DP3.
    #[must_use]
    pub const fn of_profile(id: u8) -> Self {
        Self {
            store_carry_forward: false,
            channel_offload: false,
            id,
        }
    }
}

impl Lifetime {
    /// The bases in the order of their numbers in the basic header, with their milliseconds.
    const BASES: [(LifetimeBase, u32); 4] = [
        (LifetimeBase::FiftyMilliseconds, 50),
        (LifetimeBase::OneSecond, 1_000),
        (LifetimeBase::TenSeconds, 10_000),
        (LifetimeBase::HundredSeconds, 100_000),
    ];

    /// The smallest lifetime that is not shorter than this many milliseconds; saturates at 6300 s.
    #[must_use]
    pub const fn of_milliseconds(milliseconds: u32) -> Self {
        let mut index = 0;
        while index < 3 && milliseconds > 63 * Self::BASES[index].1 {
            index += 1;
        }
        let (base, unit) = Self::BASES[index];
        let multiplier = milliseconds.div_ceil(unit);
        #[expect(clippy::cast_possible_truncation, reason = "at most 63")]
        let multiplier = if multiplier < 63 {
            multiplier as u8
        } else {
            63
        };
        Self { multiplier, base }
    }

    /// The lifetime in milliseconds.
    #[must_use]
    pub const fn milliseconds(self) -> u32 {
        self.multiplier as u32 * Self::BASES[self.base as usize].1
    }
}
