//! `crossguard sniff` on captures.

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

/// Output of `sniff` for a capture.
fn sniff(capture: &[u8], arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("capture");
    std::fs::write(&path, capture).unwrap();
    let path = path.display().to_string();
    let output = run(&[&["sniff", &path], arguments].concat());
    assert_code(&output, 0);
    stdout(&output)
}

#[test]
fn each_packet_has_its_kind_and_what_each_kind_costs_stands_at_the_end() {
    let frames = packets().map(|packet| in_ethernet(&packet));
    // A second each: CAM, SPATEM, another port; and again.
    let capture = pcap(&[&frames[..], &frames[..]].concat());
    let seen = records(&sniff(&capture, &["--json"]));
    let kinds: Vec<_> = seen.iter().map(|it| it["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["CAM", "SPATEM", "?", "CAM", "SPATEM", "?"]);
    let stations: Vec<_> = seen.iter().map(|it| it["station"].as_u64()).collect();
    let station = Some(STATION.into());
    assert_eq!(stations[..3], [station, station, None]);
    sniff(&capture, &[]).must_have(&["not read, ", ": 2\n", "load: SPATEM 0.4 packets/s"]);
    let nothing = sniff(&pcap(&[vec![0; 60]]), &[]);
    assert_eq!(nothing, "no GeoNetworking packet\n");
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
    let stdout = sniff(&pcap(&[in_ethernet(&packet)]), &["--json"]);
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
