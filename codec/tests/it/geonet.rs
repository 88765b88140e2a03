//! Headers against packets that Wireshark took apart, and the errors that name a field.

use crate::support::from_hex;
use crossguard_codec::geonet::*;

/// A packet of single-hop broadcast with traffic class 2 and BTP-B port 2001, without its CAM of 59
/// octets; and a geo-broadcast with traffic class 1 to a circle of 100 m and port 2002, without its
/// DENM of 51 octets. Both were checked with tshark 4.0.
const SHB: &str =
    "11001a0120500280003f01001400020000000001bf0353e81d1103b105702107856d03840000000007d10000";
const GBC: &str = "11001a0a2040018000370a00000700001400020000000001bf0353e81d1103b105702107856d03841d1103b105702107006400000000000007d20000";

fn octets(hex: &str, payload: usize) -> Vec<u8> {
    let mut octets = from_hex(hex);
    octets.resize(octets.len() + payload, 0xA5);
    octets
}

fn source() -> LongPositionVector {
    LongPositionVector {
        address: Address {
            is_manual: false,
            station_type: 5,
            country_code: 0,
            link_layer: [2, 0, 0, 0, 0, 1],
        },
        timestamp: 0xBF03_53E8,
        latitude: 487_654_321,
        longitude: 91_234_567,
        is_accurate: true,
        speed: 1_389,
        heading: 900,
    }
}

fn single_hop() -> Headers {
    Headers {
        lifetime: Lifetime {
            multiplier: 6,
            base: LifetimeBase::TenSeconds,
        },
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
    let area = Area {
        shape: Shape::Circle,
        latitude: 487_654_321,
        longitude: 91_234_567,
        distance_a: 100,
        distance_b: 0,
        angle: 0,
    };
    Headers {
        remaining_hop_limit: 10,
        maximum_hop_limit: 10,
        traffic_class: TrafficClass {
            id: 1,
            ..single_hop().traffic_class
        },
        transport: Transport::GeoBroadcast {
            sequence_number: 7,
            area,
        },
        port: 2_002,
        ..single_hop()
    }
}

#[test]
fn golden_packets_decode_and_encode() {
    for (hex, payload, headers) in [(SHB, 59, single_hop()), (GBC, 51, geo_broadcast())] {
        let packet = octets(hex, payload);
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
    let packet = octets(GBC, 0);
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
    let mut packet = octets(GBC, 51);
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
        (0, 0x21, HeaderField::BasicNextHeader),
        (3, 2, HeaderField::RemainingHopLimit),
        (4, 0x10, HeaderField::CommonNextHeader),
        (5, 0x51, HeaderField::HeaderType),
    ];
    for (at, octet, wrong) in cases {
        let mut packet = octets(SHB, 59);
        packet[at] = octet;
        let Err(GeonetError::Value { field, .. }) = Headers::decode(&packet) else {
            panic!("octet {at} is accepted")
        };
        assert_eq!(field, wrong);
    }
    let mut secured = octets(SHB, 59);
    secured[0] = 0x12;
    assert_eq!(Headers::decode(&secured), Err(GeonetError::Secured));
    let short = GeonetError::PayloadLength {
        announced: 63,
        present: 62,
    };
    assert_eq!(Headers::decode(&octets(SHB, 58)), Err(short));
    assert_eq!(
        short.to_string(),
        "PayloadLength is 63, and 62 octets follow the headers"
    );
}

#[test]
fn reserved_bits_are_ignored_whatever_they_are_and_sent_as_zero() {
    let of_both = [(1, 0xFF), (4, 0x0F), (7, 0x7F), (11, 0xFF)];
    let of_geo_broadcast = [(14, 0xFF), (15, 0xFF), (54, 0xFF), (55, 0xFF)];
    for (plain, reserved) in [
        (octets(SHB, 59), &of_both[..]),
        (octets(GBC, 51), &[of_both, of_geo_broadcast].concat()[..]),
    ] {
        let (expected, rest) = Headers::decode(&plain).unwrap();
        for &(at, bits) in reserved {
            for bit in (0..8).map(|bit| 1 << bit).filter(|bit| bits & bit != 0) {
                let mut packet = plain.clone();
                packet[at] |= bit;
                assert_ne!(packet, plain, "octet {at} is not zero as sent");
                let (headers, payload) = Headers::decode(&packet).unwrap();
                assert_eq!(
                    (headers, payload),
                    (expected, rest),
                    "octet {at}, bit {bit:#x}"
                );
                let again = headers.encode(payload.len()).unwrap();
                assert!(plain.starts_with(again.as_ref()));
            }
        }
        // The bits beside them count.
        let mut other = plain.clone();
        other[7] ^= 0x80;
        assert_ne!(Headers::decode(&other).unwrap().0, expected);
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
