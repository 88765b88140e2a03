//! Stations of others on the link of a robot that runs: their CAM, VAM and CPM, as independent encoders made them, and
//! garbage.

use std::io::{BufRead, BufReader, Write};
use std::net::{TcpStream, UdpSocket};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, Service, golden};
use crossguard_protocol::StationId;
use crossguard_testkit::command::*;
use serde_json::Value;

use crate::street::{ARI, PATIENCE, Street, assert_valid};

const ROBOT: u32 = 4_711;

/// Where the messages of [`golden::ITS`] and [`golden::VAM`] are from, and the robot. It drops none for a busy machine.
const SITE: &str = "[site]\nlatitude = 48.7654321\nlongitude = 9.1234567\n\n\
    [protocol]\nt_safety = 5000\ndelay_max = 2500\n\n[link]";

/// How often each message is sent.
const TIMES: usize = 12;

/// A message that asn1tools and pycrate agree on, by another station, in the packet G1, which Wireshark took apart, at the
/// port of its service.
fn packet(file: &'static str, name: &str, port: u16, station: u32) -> Vec<u8> {
    let mut message = hex::decode(golden::vector(file, name)).unwrap();
    message[2..6].copy_from_slice(&station.to_be_bytes());
    let mut packet = hex::decode(golden::vector(golden::PACKETS, "G1")).unwrap();
    packet.truncate(packet.len() - 59);
    let [.., high, low, _, _] = packet.as_mut_slice() else {
        panic!("there is a BTP header");
    };
    [*high, *low] = port.to_be_bytes();
    // The payload is the BTP header and the message; the address is the station's.
    let length = u16::try_from(4 + message.len()).unwrap();
    packet[8..10].copy_from_slice(&length.to_be_bytes());
    packet[16..20].copy_from_slice(&station.to_be_bytes());
    packet.extend(message);
    packet
}

/// Packet of a robot that was given the same station id.
fn of_namesake() -> Vec<u8> {
    let mut namesake = Stack::of_robot(Identifiers::default(), StationId(ROBOT));
    let packet = namesake.packet(&EgoPosition::default(), Service::Ram, &[0; 8]);
    packet.unwrap()
}

/// A robot that runs, and what it says from then on.
struct Running {
    child: Child,
    lines: Box<dyn Iterator<Item = String>>,
    metrics: String,
}

impl Running {
    fn start(config: &str, log: &str) -> Self {
        let mut command = crossguard(&["run", "--config", config, "--metrics", "0", "--log", log]);
        let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let mut lines = lines.map_while(Result::ok);
        let metrics = lines.find_map(|line| {
            let address = line.strip_prefix("Metrics are at http://")?;
            Some(address.strip_suffix("/metrics.")?.to_owned())
        });
        let (lines, metrics) = (Box::new(lines), metrics.unwrap());
        Self {
            child,
            lines,
            metrics,
        }
    }

    fn scrape(&self) -> String {
        let mut client = TcpStream::connect(&self.metrics).unwrap();
        let request = b"GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n";
        client.write_all(request).unwrap();
        std::io::read_to_string(client).unwrap()
    }
}

fn port_of(config: &str) -> u16 {
    let text = std::fs::read_to_string(config).unwrap();
    let (_, rest) = text.split_once("address = \"127.0.0.1:").unwrap();
    rest.split('"').next().unwrap().parse().unwrap()
}

