//! The golden vectors of RAM and RMCM: the wire format does not change by accident.
//!
//! asn1c, asn1tools and pycrate have compiled the modules and made the same octets of them. After a
//! deliberate change, `cargo xtask bless messages.json` writes the file.

use std::path::Path;
use std::{env, fs};

use crate::support::{from_hex, samples, to_hex};
use crossguard_codec::{Identifiers, Message};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct Golden {
    name: String,
    octets: String,
    message: Message,
}

fn path() -> impl AsRef<Path> {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/messages.json")
}

fn golden() -> Vec<Golden> {
    let text = fs::read_to_string(path()).expect("the golden file can be read");
    serde_json::from_str(&text).expect("the golden file is JSON")
}

#[test]
fn the_samples_are_the_golden_messages() {
    let identifiers = Identifiers::default();
    let samples = samples::golden(&identifiers);
    if env::var_os("CROSSGUARD_BLESS").is_some() {
        let golden = samples.into_iter().map(|(name, message)| Golden {
            name: name.into(),
            octets: to_hex(&message.encode(&identifiers).unwrap()),
            message,
        });
        let text = serde_json::to_string_pretty(&golden.collect::<Vec<_>>()).unwrap();
        fs::write(path(), text + "\n").expect("the golden file can be written");
        return;
    }
    let golden = golden();
    assert_eq!(golden.len(), samples.len());
    for (golden, (name, sample)) in golden.iter().zip(&samples) {
        assert_eq!(&golden.name, name);
        assert_eq!(&golden.message, sample, "{name}");
    }
}

#[test]
fn every_golden_message_has_its_octets() {
    let identifiers = Identifiers::default();
    for Golden {
        name,
        octets,
        message,
    } in golden()
    {
        assert_eq!(
            to_hex(&message.encode(&identifiers).unwrap()),
            octets,
            "{name}"
        );
        let received = Message::decode(&identifiers, &from_hex(&octets)).unwrap();
        assert_eq!(received.message, message, "{name}");
    }
}
