//! Foreign traffic on the channel while the robots cross: garbage, other versions, and hundreds of packets a second
//! of other stations.

use std::net::UdpSocket;
use std::sync::atomic::Ordering;
use std::time::Duration;

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, Service, encode, golden, ram_from};
use crossguard_codec::{MessageIdentifiers, RobotState};
use crossguard_protocol::{Availability, Robot, StationId};
use crossguard_testkit::command::*;

/// Packets a second to each robot, at most: an attacker that was held up does not catch up.
const RATE: u32 = 300;

/// A packet with these octets, from a station that has no part in anything.
fn packet(station: u32, service: Service, message: &[u8]) -> Vec<u8> {
    let mut sender = Stack::of_robot(Identifiers::default(), StationId(station));
    let packet = sender.packet(&EgoPosition::default(), service, message);
    packet.unwrap()
}

/// A RAM of a robot that has no part in anything.
fn ram(identifiers: &Identifiers) -> Vec<u8> {
    let view = Robot::new(StationId(77), 1).ram();
    let (state, available) = (RobotState::default(), Availability::Available);
    let ram = ram_from(identifiers, &state, &view, available, 0, false).unwrap();
    encode(identifiers, &ram).unwrap()
}

fn garbage() -> Vec<Vec<u8>> {
    let good = ram(&Identifiers::default());
    let usual = Identifiers::default().ram;
    let other_version = ram(&Identifiers {
        ram: MessageIdentifiers {
            protocol_version: 9,
            ..usual
        },
        ..Identifiers::default()
    });
    let a_ram = |message: &[u8]| packet(77, Service::Ram, message);
    let mut cut_short = a_ram(&good);
    cut_short.truncate(50);
    let mut secured = a_ram(&good);
    secured[0] = 0x12;
    vec![
        Vec::new(),
        vec![1],
        good.clone(),
        (0_u8..200).map(|n| n.wrapping_mul(97)).collect(),
        vec![0x11; 1_900],
        cut_short,
        secured,
        packet(77, Service::Denm, &good),
        packet(77, Service::Cam, &good),
        packet(77, Service::Rmcm, &good),
        a_ram(&[1]),
        a_ram(&good[..good.len() / 2]),
        a_ram(&[&good[..], &[0]].concat()),
        a_ram(&other_version),
        // The header of a CAM.
        a_ram(&[2, 2, 0, 0, 0, 5, 0, 0, 0, 0]),
    ]
}

/// A message of the codec's golden vectors, by the station number `n` of five hundred.
fn of_others(n: u32) -> Vec<u8> {
    let station = 1_000 + n % 500;
    let send = |service, vectors, name| {
        let mut octets = hex::decode(golden::vector(vectors, name)).unwrap();
        octets[2..6].copy_from_slice(&station.to_be_bytes());
        packet(station, service, &octets)
    };
    match n % 3 {
        0 => send(Service::Cam, golden::ITS, "C2"),
        1 => send(Service::Vam, golden::VAM, "V11"),
        _ => send(Service::Cpm, golden::ITS, "P2"),
    }
}

#[test]
fn the_crossing_goes_on_in_a_flood_and_each_kind_of_garbage_is_counted_by_its_cause() {
    let (result, ()) = demo_under_attack("--speed 10", |port, stop| {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        let garbage = garbage();
        let packets: Vec<_> = (0..2_000).map(of_others).collect();
        // Every fifth is garbage.
        let all = packets.chunks(4).zip(garbage.iter().cycle());
        let all: Vec<_> = all
            .flat_map(|(four, bad)| four.iter().chain([bad]))
            .collect();
        for datagram in all.into_iter().cycle() {
            for to in [port, port + 1] {
                let _ = socket.send_to(datagram, ("127.0.0.1", to));
            }
            if stop.load(Ordering::Relaxed) {
                break;
            }
            std::thread::sleep(Duration::from_secs(1) / RATE);
        }
    });
    assert_eq!(result["crossings"], 1);
    assert_eq!(result["traceValid"], true);
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
            let count = counters[layer][cause].as_u64().unwrap_or_default();
            assert!(count > 0, "{layer}: {cause}: {counters}");
        }
    }
}
