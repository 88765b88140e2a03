//! Time to encode and decode typical and largest messages: by the core, by rasn alone, and as the
//! endpoint does. The ratios of core and rasn are printed at the end.

#[path = "../tests/it/support/samples.rs"]
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
use crossguard_codec::core::{self, Uper};
use crossguard_codec::{
    Identifiers, MESSAGE_LEN_MAX, Pdu, asn1, decode, encode, encode_into, ram_from, state_of,
    view_of_ram, views_of_rmcm,
};
use crossguard_protocol::Availability;

/// `value` is the message as the endpoint has it, `of_rasn` the same in the reference.
fn bench<C, M>(criterion: &mut Criterion, name: &str, value: &C, of_rasn: &M)
where
    C: Uper + Pdu,
    M: rasn::Encode + rasn::Decode,
{
    let identifiers = Identifiers::default();
    let octets = encode(&identifiers, value).expect("a valid message");
    let mut buffer = [0; MESSAGE_LEN_MAX];
    let mut group = criterion.benchmark_group(format!("{name}, {} octets", octets.len()));
    group.bench_function("encode by the core", |bencher| {
        bencher.iter(|| core::encode(black_box(value), &mut buffer));
    });
    group.bench_function("decode by the core", |bencher| {
        bencher.iter(|| core::decode::<C>(black_box(&octets)));
    });
    group.bench_function("encode by rasn alone", |bencher| {
        bencher.iter(|| rasn::uper::encode(black_box(of_rasn)));
    });
    group.bench_function("decode by rasn alone", |bencher| {
        bencher.iter(|| rasn::uper::decode::<M>(black_box(&octets)));
    });
    group.bench_function("encode", |bencher| {
        bencher.iter(|| encode_into(&identifiers, black_box(value), &mut buffer));
    });
    group.bench_function("decode", |bencher| {
        bencher.iter(|| decode::<C>(&identifiers, black_box(&octets)));
    });
    group.finish();
    print_ratio(name, value, of_rasn, &octets);
}

/// Nanoseconds of one turn: the fastest of many short runs, so that other load does not count.
fn nanoseconds<R>(mut turn: impl FnMut() -> R) -> f64 {
    const TURNS: u32 = 500;
    let mut run = || {
        let start = Instant::now();
        for _ in 0..TURNS {
            // Of a reference, or else a copy of the message is measured too.
            black_box(&turn());
        }
        start.elapsed()
    };
    let fastest = (0..200).map(|_| run()).min().unwrap_or(Duration::ZERO);
    fastest.as_secs_f64() * 1e9 / f64::from(TURNS)
}

fn print_ratio<C, M>(name: &str, value: &C, of_rasn: &M, octets: &[u8])
where
    C: Uper,
    M: rasn::Encode + rasn::Decode,
{
    let mut buffer = [0; MESSAGE_LEN_MAX];
    let by_core = nanoseconds(|| core::encode(black_box(value), &mut buffer))
        + nanoseconds(|| core::decode::<C>(black_box(octets)));
    let by_rasn = nanoseconds(|| rasn::uper::encode(black_box(of_rasn)))
        + nanoseconds(|| rasn::uper::decode::<M>(black_box(octets)));
    let strictly = nanoseconds(|| asn1::encode(black_box(of_rasn)))
        + nanoseconds(|| asn1::decode::<M>(black_box(octets)));
    println!(
        "{name}, encode and decode: core {by_core:.0} ns, rasn {by_rasn:.0} ns ({:.1} times), \
         rasn under the strict decoder {strictly:.0} ns ({:.1} times)",
        by_rasn / by_core,
        strictly / by_core
    );
}

fn messages(criterion: &mut Criterion) {
    let identifiers = Identifiers::default();
    let rams = [
        ("typical RAM", samples::typical_ram(&identifiers)),
        ("largest RAM", samples::largest_ram(&identifiers)),
    ];
    for (name, ram) in rams {
        let of_rasn = asn1::ram::RAM::try_from(&ram).expect("the two agree");
        bench(criterion, name, &ram, &of_rasn);
    }
    let rmcms = [
        ("typical RMCM", samples::typical_rmcm(&identifiers)),
        ("largest RMCM", samples::largest_rmcm(&identifiers)),
    ];
    for (name, rmcm) in rmcms {
        let of_rasn = asn1::rmcm::RMCM::try_from(&rmcm).expect("the two agree");
        bench(criterion, name, &rmcm, &of_rasn);
    }
}

fn views(criterion: &mut Criterion) {
    let identifiers = Identifiers::default();
    let ram = samples::typical_ram(&identifiers);
    criterion.bench_function("a typical RAM of a view and a state", |bencher| {
        let (state, view) = (samples::state(), samples::follower_view());
        let available = Availability::Available;
        bencher.iter(|| ram_from(&identifiers, black_box(&state), &view, available, 0, false));
    });
    criterion.bench_function("state of a typical RAM", |bencher| {
        bencher.iter(|| state_of(black_box(&ram)));
    });
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
