//! Headers from octets and to octets.
//!
//! Reserved bits are sent as zero and ignored on reception, as EN 302 636-4-1 wants of fields that a later version
//! may use: the octet behind the basic header's first, the low bits of the common header's first octet, its flags
//! but for the mobile one, its last octet, and two octets each behind the sequence number and the area of a
//! geo-broadcast.

use super::{
    Address, Area, BASIC_LEN, BasicHeader, GeonetError, HEADERS_LEN_MAX, HeaderField, Headers,
    Lifetime, LongPositionVector, NextHeader, Shape, TrafficClass, Transport,
};

/// Version 1, common header next.
const BASIC_COMMON: u8 = 0x11;
/// Version 1, secured packet next.
const BASIC_SECURED: u8 = 0x12;
/// BTP-B next, in the bits that say what is next; the others are reserved.
const BTP_B: u8 = 0x20;
const NEXT_HEADER: u8 = 0xF0;
/// Header types and subtypes.
const SINGLE_HOP: u8 = 0x50;
const BROADCAST_CIRCLE: u8 = 0x40;
const BROADCAST_RECTANGLE: u8 = 0x41;
const BROADCAST_ELLIPSE: u8 = 0x42;
/// The flag of a mobile station.
const MOBILE: u8 = 0x80;
/// Octets of BTP-B, which the payload length counts.
const BTP_LEN: usize = 4;
const ADDRESS_LEN: usize = 8;
const POSITION_VECTOR_LEN: usize = 24;
const MEDIA_LEN: usize = 4;
/// Octets of a sequence number and what is reserved behind it.
const SEQUENCE_LEN: usize = 4;
/// Octets of an area and what is reserved behind it.
const AREA_LEN: usize = 16;

/// The octets of headers.
#[derive(Clone, Copy, Debug)]
pub struct Encoded {
    octets: [u8; HEADERS_LEN_MAX],
    length: usize,
}

impl AsRef<[u8]> for Encoded {
    fn as_ref(&self) -> &[u8] {
        &self.octets[..self.length]
    }
}

/// Octets that are yet to be read.
struct HeaderReader<'a>(&'a [u8]);

impl HeaderReader<'_> {
    fn array<const N: usize>(&mut self, field: HeaderField) -> Result<[u8; N], GeonetError> {
        let (first, rest) = self
            .0
            .split_first_chunk()
            .ok_or(GeonetError::Truncated { field })?;
        self.0 = rest;
        Ok(*first)
    }

    fn u8(&mut self, field: HeaderField) -> Result<u8, GeonetError> {
        self.array(field).map(u8::from_be_bytes)
    }

    fn u16(&mut self, field: HeaderField) -> Result<u16, GeonetError> {
        self.array(field).map(u16::from_be_bytes)
    }

    fn i32(&mut self, field: HeaderField) -> Result<i32, GeonetError> {
        self.array(field).map(i32::from_be_bytes)
    }

    /// Reserved octets, whatever they hold.
    fn reserved<const N: usize>(&mut self, field: HeaderField) -> Result<(), GeonetError> {
        self.array::<N>(field).map(|_| ())
    }
}

/// `value`, if it fits in `bits`.
fn fitting(field: HeaderField, value: u16, bits: u32) -> Result<u16, GeonetError> {
    if value >> bits == 0 {
        Ok(value)
    } else {
        Err(GeonetError::Value {
            field,
            found: value,
        })
    }
}

/// Octets that are being written. What is written fits. Values are checked before they come here, so
/// that where something is written is a constant to a proof.
struct HeaderWriter<const N: usize> {
    octets: [u8; N],
    length: usize,
}

impl<const N: usize> HeaderWriter<N> {
    const fn new() -> Self {
        Self {
            octets: [0; N],
            length: 0,
        }
    }

    fn put<const K: usize>(mut self, octets: [u8; K]) -> Self {
        if let Some(to) = self.octets.get_mut(self.length..self.length + K) {
            to.copy_from_slice(&octets);
            self.length += K;
        }
        self
    }
}

