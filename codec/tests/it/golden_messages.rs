//! The golden vectors of RAM and RMCM: the wire format does not change by accident.
//!
//! asn1c, asn1tools and pycrate have compiled the modules and made the same octets of them. After a
//! deliberate change, `cargo xtask bless messages.json` writes the file.

use crate::support::{blessed, samples, to_hex};
use crossguard_codec::{Identifiers, Message};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct Golden {
    name: String,
    octets: String,
    message: Message,
}

fn golden() -> Vec<Golden> {
    let text = blessed("tests/golden/messages.json", || {
        let identifiers = Identifiers::default();
        let samples = samples::golden(&identifiers).into_iter();
        let golden = samples.map(|(name, message)| Golden {
            name: name.into(),
            octets: to_hex(&message.encode(&identifiers).unwrap()),
            message,
        });
        serde_json::to_string_pretty(&golden.collect::<Vec<_>>()).unwrap() + "\n"
    });
    serde_json::from_str(&text).expect("the golden file is JSON")
}

#[test]
fn the_samples_are_the_golden_messages_and_have_their_octets() {
    let identifiers = Identifiers::default();
    let (samples, golden) = (samples::golden(&identifiers), golden());
    assert_eq!(golden.len(), samples.len());
    for (golden, (name, sample)) in golden.iter().zip(&samples) {
        assert_eq!((&golden.name[..], &golden.message), (*name, sample));
        let octets = sample.encode(&identifiers).unwrap();
        assert_eq!(to_hex(&octets), golden.octets, "{name}");
        let received = Message::decode(&identifiers, &octets).unwrap();
        assert_eq!(received.message, *sample, "{name}");
    }
}
