//! CAM beside RAM: stations that do not know RAM see the robot, and robots know it as one of theirs.

use std::path::Path;
use std::process::Command;

use crossguard_testkit::command::{
    self, records, robot_file, run, run_with, stderr, stdout, two_free_ports,
};
use serde_json::Value;

/// A robot of `robot_file`, at the origin of its site, that listens to nobody.
fn lonely_robot(folder: &Path) -> String {
    let port = two_free_ports();
    let config = robot_file(folder, "ARI", 1, port, port + 1);
    command::edit(&config, &[("autopilot = true\n", "")]);
    config
}

/// What `crossguard sniff` reads in a capture.
fn sniffed(pcap: &str) -> Vec<Value> {
    let output = run(&["sniff", "--json", pcap]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    lines.collect()
}

fn of_kind<'a>(packets: &'a [Value], kind: &str) -> Vec<&'a Value> {
    packets.iter().filter(|it| it["kind"] == kind).collect()
}

/// Runs a robot for 3.3 s; the file of its packets.
fn captured(folder: &Path, config: &str, arguments: &[&str]) -> String {
    let path = |name: &str| folder.join(name).display().to_string();
    let (pcap, log) = (path("ari.pcap"), path("ari.jsonl"));
    let files = ["run", "--config", config, "--pcap", &pcap, "--log", &log];
    let output = run_with(&[&files[..], arguments].concat(), b"wait 3.3\nquit\n");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let validated = run(&["validate", &log]);
    assert_eq!(validated.status.code(), Some(0), "{}", stderr(&validated));
    pcap
}

#[test]
fn a_station_that_does_not_know_ram_sees_the_robot() {
    let folder = tempfile::tempdir().unwrap();
    let config = lonely_robot(folder.path());
    let pcap = captured(folder.path(), &config, &["--cam"]);
    let packets = sniffed(&pcap);
    let (cam, ram) = (of_kind(&packets, "CAM"), of_kind(&packets, "RAM"));
    // Who stands still sends one a second.
    assert!((3..=5).contains(&cam.len()), "{packets:?}");
    assert!(ram.len() >= cam.len());
    let at = |packet: &Value| packet["roadUsers"][0]["position"].clone();
    for packet in &cam {
        assert_eq!(packet["station"], 1);
        let north_m = |it: &Value| it["latitude"].as_f64().unwrap() * 111_000.0;
        assert!((north_m(&at(packet)) - north_m(&at(ram[0]))).abs() < 0.5);
    }
    let log = std::fs::read_to_string(folder.path().join("ari.jsonl")).unwrap();
    let records = records(&log);
    let sent = records.iter().filter(|it| it["message"] == "CAM");
    let triggers: Vec<_> = sent.map(|it| it["trigger"].as_str().unwrap()).collect();
    assert_eq!(triggers.len(), cam.len());
    assert_eq!(triggers[..2], ["first", "interval"]);
    wireshark_decodes(&pcap, cam.len());
}

/// Wireshark's own dissector of CAM, from ETSI's module of release 1, has the robot in every packet at the
/// port of CAM: a light vehicle of 0.6 m x 0.8 m, with the slow container every time since they are a second
/// apart.
fn wireshark_decodes(pcap: &str, count: usize) {
    let fields = [
        "its.stationID",
        "its.messageID",
        "cam.stationType",
        "its.vehicleLengthValue",
        "cam.vehicleWidth",
        "cam.vehicleRole",
        "its.speedValue",
    ];
    let fields = fields.into_iter().flat_map(|field| ["-e", field]);
    let mut tshark = Command::new("tshark");
    tshark.args(["-r", pcap, "-Y", "btpb.dstport == 2001", "-T", "fields"]);
    let Ok(output) = tshark.args(["-E", "separator=;"]).args(fields).output() else {
        println!("SKIPPED wireshark_decodes: there is no tshark (Debian package tshark)");
        return;
    };
    let text = stdout(&output);
    assert_eq!(text.lines().count(), count, "{text}{}", stderr(&output));
    for line in text.lines() {
        assert_eq!(line, "1;2;12;6;8;0;0");
    }
}

#[test]
fn a_robot_file_can_ask_for_cam_and_without_there_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let config = lonely_robot(folder.path());
    let packets = sniffed(&captured(folder.path(), &config, &[]));
    assert!(of_kind(&packets, "CAM").is_empty());
    command::edit(&config, &[("speed = 40.0", "speed = 40.0\ncam = true")]);
    let packets = sniffed(&captured(folder.path(), &config, &[]));
    assert!(of_kind(&packets, "CAM").len() >= 3);
}

#[test]
fn robots_that_sign_may_send_cam_and_cluster_vam() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (people, pcap, log) = (path("people.jsonl"), path("demo.pcap"), path("demo.jsonl"));
    let lines = (0..30).map(|tenth| {
        let at_s = f64::from(tenth) / 10.0;
        format!("{{\"at_s\": {at_s}, \"id\": 1, \"position_m\": [3.0, 2.0]}}\n")
    });
    std::fs::write(&people, lines.collect::<String>()).unwrap();
    let port = two_free_ports().to_string();
    let demo = ["demo", "--quiet", "--speed", "20", "--port", &port];
    let others = ["--cam", "--cluster-vam", "--security", "enforce"];
    let files = ["--perceived", &people, "--pcap", &pcap, "--log", &log];
    let output = run(&[&demo[..], &others, &files].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let packets = sniffed(&pcap);
    for kind in ["CAM", "VAM"] {
        let sent = of_kind(&packets, kind);
        assert!(!sent.is_empty(), "{kind}");
        assert!(sent.iter().all(|it| it["isSigned"] == true), "{kind}");
    }
    // Nothing was refused for want of a permission, neither by the sender nor by the other robot.
    let log = std::fs::read_to_string(&log).unwrap();
    let drops: Vec<_> = records(&log)
        .into_iter()
        .filter(|it| it["entry"] == "dropped")
        .collect();
    assert!(drops.is_empty(), "{drops:?}");
}
