//! What does not belong on the channel: garbage, other messages, other versions, a flood.

mod support;

use std::net::UdpSocket;
use std::process::Stdio;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crossguard_codec::{Identifiers, MessageIdentifiers, RobotState};
use crossguard_harness::wire::Wire;
use crossguard_protocol::{Availability, Robot, StationId};
use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;
use support::*;

/// A RAM of a robot that has no part in anything.
fn ram(identifiers: Identifiers) -> Vec<u8> {
    let robot = Robot::new(StationId(77), 1);
    Wire { identifiers }
        .ram(
            &RobotState::default(),
            &robot.ram(),
            Availability::Available,
            0,
            false,
        )
        .unwrap()
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
    vec![
        Vec::new(),
        vec![1],
        good[..good.len() / 2].to_vec(),
        [good.clone(), vec![0]].concat(),
        ram(Identifiers {
            ram: version(9),
            ..Identifiers::default()
        }),
        random,
        vec![0xff; 1_900],
        // The header of a CAM.
        vec![2, 2, 0, 0, 0, 5, 0, 0, 0, 0],
    ]
}

#[test]
fn the_crossing_goes_on_among_garbage_and_each_kind_is_counted_by_its_cause() {
    let port = two_free_ports();
    let child = crossguard(&[
        "demo",
        "--speed",
        "10",
        "--port",
        &port.to_string(),
        "--json",
    ])
    .stdout(Stdio::piped())
    .spawn()
    .unwrap();
    let done = Arc::new(AtomicBool::new(false));
    let stop = Arc::clone(&done);
    let attacker = std::thread::spawn(move || {
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
    let output = child.wait_with_output().unwrap();
    done.store(true, Ordering::Relaxed);
    attacker.join().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let result = json(&output);
    assert_eq!(result["trace_valid"], true);
    for robot in ["ARI", "Go2"] {
        let counters = &result["counters"][robot];
        for cause in [
            "undecodable: too short",
            "undecodable: truncated",
            "undecodable: trailing octets",
            "undecodable: unknown protocolVersion",
            "undecodable: unknown messageId",
            "undecodable: too long",
        ] {
            assert!(
                counters[cause].as_u64().unwrap_or_default() > 0,
                "{cause}: {counters}"
            );
        }
    }
}