/// Hazard of the clock: a packet that was held up on its way speaks of a street as it was.
#[test]
fn stations_of_others_are_in_status_metrics_and_log_and_what_outlived_its_lifetime_is_dropped() {
    let street = Street::new(&[("[link]", SITE)]);
    let config = &street.configs[ARI];
    let station = format!("station = {ROBOT}");
    edit(
        config,
        &[("station = 1", &station), ("autopilot = true\n", "")],
    );
    let log = street.path("ari.jsonl");
    let mut robot = Running::start(config, &log);
    let station = UdpSocket::bind("127.0.0.1:0").unwrap();
    let send = |packet: &[u8]| {
        let robot = ("127.0.0.1", port_of(config));
        station.send_to(packet, robot).unwrap()
    };
    let others = [
        packet(golden::ITS, "C2", 2_001, 100),
        packet(golden::VAM, "V1", 2_018, 200),
        packet(golden::VAM, "V3", 2_018, 300),
        packet(golden::ITS, "P2", 2_009, 400),
        packet(golden::ITS, "C1", 2_001, ROBOT),
        of_namesake(),
    ];
    for _ in 0..TIMES {
        for packet in &others {
            send(packet);
        }
        std::thread::sleep(Duration::from_millis(200));
    }
    let scraped = robot.scrape();
    type_to(&mut robot.child, "status\nquit\n");
    let said = robot.lines.collect::<Vec<_>>().join("\n");
    let status = wait_for(&mut robot.child, PATIENCE);
    assert_eq!(status.code(), Some(0), "{said}");

    let heard = format!("heard {TIMES} CAM, {} VAM, {TIMES} CPM", 2 * TIMES);
    said.must_have(&[
        &heard,
        "of 4 stations",
        // A station, and what another one perceives; one by itself, and a cluster.
        "2 vehicles (nearest station 100 at 0.0 m, oldest ",
        "2 vulnerable road users (nearest ",
        "; channel: nobody measures it",
        "another station with the own station id: another station has",
    ]);
    scraped.must_have(&[
        "cause=\"another station with the own station id\"} 12",
        "crossguard_stations_heard{robot=\"ARI\"} 4",
        "crossguard_around{robot=\"ARI\",kind=\"vehicle\"} 2",
        "crossguard_around{robot=\"ARI\",kind=\"vulnerable road user\"} 2",
    ]);
    in_log(&std::fs::read_to_string(&log).unwrap());
    assert_valid([log.into()].into_iter());
}

fn in_log(log: &str) {
    let records = records(log);
    let of = |entry: &str| {
        let of = records.iter().filter(|it| it["entry"] == entry);
        of.collect::<Vec<_>>()
    };
    let heard = of("heard");
    let counts = [
        ("CAM", 100),
        ("VAM", 200),
        ("VAM", 300),
        ("CPM", 400),
        ("CAM", ROBOT),
    ];
    let counts = counts.map(|(kind, from)| {
        let is_it = |it: &&&Value| it["message"] == kind && it["from"] == from;
        heard.iter().filter(is_it).count()
    });
    assert_eq!(counts, [TIMES, TIMES, TIMES, TIMES, 0]);
    // The message itself, to be read again.
    let vam = heard.iter().find(|it| it["from"] == 300).unwrap();
    let octets = golden::vector(golden::VAM, "V3").replacen("075bcd15", "0000012c", 1);
    assert_eq!(vam["octets"], octets);
    // Messages by the robot's own station id are not heard, and counted.
    let dropped = of("dropped").into_iter();
    let dropped: Vec<_> = dropped.map(|it| it["cause"].as_str().unwrap()).collect();
    let both = [
        "message of the own station",
        "another station with the own station id",
    ];
    assert_eq!(dropped, [both; TIMES].concat());
}

#[test]
fn garbage_does_not_fill_the_disk_and_every_piece_of_it_is_counted() {
    let street = Street::new(&[]);
    let config = &street.configs[ARI];
    let log = street.path("ari.jsonl");
    let mut robot = Running::start(config, &log);
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let (port, began) = (port_of(config), Instant::now());
    while began.elapsed() < Duration::from_secs(2) {
        for _ in 0..20 {
            let _ = socket.send_to(&[0x55; 1_200], ("127.0.0.1", port));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    type_to(&mut robot.child, "quit\n");
    robot.lines.for_each(drop);
    assert_eq!(wait_for(&mut robot.child, PATIENCE).code(), Some(0));
    let seconds = began.elapsed().as_secs() + 2;
    let records = records(&std::fs::read_to_string(&log).unwrap());
    let counters = &records.last().unwrap()["counters"];
    // On a busy machine pieces wait too long before the robot takes them apart.
    let causes = ["packet", "inbox"]
        .into_iter()
        .filter_map(|layer| counters[layer].as_object());
    let counts = causes.flatten().filter_map(|(_, count)| count.as_u64());
    let counted: u64 = counts.sum();
    assert!(counted > 1_000, "{counted} arrived");
    // Of each cause so many in a second; these have up to three.
    let of = |entry: &str| records.iter().filter(|it| it["entry"] == entry).count() as u64;
    let dropped = of("dropped");
    assert!(dropped <= 3 * 32 * seconds, "{dropped} in {seconds} s");
    assert!(of("unrecorded") >= 1);
    assert_valid([log.into()].into_iter());
}
