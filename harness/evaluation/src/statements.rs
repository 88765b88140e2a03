//! Whether a run meets what the paper states: each statement with the measured value, the paper's value and a verdict.
//!
//! A verdict is computed from the run that it is about. The paper gives a figure without its deviation, so a figure is
//! met where it is within two standard deviations of single runs around our mean, and at least within half a unit of
//! its last whole digit; our mean stands beside it. Words without a figure have a rule of ours, which stands beside
//! them as well.

mod coverage;
mod load;
mod setup;
#[cfg(test)]
mod tests;
mod text;

pub use coverage::of_coverage;
pub use load::of_load;

use serde::Serialize;

use super::behaviour::Behaviour;
use super::grid::Grid;
use super::matrix::Axes;
use super::paper::{PAPER, StatedRange};
use super::statistics::Estimate;

/// Below this mean channel busy ratio it is low: no station is held back by the reactive congestion control of
/// TS 102 687 v1.2.1 (table A.1, state "relaxed").
pub const LOW_MCBR: f64 = 0.30;
/// How far a figure may be from our mean, in standard deviations of single runs.
const DEVIATIONS: f64 = 2.0;
/// How far it may be at least, in percentage points.
const ROUNDING_PERCENT: f64 = 0.5;

/// A statement of the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Statement {
    /// The grid of streets.
    Grid,
    /// Sidewalks, and crossings near intersections only.
    Crossings,
    /// The program that moves people and vehicles.
    Mobility,
    /// The network stack of the simulation.
    NetworkStack,
    /// The number of vehicles.
    Vehicles,
    /// The numbers of pedestrians.
    Pedestrians,
    /// The sensing radii.
    Radii,
    /// Where a single robot is.
    CentralIntersection,
    /// Where nine robots are.
    EveryIntersection,
    /// Robots stand.
    StaticRobots,
    /// People go the same ways whatever the number of robots.
    SameRoutes,
    /// Everybody has a device.
    Equipped,
    /// The transmission power.
    Power,
    /// The carrier frequency.
    Frequency,
    /// The width of the channel.
    Bandwidth,
    /// How stations get at the channel.
    Access,
    /// The data rate: not the paper's, but assumed here.
    DataRate,
    /// Nobody is covered without robots.
    CoverageOfNone,
    /// The coverage of one robot at the larger radius.
    CoverageOfOne,
    /// The coverage of nine robots at the larger radius.
    CoverageOfNine,
    /// It occurs mostly at intersections.
    CoverageAtIntersections,
    /// Coverage at the smaller radius is less in proportion.
    ProportionalDecrease,
    /// Several robots cover more than one.
    SeveralAreBetter,
    /// The mean channel busy ratio is comparatively low everywhere.
    LowLoad,
    /// Robots reduce it at every number of pedestrians.
    ConsistentReduction,
    /// The more pedestrians, the larger the reduction.
    GrowsWithDensity,
    /// The largest reduction.
    LargestReduction,
    /// At the smaller radius the reduction is smaller, and still there.
    SmallerRadius,
    /// Each further robot adds less than the first one.
    DiminishingGain,
    /// At the larger radius robots stand for a larger share of the people.
    LargerRadiusStandsForMore,
    /// At the smaller radius they send less.
    SmallerRadiusSendsLess,
    /// Only those fall silent that a robot perceives.
    ConservativeSilence,
    /// Devices need no change.
    UnchangedDevices,
}

/// What comes of a statement.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Outcome {
    /// The run meets it.
    Met,
    /// It does not.
    NotMet,
    /// The run does not have what it is about.
    NotMeasured,
    /// The paper does not state it; it is assumed here.
    Assumed,
}

impl Outcome {
    /// In words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::NotMet => "not met",
            Self::NotMeasured => "not measured",
            Self::Assumed => "assumed",
        }
    }
}

/// A statement, what was measured, and what comes of it.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Comparison {
    /// Which statement.
    pub statement: Statement,
    /// What it is about.
    pub about: &'static str,
    /// The paper's value, in words.
    pub paper: String,
    /// The measured value, in words.
    pub measured: String,
    /// By what rule the two are compared.
    pub rule: &'static str,
    /// What comes of it.
    pub outcome: Outcome,
}

/// What a run is of.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// The streets.
    pub grid: &'a Grid,
    /// Vehicles.
    pub vehicles: usize,
    /// What was varied.
    pub axes: &'a Axes,
    /// How stations behave, where there are any.
    pub behaviour: Option<&'a Behaviour>,
}

const FIGURE_RULE: &str = "the range within two standard deviations of a run, at every density";

/// Whether our mean agrees with what the paper states.
fn is_of(measured: Estimate, range: StatedRange) -> bool {
    let tolerance = (DEVIATIONS * measured.sd).max(ROUNDING_PERCENT);
    measured.mean + tolerance >= range.least && measured.mean - tolerance <= range.most
}

/// A comparison by what was measured, if it was.
fn compare<T>(
    (statement, about, paper): (Statement, &'static str, &str),
    measured: Option<T>,
    judge: impl Fn(&T) -> (String, bool),
    rule: &'static str,
) -> Comparison {
    let (measured, outcome) = match measured.map(|measured| judge(&measured)) {
        Some((words, is_met)) => (words, outcome(is_met)),
        None => ("-".to_owned(), Outcome::NotMeasured),
    };
    Comparison {
        statement,
        about,
        paper: paper.to_owned(),
        measured,
        rule,
        outcome,
    }
}

const fn outcome(is_met: bool) -> Outcome {
    if is_met {
        Outcome::Met
    } else {
        Outcome::NotMet
    }
}

/// An estimate for each of the paper's densities, if there is one for all.
fn over_densities(at: impl Fn(usize) -> Option<Estimate>) -> Option<Vec<Estimate>> {
    PAPER.pedestrians.into_iter().map(at).collect()
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}