impl BasicHeader {
    /// Reads the basic header of a packet, and gives what follows it.
    ///
    /// # Errors
    /// The fault, and its field.
    pub fn decode(packet: &[u8]) -> Result<(Self, &[u8]), GeonetError> {
        let reader = &mut HeaderReader(packet);
        let next = match reader.u8(HeaderField::BasicNextHeader)? {
            BASIC_COMMON => NextHeader::Common,
            BASIC_SECURED => NextHeader::Secured,
            found if found >> 4 != 1 => return Err(GeonetError::Version(found >> 4)),
            found => {
                return Err(GeonetError::Value {
                    field: HeaderField::BasicNextHeader,
                    found: found.into(),
                });
            }
        };
        reader.reserved::<1>(HeaderField::BasicReserved)?;
        let header = Self {
            next,
            lifetime: Lifetime::of_octet(reader.u8(HeaderField::Lifetime)?),
            remaining_hop_limit: reader.u8(HeaderField::RemainingHopLimit)?,
        };
        Ok((header, reader.0))
    }

    /// The octets of the basic header.
    ///
    /// # Errors
    /// When the lifetime does not fit in its bits.
    pub fn encode(&self) -> Result<[u8; BASIC_LEN], GeonetError> {
        let next = match self.next {
            NextHeader::Common => BASIC_COMMON,
            NextHeader::Secured => BASIC_SECURED,
        };
        Ok([next, 0, self.lifetime.octet()?, self.remaining_hop_limit])
    }
}

impl Headers {
    /// The basic header of the packet, in front of this.
    #[must_use]
    pub const fn basic(&self, next: NextHeader) -> BasicHeader {
        BasicHeader {
            next,
            lifetime: self.lifetime,
            remaining_hop_limit: self.remaining_hop_limit,
        }
    }

    /// Reads the headers of a packet, and gives what follows them.
    ///
    /// # Errors
    /// The fault, and its field. [`GeonetError::Secured`] where a security envelope follows the
    /// basic header; then there is [`BasicHeader::decode`] and [`decode_behind`](Self::decode_behind).
    pub fn decode(packet: &[u8]) -> Result<(Self, &[u8]), GeonetError> {
        let (basic, _) = BasicHeader::decode(packet)?;
        match basic.next {
            NextHeader::Common => Self::decode_behind(basic, &packet[BASIC_LEN..]),
            NextHeader::Secured => Err(GeonetError::Secured),
        }
    }

    /// Reads what follows a basic header, which may have come out of a security envelope, and gives
    /// what follows the headers.
    ///
    /// # Errors
    /// The fault, and its field.
    pub fn decode_behind(basic: BasicHeader, rest: &[u8]) -> Result<(Self, &[u8]), GeonetError> {
        let reader = &mut HeaderReader(rest);
        let BasicHeader {
            lifetime,
            remaining_hop_limit,
            ..
        } = basic;
        let next = reader.u8(HeaderField::CommonNextHeader)?;
        if next & NEXT_HEADER != BTP_B {
            return Err(GeonetError::Value {
                field: HeaderField::CommonNextHeader,
                found: next.into(),
            });
        }
        let header_type = reader.u8(HeaderField::HeaderType)?;
        let shape = shape_of(header_type)?;
        let traffic_class = TrafficClass::of_octet(reader.u8(HeaderField::TrafficClass)?);
        let flags = reader.u8(HeaderField::Flags)?;
        let announced = reader.u16(HeaderField::PayloadLength)?;
        let maximum_hop_limit = reader.u8(HeaderField::MaximumHopLimit)?;
        hops_are_possible(remaining_hop_limit, maximum_hop_limit)?;
        reader.reserved::<1>(HeaderField::CommonReserved)?;
        let (source, transport) = decode_transport(HeaderReader(reader.0), shape)?;
        // The rest begins where the shape says, which is a constant to a proof.
        reader.0 = &reader.0[transport_len(shape)..];
        let present = reader.0.len();
        let port = reader.u16(HeaderField::Port)?;
        let port_info = reader.u16(HeaderField::PortInfo)?;
        if usize::from(announced) != present {
            return Err(GeonetError::PayloadLength { announced, present });
        }
        let headers = Self {
            lifetime,
            remaining_hop_limit,
            maximum_hop_limit,
            traffic_class,
            is_mobile: flags & MOBILE != 0,
            source,
            transport,
            port,
            port_info,
        };
        Ok((headers, reader.0))
    }

