//! The attachment protocol: the frames between a robot and the application of an on-board unit, one in each UDP
//! datagram. The reference page is `harness/doc/attachment.md`.
//!
//! ```text
//!  0        2  3  4      6     8         10 11  12     14          16            24
//!  ├────────┼──┼──┼──────┼─────┼─────────┼──┼───┼──────┼───────────┼─────────────┼──────┤
//!  │ "CG"   │ 1│kind│length│port│port info│TC│ 0 │power │busy ratio │ time        │ body │
//! ```
//!
//! All numbers are big-endian. A field that the sender does not know has the value for *unknown*. The length says how
//! many octets the body has, and nothing follows them.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crossguard_codec::geonet::{
    Address, GeonetError, Headers, Lifetime, LongPositionVector, TrafficClass, Transport,
};
use serde::Deserialize;

/// First octets of each frame.
pub const MAGIC: [u8; 2] = *b"CG";
/// The version of this protocol.
pub const VERSION: u8 = 1;
/// Octets in front of the body.
pub const HEADER_LEN: usize = 24;
/// The longest body.
pub const BODY_LEN_MAX: usize = 2_000;

/// A busy ratio of 1.
const BUSY_ALWAYS: u16 = 10_000;
const BUSY_UNKNOWN: u16 = u16::MAX;
const POWER_UNKNOWN: i16 = i16::MIN;

/// Kind of a frame.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// The robot is here: to be said once a second, and answered by [`Kind::Channel`].
    Hello = 0,
    /// The robot asks to send a `GeoNetworking` packet.
    SendPacket = 1,
    /// The robot asks to send a payload by BTP-B and single-hop broadcast.
    SendPayload = 2,
    /// The unit has received a `GeoNetworking` packet.
    ReceivedPacket = 3,
    /// The unit has received a payload by BTP-B.
    ReceivedPayload = 4,
    /// The unit is here, and says how the channel is.
    Channel = 5,
}

impl Kind {
    const ALL: [Self; 6] = [
        Self::Hello,
        Self::SendPacket,
        Self::SendPayload,
        Self::ReceivedPacket,
        Self::ReceivedPayload,
        Self::Channel,
    ];

    /// The side that sends it.
    #[must_use]
    pub const fn side(self) -> Side {
        match self {
            Self::Hello | Self::SendPacket | Self::SendPayload => Side::Robot,
            Self::ReceivedPacket | Self::ReceivedPayload | Self::Channel => Side::Unit,
        }
    }

    /// Whether it has a body.
    #[must_use]
    pub const fn has_body(self) -> bool {
        !matches!(self, Self::Hello | Self::Channel)
    }
}

/// Which of the two sends a frame.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// The robot.
    Robot,
    /// The on-board unit.
    Unit,
}

/// Measurements of a unit.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Radio {
    /// Power of the reception, in tenths of dBm.
    pub power_decidbm: Option<i16>,
    /// Channel busy ratio, in ten-thousandths.
    pub busy_permyriad: Option<u16>,
}

impl Radio {
    /// Whether nothing is known.
    #[must_use]
    pub const fn is_unknown(&self) -> bool {
        self.power_decidbm.is_none() && self.busy_permyriad.is_none()
    }

    /// The channel busy ratio, from 0 to 1.
    #[must_use]
    pub fn busy_ratio(&self) -> Option<f64> {
        let permyriad = self.busy_permyriad?;
        Some(f64::from(permyriad) / f64::from(BUSY_ALWAYS))
    }

    /// The power of the reception, in dBm.
    #[must_use]
    pub fn power_dbm(&self) -> Option<f64> {
        self.power_decidbm.map(|decidbm| f64::from(decidbm) / 10.0)
    }
}

/// BTP-B port and traffic class of a payload; of no meaning with a packet, which has its own.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Btp {
    /// Destination port.
    pub port: u16,
    /// Destination port info.
    pub port_info: u16,
    /// Traffic class, as the octet of a `GeoNetworking` header.
    pub traffic_class: u8,
}

