//! People without a radio: a robot sees them, its RAM announces them, and a device understands it.

use std::collections::BTreeMap;
use std::process::Command;

use crossguard_codec::core::ram::RAM;
use crossguard_codec::{Identifiers, Position, RobotState, Service, decode};
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_endpoint::ras::containers::{self, Announced};
use crossguard_endpoint::ras::generation::Trigger;
use crossguard_endpoint::ras::motion::Plane;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Availability, Config, Event, Robot, Settings, StationId, Unavailability,
};
use crossguard_testkit::command;
use crossguard_testkit::command::{run, run_with, stderr, stdout, two_free_ports};
use serde_json::Value;

fn person(id: u32, east_m: f64, north_m: f64) -> PerceivedVru {
    PerceivedVru {
        id,
        position_m: [east_m, north_m],
        velocity_mps: [0.0, 0.0],
        class: VruClass::Pedestrian,
        confidence: 0.9,
    }
}

struct Street {
    endpoint: Endpoint,
    state: RobotState,
    now_ms: u64,
}

impl Street {
    fn new() -> Self {
        let config = Config::new(Settings::default()).unwrap();
        let robot = Robot::new(StationId(7), 1);
        Self {
            endpoint: Endpoint::new(robot, config, Identifiers::default(), 0),
            state: RobotState {
                position: Position::at(49.01, 8.41),
                ..RobotState::default()
            },
            now_ms: 0,
        }
    }

    /// The RAM that are sent when this happens `after_ms`: why, and what cluster they announce.
    fn hears(
        &mut self,
        after_ms: u64,
        stimulus: Stimulus<'_>,
    ) -> Vec<(Trigger, Option<Announced>)> {
        self.now_ms += after_ms;
        let moment = Moment {
            now_ms: self.now_ms,
            timestamp_its: self.now_ms,
        };
        let plane = Plane::around(&self.state.position).unwrap();
        let announced = |octets: &[u8]| {
            let ram = decode::<RAM>(&Identifiers::default(), octets)
                .unwrap()
                .message;
            containers::read(&ram, &plane)
        };
        let effects = self.endpoint.handle(moment, &self.state, stimulus);
        let sent = effects.iter().filter_map(|effect| match effect {
            Effect::Transmit {
                kind: Service::Ram,
                trigger,
                octets,
                ..
            } => Some((*trigger, announced(octets))),
            _ => None,
        });
        sent.collect()
    }
}

#[test]
fn people_around_a_robot_are_in_its_ram() {
    let mut street = Street::new();
    assert_eq!(street.hears(0, Stimulus::Time), [(Trigger::First, None)]);
    let people = [
        person(1, 3.0, 0.0),
        person(2, 2.0, -2.0),
        person(3, 40.0, 0.0),
    ];
    assert_eq!(street.hears(500, Stimulus::Perceived(&people)), []);
    let sent = street.hears(500, Stimulus::Perceived(&people));
    let [(Trigger::Interval, Some(cluster))] = &sent[..] else {
        panic!("{sent:?}")
    };
    assert_eq!(cluster.cardinality, 2);
    assert!(cluster.area.contains([3.0, 0.0]) && cluster.area.contains([2.0, -2.0]));
    assert!(!cluster.area.contains([40.0, 0.0]));
}

#[test]
fn a_crowd_is_announced_in_parts_each_within_a_second() {
    let mut street = Street::new();
    let crowd: Vec<PerceivedVru> = (0_u8..50)
        .map(|i| person(i.into(), f64::from(i % 10) - 5.0, f64::from(i / 10) - 2.0))
        .collect();
    street.hears(0, Stimulus::Perceived(&crowd));
    let mut last_ms = BTreeMap::new();
    for _ in 0..50 {
        for (trigger, cluster) in street.hears(100, Stimulus::Perceived(&crowd)) {
            assert_eq!(trigger, Trigger::Interval);
            let cluster = cluster.unwrap();
            assert!(cluster.cardinality <= 20);
            if let Some(last_ms) = last_ms.insert(cluster.id.unwrap(), street.now_ms) {
                assert!(street.now_ms - last_ms <= 1_600);
            }
        }
    }
    assert!((4..=10).contains(&last_ms.len()), "{}", last_ms.len());
}

