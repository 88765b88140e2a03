//! Whether a run meets what the paper states: each statement with the measured value, the paper's value and a verdict.
//!
//! A verdict is computed from the run that it is about. A statement is a hypothesis on a mean over seeds, or on the mean
//! of a difference that is taken seed by seed: it is met where the whole 95 % confidence interval of that mean is on the
//! stated side, not met where none of it is, and undecided in between, which more seeds sharpen. A figure of the paper
//! is a range, wider by half a unit of its last digit. Where a statement is about several cells, one that is not met
//! decides, and then one that is undecided; the level is that of a single cell. Words without a figure have a rule of
//! ours, which stands beside them.

mod coverage;
mod load;
mod setup;
#[cfg(test)]
mod tests;
mod text;

pub use coverage::of_coverage;
pub use load::of_load;

use std::fmt::Display;

use serde::Serialize;

use super::behaviour::Behaviour;
use super::matrix::Axes;
use super::net::Streets;
use super::paper::{PAPER, StatedRange};
use super::statistics::Estimate;

/// Below this mean channel busy ratio it is low: no station is held back by the reactive congestion control of
/// TS 102 687 v1.2.1 (table A.1, state "relaxed").
pub const LOW_MCBR: f64 = 0.30;

/// A table of statements: what each is about, and by what rule what was measured is compared with the paper.
macro_rules! statements {
    ($($statement:ident $about:literal: $rule:expr;)*) => {
        /// A statement of the paper.
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
        #[serde(rename_all = "camelCase")]
        pub enum Statement {
            $(#[doc = $about] $statement,)*
        }

        impl Statement {
            const fn about(self) -> &'static str {
                [$($about),*][self as usize]
            }

            const fn rule(self) -> &'static str {
                [$($rule),*][self as usize]
            }
        }
    };
}

const SAME: &str = "the same";
const FIGURE_RULE: &str =
    "the interval within the range and half of its last digit, at every density";

statements! {
    Grid "grid of streets": SAME;
    Crossings "sidewalks, and crossings near intersections only": "nobody is on a road farther than 20 m from an intersection";
    Mobility "people and vehicles are moved by": "SUMO, which this program ran itself; what a file says is no proof";
    NetworkStack "the network is simulated by": SAME;
    Vehicles "vehicles": SAME;
    Pedestrians "pedestrians": SAME;
    Radii "sensing radii in m": SAME;
    CentralIntersection "intersection of a single robot": "the same, counted from 1";
    EveryIntersection "intersections of 9 robots": SAME;
    StaticRobots "robots": SAME;
    SameRoutes "time that all people travel together, by density": "the same in every cell of a density";
    Equipped "people with a device": SAME;
    Power "transmission power": "within 1 %";
    Frequency "carrier frequency, by the path loss at 1 m": "within 1 %";
    Bandwidth "width of the channel": "80 samples a symbol (IEEE 802.11, clause 17), of 8 us here";
    Access "access to the channel": "stations contend for the channel";
    DataRate "data rate": "the default of the 10 MHz channel";
    CoverageOfNone "coverage without robots": "exactly";
    CoverageOfOne "coverage, 1 robot, 15 m, all densities": FIGURE_RULE;
    CoverageOfNine "coverage, 9 robots, 15 m, all densities": FIGURE_RULE;
    CoverageAtIntersections "share of the covered time at intersections, all cells": "more than half of it within 20 m of an intersection's middle";
    ProportionalDecrease "coverage at 10 m by that at 15 m, all cells": "every ratio within a fifth of that of the radii";
    SeveralAreBetter "several robots cover more than one": "9 robots above 1 robot in every cell";
    LowLoad "mean channel busy ratio, all cells": "below 30 %, where congestion control (TS 102 687) holds nobody back";
    ConsistentReduction "reduction by robots, all cells": "above 0 in every cell";
    GrowsWithDensity "reduction at 15 m with 20, 50, 100, by 1 and by 9 robots": "each above the one before";
    LargestReduction "largest reduction: 9 robots, 100 pedestrians, 15 m": "above all other cells, and the interval within half of the last digit";
    SmallerRadius "reduction at 10 m and at 15 m, all cells": "at 10 m above 0 and below that at 15 m, in every cell";
    DiminishingGain "reduction of 9 robots by that of 1, 15 m": "more than once and less than nine times that of one robot";
    LargerRadiusStandsForMore "silent devices at 10 m and at 15 m, all cells": "more at 15 m, in every cell";
    SmallerRadiusSendsLess "RAM per second at 10 m and at 15 m, all cells": "fewer at 10 m, in every cell";
    ConservativeSilence "share of the silence of devices that no robot perceives": "at most 5 %, in every cell";
    UnchangedDevices "devices": "devices understand nothing but ETSI's messages";
}

