//! Results of a check, for people and for machines.

use serde::{Deserialize, Serialize};

use crate::chart::names;
use crate::properties::{Claim, PropertyId};
use crate::scenario::{Scenario, Size};
use crate::sequence::{Chart, ChartStep};
use crate::timed::Figure;

/// The kit's own exploration, in a report.
pub(crate) const KIT: &str = "crossguard";

/// The engine of the second opinion, in a report.
pub(crate) const STATERIGHT: &str = "stateright";

/// The result of checking one scenario.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ScenarioReport {
    /// The scenario's name.
    pub name: String,
    /// Its subject.
    pub summary: String,
    /// The robots' names, as charts have them.
    pub robots: Vec<String>,
    /// Distinct states, up to renaming of numbers.
    pub unique_states: usize,
    /// Transitions between distinct states.
    pub transitions: usize,
    /// Steps from the initial state to the farthest state.
    pub depth: usize,
    /// Seconds that all of it took, by the clock.
    pub seconds: f64,
    /// Which engines explored the scenario and judged it: `crossguard`, the kit's own exploration, `stateright`, or
    /// `crossguard-workers`.
    pub engines: Vec<&'static str>,
    /// Whether every reachable state was visited by each of the engines, and they agree on the number of
    /// states and on what is broken.
    pub exhaustive: bool,
    /// Why it was not, where it was not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut_off: Option<CutOff>,
    /// Whether the state space has the size that the scenario's file expects, where it says one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_as_expected: Option<bool>,
    /// Reports on each property and each premise.
    pub properties: Vec<PropertyReport>,
    /// The longest times found, where the scenario is a timed one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub figures: Vec<Figure>,
    /// Assumptions of the verdicts.
    pub assumptions: Vec<String>,
}

/// Cause that cut an exploration off.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CutOff {
    /// The limit on states.
    StateLimit,
    /// The limit on time.
    TimeLimit,
    /// An observer asked to give up.
    Stopped,
    /// All properties that were to be found broken were.
    FoundBroken,
    /// stateright and the kit's own exploration found different numbers of states.
    CountsDiffer,
    /// stateright and the kit's own exploration disagree on what is broken.
    VerdictsDiffer,
}

/// Result on one property, or on its premise.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PropertyReport {
    /// The property's id; a premise has `-premise` behind it.
    pub id: String,
    /// `S`, `T`, `L`, or `premise`.
    pub kind: String,
    /// The verdict.
    pub verdict: CheckVerdict,
    /// Its statement.
    pub statement: String,
    /// Its assumptions on senders; of a property of the kit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub authentication: Option<String>,
    /// A run that breaks the property.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub counterexample: Vec<ChartStep>,
    /// Where the run is one without end: how many of its steps come before the steps that are repeated
    /// for ever. With none left to repeat, nothing happens any more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repeats_after: Option<usize>,
}

impl PropertyReport {
    /// Report on a property or a premise, without a run.
    #[must_use]
    pub fn plain(id: &str, kind: &str, verdict: CheckVerdict, statement: &str) -> Self {
        Self {
            id: id.to_owned(),
            kind: kind.to_owned(),
            verdict,
            statement: statement.to_owned(),
            authentication: None,
            counterexample: Vec::new(),
            repeats_after: None,
        }
    }

    /// Reports on a property, and on its premise unless the property speaks about every state: a run that breaks
    /// it, if it is broken, and how many of its steps come before its cycle, if it has one.
    pub fn judged(
        (id, claim): (PropertyId, &Claim),
        is_met: bool,
        counterexample: Option<Vec<ChartStep>>,
        repeats_after: Option<usize>,
        cut_off: Option<CutOff>,
    ) -> impl Iterator<Item = Self> + use<> {
        let verdict = CheckVerdict::of_property(counterexample.is_some(), cut_off);
        let rule = Self {
            authentication: Some(id.authentication().to_string()),
            counterexample: counterexample.unwrap_or_default(),
            repeats_after,
            ..Self::plain(id.name(), claim.kind.name(), verdict, claim.statement)
        };
        let premise = claim.premise.map(|premise| {
            let verdict = CheckVerdict::of_premise(is_met, cut_off);
            Self::plain(&format!("{id}-premise"), "premise", verdict, premise)
        });
        [rule].into_iter().chain(premise)
    }
}

