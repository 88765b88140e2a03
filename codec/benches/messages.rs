//! Time to encode and decode typical and largest messages, strictly and by rasn alone.

#[path = "../tests/support/samples.rs"]
#[allow(
    dead_code,
    missing_docs,
    unreachable_pub,
    reason = "shared with the tests"
)]
mod samples;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use crossguard_codec::{Identifiers, Pdu, decode, encode, view_of_ram, views_of_rmcm};

fn bench<M: Pdu>(criterion: &mut Criterion, name: &str, message: &M) {
    let identifiers = Identifiers::default();
    let octets = encode(&identifiers, message).expect("a valid message");
    let mut group = criterion.benchmark_group(format!("{name}, {} octets", octets.len()));
    group.bench_function("encode", |bencher| {
        bencher.iter(|| encode(&identifiers, black_box(message)));
    });
    group.bench_function("decode", |bencher| {
        bencher.iter(|| decode::<M>(&identifiers, black_box(&octets)));
    });
    group.bench_function("encode by rasn alone", |bencher| {
        bencher.iter(|| rasn::uper::encode(black_box(message)));
    });
    group.bench_function("decode by rasn alone", |bencher| {
        bencher.iter(|| rasn::uper::decode::<M>(black_box(&octets)));
    });
    group.finish();
}

fn messages(criterion: &mut Criterion) {
    let identifiers = Identifiers::default();
    bench(
        criterion,
        "typical RAM",
        &samples::typical_ram(&identifiers),
    );
    bench(
        criterion,
        "largest RAM",
        &samples::largest_ram(&identifiers),
    );
    bench(
        criterion,
        "typical RMCM",
        &samples::typical_rmcm(&identifiers),
    );
    bench(
        criterion,
        "largest RMCM",
        &samples::largest_rmcm(&identifiers),
    );
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
