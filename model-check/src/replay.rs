//! Runs in files: a counterexample that can be followed step by step.

use serde::{Deserialize, Serialize};

use crate::chart::{chart_step, placed};
use crate::model::{Action, Model, ModelState};
use crate::properties::{Claim, PropertyId};
use crate::report::{PropertyReport, ScenarioReport};
use crate::scenario::{Scenario, ScenarioError};
use crate::sequence::ChartStep;

/// A run through a scenario.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Replay {
    /// The scenario's name.
    pub scenario: String,
    /// The scenario's file, where it is none that comes with the kit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// The property that it broke; empty where it breaks none in particular.
    pub property: String,
    /// Its steps, in order.
    pub steps: Vec<ChartStep>,
    /// How many steps come before the steps that are repeated for ever, where the run is without end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repeats_after: Option<usize>,
}

impl Replay {
    /// The counterexample of a property; `None` where it has none, or where that is not one run: L7
    /// speaks about all that may follow. A run of a timed scenario is followed by its chart only.
    #[must_use]
    pub fn of(report: &ScenarioReport, property: &PropertyReport) -> Option<Self> {
        let id = property.id.parse::<PropertyId>().ok();
        let claim = id.and_then(PropertyId::untimed);
        let is_run =
            !property.counterexample.is_empty() && claim.is_none_or(Claim::is_shown_by_run);
        let is_run = is_run && report.figures.is_empty();
        is_run.then(|| Self {
            scenario: report.name.clone(),
            text: None,
            property: property.id.clone(),
            steps: property.counterexample.clone(),
            repeats_after: property.repeats_after,
        })
    }

    /// The scenario that it goes through.
    ///
    /// # Errors
    /// There is no shipped scenario of its name, or no usable one in its text.
    pub fn load_scenario(&self) -> Result<Scenario, ScenarioError> {
        match &self.text {
            Some(text) => Scenario::parse(&self.scenario, text),
            None => Scenario::load(&self.scenario),
        }
    }

    /// Whether the run exists in a model and breaks its property there. A liveness property is taken to be broken if the
    /// run exists as it was.
    #[must_use]
    pub fn is_broken_in(&self, model: &Model) -> bool {
        let mut state = model.initial();
        let exists = follow(model, &self.steps, &mut state, &mut |_| ()).is_none();
        let breaks = |id: PropertyId| id.is_of_runs() || model.broken_by(&state).any(|it| it == id);
        exists && self.property.parse().is_ok_and(breaks)
    }
}

/// Follows steps from a state as far as that goes, and shows each state that is reached. Says which step cannot be taken, or
/// is one with these outputs now.
pub(crate) fn follow(
    model: &Model,
    steps: &[ChartStep],
    state: &mut ModelState,
    show: &mut dyn FnMut(&ModelState),
) -> Option<(usize, Option<Vec<String>>)> {
    for (i, step) in steps.iter().enumerate() {
        let Some((next, outputs)) = take(model, state, step) else {
            return Some((i, None));
        };
        if outputs != step.outputs {
            return Some((i, Some(outputs)));
        }
        *state = next;
        show(state);
    }
    None
}

/// The effect of a step, with the outputs that it has now; `None` where it is not possible.
fn take(model: &Model, state: &ModelState, step: &ChartStep) -> Option<(ModelState, Vec<String>)> {
    let mut actions = Vec::new();
    model.actions_in(state, &mut actions);
    let is_meant = |action: &Action| {
        let (place, what) = placed(model, *action);
        place == step.place && what == step.action
    };
    let action = actions.into_iter().find(is_meant)?;
    let (next, step) = chart_step(model, state, action)?;
    Some((next, step.outputs))
}
