//! What it costs to sign and to verify, and to reject what is not worth a signature.
//!
//! The sign and verify operations of the curve alone stand beside, so that the share of everything
//! else can be seen.

#[path = "../tests/security/pki.rs"]
#[allow(dead_code, unreachable_pub, reason = "shared with the tests")]
mod pki;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use crossguard_codec::security::{Certificate, Rejected, SignedMessage, Station};
use p256::ecdsa::SigningKey;
use p256::ecdsa::signature::hazmat::{PrehashSigner, PrehashVerifier};
use pki::{NOW, Pki, RAM, after_ms, hear};

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
    group.bench_function("verify, the curve alone", |bencher| {
        bencher.iter(|| {
            key.verifying_key()
                .verify_prehash(black_box(&digest), &signature)
        });
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

fn time(mut work: impl FnMut()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}

criterion_group!(benches, bench);
criterion_main!(benches);
