//! What other encoders make of the messages of this kit, both ways: thousands of them are decoded and
//! encoded again by `judges/judge.py`, and messages that it makes of their parts by the kit.

use std::env;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::support::core::{Random, octets_of};
use crate::support::{flipped, from_hex, its_vectors, on, samples, to_hex};
use crossguard_codec::core::{Uper, ram::RAM, rmcm::RMCM};
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{Dictionary, Identifiers};

/// How many RAM and how many RMCM.
const MESSAGES: u64 = 2_000;

/// Any RAM and RMCM, each as type and octets.
fn of_robots() -> Vec<(&'static str, Vec<u8>)> {
    let identifiers = Identifiers::default();
    let [ram, rmcm] = [
        samples::typical_ram(&identifiers).header,
        samples::typical_rmcm(&identifiers).header,
    ];
    let messages = (0..MESSAGES).flat_map(|seed| {
        let random = &mut Random(seed);
        let ram = RAM {
            header: ram,
            ..Uper::arbitrary(random)
        };
        let rmcm = RMCM {
            header: rmcm,
            ..Uper::arbitrary(random)
        };
        [("RAM", octets_of(&ram)), ("RMCM", octets_of(&rmcm))]
    });
    messages.collect()
}

/// The golden vectors of other stations, and whatever they become by a flipped bit that is still a
/// message without additions.
fn of_others() -> Vec<(&'static str, Vec<u8>)> {
    let mut messages = Vec::new();
    for (name, identifiers, octets) in its_vectors() {
        let kind = match name.as_bytes() {
            // C4 is of release 2, which pycrate does not know.
            b"C4" => continue,
            [b'C', _] => "CAM",
            [b'P', _] => "CPM",
            [b'V', ..] => "VAM",
            [b'W', _] => "VAM211",
            _ => continue,
        };
        // Behind the header.
        for bit in 48..octets.len() * 8 {
            let flipped = flipped(&octets, bit);
            let decoded = ItsMessage::decode(&identifiers, &flipped);
            if decoded.is_ok_and(|it| it.is_canonical && it.extended == 0) {
                messages.push((kind, flipped));
            }
        }
        messages.push((kind, octets));
    }
    messages
}

#[test]
#[ignore = "needs asn1tools and pycrate: run codec/judges/run, which installs them"]
fn asn1tools_and_pycrate_agree_byte_for_byte() {
    let python = env::var("CROSSGUARD_JUDGE_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("judges/judge.py");
    let mut judge = Command::new(python)
        .arg(script)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let messages = [of_robots(), of_others()].concat();
    let mut input = judge.stdin.take().unwrap();
    for (kind, octets) in &messages {
        writeln!(input, "{kind} {}", to_hex(octets)).unwrap();
    }
    drop(input);
    let output = judge.wait_with_output().unwrap();
    assert!(output.status.success());
    let theirs = String::from_utf8(output.stdout).unwrap();
    let (mut count, mut refused) = (0, 0);
    for (kind, digits) in theirs.lines().filter_map(|line| line.split_once(' ')) {
        let dictionary = if kind == "VAM211" {
            Dictionary::V2_1_1
        } else {
            Dictionary::V2_4_1
        };
        let octets = from_hex(digits);
        match ItsMessage::decode(&on(dictionary), &octets) {
            Ok(received) => {
                let encoded = received.message.encode(&on(dictionary)).unwrap();
                assert_eq!(to_hex(&encoded), digits, "{kind}");
                count += 1;
            }
            // A rule of RAM that ASN.1 does not show, like the length of a path.
            Err(_) => refused += 1,
        }
    }
    println!("{count} messages of asn1tools come back, {refused} break a rule of the kit");
    assert_eq!(count + refused, messages.len());
    assert!(refused < count / 10, "{refused} of {count}");
}
