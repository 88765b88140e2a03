//! `--pcap` and `crossguard sniff`, and what Wireshark makes of the files.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use crossguard_codec::{Identifiers, golden};
use crossguard_judge::sniffer::Sniffer;
use crossguard_robot::capture;
use crossguard_testkit::command::*;
use serde_json::Value;

/// A demonstration's packets.
fn capture(folder: &Path) -> PathBuf {
    let path = folder.join("demo.pcap");
    let port = two_free_ports().to_string();
    let file = path.to_str().unwrap();
    let output = run(&[
        "demo", "--speed", "10", "--port", &port, "--json", "--pcap", file,
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    path
}

/// What tshark prints; `None` where it is not installed.
fn tshark(arguments: &[&str]) -> Option<String> {
    let output = Command::new("tshark").args(arguments).output().ok()?;
    assert!(output.status.success(), "{}", stderr(&output));
    Some(stdout(&output))
}

fn skip(test: &str) {
    // Not by eprintln!, which the test runner would capture.
    let _ = writeln!(
        std::io::stderr(),
        "SKIPPED {test}: there is no tshark (Debian package tshark)"
    );
}

#[test]
fn every_packet_of_the_demo_can_be_read_from_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = capture(folder.path());
    let output = run(&["sniff", path.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let mut kinds = BTreeMap::new();
    for line in stdout(&output).lines() {
        let seen: Value = serde_json::from_str(line).unwrap();
        let key = (seen["kind"].to_string(), seen["station"].to_string());
        *kinds.entry(key).or_insert(0) += 1;
    }
    let all: Vec<_> = kinds.keys().map(|(a, b)| format!("{a} {b}")).collect();
    assert_eq!(all, ["\"RAM\" 1", "\"RAM\" 2", "\"RMCM\" 1", "\"RMCM\" 2"]);
    let lines = stdout(&run(&["sniff", path.to_str().unwrap()]));
    for expected in [
        "needHelp 1#",
        "offerHelp",
        "leader 1#",
        "around: robot station 2",
    ] {
        assert!(lines.contains(expected), "{expected} is not in:\n{lines}");
    }
    let few = stdout(&run(&[
        "sniff",
        path.to_str().unwrap(),
        "--count",
        "3",
        "--json",
    ]));
    assert_eq!(few.lines().count(), 3);
    wireshark_understands(&path, kinds.values().sum());
}

/// tshark takes every packet apart, with the kit's dissector down to the messages.
fn wireshark_understands(path: &Path, packets: usize) {
    let file = path.to_str().unwrap();
    let lua = format!(
        "lua_script:{}/../codec/wireshark/crossguard.lua",
        env!("CARGO_MANIFEST_DIR")
    );
    let fields = [
        "-r",
        file,
        "-X",
        &lua,
        "-T",
        "fields",
        "-E",
        "separator=;",
        "-E",
        "occurrence=f",
        "-e",
        "frame.protocols",
        "-e",
        "crossguard.kind",
        "-e",
        "crossguard.stationId",
        "-e",
        "crossguard.helpStatus",
    ];
    let Some(text) = tshark(&fields) else {
        return skip("every_packet_of_the_demo_can_be_read_from_its_file");
    };
    assert_eq!(text.lines().count(), packets);
    for line in text.lines() {
        let columns: Vec<_> = line.split(';').collect();
        assert_eq!(columns[0], "eth:ethertype:gnw:btpb:crossguard", "{line}");
        assert!(matches!(columns[1], "RAM" | "RMCM"), "{line}");
        assert!(matches!(columns[2], "1" | "2"), "{line}");
    }
    for status in ["needHelp", "offerHelp", "roleConfirmed", "none"] {
        assert!(text.lines().any(|line| line.ends_with(status)), "{status}");
    }
    let malformed = [
        "-r",
        file,
        "-X",
        &lua,
        "-Y",
        "_ws.malformed || _ws.lua.error",
    ];
    assert_eq!(tshark(&malformed).unwrap(), "");
}

#[test]
fn a_denm_is_a_line_that_names_its_cause_and_place() {
    let packet = hex::decode(golden::vector(golden::PACKETS, "G2")).unwrap();
    let seen = Sniffer::new(Identifiers::default()).see(&packet, 5_000, 694_694_401_000);
    assert_eq!(
        seen.to_string(),
        "    0.000  DENM  123456789   111 B  collisionRisk (vulnerableRoadUser), \
         48.765432 9.123457, event 1 of station 123456789, for 600 s, geo-broadcast"
    );
    let json = serde_json::to_value(&seen).unwrap();
    assert_eq!(json["event"]["cause"]["name"], "collisionRisk");
    assert_eq!(json["event"]["number"], 1);
}

#[test]
fn what_cannot_be_read_or_written_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let none = folder.path().join("none.pcap");
    let missing = format!("no such file: {}", none.display());
    assert_refused(&run(&["sniff", none.to_str().unwrap()]), &missing);
    std::fs::write(&none, b"this is a text, and longer than a header of pcap").unwrap();
    assert_refused(&run(&["sniff", none.to_str().unwrap()]), "none.pcap");
    assert_refused(&run(&["sniff"]), "nothing to listen to");
    let nowhere = folder.path().join("no/such/folder.pcap");
    let demo = run(&["demo", "--pcap", nowhere.to_str().unwrap()]);
    assert_refused(&demo, "folder.pcap");
}

/// What `sniff --json` says of a capture.
fn sniffed(path: &str, arguments: &[&str]) -> Vec<Value> {
    let output = run(&[&["sniff", "--json", path], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = stdout(&output);
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    lines.collect()
}

/// A demonstration's packets, signed with tickets of a PKI in `folder/pki`, with CAM and cluster VAM.
fn signed_capture(folder: &Path) -> [String; 2] {
    let path = |name: &str| folder.join(name).display().to_string();
    let (pki, pcap, people) = (path("pki"), path("signed.pcap"), path("people.jsonl"));
    let init = ["pki", "init", &pki, "--robot", "ARI", "--robot", "Go2"];
    let output = run(&init);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let lines = (0..30).map(|tenth| {
        let at_s = f64::from(tenth) / 10.0;
        format!("{{\"at_s\": {at_s}, \"id\": 1, \"position_m\": [3.0, 2.0]}}\n")
    });
    std::fs::write(&people, lines.collect::<String>()).unwrap();
    let port = two_free_ports().to_string();
    let demo = ["demo", "--speed", "20", "--quiet", "--port", &port];
    let signs = ["--security", "enforce", "--pki", &pki];
    let others = [
        "--cam",
        "--cluster-vam",
        "--perceived",
        &people,
        "--pcap",
        &pcap,
    ];
    let output = run(&[&demo[..], &signs, &others].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    [pki, pcap]
}

#[test]
fn signed_packets_are_shown_and_verified_where_roots_are_given() {
    let folder = tempfile::tempdir().unwrap();
    let [pki, pcap] = signed_capture(folder.path());
    let seen = sniffed(&pcap, &[]);
    for kind in ["RAM", "RMCM", "CAM", "VAM"] {
        assert!(seen.iter().any(|it| it["kind"] == kind), "{kind}");
    }
    for it in &seen {
        let signature = &it["signature"];
        assert_eq!(
            (&it["isSigned"], &signature["isVerified"]),
            (&true.into(), &false.into())
        );
        assert_eq!(signature["whyNot"], "no roots were given");
    }
    for it in sniffed(&pcap, &["--trust", &pki]) {
        assert_eq!(it["signature"]["isVerified"], true, "{it}");
    }
    // Those of another PKI are not.
    let other = folder.path().join("other").display().to_string();
    let output = run(&["pki", "init", &other, "--robot", "ARI"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    for it in sniffed(&pcap, &["--trust", &other]) {
        assert_eq!(it["signature"]["isVerified"], false, "{it}");
    }
    let nothing = folder.path().display().to_string();
    let refused = run(&["sniff", &pcap, "--trust", &nothing]);
    assert_refused(&refused, "there is no root certificate in it");

    // One packet, which has its certificate.
    let first = capture::read(Path::new(&pcap)).unwrap().next().unwrap();
    let digits = hex::encode(first.unwrap().packet);
    let decode = ["codec", "decode", "--hex", &digits];
    let decoded = run(&[&decode[..], &["--trust", &pki]].concat());
    let value = json(&decoded);
    assert_eq!(value["signature"]["isVerified"], true, "{value}");
    assert!(value["packet"].is_object() && value["message"].is_object());
    let encoded = run_with(&["codec", "encode"], &decoded.stdout);
    assert_refused(&encoded, "nobody here has the key");

    wireshark_shows_signed(&pcap, &seen);
}

/// tshark takes every signed RAM and RMCM apart by the dissector, which says that nothing is verified.
fn wireshark_shows_signed(pcap: &str, seen: &[Value]) {
    let lua = format!(
        "lua_script:{}/../codec/wireshark/crossguard.lua",
        env!("CARGO_MANIFEST_DIR")
    );
    let shown = ["frame.protocols", "crossguard.kind", "crossguard.signature"];
    let shown = shown.into_iter().flat_map(|field| ["-e", field]);
    let read = ["-r", pcap, "-X", &lua];
    let fields = ["-T", "fields", "-E", "separator=;"];
    let arguments: Vec<_> = read.into_iter().chain(fields).chain(shown).collect();
    let Some(text) = tshark(&arguments) else {
        return skip("signed_packets_are_shown_and_verified_where_roots_are_given");
    };
    for (line, packet) in text.lines().zip(seen) {
        let kind = packet["kind"].as_str().unwrap();
        let stack = "eth:ethertype:gnw:ieee1609dot2:btpb";
        if matches!(kind, "RAM" | "RMCM") {
            assert_eq!(line, format!("{stack}:crossguard;{kind};not verified"));
        } else {
            assert!(line.starts_with(stack), "{kind}: {line}");
        }
    }
    assert_eq!(text.lines().count(), seen.len());
    let wrong = ["-Y", "_ws.malformed || _ws.lua.error || crossguard.broken"];
    let arguments: Vec<_> = read.into_iter().chain(wrong).collect();
    assert_eq!(tshark(&arguments).unwrap(), "");
}

#[test]
fn identifiers_of_a_channel_are_taken_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let text = std::fs::read_to_string(&config).unwrap();
    let ram = "\n[identifiers]\nram = { protocol_version = 1, message_id = 230, btp_port = 3100, its_aid = 16500 }\n";
    std::fs::write(&config, text + ram).unwrap();
    let pcap = folder.path().join("ari.pcap").display().to_string();
    let output = run_with(
        &["run", "--config", &config, "--pcap", &pcap],
        b"wait 1.2\nquit\n",
    );
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let kinds = |arguments: &[&str]| sniffed(&pcap, arguments)[0]["kind"].clone();
    assert_eq!(kinds(&[]), "?");
    assert_eq!(kinds(&["--config", &config]), "RAM");
    let wrong = folder.path().join("wrong.toml");
    std::fs::write(&wrong, "[identifiers]\nram = 3\n").unwrap();
    let refused = run(&["sniff", &pcap, "--config", wrong.to_str().unwrap()]);
    assert_refused(&refused, "wrong.toml");
}

#[test]
fn altitude_and_ellipse_of_a_station_are_kept() {
    let packet = hex::decode(golden::vector(golden::PACKETS, "G1")).unwrap();
    let seen = Sniffer::new(Identifiers::default()).see(&packet, 5_000, 694_694_401_000);
    let position = seen.road_users[0].position;
    assert_eq!(position.altitude, Some(260.0));
    let ellipse = position.ellipse.unwrap();
    let axes = [ellipse.semi_major, ellipse.semi_minor, ellipse.orientation];
    assert_eq!(axes.map(|it| it.to_string()), ["1", "0.5", "90"]);
    let json = serde_json::to_value(&seen).unwrap();
    assert!(
        json["roadUsers"][0]["position"]["ellipse"].is_object(),
        "{json}"
    );
}
