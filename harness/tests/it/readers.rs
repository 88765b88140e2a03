//! One run with all that a demonstration can send and write, and what every reader says of it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crossguard_codec::{Identifiers, Service, golden};
use crossguard_judge::sniffer::Sniffer;
use crossguard_judge::validate;
use crossguard_protocol::{Event, Output};
use crossguard_robot::capture::{self, Capture};
use crossguard_robot::trace;
use crossguard_testkit::command::*;
use serde_json::{Value, json};
use tempfile::TempDir;

/// A crossing with signed packets, CAM, and three people that both robots see and announce in cluster VAM.
struct Run {
    folder: TempDir,
    result: Value,
}

impl Run {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut made = Self {
            folder,
            result: Value::Null,
        };
        let pki = made.path("pki");
        run_well(&format!("pki init {pki} --robot ARI=1 --robot Go2=2"));
        let people = (0..120).map(|n| {
            let (at_s, id) = (f64::from(n / 3) / 10.0, n % 3 + 1);
            format!("{{\"at_s\": {at_s}, \"id\": {id}, \"position_m\": [{id}.0, 2.0]}}\n")
        });
        std::fs::write(made.path("perceived"), people.collect::<String>()).unwrap();
        let sends = "--security enforce --cam --cluster-vam";
        let demo = format!("demo --speed 10 --json --port {} {sends}", two_free_ports());
        let files = ["pki", "perceived", "pcap", "log", "report"];
        let files = files.map(|name| format!("--{name} {}", made.path(name)));
        let output = run_well(&format!("{demo} {}", files.join(" ")));
        made.result = json(&output);
        made
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    fn log(&self) -> Vec<Value> {
        records(&std::fs::read_to_string(self.path("log")).unwrap())
    }

    /// Output of `sniff --json` for the packets, with more arguments.
    fn sniffed(&self, arguments: &str) -> Vec<Value> {
        sniffed(&self.path("pcap"), arguments)
    }
}

fn sniffed(pcap: &str, arguments: &str) -> Vec<Value> {
    records(&stdout(&run_well(&format!(
        "sniff --json {pcap} {arguments}"
    ))))
}

#[test]
fn every_reader_says_the_same_of_one_run() {
    let run = Run::new();
    the_log_has_every_step(&run);
    all_names_are_in_camel_case(&run);
    let seen = run.sniffed("");
    a_sniffer_sees_both_robots(&run, &seen);
    signatures_are_verified_where_roots_are_given(&run, &seen);
    people_are_announced_by_one_robot(&seen);
    a_packet_is_decoded_and_a_message_comes_back(&run);
    wireshark_takes_all_apart(&run, &seen);
    let page = std::fs::read_to_string(run.path("report")).unwrap();
    assert!(page.contains("</html>"));
}

fn the_log_has_every_step(of: &Run) {
    assert_eq!(of.result["traceValid"], true, "{}", of.result);
    let log = trace::open(Path::new(&of.path("log"))).unwrap();
    let validated = validate::all(vec![log]).unwrap();
    let records = of.log();
    let count = |entry: &str| records.iter().filter(|it| it["entry"] == entry).count();
    assert_eq!(count("step"), validated.steps);
    assert_eq!(of.result["trace"]["steps"], validated.steps);
    assert_eq!((count("started"), count("stopped")), (2, 2));
    // Nothing was refused for want of a permission, neither by the sender nor by the other robot.
    let drops = records.iter().filter(|it| it["entry"] == "dropped");
    assert_eq!(drops.filter(|it| it["layer"] == "security").count(), 0);
}

/// In the log, in what everything can be told and say, and in the figures of a run; robots and causes are no names.
fn all_names_are_in_camel_case(of: &Run) {
    let mut values = of.log();
    values.extend(Event::SAMPLES.iter().map(|it| json!(it)));
    values.extend(Output::SAMPLES.iter().map(|it| json!(it)));
    values.push(of.result.clone());
    let others = values.iter().flat_map(others_than_camel_case);
    assert_eq!(others.collect::<BTreeSet<_>>(), BTreeSet::new());
}

