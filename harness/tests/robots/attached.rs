//! Robots attached to on-board units by the attachment protocol: `examples/unit.py`, and a unit of the test's own, which
//! measures a busy channel and sends what is no frame.

use std::fs;
use std::io::Write;
use std::net::{TcpStream, UdpSocket};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crossguard_robot::attachment::{Frame, Kind, Radio, Side};
use crossguard_testkit::command::*;

use crate::street::{ARI, CLOCKS_MS, CROSS, GO2, PATIENCE, Street, counted, sign_ended_ms};

/// A street whose robots are attached to the units at the first of these ports and the next one.
fn attached(port: u16, speed: &str) -> Street {
    let street = Street::new(&[("speed = 40.0", speed)]);
    for (robot, unit) in [(ARI, port), (GO2, port + 1)] {
        street.link(robot, &format!("unit = \"127.0.0.1:{unit}\""));
    }
    street
}

/// A unit at each of these ports and the next one, on a group at the third; nothing without Python.
fn units(street: &Street, port: u16) -> Option<[Killed; 2]> {
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/unit.py");
    let script = fs::read_to_string(example).unwrap();
    let script = script.replace("47418", &(port + 2).to_string());
    let unit = |unit: u16| {
        let path = street.path(&format!("{unit}.py"));
        fs::write(&path, script.replace("4747", &unit.to_string())).unwrap();
        Command::new("python3").arg(path).spawn().map(Killed)
    };
    match (unit(port), unit(port + 1)) {
        (Ok(one), Ok(other)) => Some([one, other]),
        (Err(error), _) | (_, Err(error)) => {
            skipped(&format!("there is no python3: {error}"));
            None
        }
    }
}

#[test]
fn two_robots_with_a_unit_each_do_the_crossing() {
    let port = free_ports(3);
    let mut street = attached(port, "speed = 40.0");
    let Some(_units) = units(&street, port) else {
        return;
    };
    street.start(&[]);
    street.say(ARI, &format!("wait 1\n{CROSS}"));
    street.until(GO2, "\"taskCompleted\"");
    let logs = street.end();
    for log in &logs {
        let measured = |it: &serde_json::Value| it["busyRatio"] == 0.2;
        assert!(log.iter().any(measured), "the busy ratio of the unit");
        // The multicast loops back what the robot sends.
        assert_ne!(counted(log, "packet", "own packet"), 0);
    }
}

#[test]
fn a_unit_that_is_killed_in_the_middle_closes_the_corridor_and_makes_the_follower_fall_back() {
    let port = free_ports(3);
    let mut street = attached(port, "speed = 1.0");
    let Some([_unit, of_go2]) = units(&street, port) else {
        return;
    };
    street.start(&[]);
    street.say(ARI, "wait 1\ndetect\n");
    street.until(ARI, "corridorOpened");
    drop(of_go2);
    street.until(GO2, "fallBack");
    street.until(GO2, "no unit is there");
    street.end();
    let [leader, follower] = [ARI, GO2].map(|robot| happenings(&street.log(robot)));
    assert!(street.log(ARI).contains("\"corridorClosed\""));
    let ended_ms = sign_ended_ms(&leader) - CLOCKS_MS;
    let fell_back_ms = first(&follower, |it| it.get("fallBack").is_some()).unwrap();
    assert!(ended_ms <= fell_back_ms, "{ended_ms} {fell_back_ms}");
    // An operator sees it.
    street.log(GO2).must_have(&["has been silent for 3 s"]);
}

/// Tells a robot this busy ratio ten times a second until it is `done`, and sends it what is no frame; how many packets
/// it was to send.
fn busy_unit(socket: &UdpSocket, busy_permyriad: u16, done: &AtomicBool) -> usize {
    let wait = Some(Duration::from_millis(100));
    socket.set_read_timeout(wait).unwrap();
    let radio = Radio {
        power_decidbm: Some(-801),
        busy_permyriad: Some(busy_permyriad),
    };
    let channel = Frame {
        radio,
        ..Frame::new(Kind::Channel, &[])
    };
    let channel = channel.encode().unwrap();
    let (mut buffer, mut packets, mut address) = ([0; 2_048], 0, None);
    while !done.load(Ordering::Relaxed) {
        if let Ok((length, robot)) = socket.recv_from(&mut buffer) {
            let frame = Frame::decode(&buffer[..length], Side::Robot).unwrap();
            packets += usize::from(frame.kind == Kind::SendPacket);
            address = Some(robot);
        }
        for octets in [&channel[..], &b"CG\x02"[..], &[0x11; 30]] {
            if let Some(robot) = address {
                let _ = socket.send_to(octets, robot);
            }
        }
    }
    packets
}

#[test]
fn a_full_channel_is_shown_and_bad_frames_are_counted_each_under_its_cause() {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let street = attached(socket.local_addr().unwrap().port(), "speed = 40.0");
    let done = Arc::new(AtomicBool::new(false));
    let stop = Arc::clone(&done);
    let heard = std::thread::spawn(move || busy_unit(&socket, 8_000, &stop));
    let address = format!("127.0.0.1:{}", free_ports(1));
    let lines = street.path("lines");
    let robot = crossguard(&["run", "--config", &street.configs[ARI]])
        .args(["--metrics", &address])
        .stdin(Stdio::piped())
        .stdout(fs::File::create(&lines).unwrap())
        .spawn();
    let mut robot = Killed(robot.unwrap());
    let scrape = || {
        let mut client = TcpStream::connect(&address)?;
        client.write_all(b"GET /metrics?x=1 HTTP/1.1\r\nHost: localhost\r\n\r\n")?;
        std::io::read_to_string(client)
    };
    for expected in [
        "crossguard_channel_busy_ratio{robot=\"ARI\"} 0.8",
        "crossguard_reception_power_dbm{robot=\"ARI\"} -80.1",
        "crossguard_congestion_interval_seconds{robot=\"ARI\"} 1\n",
        "layer=\"link\",cause=\"frame too short\"",
        "layer=\"link\",cause=\"no frame\"",
    ] {
        wait_until(expected, || scrape().is_ok_and(|it| it.contains(expected)));
    }
    type_to(&mut robot.0, "status\n");
    let expected = "channel 80 % busy, RAM at most every 1000 ms";
    wait_until(expected, || {
        let shown = fs::read_to_string(&lines).unwrap();
        shown.contains(expected)
    });
    type_to(&mut robot.0, "quit\n");
    wait_for(&mut robot.0, PATIENCE);
    let lines = fs::read_to_string(lines).unwrap();
    let expected = "dropped, link: frame too short";
    lines.must_have(&[expected]);
    done.store(true, Ordering::Relaxed);
    assert!(heard.join().unwrap() > 0);
}