/// A frame.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Frame<'a> {
    /// Its kind.
    pub kind: Kind,
    /// Port and traffic class of a payload.
    pub btp: Btp,
    /// Measurements of the unit.
    pub radio: Radio,
    /// When the unit received the body, in µs since 1970 (UTC).
    pub unix_us: Option<u64>,
    /// The packet or payload.
    pub body: &'a [u8],
}

/// Why octets are no frame, or none for this side.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum FrameError {
    /// They are shorter than a header.
    #[error("{0} octets are too few for a frame, whose header has {HEADER_LEN}")]
    Short(usize),
    /// They begin otherwise.
    #[error("it begins with {0:#04x} {1:#04x}, and a frame with 'CG'")]
    Magic(u8, u8),
    /// They are of another version.
    #[error("version {0} is not spoken here, but {VERSION}")]
    Version(u8),
    /// There is no such kind.
    #[error("no kind of frame is {0}")]
    Kind(u8),
    /// The kind is one that the other side sends.
    #[error("{0:?} is sent by the other side")]
    Side(Kind),
    /// The length is not that of the body.
    #[error("the length is {announced}, and {present} octets follow the header")]
    Length {
        /// Length in the header, in octets.
        announced: u16,
        /// Octets that are there.
        present: usize,
    },
    /// There is a body where none may be, or none where one has to be.
    #[error("{kind:?} with a body of {length} octets")]
    Body {
        /// The kind.
        kind: Kind,
        /// Octets of the body.
        length: usize,
    },
    /// The body is too long.
    #[error("a body of {0} octets is too long, the limit is {BODY_LEN_MAX}")]
    TooLong(usize),
    /// No channel is as busy as that.
    #[error("a busy ratio of {0} ten-thousandths is above 1")]
    BusyRatio(u16),
}

impl FrameError {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(self) -> &'static str {
        match self {
            Self::Short(_) => "frame too short",
            Self::Magic(..) => "no frame",
            Self::Version(_) => "frame version",
            Self::Kind(_) => "frame kind",
            Self::Side(_) => "frame of the other side",
            Self::Length { .. } => "frame length",
            Self::Body { .. } => "frame body",
            Self::TooLong(_) => "frame too long",
            Self::BusyRatio(_) => "frame busy ratio",
        }
    }
}

impl<'a> Frame<'a> {
    /// A frame that says nothing but its kind and body.
    #[must_use]
    pub fn new(kind: Kind, body: &'a [u8]) -> Self {
        Self {
            kind,
            btp: Btp::default(),
            radio: Radio::default(),
            unix_us: None,
            body,
        }
    }

    /// Its octets.
    ///
    /// # Errors
    /// When the body or the busy ratio cannot be.
    pub fn encode(&self) -> Result<Vec<u8>, FrameError> {
        let length = self.checked_length()?;
        if let Some(busy) = self.radio.busy_permyriad.filter(|busy| *busy > BUSY_ALWAYS) {
            return Err(FrameError::BusyRatio(busy));
        }
        let power = self.radio.power_decidbm.unwrap_or(POWER_UNKNOWN);
        let busy = self.radio.busy_permyriad.unwrap_or(BUSY_UNKNOWN);
        let mut octets = Vec::with_capacity(HEADER_LEN + self.body.len());
        octets.extend(MAGIC);
        octets.extend([VERSION, self.kind as u8]);
        octets.extend(length.to_be_bytes());
        octets.extend(self.btp.port.to_be_bytes());
        octets.extend(self.btp.port_info.to_be_bytes());
        octets.extend([self.btp.traffic_class, 0]);
        octets.extend(power.to_be_bytes());
        octets.extend(busy.to_be_bytes());
        octets.extend(self.unix_us.unwrap_or(0).to_be_bytes());
        octets.extend(self.body);
        Ok(octets)
    }

