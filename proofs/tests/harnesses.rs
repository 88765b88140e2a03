//! The harnesses with random values.

use crossguard_proofs::{Harness, harnesses, stand_in};

/// How often each harness runs, at most.
const RUNS: u64 = 400_000;

/// Runs a harness until it has reached all its marks, and some more.
fn exercise(harness: &Harness) -> stand_in::Record {
    // Seen where one fails: the last name is its.
    println!("{}", harness.name());
    let mut all = stand_in::Record::default();
    for round in 0..RUNS / 2_000 {
        let record = stand_in::run(harness.run, round, 2_000);
        all.complete += record.complete;
        for (name, reached) in record.covers {
            *all.covers.entry(name).or_default() |= reached;
        }
        if all.complete >= 500 && all.covers.values().all(|reached| *reached) {
            break;
        }
    }
    all
}

#[test]
fn every_harness_of_the_protocol_holds_for_random_values_and_reaches_its_marks() {
    hold_and_reach_their_marks("protocol::");
}

#[test]
fn every_harness_of_the_crossing_holds_for_random_values_and_reaches_its_marks() {
    hold_and_reach_their_marks("crossing::");
}

#[test]
fn every_harness_of_the_codec_holds_for_random_values_and_reaches_its_marks() {
    hold_and_reach_their_marks("codec::");
}

/// The harnesses of one module with random values.
fn hold_and_reach_their_marks(module: &str) {
    let harnesses = harnesses().filter(|harness| harness.name().starts_with(module));
    let records = harnesses.map(|harness| (harness.name(), exercise(harness)));
    let wrong: Vec<_> = records
        .filter(|(_, record)| record.covers.values().any(|reached| !reached))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
