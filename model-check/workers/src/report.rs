//! Results of the workers, in the form of every other check.

use std::sync::atomic::Ordering;
use std::time::Duration;

use crossguard_model_check::check::{assumptions, charted, collision_probability};
use crossguard_model_check::report::{PropertyReport, ScenarioReport};
use crossguard_model_check::scenario::Size;
use crossguard_model_check::sequence::ChartStep;
use serde::Serialize;

use crate::explorer::Common;
use crate::path;
use crate::table::FINGERPRINT_BITS;
use crate::threads::{Candidates, Outcome};

/// How far the workers are.
#[derive(Clone, Debug)]
pub struct Progress {
    /// The level that is being expanded; 0 is the initial state's.
    pub level: u32,
    /// Distinct states so far.
    pub states: u64,
    /// Bytes of the tables.
    pub table_bytes: u64,
    /// For how long they have worked.
    pub elapsed: Duration,
}

impl Progress {
    pub(crate) fn of(common: &Common) -> Self {
        let counters = &common.counters;
        Self {
            level: counters.level.load(Ordering::Relaxed),
            states: counters.states.load(Ordering::Relaxed),
            table_bytes: counters.table_bytes.load(Ordering::Relaxed),
            elapsed: common.limits.elapsed(),
        }
    }
}

/// The result of a check by workers.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct WorkersReport {
    /// As of every check, of what is judged. It is exhaustive up to a collision of fingerprints.
    #[serde(flatten)]
    pub scenario: ScenarioReport,
    /// How many workers took part.
    pub workers: usize,
    /// Bits of a fingerprint, by which states are compared.
    pub fingerprint_bits: u32,
    /// The probability that any two of the states share a fingerprint, so that some states may have been left out:
    /// an upper bound, where fingerprints are as good as random.
    pub omission_probability: f64,
    /// The states that the explored ones stand for: where robots are symmetric, of all states that differ in which of
    /// them is which, one is explored.
    pub states_of_classes: u64,
    /// Bytes of the tables of all workers.
    pub table_bytes: u64,
    /// Properties of the scenario that were not judged: they need the graph of all states.
    pub not_judged: Vec<String>,
}

pub(crate) fn of(common: &Common, outcome: &Outcome) -> WorkersReport {
    let (model, told) = (&common.model, &outcome.told);
    let scenario = model.scenario();
    let states: u64 = told.iter().map(|told| told.states).sum();
    let transitions: u64 = told.iter().map(|told| told.transitions).sum();
    let size = Size {
        unique_states: whole(states),
        depth: whole(told.iter().map(|told| told.depth).max().unwrap_or(0).into()),
    };
    let cut_off = told.iter().find_map(|told| told.cut_off);
    let omission_probability = collision_probability(states, FINGERPRINT_BITS);
    let compared = format!(
        "states are compared by fingerprints of {FINGERPRINT_BITS} bits: any two of these states share one with a \
         probability of at most {omission_probability:.0e}"
    );
    let claimed = common.judged.iter().enumerate();
    let judged = claimed.filter_map(|(i, &id)| {
        let run = outcome.ways[i].as_ref();
        let run = run.map(|way| counterexample(common, way));
        let claim = (id, id.untimed()?);
        Some(PropertyReport::judged(
            claim,
            model.premise_met(id),
            run,
            None,
            cut_off,
        ))
    });
    let not_judged = scenario.properties.iter();
    let not_judged = not_judged.filter(|id| !common.judged.contains(id));
    WorkersReport {
        scenario: ScenarioReport {
            transitions: whole(transitions),
            seconds: common.limits.elapsed().as_secs_f64(),
            engines: vec!["crossguard-workers"],
            properties: judged.flatten().collect(),
            assumptions: assumptions(scenario, compared),
            ..ScenarioReport::of_scenario(scenario, size, cut_off)
        },
        workers: common.workers,
        fingerprint_bits: FINGERPRINT_BITS,
        omission_probability,
        states_of_classes: told.iter().map(|told| told.of_classes).sum(),
        table_bytes: told.iter().map(|told| told.table_bytes).sum(),
        not_judged: not_judged.map(ToString::to_string).collect(),
    }
}

pub(crate) fn whole(number: u64) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}

/// The shortest run along what may lie on it.
fn counterexample(common: &Common, way: &Candidates) -> Vec<ChartStep> {
    let run = path::run(&common.model, way);
    run.map(|run| charted(&common.model, run))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_billion_states_are_told_apart_but_for_a_probability_below_a_billionth() {
        let probability = collision_probability(1_000_000_000, FINGERPRINT_BITS);
        assert!(probability > 1e-11 && probability < 1e-9, "{probability}");
        assert!(collision_probability(0, FINGERPRINT_BITS).abs() < f64::EPSILON);
    }
}