    /// The octets of the headers, to be followed by a payload of this length.
    ///
    /// # Errors
    /// The field whose value does not fit in its bits.
    pub fn encode(&self, payload_length: usize) -> Result<Encoded, GeonetError> {
        hops_are_possible(self.remaining_hop_limit, self.maximum_hop_limit)?;
        let announced = u16::try_from(payload_length.saturating_add(BTP_LEN));
        let announced = announced.map_err(|_| GeonetError::PayloadLength {
            announced: u16::MAX,
            present: payload_length,
        })?;
        let header_type = match self.transport {
            Transport::SingleHop { .. } => SINGLE_HOP,
            Transport::GeoBroadcast { area, .. } => area.shape.header_type(),
        };
        let flags = if self.is_mobile { MOBILE } else { 0 };
        let basic = self.basic(NextHeader::Common).encode()?;
        let traffic_class = self.traffic_class.octet()?;
        let source = self.source.octets()?;
        let writer = HeaderWriter::new()
            .put(basic)
            .put([BTP_B, header_type, traffic_class, flags])
            .put(announced.to_be_bytes())
            .put([self.maximum_hop_limit, 0]);
        let writer = match self.transport {
            Transport::SingleHop { media } => writer.put(source).put(media),
            Transport::GeoBroadcast {
                sequence_number,
                area,
            } => writer
                .put(sequence_number.to_be_bytes())
                .put([0; 2])
                .put(source)
                .put(area.octets()),
        };
        let HeaderWriter { octets, length } = writer
            .put(self.port.to_be_bytes())
            .put(self.port_info.to_be_bytes());
        Ok(Encoded { octets, length })
    }
}

/// Octets of the headers between common header and BTP.
const fn transport_len(shape: Option<Shape>) -> usize {
    match shape {
        None => POSITION_VECTOR_LEN + MEDIA_LEN,
        Some(_) => SEQUENCE_LEN + POSITION_VECTOR_LEN + AREA_LEN,
    }
}

fn decode_transport(
    mut reader: HeaderReader,
    shape: Option<Shape>,
) -> Result<(LongPositionVector, Transport), GeonetError> {
    let Some(shape) = shape else {
        let source = LongPositionVector::decode(&mut reader)?;
        let media = reader.array(HeaderField::Media)?;
        return Ok((source, Transport::SingleHop { media }));
    };
    let sequence_number = reader.u16(HeaderField::SequenceNumber)?;
    reader.reserved::<2>(HeaderField::SequenceReserved)?;
    let source = LongPositionVector::decode(&mut reader)?;
    let area = Area::decode(&mut reader, shape)?;
    let transport = Transport::GeoBroadcast {
        sequence_number,
        area,
    };
    Ok((source, transport))
}

/// The shape of a geo-broadcast's area, `None` for single-hop broadcast.
fn shape_of(header_type: u8) -> Result<Option<Shape>, GeonetError> {
    match header_type {
        SINGLE_HOP => Ok(None),
        BROADCAST_CIRCLE => Ok(Some(Shape::Circle)),
        BROADCAST_RECTANGLE => Ok(Some(Shape::Rectangle)),
        BROADCAST_ELLIPSE => Ok(Some(Shape::Ellipse)),
        found => Err(GeonetError::Value {
            field: HeaderField::HeaderType,
            found: found.into(),
        }),
    }
}

/// A packet cannot have more hops left than it had in the beginning.
fn hops_are_possible(remaining: u8, maximum: u8) -> Result<(), GeonetError> {
    if remaining <= maximum {
        return Ok(());
    }
    Err(GeonetError::Value {
        field: HeaderField::RemainingHopLimit,
        found: remaining.into(),
    })
}

impl Shape {
    const fn header_type(self) -> u8 {
        match self {
            Self::Circle => BROADCAST_CIRCLE,
            Self::Rectangle => BROADCAST_RECTANGLE,
            Self::Ellipse => BROADCAST_ELLIPSE,
        }
    }
}

impl Lifetime {
    const fn of_octet(octet: u8) -> Self {
        Self {
            multiplier: octet >> 2,
            base: Self::BASES[(octet & 0b11) as usize].0,
        }
    }

