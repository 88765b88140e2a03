//! The laws of the headers: decoding is total, and encoding is its inverse in both directions, but for reserved bits.
//!
//! Functions that assert, for the `proofs` crate to call. Not part of the stable interface.

use super::{GeonetError, HEADERS_LEN_MAX, HeaderField, Headers, Transport};

/// Octets of the headers of single-hop broadcast.
const SINGLE_HOP_LEN: usize = 44;
/// The reserved bits of each octet up to the end of the common header: they are sent as zero and ignored.
const RESERVED: [u8; 12] = [0, 0xFF, 0, 0, 0x0F, 0, 0, 0x7F, 0, 0, 0, 0xFF];
/// The reserved octets of a geo-broadcast behind that: those after the sequence number and after the area.
const RESERVED_IN_GEO_BROADCAST: [usize; 4] = [14, 15, 54, 55];

/// No octets make the decoder panic, and it reads nothing behind them. An error names what is wrong.
///
/// Gives what was decoded.
pub fn decoding_is_total(packet: &[u8]) -> Result<(Headers, &[u8]), GeonetError> {
    let decoded = Headers::decode(packet);
    match &decoded {
        Ok((headers, payload)) => assert!(payload.len() + length_of(headers) == packet.len()),
        Err(GeonetError::Truncated { .. }) => assert!(packet.len() < HEADERS_LEN_MAX),
        Err(GeonetError::PayloadLength { announced, present }) => {
            assert!(usize::from(*announced) != *present && *present <= packet.len());
        }
        Err(GeonetError::Secured) => assert!(packet[0] == 0x12),
        Err(GeonetError::Version(version)) => assert!(*version == packet[0] >> 4 && *version != 1),
        Err(GeonetError::Value { .. }) => {}
    }
    decoded
}

/// The decoder gives back the headers that it accepts: they encode to the octets that they were read from, with zeros
/// in reserved bits.
///
/// Gives whether it was accepted.
#[must_use]
pub fn what_is_accepted_is_canonical(packet: &[u8]) -> bool {
    let Ok((headers, payload)) = decoding_is_total(packet) else {
        return false;
    };
    let encoded = headers.encode(payload.len());
    let is_geo_broadcast = matches!(headers.transport, Transport::GeoBroadcast { .. });
    assert!(encoded.is_ok_and(|encoded| begins_with(packet, encoded.as_ref(), is_geo_broadcast)));
    true
}

/// Headers that encode decode to themselves, and headers that do not encode have a value that does not fit.
///
/// Gives whether it encodes.
#[must_use]
pub fn what_is_encoded_is_accepted(headers: &Headers, payload: [u8; 2]) -> bool {
    let encoded = match headers.encode(payload.len()) {
        Ok(encoded) => encoded,
        Err(error) => {
            assert!(is_broken(headers, error));
            return false;
        }
    };
    let length = length_of(headers);
    let octets = encoded.as_ref();
    assert!(octets.len() == length);
    let mut packet = [0; HEADERS_LEN_MAX + 2];
    for (at, octet) in packet.iter_mut().enumerate().take(length) {
        *octet = octets[at];
    }
    [packet[length], packet[length + 1]] = payload;
    let decoded = Headers::decode(&packet[..length + 2]);
    assert!(decoded.is_ok_and(|(again, rest)| again == *headers && rest == payload));
    true
}

/// How many octets the headers have.
fn length_of(headers: &Headers) -> usize {
    match headers.transport {
        Transport::SingleHop { .. } => SINGLE_HOP_LEN,
        Transport::GeoBroadcast { .. } => HEADERS_LEN_MAX,
    }
}

/// True if the packet begins with these octets, none of which is behind the longest headers, but for reserved
/// bits, which the octets have as zero. Octet by octet, which is easier to prove than the equality of slices.
fn begins_with(packet: &[u8], octets: &[u8], is_geo_broadcast: bool) -> bool {
    (0..HEADERS_LEN_MAX).all(|at| {
        octets.get(at).is_none_or(|octet| {
            let reserved = reserved_bits(at, is_geo_broadcast);
            packet.get(at).map(|found| found & !reserved) == Some(*octet)
        })
    })
}

/// The reserved bits of the octet at this place.
fn reserved_bits(at: usize, is_geo_broadcast: bool) -> u8 {
    match RESERVED.get(at) {
        Some(reserved) => *reserved,
        None if is_geo_broadcast && RESERVED_IN_GEO_BROADCAST.contains(&at) => 0xFF,
        None => 0,
    }
}

/// True if the headers have the fault that the error names.
fn is_broken(headers: &Headers, error: GeonetError) -> bool {
    let GeonetError::Value { field, .. } = error else {
        return false;
    };
    let source = headers.source;
    match field {
        HeaderField::RemainingHopLimit => headers.remaining_hop_limit > headers.maximum_hop_limit,
        HeaderField::Lifetime => headers.lifetime.multiplier > 63,
        HeaderField::TrafficClass => headers.traffic_class.id > 63,
        HeaderField::Address => {
            source.address.station_type > 31 || source.address.country_code > 1_023
        }
        HeaderField::Speed => !(-16_384..=16_383).contains(&source.speed),
        _ => false,
    }
}
