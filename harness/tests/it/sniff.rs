//! `crossguard sniff` on captures, and what it leaves out when it is asked to.

use std::collections::BTreeMap;

use crossguard_codec::golden;
use crossguard_testkit::command::*;
use serde_json::{Value, json};

/// The station of the golden vectors.
const STATION: u32 = 123_456_789;

/// A CAM of a car, a packet whose port says SPATEM, and one of no service.
fn packets() -> [Vec<u8>; 3] {
    let cam = hex::decode(golden::vector(golden::PACKETS, "G1")).unwrap();
    [2_001_u16, 2_004, 9].map(|port| {
        let mut packet = cam.clone();
        packet[40..42].copy_from_slice(&port.to_be_bytes());
        if port == 9 {
            // A messageId that nobody has.
            packet[45] = 99;
        }
        packet
    })
}

fn in_ethernet(packet: &[u8]) -> Vec<u8> {
    [&[2; 12][..], &[0x89, 0x47], packet].concat()
}

/// A capture of Ethernet in pcap, each frame a second after the one before.
fn pcap(frames: &[Vec<u8>]) -> Vec<u8> {
    let mut file: Vec<u8> = [0xa1b2_c3d4_u32, 0x0004_0002, 0, 0, 65_535, 1]
        .iter()
        .flat_map(|it| it.to_le_bytes())
        .collect();
    for (second, frame) in (1_767_609_596..).zip(frames) {
        let length = u32::try_from(frame.len()).unwrap();
        for it in [second, 0, length, length] {
            file.extend(it.to_le_bytes());
        }
        file.extend(frame);
    }
    file
}

/// What `sniff` prints of a capture, and its exit code.
fn sniff(capture: &[u8], arguments: &[&str]) -> (String, String, Option<i32>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("capture");
    std::fs::write(&path, capture).unwrap();
    let path = path.display().to_string();
    let output = run(&[&["sniff", &path], arguments].concat());
    let text = |octets: &[u8]| String::from_utf8_lossy(octets).into_owned();
    (
        text(&output.stdout),
        text(&output.stderr),
        output.status.code(),
    )
}

/// How many packets have which kind.
fn kinds(stdout: &str) -> BTreeMap<String, usize> {
    let mut kinds = BTreeMap::new();
    for packet in records(stdout) {
        let kind = packet["kind"].as_str().unwrap().to_owned();
        *kinds.entry(kind).or_default() += 1;
    }
    kinds
}

/// Arguments, and how many packets of which kind are told then.
type Row<'a> = (&'a [&'a str], &'a [(&'a str, usize)]);

#[test]
fn only_what_is_asked_for_is_told_and_counted() {
    let frames = packets().map(|packet| in_ethernet(&packet));
    // A second each: CAM, SPATEM, another port; and again.
    let capture = pcap(&[&frames[..], &frames[..]].concat());
    let station = STATION.to_string();
    let table: [Row<'_>; 9] = [
        (&[], &[("?", 2), ("CAM", 2), ("SPATEM", 2)]),
        (&["--kind", "spatem"], &[("SPATEM", 2)]),
        (&["--kind", "CAM", "--kind", "?"], &[("?", 2), ("CAM", 2)]),
        (&["--station", &station], &[("CAM", 2), ("SPATEM", 2)]),
        (&["--station", "7"], &[]),
        (&["--from", "2"], &[("?", 2), ("CAM", 1), ("SPATEM", 1)]),
        (&["--seconds", "1"], &[("CAM", 1), ("SPATEM", 1)]),
        (&["--from", "3", "--seconds", "3.5"], &[("CAM", 1)]),
        (&["--kind", "CAM", "--count", "1"], &[("CAM", 1)]),
    ];
    for (arguments, expected) in table {
        let (stdout, stderr, code) = sniff(&capture, &[arguments, &["--json"]].concat());
        assert_eq!((code, &*stderr), (Some(0), ""), "{arguments:?}");
        let expected = expected
            .iter()
            .map(|(kind, count)| ((*kind).to_owned(), *count));
        assert_eq!(kinds(&stdout), expected.collect(), "{arguments:?}");
    }
    let (told, ..) = sniff(&capture, &[]);
    told.must_have(&[
        "station 123456789: 2 CAM, 2 SPATEM\n",
        "load: SPATEM 0.4 packets/s",
    ]);
    let (told, ..) = sniff(&capture, &["--station", "7"]);
    assert_eq!(
        told.lines().next(),
        Some("no packet is of that kind, station and time")
    );
    assert!(!told.contains("around"), "{told}");
    let (_, refused, code) = sniff(&capture, &["--kind", "BSM"]);
    assert_eq!(code, Some(2));
    refused.must_have(&["invalid value 'BSM'", "SPATEM", "IVIM"]);
}

/// The message is what `codec decode` prints of it.
#[test]
fn json_has_the_whole_message() {
    let [cam, ..] = packets();
    let (stdout, ..) = sniff(&pcap(&[in_ethernet(&cam)]), &["--json"]);
    let seen = records(&stdout).remove(0);
    let decoded = json(&run(&["codec", "decode", "--hex", &hex::encode(&cam)]));
    assert_eq!(seen["message"], decoded["message"]);
    let parameters = &seen["message"]["cam"]["cam"]["camParameters"];
    assert_eq!(parameters["basicContainer"]["stationType"], 5, "{seen}");
}

#[test]
fn messages_of_release_1_are_read() {
    // As in `codec/tests/it/release1.rs`: an emergency vehicle, whose own container is left out.
    let car = "0102075bcd1503e8605a56bd962e173e60e0c80a0709b7743e00384122b68902908a83334bc75fffb00000b01f3bf82f8e70006380fa1fc17c73800315f5f018";
    let message = hex::decode(car).unwrap();
    let mut packet = packets()[0].clone();
    packet.truncate(packet.len() - 59);
    packet[8..10].copy_from_slice(&u16::try_from(4 + message.len()).unwrap().to_be_bytes());
    packet.extend(message);
    let (stdout, ..) = sniff(&pcap(&[in_ethernet(&packet)]), &["--json"]);
    let seen = records(&stdout).remove(0);
    assert_eq!(
        (&seen["kind"], &seen["station"]),
        (&json!("CAM"), &json!(STATION))
    );
    let header: &Value = &seen["message"]["cam"]["header"];
    assert_eq!(header["protocolVersion"], 1, "{seen}");
    assert_eq!(seen["roadUsers"][0]["speed"], 13.89, "{seen}");
    assert_eq!(
        seen["text"],
        "vehicle, 48.765432 9.123457, 13.89 m/s to 90°, and parts that are not read"
    );
}