/// Outcome of a comparison with a statement.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Outcome {
    /// The run meets it.
    Met,
    /// It does not.
    NotMet,
    /// The confidence interval is on both sides: more seeds decide it.
    Undecided,
    /// The run does not have what it is about.
    NotMeasured,
    /// The paper does not state it; it is assumed here.
    Assumed,
}

impl Outcome {
    const fn of(is_met: bool) -> Self {
        if is_met { Self::Met } else { Self::NotMet }
    }

    /// Outcome of all of these: one that is not met decides, and then one that is undecided.
    fn all(all: impl IntoIterator<Item = Self>) -> Self {
        all.into_iter()
            .fold(Self::Met, |one, other| match (one, other) {
                (Self::NotMet, _) | (_, Self::NotMet) => Self::NotMet,
                (Self::Undecided, _) | (_, Self::Undecided) => Self::Undecided,
                _ => Self::Met,
            })
    }

    fn above(it: &Estimate, bound: f64) -> Self {
        match it.ci95 {
            [least, _] if least > bound => Self::Met,
            [_, most] if most <= bound => Self::NotMet,
            _ => Self::Undecided,
        }
    }

    fn below(it: &Estimate, bound: f64) -> Self {
        match it.ci95 {
            [_, most] if most < bound => Self::Met,
            [least, _] if least >= bound => Self::NotMet,
            _ => Self::Undecided,
        }
    }

    fn within(it: &Estimate, range: StatedRange) -> Self {
        let (least, most) = (range.least - range.rounding, range.most + range.rounding);
        match it.ci95 {
            [from, to] if least <= from && to <= most => Self::Met,
            [from, to] if to < least || most < from => Self::NotMet,
            _ => Self::Undecided,
        }
    }

    /// In words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::NotMet => "not met",
            Self::Undecided => "undecided",
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
    /// Its subject.
    pub about: &'static str,
    /// The paper's value, in words.
    pub paper: String,
    /// The measured value, in words.
    pub measured: String,
    /// Rule of the comparison, in words.
    pub rule: &'static str,
    /// The outcome.
    pub outcome: Outcome,
}

/// Setting of a run.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// The streets.
    pub streets: &'a Streets,
    /// Whether this program knows what moved everybody ([`Traces::is_proven`](super::trace::Traces::is_proven)).
    pub is_proven: bool,
    /// Vehicles, by run: one number where it is the same in all.
    pub vehicles: &'a [usize],
    /// The parameters that vary.
    pub axes: &'a Axes,
    /// How stations behave, where there are any.
    pub behaviour: Option<&'a Behaviour>,
}

impl Statement {
    fn with(self, paper: &dyn Display, measured: &dyn Display, outcome: Outcome) -> Comparison {
        Comparison {
            statement: self,
            about: self.about(),
            paper: paper.to_string(),
            measured: measured.to_string(),
            rule: self.rule(),
            outcome,
        }
    }

    fn compare(self, paper: &dyn Display, measured: &dyn Display, is_met: bool) -> Comparison {
        self.with(paper, measured, Outcome::of(is_met))
    }

    /// A comparison by what was measured, if it was.
    fn judge<T>(
        self,
        paper: &dyn Display,
        measured: Option<T>,
        judge: impl Fn(T) -> (String, Outcome),
    ) -> Comparison {
        match measured.map(judge) {
            Some((words, outcome)) => self.with(paper, &words, outcome),
            None => self.with(paper, &"-", Outcome::NotMeasured),
        }
    }
}

/// An estimate for each of the paper's densities, if there is one for all.
fn over_densities(at: impl Fn(usize) -> Option<Estimate>) -> Option<Vec<Estimate>> {
    PAPER.pedestrians.into_iter().map(at).collect()
}

/// The values of all these keys in a row, if each has some.
fn all_of<K: Copy, T, I: IntoIterator<Item = T>>(
    keys: &[K],
    of: impl Fn(K) -> Option<I>,
) -> Option<Vec<T>> {
    let all: Option<Vec<I>> = keys.iter().map(|key| of(*key)).collect();
    Some(all?.into_iter().flatten().collect())
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}