    fn octet(self) -> Result<u8, GeonetError> {
        fitting(HeaderField::Lifetime, self.multiplier.into(), 6)?;
        Ok(self.multiplier << 2 | self.base as u8)
    }
}

impl TrafficClass {
    const fn of_octet(octet: u8) -> Self {
        Self {
            store_carry_forward: octet & 0x80 != 0,
            channel_offload: octet & 0x40 != 0,
            id: octet & 0x3F,
        }
    }

    fn octet(self) -> Result<u8, GeonetError> {
        fitting(HeaderField::TrafficClass, self.id.into(), 6)?;
        let flags = u8::from(self.store_carry_forward) << 7 | u8::from(self.channel_offload) << 6;
        Ok(flags | self.id)
    }
}

impl Address {
    fn decode(reader: &mut HeaderReader) -> Result<Self, GeonetError> {
        let bits = reader.u16(HeaderField::Address)?;
        let [_, station_type] = (bits >> 10 & 0x1F).to_be_bytes();
        Ok(Self {
            is_manual: bits & 0x8000 != 0,
            station_type,
            country_code: bits & 0x3FF,
            link_layer: reader.array(HeaderField::Address)?,
        })
    }

    fn octets(self) -> Result<[u8; ADDRESS_LEN], GeonetError> {
        let station_type = fitting(HeaderField::Address, self.station_type.into(), 5)?;
        let country_code = fitting(HeaderField::Address, self.country_code, 10)?;
        let bits = u16::from(self.is_manual) << 15 | station_type << 10 | country_code;
        Ok(HeaderWriter::new()
            .put(bits.to_be_bytes())
            .put(self.link_layer)
            .octets)
    }
}

impl LongPositionVector {
    fn decode(reader: &mut HeaderReader) -> Result<Self, GeonetError> {
        let address = Address::decode(reader)?;
        let timestamp = u32::from_be_bytes(reader.array(HeaderField::Timestamp)?);
        let latitude = reader.i32(HeaderField::Position)?;
        let longitude = reader.i32(HeaderField::Position)?;
        let speed = reader.u16(HeaderField::Speed)?;
        Ok(Self {
            address,
            timestamp,
            latitude,
            longitude,
            is_accurate: speed & 0x8000 != 0,
            // Its 15 bits, extended by their sign.
            speed: (speed << 1).cast_signed() >> 1,
            heading: reader.u16(HeaderField::Heading)?,
        })
    }

    fn octets(&self) -> Result<[u8; POSITION_VECTOR_LEN], GeonetError> {
        if !(-0x4000..0x4000).contains(&self.speed) {
            return Err(GeonetError::Value {
                field: HeaderField::Speed,
                found: self.speed.cast_unsigned(),
            });
        }
        let speed = self.speed.cast_unsigned() & 0x7FFF;
        Ok(HeaderWriter::new()
            .put(self.address.octets()?)
            .put(self.timestamp.to_be_bytes())
            .put(self.latitude.to_be_bytes())
            .put(self.longitude.to_be_bytes())
            .put((u16::from(self.is_accurate) << 15 | speed).to_be_bytes())
            .put(self.heading.to_be_bytes())
            .octets)
    }
}

impl Area {
    fn decode(reader: &mut HeaderReader, shape: Shape) -> Result<Self, GeonetError> {
        let area = Self {
            shape,
            latitude: reader.i32(HeaderField::AreaPosition)?,
            longitude: reader.i32(HeaderField::AreaPosition)?,
            distance_a: reader.u16(HeaderField::AreaDistances)?,
            distance_b: reader.u16(HeaderField::AreaDistances)?,
            angle: reader.u16(HeaderField::AreaAngle)?,
        };
        reader.reserved::<2>(HeaderField::AreaReserved)?;
        Ok(area)
    }

    fn octets(&self) -> [u8; AREA_LEN] {
        HeaderWriter::new()
            .put(self.latitude.to_be_bytes())
            .put(self.longitude.to_be_bytes())
            .put(self.distance_a.to_be_bytes())
            .put(self.distance_b.to_be_bytes())
            .put(self.angle.to_be_bytes())
            .put([0; 2])
            .octets
    }
}
