//! The headers under a message.

use crossguard_codec::geonet::{
    Address, Area, Headers, Lifetime, LifetimeBase, LongPositionVector, Shape, TrafficClass,
    Transport, laws,
};

use crate::harness::harnesses;
use crate::kani;

/// The longest headers and two octets.
const PACKET: usize = 62;

/// Where the headers of a geo-broadcast have to be zero, behind the sequence number and the area.
const RESERVED: [usize; 4] = [14, 15, 54, 55];

/// Octets whose first decide on headers often enough, also where they are random.
fn any_octets<const N: usize>(header_type: u8, length: usize) -> [u8; N] {
    let mut octets: [u8; N] = kani::any();
    let payload = u8::try_from(length).unwrap_or(0);
    if kani::any() {
        let fixed = [
            0x11,
            0,
            0x1A,
            1,
            0x20,
            header_type,
            2,
            0x80,
            0,
            payload,
            1,
            0,
        ];
        octets[..12].copy_from_slice(&fixed);
    }
    octets
}

fn any_headers(transport: Transport) -> Headers {
    Headers {
        lifetime: Lifetime {
            multiplier: kani::any::<u8>() % 65,
            base: LifetimeBase::TenSeconds,
        },
        remaining_hop_limit: kani::any(),
        maximum_hop_limit: kani::any(),
        traffic_class: TrafficClass {
            store_carry_forward: kani::any(),
            channel_offload: kani::any(),
            id: kani::any::<u8>() % 65,
        },
        is_mobile: kani::any(),
        source: LongPositionVector {
            address: Address {
                is_manual: kani::any(),
                station_type: kani::any::<u8>() % 33,
                country_code: kani::any::<u16>() % 1_025,
                link_layer: kani::any(),
            },
            timestamp: kani::any(),
            latitude: kani::any(),
            longitude: kani::any(),
            is_accurate: kani::any(),
            speed: kani::any::<u16>().cast_signed(),
            heading: kani::any(),
        },
        transport,
        port: kani::any(),
        port_info: kani::any(),
    }
}

/// Any packet of this length with this header type.
fn any_packet<const N: usize>(header_type: u8) {
    let mut packet: [u8; N] = any_octets(header_type, 6);
    packet[5] = header_type;
    if N == PACKET && kani::any() {
        for at in RESERVED {
            packet[at] = 0;
        }
    }
    let is_accepted = laws::what_is_accepted_is_canonical(&packet);
    kani::cover!(is_accepted, "accepted");
    kani::cover!(!is_accepted, "refused");
}

fn any_headers_come_back(transport: Transport) {
    let headers = any_headers(transport);
    let is_encoded = laws::what_is_encoded_is_accepted(&headers, kani::any());
    kani::cover!(is_encoded, "encoded");
    kani::cover!(!is_encoded, "refused");
}

harnesses! {
    /// Any octets, up to the length of the longest headers and two more.
    #[unwind(64)]
    fn decoding_is_total() {
        let length = usize::from(kani::any::<u8>()) % (PACKET + 1);
        let octets: [u8; PACKET] = any_octets(0x50, length.saturating_sub(40));
        let decoded = laws::decoding_is_total(&octets[..length]);
        kani::cover!(decoded.is_ok(), "accepted");
        kani::cover!(decoded.is_err(), "refused");
    }

    /// Any packet of single-hop broadcast with two octets of payload.
    #[unwind(64)]
    fn single_hop_is_canonical() {
        any_packet::<46>(0x50);
    }

    /// Any packet of geo-broadcast to a circle with two octets of payload. To another shape only the header
    /// type is another one.
    #[unwind(64)]
    fn geo_broadcast_is_canonical() {
        any_packet::<PACKET>(0x40);
    }

    /// Any headers of single-hop broadcast.
    #[unwind(64)]
    fn single_hop_comes_back() {
        any_headers_come_back(Transport::SingleHop { media: kani::any() });
    }

    /// Any headers of geo-broadcast to a circle. To another shape only the header type is another one.
    #[unwind(64)]
    fn geo_broadcast_comes_back() {
        let area = Area {
            shape: Shape::Circle,
            latitude: kani::any(),
            longitude: kani::any(),
            distance_a: kani::any(),
            distance_b: kani::any(),
            angle: kani::any(),
        };
        let sequence_number = kani::any();
        any_headers_come_back(Transport::GeoBroadcast { sequence_number, area });
    }
}
