//! Stations of others on the link of a robot that runs: their CAM, VAM and CPM, as independent encoders made
//! them, in status, metrics, log, MCAP file and map.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpStream, UdpSocket};
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crossguard_codec::golden;
use crossguard_codec::si::timestamp_its;
use crossguard_testkit::command::{
    crossguard, records, robot_file, run, stderr, stdout, two_free_ports, type_to, wait_for,
};
use serde_json::Value;

/// The robot.
const ROBOT: u32 = 4_711;

/// Where the messages of [`golden::ITS`] and [`golden::VAM`] are from, and the robot.
const SITE: &str = "\n[site]\nlatitude = 48.7654321\nlongitude = 9.1234567\n";

/// How often each message is sent.
const TIMES: usize = 12;

/// A message that asn1tools and pycrate agree on, by another station, in the packet G1, which Wireshark took
/// apart, at the port of its service.
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

/// What the other stations send, and one in the robot's own name.
fn packets() -> [Vec<u8>; 5] {
    [
        packet(golden::ITS, "C2", 2_001, 100),
        packet(golden::VAM, "V1", 2_018, 200),
        packet(golden::VAM, "V3", 2_018, 300),
        packet(golden::ITS, "P2", 2_009, 400),
        packet(golden::ITS, "C1", 2_001, ROBOT),
    ]
}

/// A robot that runs, and what it says from then on.
struct Robot {
    child: Child,
    lines: Box<dyn Iterator<Item = String>>,
    metrics: String,
}

fn start(config: &str, log: &Path) -> Robot {
    let mut command = crossguard(&["run", "--config", config, "--metrics", "0", "--log"]);
    let mut child = command
        .arg(log)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap())
        .lines()
        .map_while(Result::ok);
    let metrics = lines.find_map(|line| {
        let address = line.strip_prefix("Metrics are at http://")?;
        Some(address.strip_suffix("/metrics.")?.to_owned())
    });
    Robot {
        child,
        lines: Box::new(lines),
        metrics: metrics.unwrap(),
    }
}

fn metrics(address: &str) -> String {
    let mut client = TcpStream::connect(address).unwrap();
    client
        .write_all(b"GET /metrics HTTP/1.1\r\nHost: here\r\n\r\n")
        .unwrap();
    let mut answer = String::new();
    client.read_to_string(&mut answer).unwrap();
    answer
}

fn of<'a>(records: &'a [Value], entry: &str) -> Vec<&'a Value> {
    records.iter().filter(|it| it["entry"] == entry).collect()
}

#[test]
fn stations_of_others_are_in_status_metrics_log_recording_and_map() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", ROBOT, port, port + 1);
    let text = std::fs::read_to_string(&config).unwrap();
    std::fs::write(&config, text + SITE).unwrap();
    let log = folder.path().join("ari.jsonl");
    let mut robot = start(&config, &log);

    let station = UdpSocket::bind("127.0.0.1:0").unwrap();
    for _ in 0..TIMES {
        for packet in packets() {
            station.send_to(&packet, ("127.0.0.1", port)).unwrap();
        }
        std::thread::sleep(Duration::from_millis(200));
    }
    let scraped = metrics(&robot.metrics);
    type_to(&mut robot.child, "status\nquit\n");
    let said: Vec<_> = robot.lines.collect();
    let status = wait_for(&mut robot.child, Duration::from_mins(1));
    assert_eq!(status.code(), Some(0), "{said:?}");

    in_status(&said);
    in_metrics(&scraped);
    in_log(&std::fs::read_to_string(&log).unwrap());
    let log = log.display().to_string();
    let validated = run(&["validate", &log]);
    assert_eq!(validated.status.code(), Some(0), "{}", stderr(&validated));
    in_recording(&log, &folder.path().join("ari.mcap"));
    in_report(&log, &folder.path().join("ari.html"));
}