    /// Reads a frame that the other side has sent.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn decode(octets: &'a [u8], sent_by: Side) -> Result<Self, FrameError> {
        let (header, body) = octets
            .split_first_chunk::<HEADER_LEN>()
            .ok_or(FrameError::Short(octets.len()))?;
        let two = |at: usize| [header[at], header[at + 1]];
        if header[..2] != MAGIC {
            return Err(FrameError::Magic(header[0], header[1]));
        }
        if header[2] != VERSION {
            return Err(FrameError::Version(header[2]));
        }
        let kind = Kind::ALL.into_iter().find(|it| *it as u8 == header[3]);
        let kind = kind.ok_or(FrameError::Kind(header[3]))?;
        if kind.side() != sent_by {
            return Err(FrameError::Side(kind));
        }
        let announced = u16::from_be_bytes(two(4));
        let present = body.len();
        if usize::from(announced) != present {
            return Err(FrameError::Length { announced, present });
        }
        let power = Some(i16::from_be_bytes(two(12))).filter(|it| *it != POWER_UNKNOWN);
        let busy = Some(u16::from_be_bytes(two(14))).filter(|it| *it != BUSY_UNKNOWN);
        if let Some(impossible) = busy.filter(|busy| *busy > BUSY_ALWAYS) {
            return Err(FrameError::BusyRatio(impossible));
        }
        let (_, time) = header.split_last_chunk::<8>().unwrap_or((&[], &[0; 8]));
        let frame = Self {
            kind,
            btp: Btp {
                port: u16::from_be_bytes(two(6)),
                port_info: u16::from_be_bytes(two(8)),
                traffic_class: header[10],
            },
            radio: Radio {
                power_decidbm: power,
                busy_permyriad: busy,
            },
            unix_us: Some(u64::from_be_bytes(*time)).filter(|it| *it != 0),
            body,
        };
        frame.checked_length()?;
        Ok(frame)
    }

    fn checked_length(&self) -> Result<u16, FrameError> {
        let length = self.body.len();
        if self.kind.has_body() == self.body.is_empty() {
            let kind = self.kind;
            return Err(FrameError::Body { kind, length });
        }
        match u16::try_from(length) {
            Ok(short) if length <= BODY_LEN_MAX => Ok(short),
            _ => Err(FrameError::TooLong(length)),
        }
    }
}

/// Data that a robot gives to its unit.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sends {
    /// Whole `GeoNetworking` packets, signed if the robot signs.
    #[default]
    GeoNetworking,
    /// Payloads with port and traffic class: the unit has `GeoNetworking`, and security, of its own.
    Btp,
}

/// The payload of an unsigned packet, with its port and traffic class.
///
/// # Errors
/// When the packet is signed, or is none.
pub fn payload_of(packet: &[u8]) -> Result<(Btp, &[u8]), GeonetError> {
    let (headers, payload) = Headers::decode(packet)?;
    let class = headers.traffic_class;
    let flags = u8::from(class.store_carry_forward) << 7 | u8::from(class.channel_offload) << 6;
    let btp = Btp {
        port: headers.port,
        port_info: headers.port_info,
        traffic_class: flags | class.id & 0x3F,
    };
    Ok((btp, payload))
}

/// A packet with a payload, as if it came from a station of which nothing is known but that payload. A unit that
/// has `GeoNetworking` of its own puts what it knows into the packet's source.
///
/// # Errors
/// When the payload is too long.
pub fn packet_of(btp: Btp, payload: &[u8]) -> Result<Vec<u8>, GeonetError> {
    let headers = Headers {
        lifetime: Lifetime::of_milliseconds(1_000),
        remaining_hop_limit: 1,
        maximum_hop_limit: 1,
        traffic_class: TrafficClass {
            store_carry_forward: btp.traffic_class & 0x80 != 0,
            channel_offload: btp.traffic_class & 0x40 != 0,
            id: btp.traffic_class & 0x3F,
        },
        is_mobile: true,
        source: LongPositionVector {
            address: Address {
                is_manual: false,
                station_type: 0,
                country_code: 0,
                link_layer: [0x02, 0, 0, 0, 0, 0],
            },
            timestamp: 0,
            latitude: 0,
            longitude: 0,
            is_accurate: false,
            speed: 0,
            heading: 0,
        },
        transport: Transport::SingleHop { media: [0; 4] },
        port: btp.port,
        port_info: btp.port_info,
    };
    let encoded = headers.encode(payload.len())?;
    Ok([encoded.as_ref(), payload].concat())
}

