//! What it costs to sign and to verify, and to refuse what is not worth a signature:
//! `cargo bench -p crossguard-codec --features security --bench security`.
//!
//! The sign and verify operations of the curve alone stand beside, by both libraries, so that the share of everything
//! else can be seen.

#[path = "../tests/it/security/forge.rs"]
#[allow(dead_code, unreachable_pub, reason = "shared with the tests")]
mod forge;
#[path = "../tests/it/security/pki.rs"]
#[allow(dead_code, unreachable_pub, reason = "shared with the tests")]
mod pki;
#[allow(unreachable_pub, reason = "shared by two programs")]
mod support;

use std::hint::black_box;

use crossguard_codec::security::{Certificate, SignedMessage, Station};
use forge::{Envelope, Terms, opaque, permissions};
use p256::ecdsa::signature::{Signer, Verifier};
use p256::ecdsa::{Signature, SigningKey};
use pki::{NOW, NOW_S, Pki, RAM, after_ms, hear};
use ring::signature::{ECDSA_P256_SHA256_FIXED, UnparsedPublicKey};
use support::{Row, is_wanted, print_shortest, time};

/// As long as common header, extended header, BTP and a RAM in a session.
const PAYLOAD: [u8; 120] = [0x55; 120];

/// A receiver that knows the sender, one that does not, and three messages: with a certificate, with
/// a digest, and one that was received before.
struct Scene {
    sender: Station,
    knowing: Station,
    new: Station,
    in_full: Vec<u8>,
    by_digest: Vec<u8>,
    replayed: Vec<u8>,
}

fn scene() -> Scene {
    let pki = Pki::new(1);
    let (mut sender, new) = (pki.station(10), pki.station(11));
    let in_full = sender.seal(NOW, RAM, &PAYLOAD).expect("a ticket");
    let replayed = sender.seal(after_ms(1), RAM, &PAYLOAD).expect("a ticket");
    let by_digest = sender.seal(after_ms(2), RAM, &PAYLOAD).expect("a ticket");
    let mut knowing = new.clone();
    for envelope in [&in_full, &replayed] {
        hear(&mut knowing, after_ms(1), envelope).expect("a message to be believed");
    }
    Scene {
        sender,
        knowing,
        new,
        in_full,
        by_digest,
        replayed,
    }
}

/// A receiver hears a packet, which it takes or refuses; the receiver is as it was before in every round.
fn hearing<'a>(name: &'a str, receiver: &'a Station, packet: &'a [u8], is_taken: bool) -> Row<'a> {
    let turn = move || {
        let mut receiver = receiver.clone();
        time(|| {
            let heard = hear(&mut receiver, after_ms(2), black_box(packet));
            assert_eq!(heard.is_ok(), is_taken, "{name}");
        })
    };
    (name, Box::new(turn))
}

/// What is signed and taken, and how many more packets that are since `ring` verifies them.
fn take(scene: &Scene) {
    let key = SigningKey::from_slice(&[1; 32]).expect("a key");
    let data = [7; 64];
    let signature: Signature = key.sign(&data);
    let point = key.verifying_key().to_sec1_point(false);
    let (ring, fixed) = (
        UnparsedPublicKey::new(&ECDSA_P256_SHA256_FIXED, point.as_bytes()),
        signature.to_bytes(),
    );
    let certificate = scene.sender.ticket().certificate().octets();
    let mut sender = scene.sender.clone();
    let Scene { knowing, new, .. } = scene;
    let [by_p256, by_ring, open, ..] = print_shortest(
        "what is signed and taken",
        1,
        [
            (
                "verify by p256, the curve alone",
                Box::new(|| time(|| key.verifying_key().verify(black_box(&data), &signature))),
            ),
            (
                "verify by ring, the curve alone",
                Box::new(|| time(|| ring.verify(black_box(&data), &fixed))),
            ),
            hearing("open, signer known", knowing, &scene.by_digest, true),
            hearing("open, signer new", new, &scene.in_full, true),
            (
                "sign, the curve alone",
                Box::new(|| time(|| -> Signature { key.sign(black_box(&data)) })),
            ),
            (
                "seal",
                Box::new(move || time(|| sender.seal(after_ms(2), RAM, black_box(&PAYLOAD)))),
            ),
            (
                "read an envelope",
                Box::new(|| time(|| SignedMessage::decode(black_box(&scene.by_digest)).is_ok())),
            ),
            (
                "read a certificate",
                Box::new(|| time(|| Certificate::decode(black_box(certificate)))),
            ),
        ],
    );
    let before = open - by_ring + by_p256;
    println!(
        "with p256, a packet of a known signer would take {before:.1} us: {:.2} times as many packets",
        before / open,
    );
}

