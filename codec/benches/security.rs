//! What it costs to sign and to verify, and to reject what is not worth a signature.
//!
//! The sign and verify operations of the curve alone stand beside, by both libraries, so that the share of everything
//! else can be seen.

#[path = "../tests/it/security/forge.rs"]
#[allow(dead_code, unreachable_pub, reason = "shared with the tests")]
mod forge;
#[path = "../tests/it/security/pki.rs"]
#[allow(dead_code, unreachable_pub, reason = "shared with the tests")]
mod pki;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use crossguard_codec::security::{Certificate, Rejected, SignedMessage, Station};
use forge::{Envelope, Terms, opaque, permissions};
use p256::ecdsa::SigningKey;
use p256::ecdsa::signature::hazmat::{PrehashSigner, PrehashVerifier};
use pki::{NOW, NOW_S, Pki, RAM, after_ms, hear};
use ring::signature::{ECDSA_P256_SHA256_FIXED, UnparsedPublicKey};

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

fn bench(criterion: &mut Criterion) {
    let scene = scene();
    let now = after_ms(2);
    let mut group = criterion.benchmark_group("security");
    let key = SigningKey::from_slice(&[1; 32]).expect("a key");
    let digest = [7; 32];
    let signature: p256::ecdsa::Signature = key.sign_prehash(&digest).expect("a signature");
    group.bench_function("sign, the curve alone", |bencher| {
        bencher
            .iter(|| -> Result<p256::ecdsa::Signature, _> { key.sign_prehash(black_box(&digest)) });
    });
    group.bench_function("verify by p256, the curve alone", |bencher| {
        bencher.iter(|| {
            key.verifying_key()
                .verify_prehash(black_box(&digest), &signature)
        });
    });
    let point = key.verifying_key().to_sec1_point(false);
    let signature: p256::ecdsa::Signature = signing(&key, &[7; 64]);
    let signature = signature.to_bytes();
    group.bench_function("verify by ring, the curve alone", |bencher| {
        let key = UnparsedPublicKey::new(&ECDSA_P256_SHA256_FIXED, point.as_bytes());
        bencher.iter(|| key.verify(black_box(&[7; 64]), &signature));
    });
    let mut sender = scene.sender.clone();
    group.bench_function("seal", |bencher| {
        bencher.iter(|| sender.seal(now, RAM, black_box(&PAYLOAD)));
    });
    for (name, receiver, envelope) in [
        ("open, signer known", &scene.knowing, &scene.by_digest),
        ("open, signer new", &scene.new, &scene.in_full),
        ("reject, replayed", &scene.knowing, &scene.replayed),
        ("reject, signer unknown", &scene.new, &scene.by_digest),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter_batched_ref(
                || receiver.clone(),
                |receiver| hear(receiver, now, black_box(envelope)),
                BatchSize::SmallInput,
            );
        });
    }
    let certificate = scene.sender.ticket().certificate().octets();
    group.bench_function("read an envelope", |bencher| {
        bencher.iter(|| SignedMessage::decode(black_box(&scene.by_digest)).is_ok());
    });
    group.bench_function("read a certificate", |bencher| {
        bencher.iter(|| Certificate::decode(black_box(certificate)));
    });
    group.finish();
    print_rates(&scene);
    print_pairwise(&scene);
}

/// Signs 64 octets.
fn signing(key: &SigningKey, data: &[u8]) -> p256::ecdsa::Signature {
    use p256::ecdsa::signature::Signer;
    key.sign(data)
}

