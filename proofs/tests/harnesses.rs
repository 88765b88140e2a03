//! The harnesses with random values, and the list of harnesses against the harnesses.

use std::collections::BTreeSet;

use crossguard_proofs::{Harness, harnesses, stand_in};
use serde::Deserialize;

/// How often each harness runs, at most.
const RUNS: u64 = 400_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Committed {
    harness: Vec<Entry>,
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
    /// Seconds, over how many it was stopped, or that it was not measured.
    time: String,
}

fn committed() -> Vec<Entry> {
    let list: Committed = toml::from_str(include_str!("../harnesses.toml")).unwrap();
    list.harness
}

/// Runs a harness until it has reached all its marks, and some more.
fn exercise(harness: &Harness) -> stand_in::Record {
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
fn every_harness_holds_for_random_values_and_reaches_its_marks() {
    let mut wrong = Vec::new();
    for (harness, entry) in harnesses().zip(committed()) {
        let record = exercise(harness);
        if record.covers.len() != entry.covers || record.covers.values().any(|reached| !reached) {
            wrong.push(format!(
                "{}: {record:?}, listed {}",
                harness.name(),
                entry.covers
            ));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_list_has_every_harness_as_it_is() {
    let committed = committed();
    let listed: Vec<_> = committed.iter().map(|entry| entry.name.as_str()).collect();
    let present: Vec<_> = harnesses().map(Harness::name).collect();
    assert_eq!(listed, present);
    assert_eq!(listed.iter().collect::<BTreeSet<_>>().len(), listed.len());
    for (harness, entry) in harnesses().zip(&committed) {
        let facts = (entry.unwind, entry.solver.as_str());
        assert_eq!((harness.unwind, harness.solver), facts, "{}", entry.name);
        assert!(
            !entry.law.is_empty() && !entry.bound.is_empty(),
            "{}",
            entry.name
        );
        let time = entry.time.strip_prefix("over ").unwrap_or(&entry.time);
        let measured = time
            .strip_suffix(" s")
            .is_some_and(|s| s.parse::<f64>().is_ok());
        assert!(
            measured || entry.time == "not measured",
            "{}: {}",
            entry.name,
            entry.time
        );
    }
}