fn others_than_camel_case(value: &Value) -> Vec<String> {
    let is_name = |name: &str| {
        name.starts_with(|it: char| it.is_ascii_lowercase())
            && name.chars().all(|it| it.is_ascii_alphanumeric())
    };
    match value {
        Value::Object(fields) => fields
            .iter()
            .filter(|(name, _)| !["counters", "finalStates"].contains(&name.as_str()))
            .flat_map(|(name, held)| {
                let own = (!is_name(name)).then(|| name.clone());
                own.into_iter().chain(others_than_camel_case(held))
            })
            .collect(),
        Value::Array(items) => items.iter().flat_map(others_than_camel_case).collect(),
        _ => Vec::new(),
    }
}

fn a_sniffer_sees_both_robots(of: &Run, seen: &[Value]) {
    for kind in ["RAM", "RMCM", "CAM"] {
        for station in [1, 2] {
            let is_it = |it: &Value| it["kind"] == kind && it["station"] == station;
            assert!(seen.iter().any(is_it), "{kind} {station}: {seen:?}");
        }
    }
    let lines = stdout(&run(&["sniff", &of.path("pcap")]));
    lines.must_have(&[
        "needHelp, 1#",
        "offerHelp",
        "leader of station 2, 1#",
        "load: RAM ",
    ]);
}

fn signatures_are_verified_where_roots_are_given(of: &Run, seen: &[Value]) {
    for it in seen {
        assert_eq!(it["isSigned"], true, "{it}");
        assert_eq!(it["signature"]["whyNot"], "no roots were given", "{it}");
    }
    let other = of.path("other");
    assert!(run(&["pki", "init", &other]).status.success());
    for (roots, is_verified) in [(&of.path("pki"), true), (&other, false)] {
        for it in of.sniffed(&format!("--trust {roots}")) {
            assert_eq!(it["signature"]["isVerified"], is_verified, "{it}");
        }
    }
    // The times in a capture are those of several threads.
    let disordered = of.path("disordered");
    let copy = Capture::create(Path::new(&disordered)).unwrap();
    let captured = capture::read(Path::new(&of.path("pcap"))).unwrap();
    for (n, it) in captured.enumerate() {
        let captured = it.unwrap();
        let early = Duration::from_millis(if n % 2 == 1 { 20 } else { 0 });
        let at = captured.at.checked_sub(early).unwrap();
        copy.record_at(at, &captured.packet);
    }
    copy.finish().unwrap();
    for it in sniffed(&disordered, &format!("--trust {}", of.path("pki"))) {
        assert_eq!(it["signature"]["isVerified"], true, "{it}");
    }
}

/// Both robots see everybody; once they know of each other, the lower station id announces them.
fn people_are_announced_by_one_robot(seen: &[Value]) {
    for kind in ["RAM", "VAM"] {
        let of_kind = seen.iter().filter(|it| it["kind"] == kind);
        let mut users = of_kind.flat_map(|it| it["roadUsers"].as_array().into_iter().flatten());
        assert!(users.any(|it| it["cardinality"] == 3), "{kind}");
    }
    let vams = seen.iter().filter(|it| it["kind"] == "VAM");
    let heads: Vec<_> = vams.map(|it| it["station"].as_u64()).collect();
    let settled = heads.iter().rev().take_while(|it| **it == Some(1));
    assert!(settled.count() >= 3, "{heads:?}");
}