/// A CAM of another station that was sent so long ago, by its own time stamp. It lives for a minute.
fn sent_ago(ago: Duration) -> Vec<u8> {
    let mut packet = packet(golden::ITS, "C2", 2_001, 100);
    let sent = SystemTime::now() - ago;
    let unix_ms = sent.duration_since(UNIX_EPOCH).unwrap().as_millis();
    let timestamp = timestamp_its(i64::try_from(unix_ms).unwrap());
    // The low half of it stands behind the address of the source.
    packet[20..24].copy_from_slice(&timestamp.to_be_bytes()[4..]);
    packet
}

/// Hazard: a packet that was held up on its way speaks of a street as it was.
#[test]
fn a_clock_that_is_known_to_be_right_is_shown_and_drops_what_outlived_its_lifetime() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", ROBOT, port, port + 1);
    let log = folder.path().join("ari.jsonl");
    let mut robot = start(&config, &log);
    let station = UdpSocket::bind("127.0.0.1:0").unwrap();
    let send = |ago| {
        let packet = sent_ago(Duration::from_secs(ago));
        station.send_to(&packet, ("127.0.0.1", port)).unwrap();
        std::thread::sleep(Duration::from_millis(300));
    };
    send(120);
    type_to(&mut robot.child, "status\nclock 20\nwait 0.1\nstatus\n");
    std::thread::sleep(Duration::from_secs(1));
    send(120);
    send(0);
    let scraped = metrics(&robot.metrics);
    type_to(&mut robot.child, "clock lost\nwait 0.3\nstatus\nquit\n");
    let said: Vec<_> = robot.lines.collect();
    let status = wait_for(&mut robot.child, Duration::from_mins(1));
    assert_eq!(status.code(), Some(0), "{said:?}");
    for part in [
        "; clock: nobody says how right it is; channel: nobody measures it",
        "; clock right to 20 ms;",
        "; clock not known to be right;",
        "security off, 0 rejected",
    ] {
        let shows = |line: &&String| line.starts_with("link ") && line.contains(part);
        assert!(said.iter().any(|line| shows(&line)), "'{part}': {said:#?}");
    }
    for line in [
        "crossguard_clock_is_right{robot=\"ARI\"} 1",
        "crossguard_clock_error_seconds{robot=\"ARI\"} 0.02",
        "security=\"off\"} 1",
    ] {
        assert!(scraped.contains(line), "{line} is not in:\n{scraped}");
    }
    let records = records(&std::fs::read_to_string(&log).unwrap());
    assert_eq!(of(&records, "heard").len(), 2, "the first and the last");
    let dropped = of(&records, "dropped");
    assert_eq!(dropped.len(), 1, "{dropped:?}");
    assert_eq!(dropped[0]["cause"], "lifetime over");
    let clocks = of(&records, "clockQuality").into_iter();
    let errors: Vec<_> = clocks.map(|it| it["errorMs"].clone()).collect();
    assert_eq!(errors, [20.into(), Value::Null]);
    let log = log.display().to_string();
    let validated = run(&["validate", &log]);
    assert_eq!(validated.status.code(), Some(0), "{}", stderr(&validated));
}

fn in_status(said: &[String]) {
    let line = said.iter().find(|line| line.starts_with("sent "));
    let line = line.unwrap_or_else(|| panic!("{said:#?}"));
    for part in [
        &format!("heard {TIMES} CAM, {} VAM, {TIMES} CPM", 2 * TIMES),
        "of 4 stations",
        // A station, and what another one perceives.
        "2 vehicles (nearest station 100 at 0.0 m, oldest 0.",
        // One by itself, a cluster.
        "2 vulnerable road users (nearest ",
    ] {
        assert!(line.contains(part), "'{part}' is not in: {line}");
    }
}

