//! Headers against packets that Wireshark took apart, and the errors that name a field.

use crate::stack::{address, area, ego, sixty_seconds, vector};
use crate::support::{flips, without_reserved_bits};
use crossguard_codec::geonet::*;

/// Octets of the messages in G1, a single-hop broadcast with traffic class 2 and BTP-B port 2001, and G2, a geo-broadcast
/// with traffic class 1 to a circle of 100 m and port 2002. Both packets were checked with tshark 4.0.
const CAM_LEN: usize = 59;
const DENM_LEN: usize = 51;

fn source() -> LongPositionVector {
    ego().vector(address())
}

fn single_hop() -> Headers {
    Headers {
        lifetime: sixty_seconds(),
        remaining_hop_limit: 1,
        maximum_hop_limit: 1,
        traffic_class: TrafficClass {
            store_carry_forward: false,
            channel_offload: false,
            id: 2,
        },
        is_mobile: true,
        source: source(),
        transport: Transport::SingleHop { media: [0; 4] },
        port: 2_001,
        port_info: 0,
    }
}

fn geo_broadcast() -> Headers {
    Headers {
        remaining_hop_limit: 10,
        maximum_hop_limit: 10,
        traffic_class: TrafficClass {
            id: 1,
            ..single_hop().traffic_class
        },
        transport: Transport::GeoBroadcast {
            sequence_number: 7,
            area: area(),
        },
        port: 2_002,
        ..single_hop()
    }
}

#[test]
fn golden_packets_decode_and_encode() {
    for (name, payload, headers) in [
        ("G1", CAM_LEN, single_hop()),
        ("G2", DENM_LEN, geo_broadcast()),
    ] {
        let packet = vector(name);
        let (decoded, rest) = Headers::decode(&packet).unwrap();
        assert_eq!(decoded, headers);
        assert_eq!(rest.len(), payload);
        let encoded = headers.encode(payload).unwrap();
        assert_eq!(encoded.as_ref(), &packet[..packet.len() - payload]);
    }
    assert_eq!(single_hop().lifetime.milliseconds(), 60_000);
}

#[test]
fn a_packet_that_ends_early_names_the_field_in_which_it_ends() {
    let packet = vector("G2");
    let cases = [
        (0, HeaderField::BasicNextHeader),
        (3, HeaderField::RemainingHopLimit),
        (9, HeaderField::PayloadLength),
        (17, HeaderField::Address),
        (55, HeaderField::AreaReserved),
        (59, HeaderField::PortInfo),
    ];
    for (length, field) in cases {
        let truncated = Headers::decode(&packet[..length]);
        assert_eq!(truncated, Err(GeonetError::Truncated { field }), "{length}");
    }
}

#[test]
fn each_shape_has_its_header_type_and_no_other_is_accepted() {
    let shapes = [
        (0x40, Shape::Circle),
        (0x41, Shape::Rectangle),
        (0x42, Shape::Ellipse),
    ];
    let mut packet = vector("G2");
    for header_type in 0..=255 {
        packet[5] = header_type;
        let decoded = Headers::decode(&packet);
        let Some((_, shape)) = shapes.iter().find(|(of, _)| *of == header_type) else {
            assert!(decoded.is_err(), "{header_type:#x}");
            continue;
        };
        let (headers, payload) = decoded.unwrap();
        let Transport::GeoBroadcast { area, .. } = headers.transport else {
            panic!("{header_type:#x} is no geo-broadcast")
        };
        assert_eq!(area.shape, *shape);
        let encoded = headers.encode(payload.len()).unwrap();
        assert_eq!(encoded.as_ref(), &packet[..HEADERS_LEN_MAX]);
    }
}

#[test]
fn a_wrong_octet_names_its_field() {
    let cases = [
        (0, 0x13, HeaderField::BasicNextHeader),
        (3, 2, HeaderField::RemainingHopLimit),
        (4, 0x10, HeaderField::CommonNextHeader),
        (5, 0x51, HeaderField::HeaderType),
    ];
    for (at, octet, wrong) in cases {
        let mut packet = vector("G1");
        packet[at] = octet;
        let Err(GeonetError::Value { field, .. }) = Headers::decode(&packet) else {
            panic!("octet {at} is accepted")
        };
        assert_eq!(field, wrong);
    }
    let mut newer = vector("G1");
    newer[0] = 0x21;
    assert_eq!(Headers::decode(&newer), Err(GeonetError::Version(2)));
    let mut secured = vector("G1");
    secured[0] = 0x12;
    assert_eq!(Headers::decode(&secured), Err(GeonetError::Secured));
    let short = GeonetError::PayloadLength {
        announced: 63,
        present: 62,
    };
    let mut packet = vector("G1");
    packet.pop();
    assert_eq!(Headers::decode(&packet), Err(short));
    assert_eq!(
        short.to_string(),
        "PayloadLength is 63, and 62 octets follow the headers"
    );
}

#[test]
fn reserved_bits_are_ignored_whatever_they_are_and_sent_as_zero() {
    for (plain, count) in [(vector("G1"), 27), (vector("G2"), 27 + 32)] {
        let expected = Headers::decode(&plain).unwrap();
        let reserved = flips(&plain).filter(|packet| without_reserved_bits(packet) == plain);
        let reserved: Vec<_> = reserved.collect();
        assert_eq!(reserved.len(), count, "they are zero as sent");
        for packet in reserved {
            let decoded = Headers::decode(&packet).unwrap();
            assert_eq!(decoded, expected, "{packet:02x?}");
            let again = decoded.0.encode(decoded.1.len()).unwrap();
            assert!(plain.starts_with(again.as_ref()));
        }
        // The bits beside them count.
        let mut other = plain.clone();
        other[7] ^= 0x80;
        assert_ne!(Headers::decode(&other).unwrap().0, expected.0);
    }
}

#[test]
fn a_speed_is_signed() {
    let backwards = LongPositionVector {
        speed: -16_384,
        ..source()
    };
    let headers = Headers {
        source: backwards,
        ..single_hop()
    };
    let encoded = headers.encode(0).unwrap();
    assert_eq!(Headers::decode(encoded.as_ref()).unwrap().0, headers);
}

#[test]
fn a_value_that_does_not_fit_names_its_field() {
    let mut headers = single_hop();
    headers.lifetime.multiplier = 64;
    let error = headers.encode(0).unwrap_err();
    assert_eq!(
        error.to_string(),
        "Lifetime is 0x40, which is not possible or not supported"
    );
    let too_long = single_hop().encode(65_532).unwrap_err();
    assert!(matches!(too_long, GeonetError::PayloadLength { .. }));
}
