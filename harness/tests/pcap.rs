//! `--pcap` and `crossguard sniff`, and what Wireshark makes of the files.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use crossguard_codec::{Identifiers, golden};
use crossguard_judge::sniffer::Sniffer;
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
    assert_refused(&run(&["sniff", none.to_str().unwrap()]), "none.pcap");
    std::fs::write(&none, b"this is a text, and longer than a header of pcap").unwrap();
    assert_refused(&run(&["sniff", none.to_str().unwrap()]), "none.pcap");
    assert_refused(&run(&["sniff"]), "nothing to listen to");
    let nowhere = folder.path().join("no/such/folder.pcap");
    let demo = run(&["demo", "--pcap", nowhere.to_str().unwrap()]);
    assert_refused(&demo, "folder.pcap");
}
