//! Questions of pages to the model: scenarios, steps along a run, and properties. Questions and answers are JSON.

use serde::{Deserialize, Serialize};

use super::{Chances, Goal, Walk, next_step, search};
use crate::properties::PropertyId;
use crate::replay::Replay;
use crate::scenario::Scenario;

const STEPS_MAX: usize = 2_000;

const STATES_MAX: usize = 400_000;

#[derive(Serialize)]
struct ShippedScenario {
    name: &'static str,
    summary: String,
    text: &'static str,
}

/// A property, as far as it is claimed of the model without time.
#[derive(Serialize)]
struct PropertyText {
    id: &'static str,
    kind: &'static str,
    statement: &'static str,
    premise: Option<&'static str>,
    /// Its assumptions on the stations that send.
    assumes: String,
    /// The weakening of the protocol that breaks it.
    weakening: &'static str,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ByItself {
    run: Replay,
    chances: Chances,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wanted {
    run: Replay,
    goal: Goal,
}

/// Why a question of a page has no answer.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Refusal {
    /// There is no such question.
    Unknown,
    /// It is asked wrongly: what is wanted.
    Wrong(String),
}

/// The answer to a question of a page, in JSON: `scenarios`, `properties`, `walk`, `next` or `search`.
///
/// # Errors
/// There is no such question, or its body is not what it wants.
pub fn ask(what: &str, body: &str) -> Result<String, Refusal> {
    match what {
        "scenarios" => json(&scenarios()),
        "properties" => json(&properties()),
        "walk" => {
            let run: Replay = read(body)?;
            json(&Walk::along(scenario(&run)?, &run.steps))
        }
        "next" => {
            let ByItself { run, chances } = read(body)?;
            json(&next_step(scenario(&run)?, &run.steps, chances))
        }
        "search" => {
            let Wanted { run, goal } = read(body)?;
            json(&search(scenario(&run)?, goal, STATES_MAX))
        }
        _ => Err(Refusal::Unknown),
    }
}

/// The scenario of a run. A file of this machine is read by the command, never for a page.
fn scenario(run: &Replay) -> Result<Scenario, Refusal> {
    if run.steps.len() > STEPS_MAX {
        return Err(wrong(format!(
            "the run has {} steps; at most {STEPS_MAX} are followed",
            run.steps.len()
        )));
    }
    let is_shipped = Scenario::shipped().any(|name| name == run.scenario);
    if run.text.is_none() && !is_shipped {
        return Err(wrong(format!(
            "the run is of scenario '{}', which does not come with the kit, and has no text of it: \
             open it with `crossguard studio --replay FILE`",
            run.scenario
        )));
    }
    let scenario = run
        .load_scenario()
        .map_err(|cause| wrong(cause.to_string()))?;
    if scenario.timed.is_some() {
        let cause = "the scenario is timed; its runs are shown by `crossguard check` as charts";
        return Err(wrong(cause));
    }
    Ok(scenario)
}

fn scenarios() -> Vec<ShippedScenario> {
    let shipped = Scenario::shipped_texts();
    let untimed = shipped.filter_map(|(name, text)| {
        let scenario = Scenario::parse(name, text).ok()?;
        scenario.timed.is_none().then_some(ShippedScenario {
            name,
            summary: scenario.summary,
            text,
        })
    });
    untimed.collect()
}

fn properties() -> Vec<PropertyText> {
    let claimed = PropertyId::all_untimed().filter_map(|id| Some((id, id.untimed()?)));
    claimed
        .map(|(id, claim)| PropertyText {
            id: id.name(),
            kind: claim.kind.name(),
            statement: claim.statement,
            premise: claim.premise,
            assumes: id.authentication().to_string(),
            weakening: claim.weakening,
        })
        .collect()
}

fn read<'a, T: Deserialize<'a>>(body: &'a str) -> Result<T, Refusal> {
    serde_json::from_str(body).map_err(|cause| wrong(format!("this is no run: {cause}")))
}

fn json(value: &impl Serialize) -> Result<String, Refusal> {
    serde_json::to_string(value).map_err(|cause| wrong(cause.to_string()))
}

fn wrong(cause: impl Into<String>) -> Refusal {
    Refusal::Wrong(cause.into())
}