fn a_packet_is_decoded_and_a_message_comes_back(of: &Run) {
    let decode = |digits: &str, more: &[&str]| {
        let decode = ["codec", "decode", "--hex", digits];
        run(&[&decode, more].concat())
    };
    // The first packet has its certificate.
    let first = capture::read(Path::new(&of.path("pcap"))).unwrap().next();
    let digits = hex::encode(first.unwrap().unwrap().packet);
    let decoded = decode(&digits, &["--trust", &of.path("pki")]);
    let value = json(&decoded);
    assert_eq!(value["signature"]["isVerified"], true, "{value}");
    assert!(value["packet"].is_object() && value["message"].is_object());
    let encoded = run_with(&["codec", "encode"], &decoded.stdout);
    assert_refused(&encoded, "nobody here has the key");

    let log = of.log();
    let sent = log.iter().find(|it| it["message"] == "RMCM").unwrap();
    let digits = sent["octets"].as_str().unwrap();
    let decoded = decode(digits, &[]);
    assert_eq!(json(&decoded)["octets"], digits.len() / 2);
    let encoded = run_with(&["codec", "encode"], &decoded.stdout);
    assert_eq!(stdout(&encoded).trim(), digits);
    // The same through octets.
    let octets = run_with(&["codec", "encode", "--binary"], &decoded.stdout).stdout;
    let again = run_with(&["codec", "decode", "--binary"], &octets);
    assert_eq!(again.stdout, decoded.stdout);
    let refused = |digits: &str, cause| assert_refused(&decode(digits, &[]), cause);
    let end = digits.len() - 8;
    refused(&digits[..end], "the message ends within it");
    let more = "1 octets follow the end of the message";
    refused(&format!("{digits}00"), more);
    let version = "protocolVersion 9 of RMCM is unknown, 1 is known";
    refused(&format!("09{}", &digits[2..]), version);
}

/// Output of tshark for these fields with the kit's dissector, line by line; `None` where it is not installed.
fn tshark(pcap: &str, filter: &str, fields: &[&str]) -> Option<Vec<String>> {
    let lua = concat!(
        "lua_script:",
        env!("CARGO_MANIFEST_DIR"),
        "/../codec/wireshark/crossguard.lua"
    );
    let mut tshark = Command::new("tshark");
    tshark.args(["-r", pcap, "-X", lua, "-Y", filter]);
    tshark.args(["-T", "fields", "-E", "separator=;", "-E", "occurrence=f"]);
    for field in fields {
        tshark.args(["-e", field]);
    }
    let Ok(output) = tshark.output() else {
        skipped("tshark is not installed (Debian package tshark)");
        return None;
    };
    assert_code(&output, 0);
    Some(stdout(&output).lines().map(str::to_owned).collect())
}

/// tshark takes every signed RAM and RMCM apart by the dissector, which says that nothing is verified.
fn wireshark_takes_all_apart(of: &Run, seen: &[Value]) {
    let fields = [
        "frame.protocols",
        "crossguard.kind",
        "crossguard.signature",
        "crossguard.helpStatus",
    ];
    let pcap = of.path("pcap");
    let Some(lines) = tshark(&pcap, "frame", &fields) else {
        return;
    };
    assert_eq!(lines.len(), seen.len());
    for (line, packet) in lines.iter().zip(seen) {
        let kind = packet["kind"].as_str().unwrap();
        let stack = "eth:ethertype:gnw:ieee1609dot2:btpb";
        let is_ours = matches!(kind, "RAM" | "RMCM");
        let ours = format!("{stack}:crossguard;{kind};not verified");
        let begin = if is_ours { &ours } else { stack };
        assert!(line.starts_with(begin), "{kind}: {line}");
    }
    for status in ["needHelp", "offerHelp", "roleConfirmed", "none"] {
        assert!(lines.iter().any(|line| line.ends_with(status)), "{status}");
    }
    let wrong = "_ws.malformed || _ws.lua.error || crossguard.broken";
    assert_eq!(tshark(&pcap, wrong, &["frame.number"]).unwrap(), [""; 0]);
}

