//! Robots attached to on-board units by the attachment protocol: `examples/unit.py`, and a unit of the test's own, which
//! measures a busy channel and sends what is no frame.

use std::fs;
use std::io::{Read, Write};
use std::net::{TcpStream, UdpSocket};
use std::process::{Command, Stdio};
use std::time::Duration;

use crossguard_robot::attachment::{Frame, Kind, Radio, Side};
use crossguard_testkit::command::*;

use crate::street::{ARI, CROSS, GO2, Street, skipped};

/// A street whose robots are attached to the units at the first of these ports and the next one.
fn attached(port: u16, speed: &str) -> Street {
    let street = Street::new(&[("speed = 40.0", speed)]);
    for (config, unit) in street.configs.iter().zip([port, port + 1]) {
        let text = fs::read_to_string(config).unwrap();
        let (robot, _) = text.split_once("[link]").unwrap();
        let text = format!("{robot}[link]\nunit = \"127.0.0.1:{unit}\"\n");
        fs::write(config, text).unwrap();
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
        let counters = &log.last().unwrap()["counters"];
        assert!(
            counters["packet"]["own packet"].as_u64() > Some(0),
            "{counters}"
        );
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
    let closed_ms = first(&leader, |it| it.get("corridorClosed").is_some()).unwrap();
    let fell_back_ms = first(&follower, |it| it.get("fallBack").is_some()).unwrap();
    assert!(closed_ms < fell_back_ms, "{closed_ms} {fell_back_ms}");
    assert!(
        street.log(GO2).contains("has been silent for 3 s"),
        "an operator sees it"
    );
}

/// Answers a robot with frames that tell this busy ratio, and with what is none; how many packets it was to send.
fn busy_unit(socket: &UdpSocket, busy_permyriad: u16) -> usize {
    let wait = Some(Duration::from_secs(4));
    socket.set_read_timeout(wait).unwrap();
    let mut buffer = [0; 2_048];
    let mut packets = 0;
    // It ends when the robot has.
    while let Ok((length, robot)) = socket.recv_from(&mut buffer) {
        let frame = Frame::decode(&buffer[..length], Side::Robot).unwrap();
        packets += usize::from(frame.kind == Kind::SendPacket);
        let radio = Radio {
            power_decidbm: Some(-801),
            busy_permyriad: Some(busy_permyriad),
        };
        let channel = Frame {
            radio,
            ..Frame::new(Kind::Channel, &[])
        };
        let _ = socket.send_to(&channel.encode().unwrap(), robot);
        for bad in [&b"CG\x02"[..], &[0x11; 30]] {
            let _ = socket.send_to(bad, robot);
        }
    }
    packets
}

#[test]
fn a_full_channel_is_shown_and_bad_frames_are_counted_each_under_its_cause() {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let street = attached(socket.local_addr().unwrap().port(), "speed = 40.0");
    let heard = std::thread::spawn(move || busy_unit(&socket, 8_000));
    let address = format!("127.0.0.1:{}", free_ports(1));
    let options = ["--status", "always", "--metrics", &address];
    let mut robot = crossguard(&["run", "--config", &street.configs[ARI]])
        .args(options)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(3));
    let mut client = TcpStream::connect(&address).unwrap();
    client
        .write_all(b"GET /metrics?x=1 HTTP/1.1\r\n\r\n")
        .unwrap();
    let mut metrics = String::new();
    client.read_to_string(&mut metrics).unwrap();
    type_to(&mut robot, "quit\n");
    let output = robot.wait_with_output().unwrap();
    let (lines, status) = (stdout(&output), stderr(&output));
    for (said, expected) in [
        (&metrics, "crossguard_channel_busy_ratio{robot=\"ARI\"} 0.8"),
        (
            &metrics,
            "crossguard_reception_power_dbm{robot=\"ARI\"} -80.1",
        ),
        (
            &metrics,
            "crossguard_congestion_interval_seconds{robot=\"ARI\"} 1",
        ),
        (&metrics, "layer=\"link\",cause=\"frame too short\""),
        (&metrics, "layer=\"link\",cause=\"no frame\""),
        (&status, "channel 80 % busy, RAM at most every 1000 ms"),
        (&lines, "dropped, link: frame too short"),
    ] {
        assert!(said.contains(expected), "'{expected}' is not in:\n{said}");
    }
    assert!(heard.join().unwrap() > 0);
}
