//! Robots attached to on-board units by the attachment protocol: `examples/unit.rs` and `examples/unit.py`, and
//! units of the test's own, which measure a busy channel or send what is no frame.

use std::io::{Read, Write};
use std::net::{TcpStream, UdpSocket};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crossguard_robot::attachment::{Frame, Kind, Radio, Side};
use crossguard_testkit::command::*;
use serde_json::Value;

use crate::unit_process::{ARGUMENTS, AS_UNIT};

const PATIENCE: Duration = Duration::from_mins(1);

/// A unit on the loopback interface, which ends with the test.
struct Unit(Child);

impl Unit {
    fn start(port: u16, group: u16) -> Self {
        let arguments = format!("127.0.0.1:{port} multicast 239.118.50.19:{group} lo 0.8");
        let child = Command::new(std::env::current_exe().unwrap())
            .args(AS_UNIT)
            .env(ARGUMENTS, arguments)
            .stdout(Stdio::null())
            .spawn();
        Self(child.unwrap())
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The configuration of a robot that is attached to the unit at this port.
fn attached(mut config: String, unit: u16, more: &str, speed: &str) -> String {
    let text = std::fs::read_to_string(&config).unwrap();
    let (robot, _) = text.split_once("[link]").unwrap();
    let robot = robot.replace("speed = 40.0", speed);
    let text = format!("{robot}[link]\nunit = \"127.0.0.1:{unit}\"\n{more}");
    std::fs::write(&config, text).unwrap();
    config.shrink_to_fit();
    config
}

/// ARI and Go2, each attached to a unit of its own.
fn street(folder: &std::path::Path, port: u16, more: &str, speed: &str) -> [String; 2] {
    [("ARI", 1), ("Go2", 2)].map(|(name, station)| {
        let config = robot_file(folder, name, station, port, port);
        let unit = port + u16::try_from(station).unwrap();
        attached(config, unit, more, speed)
    })
}

#[test]
fn two_robots_with_a_unit_each_do_the_crossing_with_packets_and_with_payloads() {
    for sends in ["geonetworking", "btp"] {
        let folder = tempfile::tempdir().unwrap();
        let port = free_ports(3);
        let _units = [1, 2].map(|unit| Unit::start(port + unit, port));
        let more = format!("sends = \"{sends}\"\n");
        let [ari, go2] = street(folder.path(), port, &more, "speed = 40.0");
        let mut robots = [&ari, &go2].map(|config| start(config));
        type_to(
            &mut robots[0],
            "wait 1\ndetect\nuntil maneuver-executing 20\nuntil idle 20\nquit\n",
        );
        assert_eq!(
            wait_for(&mut robots[0], PATIENCE).code(),
            Some(0),
            "{sends}"
        );
        type_to(&mut robots[1], "quit\n");
        assert_eq!(
            wait_for(&mut robots[1], PATIENCE).code(),
            Some(0),
            "{sends}"
        );
        let logs = [&ari, &go2].map(|config| log_of(config));
        for log in &logs {
            assert!(log.contains("\"taskCompleted\""), "{sends}");
            assert!(log.contains("\"busyRatio\":0.8"), "{sends}");
        }
        assert!(logs[0].contains("corridorOpened"), "{sends}");
        let paths = [&ari, &go2].map(|config| {
            let path = std::path::Path::new(config).with_extension("log");
            path.display().to_string()
        });
        let verdict = run(&["validate", &paths[0], &paths[1]]);
        assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
    }
}

#[test]
fn a_unit_that_is_killed_in_the_middle_closes_the_corridor_and_makes_the_follower_fall_back() {
    let folder = tempfile::tempdir().unwrap();
    let port = free_ports(3);
    let mut units = [1, 2].map(|unit| Unit::start(port + unit, port));
    let [ari, go2] = street(folder.path(), port, "", "speed = 1.0");
    let mut robots = [&ari, &go2].map(|config| start(config));
    type_to(
        &mut robots[0],
        "wait 1\ndetect\nuntil maneuver-executing 30\n",
    );
    // The pedestrian is on the way once the corridor is open.
    let opened = Instant::now();
    while !log_of(&ari).contains("corridorOpened") {
        assert!(opened.elapsed() < PATIENCE, "{}", log_of(&ari));
        std::thread::sleep(Duration::from_millis(50));
    }
    units[1].0.kill().unwrap();
    units[1].0.wait().unwrap();
    for robot in &mut robots {
        type_to(robot, "until idle 30\nwait 4\nquit\n");
    }
    for robot in &mut robots {
        assert_eq!(wait_for(robot, PATIENCE).code(), Some(0));
    }
    let [leader, follower] = [&ari, &go2].map(|config| happenings(&log_of(config)));
    let opened_ms = first(&leader, |it| it.get("corridorOpened").is_some()).unwrap();
    let closed_ms = first(&leader, |it| it.get("corridorClosed").is_some()).unwrap();
    let fell_back_ms = first(&follower, |it| it.get("fallBack").is_some()).unwrap();
    assert!(opened_ms < closed_ms, "{opened_ms} {closed_ms}");
    // The lease is shorter than the follower's safety timeout.
    assert!(closed_ms < fell_back_ms, "{closed_ms} {fell_back_ms}");
    let of_follower = log_of(&go2);
    assert!(
        of_follower.contains("has been silent for 3 s"),
        "an operator sees that the unit is gone"
    );
    assert!(of_follower.contains("no unit is there"), "{of_follower}");
}

/// A unit of the test: it answers the robot with frames that tell this busy ratio, until it is dropped.
fn busy_unit(busy_permyriad: u16) -> (u16, std::thread::JoinHandle<usize>) {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let port = socket.local_addr().unwrap().port();
    socket
        .set_read_timeout(Some(Duration::from_secs(4)))
        .unwrap();
    let unit = std::thread::spawn(move || {
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
    });
    (port, unit)
}

fn scrape(address: &str, query: &str) -> String {
    let mut client = TcpStream::connect(address).unwrap();
    write!(client, "GET /metrics{query} HTTP/1.1\r\n\r\n").unwrap();
    let mut answer = String::new();
    client.read_to_string(&mut answer).unwrap();
    answer
}

#[test]
fn a_full_channel_is_shown_and_bad_frames_are_counted_each_under_its_cause() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let (unit, heard) = busy_unit(8_000);
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let config = attached(config, unit, "", "speed = 40.0");
    let address = format!("127.0.0.1:{}", free_ports(1));
    let arguments = [
        "run",
        "--config",
        &config,
        "--status",
        "always",
        "--metrics",
        &address,
    ];
    let mut robot = crossguard(&arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(3));
    let metrics = scrape(&address, "?x=1");
    for expected in [
        "crossguard_channel_busy_ratio{robot=\"ARI\"} 0.8",
        "crossguard_reception_power_dbm{robot=\"ARI\"} -80.1",
        "crossguard_congestion_interval_seconds{robot=\"ARI\"} 1",
        "layer=\"link\",cause=\"frame too short\"",
        "layer=\"link\",cause=\"no frame\"",
    ] {
        assert!(
            metrics.contains(expected),
            "{expected} is not in:\n{metrics}"
        );
    }
    type_to(&mut robot, "quit\n");
    let output = robot.wait_with_output().unwrap();
    let status = stderr(&output);
    assert!(
        status.contains("channel 80 % busy, RAM at most every 1000 ms"),
        "{status}"
    );
    let lines = stdout(&output);
    assert!(lines.contains("dropped, link: frame too short"), "{lines}");
    assert!(heard.join().unwrap() > 0);
}

#[test]
fn what_a_unit_cannot_do_is_refused_in_the_robot_file() {
    let folder = tempfile::tempdir().unwrap();
    let refuse = |link: &str, cause: &str| {
        let config = attached(robot_file(folder.path(), "ARI", 1, 1, 2), 4_747, link, "");
        assert_refused(&run(&["run", "--config", &config]), cause);
    };
    refuse("framing = \"ethernet\"\n", "[link] wants either");
    refuse("peers = [\"127.0.0.1:4\"]\n", "[link] wants either");
    refuse("sends = \"can\"\n", "unknown variant `can`");
    let both = robot_file(folder.path(), "ARI", 1, 1, 2);
    edit(&both, &[("peers", "sends = \"btp\"\npeers")]);
    assert_refused(&run(&["run", "--config", &both]), "[link] wants either");
    let pki = folder.path().join("pki").display().to_string();
    assert!(run(&["pki", "init", &pki]).status.success());
    let config = attached(
        robot_file(folder.path(), "ARI", 1, 1, 2),
        4_747,
        "sends = \"btp\"\n",
        "speed = 1.0",
    );
    let own = format!("{pki}/robots/ARI");
    let output = run(&[
        "run",
        "--config",
        &config,
        "--security",
        "sign",
        "--pki",
        &own,
    ]);
    assert_refused(
        &output,
        "sends = \"btp\": a unit signs what it sends itself",
    );
}

/// The records of the channel in a log.
fn channels(log: &str) -> Vec<Value> {
    let records = records(log).into_iter();
    records.filter(|it| it["entry"] == "channel").collect()
}

#[test]
fn a_unit_in_python_carries_the_packets_of_a_robot_and_its_busy_ratio() {
    let folder = tempfile::tempdir().unwrap();
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/unit.py");
    let port = free_ports(2);
    let script = std::fs::read_to_string(example).unwrap();
    let script = script.replace("4747", &port.to_string());
    let script = script.replace("47418", &(port + 1).to_string());
    let path = folder.path().join("unit.py");
    std::fs::write(&path, script).unwrap();
    let python = Command::new("python3").arg(&path).spawn();
    let _unit = match python {
        Ok(child) => Unit(child),
        Err(error) => {
            // Not by eprintln!, which the test runner would capture.
            let _ = writeln!(
                std::io::stderr(),
                "SKIPPED a_unit_in_python_carries_the_packets_of_a_robot_and_its_busy_ratio: {error}"
            );
            return;
        }
    };
    // Its multicast loops back what the robot sends.
    let config = robot_file(folder.path(), "ARI", 1, port, port);
    let config = attached(config, port, "", "speed = 1.0");
    let mut robot = start(&config);
    std::thread::sleep(Duration::from_secs(4));
    type_to(&mut robot, "quit\n");
    assert_eq!(wait_for(&mut robot, PATIENCE).code(), Some(0));
    let log = log_of(&config);
    assert!(
        channels(&log).iter().any(|it| it["busyRatio"] == 0.2),
        "{log}"
    );
    let last = records(&log).pop().unwrap();
    assert!(
        last["counters"]["packet"]["own packet"].as_u64() > Some(0),
        "{last}"
    );
}