#[test]
fn every_ram_says_why_it_was_sent() {
    let mut street = Street::new();
    street.hears(0, Stimulus::Time);
    let why = |sent: Vec<(Trigger, _)>| sent.first().map(|(trigger, _)| *trigger);
    let unavailable = Availability::Unavailable(Unavailability::LowBattery);
    let event = Event::AvailabilityChanged(unavailable);
    let sent = street.hears(200, Stimulus::Event(event));
    assert_eq!(why(sent), Some(Trigger::Availability));
    let event = Event::AvailabilityChanged(Availability::Available);
    let sent = street.hears(200, Stimulus::Event(event));
    assert_eq!(why(sent), Some(Trigger::Availability));

    street.endpoint.hold_back(500);
    street.state.speed = Some(1.0.into());
    assert_eq!(
        why(street.hears(1_000, Stimulus::Time)),
        Some(Trigger::Interval)
    );
    street.state.speed = Some(2.0.into());
    assert_eq!(why(street.hears(400, Stimulus::Time)), None);
    assert_eq!(why(street.hears(100, Stimulus::Time)), Some(Trigger::Speed));
}

/// A robot that listens to nobody, at the origin of its site.
fn lonely_robot(folder: &std::path::Path) -> String {
    let port = two_free_ports();
    command::robot_file(folder, "ARI", 1, port, port + 1)
}

/// What `crossguard sniff` reads in a file of packets, line by line.
fn sniffed(pcap: &str) -> Vec<Value> {
    let output = run(&["sniff", "--json", pcap]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    lines.collect()
}

/// Clusters by message: how many people, each time that they were announced.
fn clusters<'a>(packets: &'a [Value], kind: &str) -> Vec<&'a Value> {
    let of_kind = packets.iter().filter(|packet| packet["kind"] == kind);
    let users = of_kind.flat_map(|packet| packet["roadUsers"].as_array().into_iter().flatten());
    users.filter(|user| user["kind"] == "vru").collect()
}

/// Three people for 2.5 s, as a sensor would tell of them.
fn three_people(line: impl Fn(f64, u32) -> String) -> String {
    let times = (0..25).map(|tenth| f64::from(tenth) / 10.0);
    times
        .flat_map(|at_s| [1, 2, 3].map(|id| line(at_s, id)))
        .collect()
}

#[test]
fn people_of_a_file_are_announced_in_ram_and_in_cluster_vam() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let robot = lonely_robot(folder.path());
    let people = three_people(|at_s, id| {
        let east_m = 3.0 + f64::from(id);
        format!("{{\"at_s\": {at_s}, \"id\": {id}, \"position_m\": [{east_m}, 2.0]}}\n")
    });
    std::fs::write(path("people.jsonl"), people).unwrap();
    let (people, pcap, log) = (path("people.jsonl"), path("ari.pcap"), path("ari.jsonl"));
    let arguments = [
        "run",
        "--config",
        &robot,
        "--perceived",
        &people,
        "--cluster-vam",
    ];
    let records = ["--pcap", &pcap, "--log", &log];
    let output = run_with(
        &[&arguments[..], &records[..]].concat(),
        b"wait 4.5\nquit\n",
    );
    let text = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{text}{}", stderr(&output));
    assert!(text.contains("announces 3 people, cluster "), "{text}");
    assert!(text.contains("announces nobody any more"), "{text}");

    let packets = sniffed(&pcap);
    for kind in ["RAM", "VAM"] {
        let clusters = clusters(&packets, kind);
        assert!(clusters.len() >= 2, "{kind}: {packets:?}");
        // Lines come one by one, so the first and the last messages may know fewer.
        let of_all = clusters.iter().filter(|it| it["cardinality"] == 3);
        assert!(of_all.count() + 2 >= clusters.len(), "{kind}: {clusters:?}");
        for cluster in &clusters {
            assert_eq!(cluster["identity"]["object"]["by"], 1, "{kind}");
        }
    }
    // Every 500 ms for as long as there is somebody.
    assert!(clusters(&packets, "VAM").len() <= 8);
    // What was sent besides RAM and RMCM does not make the log invalid.
    let validated = run(&["validate", &log]);
    assert_eq!(validated.status.code(), Some(0), "{}", stderr(&validated));
    // Once nobody is there any more, VAM break the cluster up, by which there is nobody.
    let vams = packets
        .iter()
        .filter(|packet| packet["kind"] == "VAM")
        .count();
    let breakups = vams - clusters(&packets, "VAM").len();
    assert!((1..=3).contains(&breakups), "{breakups}");
    tshark_finds_packets_at_the_port_of_vam(&pcap, vams);
}

