//! The harnesses with random values, and the list of harnesses against the harnesses.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crossguard_proofs::{Harness, Proof, harnesses, stand_in};
use serde::Deserialize;

/// How often each harness runs, at most.
const RUNS: u64 = 400_000;

/// How often each runs where more is asked for.
const MANY_RUNS: u64 = 30_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Committed {
    harness: Vec<Entry>,
    random_only: Vec<Unproved>,
}

/// One entry of `harnesses.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// As `cargo kani --harness` takes it.
    name: String,
    /// The laws that it calls.
    law: String,
    /// What is bounded, in words.
    bound: String,
    unwind: u32,
    solver: String,
    /// How many cover marks must be reached.
    covers: usize,
    /// Seconds that it took, or that it was not measured.
    time: String,
}

/// One entry of the harnesses that are not proved.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Unproved {
    name: String,
    law: String,
    bound: String,
    covers: usize,
}

fn committed() -> Committed {
    toml::from_str(include_str!("../harnesses.toml")).unwrap()
}

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
fn every_harness_of_the_codec_holds_for_random_values_and_reaches_its_marks() {
    hold_and_reach_their_marks("codec::");
}

#[test]
#[ignore = "takes a minute; the protocol's mutants are judged by it, see protocol/MUTANTS.md"]
fn every_harness_of_the_protocol_holds_for_many_random_values() {
    for harness in harnesses().filter(|harness| harness.name().starts_with("protocol::")) {
        println!("{}", harness.name());
        stand_in::run(harness.run, 1, MANY_RUNS);
    }
}

/// With a mutant of the protocol switched on, this tells which harnesses notice: by a panic, or by a mark that is not reached.
#[test]
#[ignore = "fails as it should with a mutant: see `crossguard-mutants harnesses`"]
fn the_harnesses_that_fail_are_named() {
    let is_of_protocol = |harness: &&Harness| harness.name().starts_with("protocol::");
    let fails = |harness: &&Harness| {
        let record = catch_unwind(AssertUnwindSafe(|| exercise(harness)));
        !record.is_ok_and(|record| record.covers.values().all(|reached| *reached))
    };
    let failed: Vec<_> = harnesses().filter(is_of_protocol).filter(fails).collect();
    for harness in &failed {
        println!("fails: {}", harness.name());
    }
    assert!(failed.is_empty());
}

/// The harnesses of one module with random values.
fn hold_and_reach_their_marks(module: &str) {
    let committed = committed();
    let proved = committed
        .harness
        .iter()
        .map(|e| (e.name.as_str(), e.covers));
    let others = committed
        .random_only
        .iter()
        .map(|e| (e.name.as_str(), e.covers));
    let covers: BTreeMap<_, _> = proved.chain(others).collect();
    let mut wrong = Vec::new();
    for harness in harnesses().filter(|harness| harness.name().starts_with(module)) {
        let listed = covers.get(harness.name()).copied();
        let record = exercise(harness);
        let unreached = record.covers.values().any(|reached| !reached);
        if Some(record.covers.len()) != listed || unreached {
            wrong.push(format!("{}: {record:?}, listed {listed:?}", harness.name()));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_list_has_every_harness_as_it_is() {
    let committed = committed();
    let (proved, others): (Vec<_>, Vec<_>) = harnesses().partition(|h| h.proof.is_some());
    let names =
        |harnesses: Vec<&Harness>| -> Vec<_> { harnesses.iter().map(|h| h.name()).collect() };
    let listed: Vec<_> = committed.harness.iter().map(|e| e.name.as_str()).collect();
    assert_eq!(listed, names(proved.clone()));
    let listed: Vec<_> = committed
        .random_only
        .iter()
        .map(|e| e.name.as_str())
        .collect();
    assert_eq!(listed, names(others));
    for entry in &committed.random_only {
        assert!(
            !entry.law.is_empty() && !entry.bound.is_empty(),
            "{}",
            entry.name
        );
    }
    for (harness, entry) in proved.into_iter().zip(&committed.harness) {
        let proof = Proof {
            unwind: entry.unwind,
            solver: entry.solver.as_str().to_owned().leak(),
        };
        assert_eq!(harness.proof, Some(proof), "{}", entry.name);
        assert!(
            !entry.law.is_empty() && !entry.bound.is_empty(),
            "{}",
            entry.name
        );
        let seconds = entry
            .time
            .strip_suffix(" s")
            .and_then(|s| s.parse::<f64>().ok());
        assert!(
            seconds.is_some() || entry.time == "not measured",
            "{}",
            entry.name
        );
    }
}
