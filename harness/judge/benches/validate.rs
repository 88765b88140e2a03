//! Validation of logs, in records a second: those of runs of six simulated robots, about 100,000 records
//! in all.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use crossguard_judge::sim::{Swarm, run};
use crossguard_judge::validate;
use crossguard_robot::trace::{self, Record};

/// How many records the logs have together at least.
const RECORDS: u64 = 100_000;

/// The logs, and how many records are in them.
fn logs() -> (Vec<Vec<u8>>, u64) {
    let (mut logs, mut records) = (Vec::new(), 0);
    for seed in 1.. {
        let mut log = Vec::new();
        let mut watch = |record: Record| {
            records += 1;
            trace::write(&mut log, &record).expect("writing to memory does not fail");
        };
        let _ = run(&Swarm::draw(seed, 6, None), Some(&mut watch));
        logs.push(log);
        if records >= RECORDS {
            break;
        }
    }
    (logs, records)
}

fn validating(criterion: &mut Criterion) {
    let (logs, records) = logs();
    let mut group = criterion.benchmark_group("validate");
    group
        .throughput(Throughput::Elements(records))
        .sample_size(10);
    group.bench_function("logs of six robots each", |bencher| {
        bencher.iter(|| {
            for log in &logs {
                black_box(validate::one(&**log)).expect("simulated logs are valid");
            }
        });
    });
    group.finish();
}

criterion_group!(benches, validating);
criterion_main!(benches);