/// What it costs to refuse a packet, by kind: what an outsider can send as often as the channel carries it.
fn refuse(scene: &Scene) {
    let now = after_ms(2);
    let ticket = scene.sender.ticket().certificate().octets().to_vec();
    // A certificate that names the authority and was signed by somebody else.
    let terms = Terms {
        name: None,
        start: NOW_S - 60,
        hours: 24,
        unit: 4,
        region: Vec::new(),
        assurance: Vec::new(),
        permissions: permissions(&[RAM]),
        issue: Vec::new(),
        encryption: Vec::new(),
        additions: Vec::new(),
        key: 20,
    };
    let forged = terms.signed(Some(Pki::new(1).authority.octets()), 21);
    let envelope = |certificate: &[u8], in_full, generated_us, key| Envelope {
        payload: PAYLOAD.to_vec(),
        preamble: 0,
        its_aid: RAM,
        generated_us,
        fields: Vec::new(),
        additions: Vec::new(),
        certificate: certificate.to_vec(),
        sent: if in_full {
            certificate.to_vec()
        } else {
            Vec::new()
        },
        r_form: 0x80,
        key,
    };
    let wrong_signature = envelope(&ticket, false, now.0, 21).octets();
    let forged_certificate = envelope(&forged, true, now.0, 20).octets();
    let old = envelope(&forged, true, now.0 - 5_000_000, 20).octets();
    let mut with_authority = envelope(&forged, false, now.0, 20);
    let authority = Terms {
        name: Some("authority"),
        permissions: Vec::new(),
        issue: forge::issue_permissions(0, &[RAM], &[]),
        ..terms
    };
    let authority = authority.signed(Some(Pki::new(1).root.octets()), 21);
    with_authority.additions = [&[2, 4, 0x40][..], &opaque(&authority)].concat();
    let with_authority = with_authority.octets();
    let octet = |at: u32| ((at * 7_919) >> 3).to_le_bytes()[0];
    let garbage: Vec<u8> = (0..400).map(octet).collect();
    let Scene { knowing, new, .. } = scene;
    // Both have been refused before.
    let mut refused_before = knowing.clone();
    for packet in [&wrong_signature, &forged_certificate] {
        let _ = hear(&mut refused_before, now, packet);
    }
    let rows = [
        ("garbage", knowing, &garbage),
        ("too old, with a certificate", knowing, &old),
        ("signer unknown", new, &scene.by_digest),
        (
            "signer unknown, with the forged certificate of an authority",
            new,
            &with_authority,
        ),
        ("replayed", knowing, &scene.replayed),
        ("a forged certificate", knowing, &forged_certificate),
        (
            "a forged certificate, again",
            &refused_before,
            &forged_certificate,
        ),
        (
            "a wrong signature of a known ticket",
            knowing,
            &wrong_signature,
        ),
        (
            "a wrong signature of a known ticket, again",
            &refused_before,
            &wrong_signature,
        ),
    ];
    let rows = rows.map(|(name, receiver, packet)| hearing(name, receiver, packet, false));
    print_shortest("what is refused", 1, rows);
}

fn main() {
    if is_wanted() {
        let scene = scene();
        take(&scene);
        refuse(&scene);
    }
}
