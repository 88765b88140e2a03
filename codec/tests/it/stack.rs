//! Whole packets: golden ones, what is discarded and why, and hostile octets.

use crate::support::{flips, from_hex, golden, without_reserved_bits};
use crossguard_codec::geonet::*;
use crossguard_codec::{Identifiers, MESSAGE_LEN_MAX, Service};
use proptest::prelude::*;

pub(crate) fn vector(name: &str) -> Vec<u8> {
    from_hex(golden::vector(golden::PACKETS, name))
}

/// The station of the vectors.
pub(crate) fn address() -> Address {
    Address {
        link_layer: [2, 0, 0, 0, 0, 1],
        ..Address::of_station(1, 5)
    }
}

fn stack_of(address: Address) -> Stack {
    Stack::new(Identifiers::default(), address, Envelope::Off)
}

fn listener() -> Stack {
    stack_of(Address::of_station(77, 12))
}

pub(crate) fn ego() -> EgoPosition {
    EgoPosition {
        timestamp_its: 694_694_401_000,
        coordinates: Some((487_654_321, 91_234_567)),
        is_accurate: true,
        speed: 1_389,
        heading: 900,
    }
}

pub(crate) fn area() -> Area {
    Area {
        shape: Shape::Circle,
        latitude: 487_654_321,
        longitude: 91_234_567,
        distance_a: 100,
        distance_b: 0,
        angle: 0,
    }
}

pub(crate) fn sixty_seconds() -> Lifetime {
    Lifetime {
        multiplier: 6,
        base: LifetimeBase::TenSeconds,
    }
}

fn send(stack: &mut Stack, request: &Request, message: &[u8]) -> Vec<u8> {
    let mut packet = [0; PACKET_LEN_MAX];
    let length = stack.send(&ego(), request, message, &mut packet).unwrap();
    packet[..length].to_vec()
}

#[test]
fn the_golden_packet_is_made_bit_for_bit() {
    let mut stack = stack_of(address());
    let request = Request {
        lifetime: sixty_seconds(),
        ..Service::Cam.request(&Identifiers::default())
    };
    assert_eq!(send(&mut stack, &request, &vector("CAM")), vector("G1"));
}

#[test]
fn the_golden_packet_is_understood() {
    let packet = vector("G1");
    let mut listener = listener();
    let indication = listener.receive(&ego(), &packet).unwrap();
    assert_eq!(indication.source, ego().vector(address()));
    assert_eq!(indication.signer, None);
    let said = (indication.service, indication.message);
    assert_eq!(said, (Service::Cam, &vector("CAM")[..]));
}

#[test]
fn what_is_not_for_the_station_is_discarded_by_name() {
    let mut octets = vector("G1");
    let namesake = stack_of(address()).receive(&ego(), &octets);
    assert_eq!(namesake, Err(Discarded::Namesake));
    // Port 2003.
    octets[41] = 0xd3;
    let at_no_service = listener().receive(&ego(), &octets);
    assert_eq!(at_no_service, Err(Discarded::UnknownPort(2_003)));
    let octets = vector("G2");
    let to_an_area = listener().receive(&ego(), &octets);
    assert_eq!(to_an_area, Err(Discarded::GeoBroadcast));
}

/// Hazard: two robots go by one station id. Each took the packets of the other for its own, and nothing ever said so.
#[test]
fn a_packet_from_the_own_address_is_an_echo_only_if_the_station_has_sent_it() {
    let mut robots = [(); 2].map(|()| stack_of(address()));
    let mut later = ego();
    for _ in 0..100 {
        later.timestamp_its += 100;
        let [packet, of_namesake] = robots.each_mut().map(|robot| {
            later.timestamp_its += 1;
            robot.packet(&later, Service::Ram, &[1; 20]).unwrap()
        });
        let mut hear = |packet: &[u8]| robots[0].receive(&later, packet).unwrap_err();
        assert_eq!(hear(&packet), Discarded::OwnPacket);
        assert_eq!(hear(&of_namesake), Discarded::Namesake);
    }
}

#[test]
fn a_secured_packet_is_not_understood_while_security_is_off() {
    let mut octets = vector("G1");
    octets[0] = 0x12;
    let secured = listener().receive(&ego(), &octets);
    let off = Discarded::Envelope(EnvelopeError::SecurityIsOff);
    assert_eq!(secured, Err(off));
}

#[test]
fn a_message_that_is_too_long_is_refused() {
    let request = Service::Ram.request(&Identifiers::default());
    let mut packet = [0; PACKET_LEN_MAX];
    let mut stack = listener();
    let mut send = |length, room: usize| {
        let message = vec![0; length];
        stack.send(&ego(), &request, &message, &mut packet[..room])
    };
    let length = MESSAGE_LEN_MAX;
    assert_eq!(send(length, PACKET_LEN_MAX), Ok(length + 44));
    assert_eq!(send(length, length), Err(SendError::NoRoom));
    let length = length + 1;
    let too_long = send(length, PACKET_LEN_MAX);
    assert_eq!(too_long, Err(SendError::TooLong { length }));
    let flood = [0x11; PACKET_LEN_MAX + 1];
    let too_long = listener().receive(&ego(), &flood).unwrap_err();
    assert_eq!(too_long.cause(), "too long");
}

#[test]
fn packets_are_made_and_taken_without_heap() {
    let request = Service::Cam.request(&Identifiers::default());
    let (mut sender, mut receiver) = (stack_of(address()), listener());
    let (message, mut packet) = (vector("CAM"), [0; PACKET_LEN_MAX]);
    let used = allocation_counter::measure(|| {
        let length = sender
            .send(&ego(), &request, &message, &mut packet)
            .unwrap();
        let heard = receiver.receive(&ego(), &packet[..length]).unwrap();
        assert_eq!(*heard.message, *message);
    });
    assert_eq!(used.count_total, 0);
}

/// What is accepted comes out of its own headers again; what is not has a cause.
fn check(octets: &[u8]) {
    match listener().receive(&ego(), octets) {
        Ok(indication) => {
            let headers = indication.headers.encode(indication.message.len()).unwrap();
            let again = [headers.as_ref(), indication.message].concat();
            assert_eq!(again, without_reserved_bits(octets));
        }
        Err(discarded) => assert!(!discarded.cause().is_empty()),
    }
}

#[test]
fn every_flipped_bit_and_every_truncation_is_understood_or_discarded() {
    for octets in [vector("G1"), vector("G2")] {
        for flipped in flips(&octets) {
            check(&flipped);
        }
        for length in 0..octets.len() {
            let truncated = listener().receive(&ego(), &octets[..length]);
            assert!(matches!(truncated, Err(Discarded::Headers(_))), "{length}");
        }
    }
}

proptest! {
    #[test]
    fn any_octets_are_understood_or_discarded(octets in prop::collection::vec(any::<u8>(), 0..1_600)) {
        check(&octets);
        let behind_a_good_start = [&vector("G1")[..4], &octets].concat();
        check(&behind_a_good_start);
    }
}