/// What it costs to refuse a packet, by kind: what an outsider can send as often as the channel carries it.
fn refuse(criterion: &mut Criterion) {
    let scene = scene();
    let now = after_ms(2);
    let ticket = scene.sender.ticket().certificate().octets().to_vec();
    // A certificate that names the authority and was signed by somebody else.
    let terms = Terms {
        name: None,
        start: NOW_S - 60,
        hours: 24,
        region: Vec::new(),
        permissions: permissions(&[RAM]),
        issue: Vec::new(),
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
        in_full,
        r_forms: [0x80; 2],
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
    let mut knowing = scene.knowing.clone();
    // Both have been refused before.
    let mut refused_before = knowing.clone();
    for packet in [&wrong_signature, &forged_certificate] {
        let _ = hear(&mut refused_before, now, packet);
    }
    let _ = hear(&mut knowing, now, &garbage);
    let mut group = criterion.benchmark_group("refuse");
    for (name, receiver, packet) in [
        ("garbage", &knowing, &garbage),
        ("too old, with a certificate", &knowing, &old),
        ("signer unknown", &scene.new, &scene.by_digest),
        (
            "signer unknown, with the forged certificate of an authority",
            &scene.new,
            &with_authority,
        ),
        ("replayed", &knowing, &scene.replayed),
        ("a forged certificate", &knowing, &forged_certificate),
        (
            "a forged certificate, again",
            &refused_before,
            &forged_certificate,
        ),
        (
            "a wrong signature of a known ticket",
            &knowing,
            &wrong_signature,
        ),
        (
            "a wrong signature of a known ticket, again",
            &refused_before,
            &wrong_signature,
        ),
    ] {
        let shortest = (0..200).map(|_| {
            let mut receiver = receiver.clone();
            time(|| assert!(hear(&mut receiver, now, packet).is_err(), "{name}"))
        });
        let shortest = shortest.min().unwrap_or_default().as_secs_f64() * 1e6;
        println!("{name}: {shortest:.2} us, the shortest of 200");
        group.bench_function(name, |bencher| {
            bencher.iter_batched_ref(
                || receiver.clone(),
                |receiver| hear(receiver, now, black_box(packet)),
                BatchSize::SmallInput,
            );
        });
    }
    group.finish();
}

/// Messages per second and core, of many messages in a row as they come from one sender.
fn print_rates(scene: &Scene) {
    const MESSAGES: u64 = 2_000;
    let mut sender = scene.sender.clone();
    let mut said = Vec::new();
    let sealing = time(|| {
        let mut seal = |at| sender.seal(after_ms(3 + at), RAM, &PAYLOAD);
        said.extend((0..MESSAGES).filter_map(|at| seal(at).ok()));
    });
    let mut receiver = scene.knowing.clone();
    let opening = time(|| {
        for (at, envelope) in (0..).zip(&said) {
            assert!(hear(&mut receiver, after_ms(3 + at), envelope).is_ok());
        }
    });
    let mut replays = 0_u64;
    let last = after_ms(2 + MESSAGES);
    let rejecting = time(|| {
        let heard = said
            .iter()
            .map(|envelope| hear(&mut receiver, last, envelope));
        replays = heard
            .filter(|heard| *heard == Err(Rejected::Replayed))
            .count() as u64;
    });
    assert_eq!(replays, MESSAGES);
    let per_second = |time: Duration| f64::from(2_000_u32) / time.as_secs_f64();
    println!(
        "messages per second and core: {:.0} sealed, {:.0} opened, {:.0} replays rejected",
        per_second(sealing),
        per_second(opening),
        per_second(rejecting),
    );
}

/// What the library that verifies makes of a packet, on a machine that does other things as well: in turns, and the
/// shortest of each, which nothing has interrupted.
fn print_pairwise(scene: &Scene) {
    const ROUNDS: usize = 400;
    let key = SigningKey::from_slice(&[1; 32]).expect("a key");
    let point = key.verifying_key().to_sec1_point(false);
    let signature = signing(&key, &[7; 64]);
    let fixed = signature.to_bytes();
    let ring = UnparsedPublicKey::new(&ECDSA_P256_SHA256_FIXED, point.as_bytes());
    let mut shortest = [Duration::MAX; 3];
    for _ in 0..ROUNDS {
        let mut receiver = scene.knowing.clone();
        let times = [
            time(|| {
                use p256::ecdsa::signature::Verifier;
                assert!(key.verifying_key().verify(&[7; 64], &signature).is_ok());
            }),
            time(|| assert!(ring.verify(&[7; 64], &fixed).is_ok())),
            time(|| assert!(hear(&mut receiver, after_ms(2), &scene.by_digest).is_ok())),
        ];
        for (shortest, time) in shortest.iter_mut().zip(times) {
            *shortest = time.min(*shortest);
        }
    }
    let [p256, ring, open] = shortest.map(|time| time.as_secs_f64() * 1e6);
    let before = open - ring + p256;
    println!(
        "shortest of {ROUNDS}, in turns: verify by p256 {p256:.1} us, by ring {ring:.1} us; a packet of a known signer \
         {open:.1} us, with p256 it would be {before:.1} us: {:.2} times as many packets",
        before / open,
    );
}

fn time(mut work: impl FnMut()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}

criterion_group!(benches, bench, refuse);
criterion_main!(benches);
