//! Packets that are to be taken, and packets that are to be refused, each with the cause under which.
//!
//! They are in `codec/tests/golden/security.json` for other implementations, with the certificates that the receiver
//! trusts. `cargo xtask bless security.json` writes the file. Nothing of the kit encodes or signs what is in it.

use crossguard_codec::Service;
use crossguard_codec::geonet::{Demand, Envelope as Around, Secured, Stack};
use crossguard_codec::security::{Certificate, Station, Ticket, Time64, Tolerances, TrustStore};
use crossguard_protocol::StationId;
use serde_json::{Value, json};

use super::forge::{Terms, opaque, with_r_form};
use super::listed::vectors;
use super::pki::{CAM, NOW, RAM, RMCM, after_ms};
use super::scene::{
    AUTHORITY, DENM, HERE, Heard, Pki, RECEIVER, ROOT, SENDER, VAM, Vector, Vectors,
    authority_terms, ego, envelope, identifiers, secured, terms,
};
use crate::support::{blessed, from_hex, to_hex};

/// A receiver that trusts these certificates and has heard nothing.
fn receiver(root: &[u8], authority: &[u8]) -> Stack {
    let mut trust = TrustStore::default();
    trust.add_root(Certificate::decode(root).unwrap()).unwrap();
    trust
        .add_authority(Certificate::decode(authority).unwrap())
        .unwrap();
    let own = terms(RECEIVER).signed(Some(authority), AUTHORITY);
    let ticket = Ticket::new(
        Certificate::decode(&own).unwrap(),
        super::pki::key(RECEIVER),
    );
    let station = Station::new(trust, vec![ticket.unwrap()], Tolerances::default(), NOW).unwrap();
    let mut stack = Stack::of_robot(identifiers(), StationId(8));
    let secured = Secured::new(station, Demand::Signature);
    *stack.envelope_mut() = Around::Secured(Box::new(secured));
    stack
}

/// How many signatures a receiver has checked.
fn signatures_of(receiver: &Stack) -> u64 {
    match receiver.envelope() {
        Around::Secured(secured) => secured.station().verifier().signatures(),
        _ => unreachable!("it is secured"),
    }
}

fn octets_of(text: &Value) -> Vec<u8> {
    from_hex(text.as_str().unwrap())
}

fn as_json(vectors: &Vectors) -> Value {
    let packet = |it: &Heard| {
        json!({
            "octets": to_hex(&it.packet),
            "heardAtUs": it.at.0,
            "refused": it.refused,
        })
    };
    let vector = |it: &Vector| {
        json!({
            "name": it.name,
            "clause": it.clause,
            "packets": it.heard.iter().map(packet).collect::<Vec<_>>(),
        })
    };
    json!({
        "about": [
            "GeoNetworking packets behind the link layer, secured by TS 103 097 v2.1.1 on IEEE 1609.2.",
            "Each vector is for a receiver that has heard nothing before, demands a signature, trusts the root and the \
             authority, and is at the place given. It hears the packets in order, at heardAtUs (Time64).",
            "refused is null for a packet that is taken, or else the cause under which this kit counts it. What the \
             standards leave to the receiver is 2 s of age, 220 ms ahead, and 10 km of distance here.",
            "The messages in the packets are all the same RAM: only what is under a message is judged."
        ],
        "root": to_hex(&vectors.pki.root),
        "authority": to_hex(&vectors.pki.authority),
        "receiver": {"latitude": HERE.0, "longitude": HERE.1},
        "itsAid": {"cam": CAM, "denm": DENM, "vam": VAM, "ram": RAM, "rmcm": RMCM},
        "vectors": vectors.all.iter().map(vector).collect::<Vec<_>>(),
    })
}

/// What is in the file.
fn file() -> Value {
    let text = blessed("tests/golden/security.json", || {
        serde_json::to_string_pretty(&as_json(&vectors())).unwrap() + "\n"
    });
    serde_json::from_str(&text).unwrap()
}

#[test]
fn the_vectors_are_those_of_the_file() {
    let is_same = file() == as_json(&vectors());
    assert!(is_same, "cargo xtask bless security.json");
}

#[test]
fn every_packet_of_the_file_is_taken_or_refused_under_its_cause() {
    let file = file();
    let (root, authority) = (octets_of(&file["root"]), octets_of(&file["authority"]));
    let mut wrong = Vec::new();
    let mut causes = std::collections::BTreeSet::new();
    for vector in file["vectors"].as_array().unwrap() {
        let mut receiver = receiver(&root, &authority);
        for packet in vector["packets"].as_array().unwrap() {
            let now = Time64(packet["heardAtUs"].as_u64().unwrap());
            let octets = octets_of(&packet["octets"]);
            let before = signatures_of(&receiver);
            let heard = receiver.receive(&ego(now, HERE), &octets);
            let refused = heard.err().map(crossguard_codec::geonet::Discarded::cause);
            let expected = packet["refused"].as_str();
            causes.extend(expected.map(str::to_owned));
            if refused != expected {
                wrong.push(format!("{}: {refused:?}, not {expected:?}", vector["name"]));
            }
            // Nothing is spent on a packet that something else is wrong with.
            let spent = signatures_of(&receiver) - before;
            let is_dear = refused.is_none_or(|cause| cause.ends_with("signature"));
            if (spent > 0) != is_dear || spent > 2 {
                wrong.push(format!("{}: {spent} signatures", vector["name"]));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(causes.len() > 25, "{causes:?}");
}

#[test]
fn an_authority_is_taken_when_it_was_asked_for() {
    let pki = Pki::new();
    let authority = Terms {
        name: Some("late"),
        ..authority_terms()
    };
    let authority = authority.signed(Some(&pki.root), ROOT);
    let ticket = terms(SENDER).signed(Some(&authority), AUTHORITY);
    let say = |at, in_full, brings: Option<&[u8]>| {
        let mut it = envelope(&pki, Service::Ram, at);
        it.certificate = ticket.clone();
        it.sent = if in_full { ticket.clone() } else { Vec::new() };
        it.additions = brings.map_or(Vec::new(), |certificate| {
            [&[2, 4, 0x40][..], &opaque(certificate)].concat()
        });
        secured(&it.octets())
    };
    let mut receiver = receiver(&pki.root, &pki.authority);
    let mut hear = |at, packet: &[u8]| {
        let heard = receiver.receive(&ego(at, HERE), packet);
        let cause = heard.err().map(crossguard_codec::geonet::Discarded::cause);
        (cause, signatures_of(&receiver))
    };
    // Nobody asked: it is not looked at, and the ticket is not known.
    let unasked = say(NOW, false, Some(&authority));
    assert_eq!(hear(NOW, &unasked), (Some("unknown certificate"), 0));
    assert_eq!(hear(NOW, &say(NOW, true, None)), (Some("foreign root"), 0));
    // One with another name is another authority.
    assert_eq!(hear(NOW, &say(NOW, false, Some(&pki.authority))).1, 0);
    // A forged one, which has the name that was asked for, cannot be made: that takes its digest.
    let at = after_ms(100);
    // It comes in another form than the one that its name is the digest of.
    let asked = say(at, false, Some(&with_r_form(authority.clone(), 0x83)));
    assert_eq!(hear(at, &asked), (Some("unknown certificate"), 1));
    let at = after_ms(200);
    assert_eq!(hear(at, &say(at, true, None)), (None, 3));
}
