//! The headers under a message.

use crossguard_codec::geonet::{
    Address, Area, Headers, Lifetime, LifetimeBase, LongPositionVector, Shape, TrafficClass,
    Transport, laws,
};

use crate::harness::harnesses;
use crate::kani;

/// The longest headers and two octets.
const PACKET: usize = 62;

/// Octets whose first decide on headers often enough, also where they are random.
fn any_octets(header_type: u8, length: usize) -> [u8; PACKET] {
    let mut octets: [u8; PACKET] = kani::any();
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

harnesses! {
    /// Any octets, up to the length of the longest headers and two more.
    #[unwind(64)]
    #[solver(cadical)]
    #[random_only("Kani was stopped after 200 s on a busy machine.")]
    fn what_is_accepted_is_canonical() {
        let length = usize::from(kani::any::<u8>()) % (PACKET + 1);
        let octets = any_octets(0x50, length.saturating_sub(40));
        let packet = &octets[..length];
        laws::what_is_accepted_is_canonical(packet);
        let decoded = Headers::decode(packet);
        kani::cover!(decoded.is_ok(), "accepted");
        kani::cover!(decoded.is_err(), "refused");
    }

    /// Any headers of single-hop broadcast.
    #[unwind(64)]
    #[solver(cadical)]
    #[random_only("Kani was stopped after 200 s on a busy machine.")]
    fn single_hop_headers_come_back() {
        let headers = any_headers(Transport::SingleHop { media: kani::any() });
        laws::what_is_encoded_is_accepted(&headers, &kani::any());
        kani::cover!(headers.encode(2).is_ok(), "encoded");
        kani::cover!(headers.encode(2).is_err(), "refused");
    }

    /// Any headers of geo-broadcast to a rectangle.
    #[unwind(64)]
    #[solver(cadical)]
    #[random_only("Kani was stopped after 200 s on a busy machine.")]
    fn geo_broadcast_headers_come_back() {
        let area = Area {
            shape: Shape::Rectangle,
            latitude: kani::any(),
            longitude: kani::any(),
            distance_a: kani::any(),
            distance_b: kani::any(),
            angle: kani::any(),
        };
        let sequence_number = kani::any();
        let headers = any_headers(Transport::GeoBroadcast { sequence_number, area });
        laws::what_is_encoded_is_accepted(&headers, &kani::any());
        kani::cover!(headers.encode(2).is_ok(), "encoded");
        kani::cover!(headers.encode(2).is_err(), "refused");
    }
}
