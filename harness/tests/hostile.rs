//! What does not belong on the channel: garbage, other messages, other versions, a flood.

use std::net::UdpSocket;
use std::sync::atomic::Ordering;
use std::time::Duration;

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{
    Identifiers, MessageIdentifiers, RobotState, Service, encode, golden, ram_from,
};
use crossguard_protocol::{Availability, Robot, StationId};
use crossguard_testkit::command::*;
use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A packet with these octets, from a station that has no part in anything.
fn packet(service: Service, message: &[u8]) -> Vec<u8> {
    Stack::of_robot(Identifiers::default(), StationId(77))
        .packet(&EgoPosition::default(), service, message)
        .unwrap()
}

/// A RAM of a robot that has no part in anything.
fn ram(identifiers: Identifiers) -> Vec<u8> {
    let view = Robot::new(StationId(77), 1).ram();
    let (state, available) = (RobotState::default(), Availability::Available);
    let ram = ram_from(&identifiers, &state, &view, available, 0, false).unwrap();
    encode(&identifiers, &ram).unwrap()
}

fn hostile_datagrams() -> Vec<Vec<u8>> {
    let good = ram(Identifiers::default());
    let version = |protocol_version| MessageIdentifiers {
        protocol_version,
        ..Identifiers::default().ram
    };
    let mut noise = ChaCha8Rng::seed_from_u64(1);
    let mut random = vec![0; 200];
    noise.fill_bytes(&mut random);
    let other_version = ram(Identifiers {
        ram: version(9),
        ..Identifiers::default()
    });
    let a_ram = |message: &[u8]| packet(Service::Ram, message);
    let mut cut_short = a_ram(&good);
    cut_short.truncate(50);
    let mut secured = a_ram(&good);
    secured[0] = 0x12;
    let denm = hex::decode(golden::vector(golden::ITS, "D1")).unwrap();
    vec![
        Vec::new(),
        vec![1],
        good.clone(),
        random,
        vec![0x11; 1_900],
        cut_short,
        secured,
        packet(Service::Denm, &denm),
        packet(Service::Denm, &good),
        packet(Service::Rmcm, &good),
        a_ram(&[1]),
        a_ram(&good[..good.len() / 2]),
        a_ram(&[good.clone(), vec![0]].concat()),
        a_ram(&other_version),
        // The header of a CAM.
        a_ram(&[2, 2, 0, 0, 0, 5, 0, 0, 0, 0]),
    ]
}

#[test]
fn the_crossing_goes_on_among_garbage_and_each_kind_is_counted_by_its_cause() {
    let (result, ()) = demo_under_attack(|port, stop| {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        let datagrams = hostile_datagrams();
        while !stop.load(Ordering::Relaxed) {
            for datagram in &datagrams {
                for to in [port, port + 1] {
                    let _ = socket.send_to(datagram, ("127.0.0.1", to));
                }
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    });
    assert_eq!(result["trace_valid"], true);
    for robot in ["ARI", "Go2"] {
        let counters = &result["counters"][robot];
        for (layer, cause) in [
            ("packet", "truncated"),
            ("packet", "too long"),
            ("packet", "not supported"),
            ("packet", "payload length"),
            ("security", "secured, and security is off"),
            ("packet", "message of another port"),
            ("service", "no use for DENM"),
            ("syntax", "too short"),
            ("syntax", "truncated"),
            ("syntax", "trailing octets"),
            ("syntax", "unknown protocolVersion"),
            ("syntax", "unknown messageId"),
        ] {
            assert!(
                counters[layer][cause].as_u64().unwrap_or_default() > 0,
                "{layer}: {cause}: {counters}"
            );
        }
    }
}
