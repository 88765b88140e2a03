//! A thousand packets a second of other stations, and garbage, while the robots cross.

use std::net::UdpSocket;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, Service, golden};
use crossguard_protocol::StationId;
use crossguard_testkit::command::*;

/// Packets a second to each robot.
const RATE: u32 = 1_000;

/// A message of the codec's golden vectors, from another station each time.
fn message(vectors: &'static str, name: &str, station: u32) -> Vec<u8> {
    let mut octets = hex::decode(golden::vector(vectors, name)).unwrap();
    octets[2..6].copy_from_slice(&station.to_be_bytes());
    octets
}

/// The packet number `n` of the flood.
fn packet(n: u32) -> Vec<u8> {
    let station = 1_000 + n % 500;
    let mut sender = Stack::of_robot(Identifiers::default(), StationId(station));
    let mut send = |service, message: &[u8]| {
        sender
            .packet(&EgoPosition::default(), service, message)
            .unwrap()
    };
    match n % 5 {
        0 => send(Service::Cam, &message(golden::ITS, "C2", station)),
        1 => send(Service::Denm, &message(golden::ITS, "D1", station)),
        2 => send(Service::Vam, &message(golden::VAM, "V11", station)),
        3 => send(Service::Cpm, &message(golden::ITS, "P2", station)),
        // Garbage: a CAM that says to be a RAM, and is cut off.
        _ => send(Service::Ram, &message(golden::ITS, "C1", station)[..20]),
    }
}

/// Sends the flood at its rate until it is told to stop; how many packets that were.
fn flood(port: u16, stop: &AtomicBool) -> u32 {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let packets: Vec<_> = (0..2_500).map(packet).collect();
    let began = Instant::now();
    let mut sent = 0;
    while !stop.load(Ordering::Relaxed) {
        for to in [port, port + 1] {
            let _ = socket.send_to(&packets[sent as usize % packets.len()], ("127.0.0.1", to));
        }
        sent += 1;
        let due = began + Duration::from_secs(1) / RATE * sent;
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
    }
    sent
}

#[test]
fn the_crossing_goes_on_in_a_flood_of_other_stations() {
    let (result, sent) = demo_under_attack(flood);
    assert_eq!(result["crossings"], 1);
    assert_eq!(result["trace_valid"], true);
    for robot in ["ARI", "Go2"] {
        let garbage = &result["counters"][robot]["syntax"]["unknown messageId"];
        // A fifth of what was sent while the robot ran, unless the machine was too slow for it.
        assert!(garbage.as_u64().unwrap_or_default() > 0, "{result}");
    }
    for maneuver in result["maneuvers"].as_array().unwrap() {
        let latency = maneuver["t_neg_s"]["mean"].as_f64().unwrap();
        assert!(latency > 0.0, "{maneuver}");
        println!(
            "{sent} packets to each robot: {} acknowledged after {latency:.4} s",
            maneuver["task"]
        );
    }
}
