//! Verdict of validation on logs, in words: for the terminal, for the report and for the studio.

use crossguard_model_check::properties::PropertyId;
use serde::Serialize;

use crate::validate::{Fault, Invalid, Validated};

/// Verdict on a property in a run.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PropertyVerdict {
    /// Its id, like `I4`.
    pub id: String,
    /// Whether a step broke it.
    pub is_broken: bool,
    /// Its statement.
    pub statement: &'static str,
}

/// Verdict on each property that had something to say; empty where the logs could not be judged by them.
#[must_use]
pub fn properties(verdict: Result<&Validated, &Invalid>) -> Vec<PropertyVerdict> {
    let broken = verdict.err().and_then(|invalid| match *invalid.fault {
        Fault::Broken(broken) => Some(broken),
        _ => None,
    });
    let kept: &[String] = verdict.map_or(&[], |valid| &valid.properties);
    let verdict_of = |id: PropertyId| {
        let name = id.to_string();
        let is_broken = broken == Some(id);
        (is_broken || kept.contains(&name)).then(|| PropertyVerdict {
            id: name,
            is_broken,
            statement: id.statement(),
        })
    };
    PropertyId::ALL.into_iter().filter_map(verdict_of).collect()
}

/// Contents of valid logs, and their gaps, a sentence for each.
#[must_use]
pub fn sentences(valid: &Validated) -> Vec<String> {
    let mut sentences = vec![format!(
        "{} steps, each one of the transition function; {} messages sent; {} receptions, each with its transmission; \
         {} properties put to the test and kept.",
        valid.steps,
        valid.sent,
        valid.heard,
        valid.properties.len()
    )];
    let counted = [
        (
            valid.from_strangers as u64,
            "messages came from stations whose logs are not here",
        ),
        (
            valid.beyond_logs as u64,
            "messages came from robots after the end of their logs",
        ),
        (
            valid.of_unknown_age as u64,
            "messages were taken in of which the logs do not say how long they had waited",
        ),
    ];
    let counted = counted.into_iter().filter(|(count, _)| *count > 0);
    sentences.extend(counted.map(|(count, what)| format!("{count} {what}.")));
    if valid.late.steps > 0 {
        sentences.push(format!(
            "{} steps came later than delay_max after they were due, the latest by {} ms: the process hung, or its machine was \
             too slow.",
            valid.late.steps, valid.late.longest_ms
        ));
    }
    let not_judged = valid.not_judged.iter();
    sentences.extend(not_judged.map(|what| format!("Not judged: {what}.")));
    sentences.extend(valid.crossing.iter().map(|what| format!("{what}.")));
    if valid.missing > 0 {
        sentences.push(format!(
            "{} records are missing by the robots' own account: their reader was too slow. What is here is valid, and is not \
             all.",
            valid.missing
        ));
    }
    let cut_off = valid.cut_off.iter();
    sentences
        .extend(cut_off.map(|robot| format!("The log of {robot} ends in the middle of a run.")));
    sentences
}
