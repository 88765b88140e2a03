//! The laws of the headers: decoding is total, and encoding is its inverse in both directions.
//!
//! Functions that assert, for the `proofs` crate to call. Not part of the stable interface.

use super::{Field, GeonetError, HEADERS_LEN_MAX, Headers};

/// No octets make the decoder panic, and what it accepts it gives back: the headers encode to the
/// octets that they were read from. An error names a field that there is.
pub fn what_is_accepted_is_canonical(packet: &[u8]) {
    match Headers::decode(packet) {
        Ok((headers, payload)) => {
            let encoded = headers.encode(payload.len());
            let length = packet.len() - payload.len();
            assert!(length <= HEADERS_LEN_MAX);
            assert!(encoded.is_ok_and(|encoded| same(encoded.as_ref(), &packet[..length])));
        }
        Err(GeonetError::Truncated { .. }) => assert!(packet.len() < HEADERS_LEN_MAX),
        Err(GeonetError::PayloadLength { announced, present }) => {
            assert!(usize::from(announced) != present && present <= packet.len());
        }
        Err(GeonetError::Secured) => assert!(packet[0] == 0x12),
        Err(GeonetError::Value { .. }) => {}
    }
}

/// What encodes decodes to itself, and what does not encode has a value that does not fit.
pub fn what_is_encoded_is_accepted(headers: &Headers, payload: &[u8; 2]) {
    match headers.encode(payload.len()) {
        Ok(encoded) => {
            let mut packet = [0; HEADERS_LEN_MAX + 2];
            let length = encoded.as_ref().len();
            packet[..length].copy_from_slice(encoded.as_ref());
            packet[length..length + 2].copy_from_slice(payload);
            let decoded = Headers::decode(&packet[..length + 2]);
            assert!(decoded.is_ok_and(|(again, rest)| again == *headers && same(rest, payload)));
        }
        Err(error) => assert!(is_broken(headers, error)),
    }
}

/// Whether the headers have the fault that the error names.
fn is_broken(headers: &Headers, error: GeonetError) -> bool {
    let GeonetError::Value { field, .. } = error else {
        return false;
    };
    let source = headers.source;
    match field {
        Field::RemainingHopLimit => headers.remaining_hop_limit > headers.maximum_hop_limit,
        Field::Lifetime => headers.lifetime.multiplier > 63,
        Field::TrafficClass => headers.traffic_class.id > 63,
        Field::Address => source.address.station_type > 31 || source.address.country_code > 1_023,
        Field::Speed => !(-16_384..=16_383).contains(&source.speed),
        _ => false,
    }
}

/// Equality octet by octet, which is easier to prove than that of slices.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b)
}