/// A moment as frames have it: microseconds since 1970.
#[must_use]
pub fn unix_us(time: SystemTime) -> u64 {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_micros()).unwrap_or(u64::MAX)
}

/// For how long something has waited that arrived then, by the wall clock; nothing if that is in the future.
#[must_use]
pub fn waited(since_unix_us: u64, now: SystemTime) -> Duration {
    Duration::from_micros(unix_us(now).saturating_sub(since_unix_us))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn received() -> Frame<'static> {
        Frame {
            kind: Kind::ReceivedPayload,
            btp: Btp {
                port: 2_001,
                port_info: 7,
                traffic_class: 0x82,
            },
            radio: Radio {
                power_decidbm: Some(-853),
                busy_permyriad: Some(8_000),
            },
            unix_us: Some(1_700_000_000_123_456),
            body: b"payload",
        }
    }

    #[test]
    fn the_octets_of_a_frame_are_those_of_the_page() {
        let octets = received().encode().unwrap();
        let expected = "434701040007\
                        07d100078200\
                        fcab1f40\
                        00060a2418202240\
                        7061796c6f6164";
        assert_eq!(hex::encode(&octets), expected);
        assert_eq!(Frame::decode(&octets, Side::Unit), Ok(received()));
    }

    #[test]
    fn what_a_frame_does_not_say_is_unknown() {
        for kind in Kind::ALL {
            let body: &[u8] = if kind.has_body() { b"body" } else { b"" };
            let frame = Frame::new(kind, body);
            let octets = frame.encode().unwrap();
            let decoded = Frame::decode(&octets, kind.side()).unwrap();
            assert_eq!(decoded, frame);
            assert!(decoded.radio.is_unknown() && decoded.unix_us.is_none());
        }
    }

    #[test]
    fn each_bad_frame_has_a_cause_of_its_own() {
        let good = received().encode().unwrap();
        let with = |at: usize, octet: u8| {
            let mut bad = good.clone();
            bad[at] = octet;
            bad
        };
        let longer = [&good[..], b"!"].concat();
        let channel = [&with(3, Kind::Channel as u8)[..]].concat();
        let (announced, present) = (7, 8);
        let length = FrameError::Length { announced, present };
        let (kind, of_channel) = (Kind::Channel, 7);
        let body = FrameError::Body {
            kind,
            length: of_channel,
        };
        let bad_frames = [
            (good[..HEADER_LEN - 1].to_vec(), FrameError::Short(23)),
            (with(1, 0), FrameError::Magic(b'C', 0)),
            (with(2, 2), FrameError::Version(2)),
            (with(3, 6), FrameError::Kind(6)),
            (with(3, 2), FrameError::Side(Kind::SendPayload)),
            (longer, length),
            (channel, body),
            (with(14, 0xF0), FrameError::BusyRatio(0xF040)),
        ];
        let mut causes = std::collections::BTreeSet::new();
        for (octets, expected) in bad_frames {
            assert_eq!(Frame::decode(&octets, Side::Unit), Err(expected));
            assert!(causes.insert(expected.cause()), "{}", expected.cause());
        }
        let long = vec![0; BODY_LEN_MAX + 1];
        let too_long = Frame::new(Kind::SendPacket, &long).encode();
        assert_eq!(too_long, Err(FrameError::TooLong(2_001)));
    }

    #[test]
    fn no_octets_make_the_decoder_panic() {
        let good = received().encode().unwrap();
        for length in 0..=good.len() {
            for octet in 0..=255 {
                let mut octets = good[..length].to_vec();
                if let Some(last) = octets.last_mut() {
                    *last = octet;
                }
                let _ = Frame::decode(&octets, Side::Unit);
            }
        }
    }

    #[test]
    fn a_payload_comes_back_from_its_packet() {
        let (btp, payload) = (received().btp, received().body);
        let packet = packet_of(btp, payload).unwrap();
        assert_eq!(payload_of(&packet), Ok((btp, payload)));
    }
}