fn in_metrics(scraped: &str) {
    let value = |series: &str| {
        let line = scraped.lines().find_map(|line| line.strip_prefix(series));
        let value = line.unwrap_or_else(|| panic!("{series} is not in:\n{scraped}"));
        value.trim().parse::<f64>().unwrap()
    };
    let of = |family: &str, label: &str| value(&format!("{family}{{robot=\"ARI\",{label}}}"));
    for (service, at_least) in [("CAM", 11.0), ("VAM", 22.0), ("CPM", 11.0)] {
        let labels = format!("direction=\"heard\",message=\"{service}\"");
        assert!(of("crossguard_messages_total", &labels) >= at_least);
    }
    assert!((value("crossguard_stations_heard{robot=\"ARI\"}") - 4.0).abs() < 0.1);
    let around = |kind: &str| of("crossguard_around", &format!("kind=\"{kind}\"")).to_string();
    let kinds = ["robot", "vehicle", "vulnerable road user", "road-side unit"];
    assert_eq!(kinds.map(around), ["0", "2", "2", "0"]);
    assert!(of("crossguard_around_nearest_metres", "kind=\"vehicle\"") < 0.1);
    assert!(of("crossguard_around_oldest_seconds", "kind=\"vehicle\"") < 1.0);
}

fn in_log(log: &str) {
    let records = records(log);
    let heard = of(&records, "heard");
    let of_kind = |kind: &str, from: u32| {
        let is_it = |it: &&&Value| it["message"] == kind && it["from"] == from;
        heard.iter().filter(is_it).count()
    };
    let counts = [("CAM", 100), ("VAM", 200), ("VAM", 300), ("CPM", 400)];
    assert_eq!(counts.map(|(kind, from)| of_kind(kind, from)), [TIMES; 4]);
    // The message itself, to be read again.
    let vam = heard.iter().find(|it| it["from"] == 300).unwrap();
    let octets = golden::vector(golden::VAM, "V3").replacen("075bcd15", "0000012c", 1);
    assert_eq!(vam["octets"], octets);
    // What goes by the robot's own station id is not heard, and counted.
    assert_eq!(of_kind("CAM", ROBOT), 0);
    let dropped = of(&records, "dropped");
    assert!(
        dropped
            .iter()
            .all(|it| it["cause"] == "message of the own station" && it["layer"] == "packet"),
        "{dropped:?}"
    );
    assert_eq!(dropped.len(), TIMES);
    let around = of(&records, "around");
    let last = &around.last().unwrap()["kinds"];
    let vehicles = &last[0];
    assert_eq!(
        (&vehicles["kind"], &vehicles["count"]),
        (&"vehicle".into(), &2.into())
    );
    assert_eq!(vehicles["nearest"]["who"]["station"], 100);
}

fn in_recording(log: &str, file: &Path) {
    let export = run(&["export", log, "--mcap", file.to_str().unwrap()]);
    assert_eq!(export.status.code(), Some(0), "{}", stderr(&export));
    assert!(stdout(&export).contains("topics"));
    // Its messages are JSON, and not compressed.
    let recording = std::fs::read(file).unwrap();
    let text = String::from_utf8_lossy(&recording);
    let count = |part: &str| text.matches(part).count();
    for (kind, times) in [("CAM", TIMES), ("VAM", 2 * TIMES), ("CPM", TIMES)] {
        let heard = format!("\"direction\":\"heard\",\"kind\":\"{kind}\"");
        assert_eq!(count(&heard), times, "{kind}");
    }
    assert!(count("\"kind\":\"vehicle\",\"count\":2") >= 2);
}

fn in_report(log: &str, file: &Path) {
    let report = run(&["report", log, "--output", file.to_str().unwrap()]);
    assert_eq!(report.status.code(), Some(0), "{}", stderr(&report));
    let page = std::fs::read_to_string(file).unwrap();
    let section = page.split("Who was around</h2>").nth(1);
    let section = section.unwrap_or_else(|| panic!("the section is not in:\n{page}"));
    let vehicles = "<td>vehicle</td><td class=\"n\">2</td><td>station 100, 0.0 m at ";
    assert!(section.contains(vehicles), "{section}");
}