/// Verdict on a property or a premise.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CheckVerdict {
    /// The property holds of everything reachable.
    Holds,
    /// The premise is met somewhere.
    Reachable,
    /// The property is broken somewhere.
    Violated,
    /// The premise is met nowhere: the property says nothing in this scenario.
    Unreachable,
    /// The exploration was cut off before the answer was known.
    Incomplete,
}

impl CheckVerdict {
    /// The verdict on a property: what was not found broken holds only if nothing was cut off.
    pub(crate) const fn of_property(is_broken: bool, cut_off: Option<CutOff>) -> Self {
        match (is_broken, cut_off) {
            (true, _) => Self::Violated,
            (false, Some(_)) => Self::Incomplete,
            (false, None) => Self::Holds,
        }
    }

    /// The verdict on a premise: what was not met cannot be met only if nothing was cut off.
    pub(crate) const fn of_premise(is_met: bool, cut_off: Option<CutOff>) -> Self {
        match (is_met, cut_off) {
            (true, _) => Self::Reachable,
            (false, Some(_)) => Self::Incomplete,
            (false, None) => Self::Unreachable,
        }
    }
}

impl ScenarioReport {
    /// A report that says how large a state space is, and nothing about it yet.
    #[must_use]
    pub fn of(
        name: &str,
        summary: &str,
        robots: Vec<String>,
        size: Size,
        cut_off: Option<CutOff>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            summary: summary.to_owned(),
            robots,
            unique_states: size.unique_states,
            transitions: 0,
            depth: size.depth,
            seconds: 0.0,
            engines: Vec::new(),
            exhaustive: cut_off.is_none(),
            cut_off,
            size_as_expected: None,
            properties: Vec::new(),
            figures: Vec::new(),
            assumptions: Vec::new(),
        }
    }

    /// The same on a scenario, whose file may say the size.
    #[must_use]
    pub fn of_scenario(scenario: &Scenario, size: Size, cut_off: Option<CutOff>) -> Self {
        Self {
            size_as_expected: scenario.is_expected(size).filter(|_| cut_off.is_none()),
            ..Self::of(
                &scenario.name,
                &scenario.summary,
                names(scenario),
                size,
                cut_off,
            )
        }
    }

    /// Whether something was found that is wrong: a property is broken, a premise is met nowhere, or
    /// the state space has another size than the scenario's file expects.
    #[must_use]
    pub fn failed(&self) -> bool {
        let wrong = |p: &PropertyReport| {
            matches!(
                p.verdict,
                CheckVerdict::Violated | CheckVerdict::Unreachable
            )
        };
        self.properties.iter().any(wrong) || self.size_as_expected == Some(false)
    }

    /// The verdict on a property or premise.
    #[must_use]
    pub fn verdict(&self, id: &str) -> Option<CheckVerdict> {
        self.properties
            .iter()
            .find(|property| property.id == id)
            .map(|property| property.verdict)
    }

    /// The chart of the run that breaks a property; `None` where nothing does.
    #[must_use]
    pub fn chart<'a>(&'a self, property: &'a PropertyReport) -> Option<Chart<'a>> {
        (!property.counterexample.is_empty()).then_some(Chart {
            title: &property.statement,
            robots: &self.robots,
            steps: &property.counterexample,
            repeats_after: property.repeats_after,
        })
    }

    /// The ids of the properties that are broken.
    pub fn violated(&self) -> impl Iterator<Item = &str> {
        let violated = |p: &&PropertyReport| p.verdict == CheckVerdict::Violated;
        self.properties
            .iter()
            .filter(violated)
            .map(|property| property.id.as_str())
    }
}