/// A robot that is alone for 3.3 s, with CAM and without; with identifiers of its own.
#[test]
fn a_station_that_does_not_know_ram_sees_a_robot_that_sends_cam() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let identifiers = "[identifiers]\nram = { protocol_version = 1, message_id = 230, btp_port = 3100, its_aid = 16500 }\n\n[link]";
    edit(
        &config,
        &[("autopilot = true", "cam = true"), ("[link]", identifiers)],
    );
    let (pcap, log) = (path("pcap"), path("log"));
    let arguments = ["run", "--config", &config, "--pcap", &pcap, "--log", &log];
    let output = run_with(&arguments, b"wait 3.3\nquit\n");
    assert_code(&output, 0);
    let count = |seen: &[Value]| {
        let mut kinds = BTreeMap::new();
        for packet in seen {
            let kind = packet["kind"].as_str().unwrap().to_owned();
            *kinds.entry(kind).or_insert(0) += 1;
        }
        kinds
    };
    // A robot that stands still sends one a second. Its RAM are known by stations that have its identifiers.
    let strangers = count(&sniffed(&pcap, ""));
    let friends = count(&sniffed(&pcap, &format!("--config {config}")));
    assert!((3..=5).contains(&strangers["CAM"]), "{strangers:?}");
    let unknown = strangers["?"];
    assert!(
        unknown >= 3 && unknown == friends["RAM"],
        "{strangers:?} {friends:?}"
    );
    let seen = sniffed(&pcap, &format!("--config {config}"));
    let north_m = |kind: &str| {
        let packet = seen.iter().find(|it| it["kind"] == kind).unwrap();
        let position = &packet["roadUsers"][0]["position"];
        position["latitude"].as_f64().unwrap() * 111_000.0
    };
    assert!((north_m("CAM") - north_m("RAM")).abs() < 0.5);
    let records = records(&std::fs::read_to_string(&log).unwrap());
    let sent = records.iter().filter(|it| it["message"] == "CAM");
    let triggers: Vec<_> = sent.map(|it| it["trigger"].as_str().unwrap()).collect();
    assert_eq!(triggers[..2], ["first", "interval"]);
    // Wireshark's own dissector of CAM, from ETSI's module of release 1: a light vehicle of 0.6 m x 0.8 m, with the slow
    // container every time since they are a second apart.
    let fields = [
        "its.stationID",
        "its.messageID",
        "cam.stationType",
        "its.vehicleLengthValue",
        "cam.vehicleWidth",
        "cam.vehicleRole",
        "its.speedValue",
    ];
    if let Some(lines) = tshark(&pcap, "btpb.dstport == 2001", &fields) {
        assert_eq!(lines, vec!["1;2;12;6;8;0;0"; strangers["CAM"]]);
    }
}

#[test]
fn a_packet_that_is_not_decoded_has_the_name_of_its_message_or_a_reason() {
    let packet = hex::decode(golden::vector(golden::PACKETS, "G2")).unwrap();
    let mut sniffer = Sniffer::new(Identifiers::default());
    let mut see = |at: usize, octets: &[u8]| {
        let mut changed = packet.clone();
        changed[at..at + octets.len()].copy_from_slice(octets);
        sniffer.see(&changed, 5_000, 694_694_401_000)
    };
    assert_eq!(packet[56..58], 2_002_u16.to_be_bytes(), "the BTP port");
    for (port, name) in Service::FOREIGN {
        let seen = see(56, &port.to_be_bytes());
        assert_eq!((seen.kind, seen.station), (name, Some(123_456_789)));
    }
    let seen = see(0, &[0x01]);
    let why = "GeoNetworking of version 0: version 1 is read";
    assert_eq!((seen.kind, &*seen.text), ("?", why));
    // An envelope of signed data, whose hash is none that is known.
    let seen = see(0, &[0x12, 0, 0x50, 1, 3, 0x81, 1]);
    assert!(seen.is_signed, "{seen:?}");
    seen.text.must_have(&["a hash other than SHA-256"]);
    assert_eq!(sniffer.counters().iter().count(), 2);
}
