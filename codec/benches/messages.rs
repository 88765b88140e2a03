//! Time to encode and decode typical and largest messages: by the core, by rasn alone, and as the
//! endpoint does. The ratios of core and rasn are printed at the end.

#[path = "../tests/support/samples.rs"]
#[allow(
    dead_code,
    missing_docs,
    unreachable_pub,
    reason = "shared with the tests"
)]
mod samples;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use crossguard_codec::core::{self, Uper, max_octets};
use crossguard_codec::{Identifiers, Pdu, asn1, decode, encode, view_of_ram, views_of_rmcm};

/// More octets than any message has.
const BUFFER_LEN: usize = 1_024;
const _: () = assert!(max_octets::<core::ram::RAM>() <= BUFFER_LEN);
const _: () = assert!(max_octets::<core::rmcm::RMCM>() <= BUFFER_LEN);

fn bench<C: Uper, M: Pdu>(criterion: &mut Criterion, name: &str, message: &M) {
    let identifiers = Identifiers::default();
    let octets = encode(&identifiers, message).expect("a valid message");
    let (value, _) = core::decode::<C>(&octets).expect("a valid message");
    let mut buffer = [0; BUFFER_LEN];
    let mut group = criterion.benchmark_group(format!("{name}, {} octets", octets.len()));
    group.bench_function("encode by the core", |bencher| {
        bencher.iter(|| core::encode(black_box(&value), &mut buffer));
    });
    group.bench_function("decode by the core", |bencher| {
        bencher.iter(|| core::decode::<C>(black_box(&octets)));
    });
    group.bench_function("encode by rasn alone", |bencher| {
        bencher.iter(|| rasn::uper::encode(black_box(message)));
    });
    group.bench_function("decode by rasn alone", |bencher| {
        bencher.iter(|| rasn::uper::decode::<M>(black_box(&octets)));
    });
    group.bench_function("encode", |bencher| {
        bencher.iter(|| encode(&identifiers, black_box(message)));
    });
    group.bench_function("decode", |bencher| {
        bencher.iter(|| decode::<M>(&identifiers, black_box(&octets)));
    });
    group.finish();
    print_ratio::<C, M>(name, &value, message, &octets);
}

/// Nanoseconds of one turn: the fastest of many short runs, so that other load does not count.
fn nanoseconds<R>(mut turn: impl FnMut() -> R) -> f64 {
    const TURNS: u32 = 500;
    let mut run = || {
        let start = Instant::now();
        for _ in 0..TURNS {
            black_box(turn());
        }
        start.elapsed()
    };
    let fastest = (0..200).map(|_| run()).min().unwrap_or(Duration::ZERO);
    fastest.as_secs_f64() * 1e9 / f64::from(TURNS)
}

fn print_ratio<C: Uper, M: Pdu>(name: &str, value: &C, message: &M, octets: &[u8]) {
    let mut buffer = [0; BUFFER_LEN];
    let by_core = nanoseconds(|| core::encode(black_box(value), &mut buffer))
        + nanoseconds(|| core::decode::<C>(black_box(octets)));
    let by_rasn = nanoseconds(|| rasn::uper::encode(black_box(message)))
        + nanoseconds(|| rasn::uper::decode::<M>(black_box(octets)));
    let strictly = nanoseconds(|| asn1::encode(black_box(message)))
        + nanoseconds(|| asn1::decode::<M>(black_box(octets)));
    println!(
        "{name}, encode and decode: core {by_core:.0} ns, rasn {by_rasn:.0} ns ({:.1} times), \
         rasn under the strict decoder {strictly:.0} ns ({:.1} times)",
        by_rasn / by_core,
        strictly / by_core
    );
}

fn messages(criterion: &mut Criterion) {
    use core::{ram::RAM, rmcm::RMCM};
    let identifiers = Identifiers::default();
    let ram = samples::typical_ram(&identifiers);
    bench::<RAM, _>(criterion, "typical RAM", &ram);
    let ram = samples::largest_ram(&identifiers);
    bench::<RAM, _>(criterion, "largest RAM", &ram);
    let rmcm = samples::typical_rmcm(&identifiers);
    bench::<RMCM, _>(criterion, "typical RMCM", &rmcm);
    let rmcm = samples::largest_rmcm(&identifiers);
    bench::<RMCM, _>(criterion, "largest RMCM", &rmcm);
}

fn views(criterion: &mut Criterion) {
    let identifiers = Identifiers::default();
    let ram = samples::typical_ram(&identifiers);
    criterion.bench_function("view of a typical RAM", |bencher| {
        bencher.iter(|| view_of_ram(black_box(&ram)));
    });
    let rmcm = samples::typical_rmcm(&identifiers);
    criterion.bench_function("views of a typical RMCM", |bencher| {
        bencher.iter(|| views_of_rmcm(black_box(&rmcm)));
    });
}

criterion_group!(benches, messages, views);
criterion_main!(benches);