/// Wireshark 4.0 has no dissector for VAM, but knows the packets around them.
fn tshark_finds_packets_at_the_port_of_vam(pcap: &str, count: usize) {
    let filter = ["-r", pcap, "-Y", "btpb.dstport == 2018 && gnw"];
    let Ok(tshark) = Command::new("tshark").args(filter).output() else {
        println!("skipped tshark_finds_packets_at_the_port_of_vam: no tshark");
        return;
    };
    let text = String::from_utf8_lossy(&tshark.stdout);
    assert_eq!(text.lines().count(), count, "{text}");
}

#[test]
fn people_who_are_typed_are_announced_and_forgotten() {
    let folder = tempfile::tempdir().unwrap();
    let robot = lonely_robot(folder.path());
    let script = "wait 0.3\n{\"id\": 1, \"position_m\": [3, 1]}\n\
                  {\"id\": 2, \"position_m\": [300, 1]}\nwait 3.0\nquit\n";
    let output = run_with(&["run", "--config", &robot], script.as_bytes());
    let text = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{text}{}", stderr(&output));
    assert!(text.contains("announces 1 person, cluster "), "{text}");
    assert!(text.contains("announces nobody any more"), "{text}");
}

#[test]
fn a_line_that_is_no_person_is_refused_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let robot = lonely_robot(folder.path());
    let people = folder.path().join("people.jsonl").display().to_string();
    let refusal = |text: &str, cause: &str| {
        std::fs::write(&people, text).unwrap();
        let arguments = ["run", "--config", &robot, "--perceived", &people];
        command::assert_refused(&run(&arguments), cause);
    };
    let good = "{\"id\": 1, \"position_m\": [3, 1]}\n\n";
    refusal(&format!("{good}nobody\n"), "people.jsonl:3: ");
    refusal(
        &good.replace("1]}", "1], \"confidence\": 2}"),
        "confidence is 2: 0 to 1 is wanted",
    );
    std::fs::remove_file(&people).unwrap();
    let output = run(&["run", "--config", &robot, "--perceived", &people]);
    command::assert_refused(&output, "people.jsonl: No such file");
    let output = run_with(&["run", "--config", &robot], b"{\"id\": 1}\n");
    command::assert_refused(&output, "missing field `position_m`");
}

#[test]
fn a_demo_announces_the_people_of_a_file_while_it_coordinates() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (people, pcap) = (path("people.jsonl"), path("demo.pcap"));
    let lines = three_people(|at_s, id| {
        format!("{{\"at_s\": {at_s}, \"id\": {id}, \"position_m\": [{id}.0, 2.0]}}\n")
    });
    std::fs::write(&people, lines).unwrap();
    let port = two_free_ports().to_string();
    let demo = [
        "demo", "--json", "--speed", "20", "--port", &port, "--pcap", &pcap,
    ];
    let output = run(&[&demo[..], &["--perceived", &people, "--cluster-vam"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let packets = sniffed(&pcap);
    assert!(
        clusters(&packets, "RAM")
            .iter()
            .any(|it| it["cardinality"] == 3)
    );
    assert!(
        clusters(&packets, "VAM")
            .iter()
            .any(|it| it["cardinality"] == 3)
    );
    // Both robots see everybody; once they know of each other, the lower station id announces them.
    let settled = packets
        .iter()
        .filter(|it| it["kind"] == "VAM" && it["atS"].as_f64() > Some(1.5));
    let heads: Vec<_> = settled.map(|it| it["station"].as_u64()).collect();
    assert!(
        !heads.is_empty() && heads.iter().all(|head| *head == Some(1)),
        "{heads:?}"
    );
}
