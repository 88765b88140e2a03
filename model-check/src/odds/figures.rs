//! Results of an analysis, for people and programs.

use crossguard_protocol::Millis;
use serde::Serialize;

use super::enclosure::Enclosure;
use super::flow::Flow;
use super::setup::TimeGrid;
use super::stage::{Milestone, Stage};

/// How many states and ways between them a stage has, as far as they were needed for all loss rates together.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct StageSize {
    /// The stage.
    pub stage: Stage,
    /// How many states.
    pub states: usize,
    /// How many different ways from one to another.
    pub transitions: usize,
}

/// Odds of a team at one loss rate.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LossOdds {
    /// The share of messages that get lost.
    pub loss: f64,
    /// The probability that from the detection on a team is gathered, the corridor opens and does not close before
    /// the maneuver is over.
    pub crossing: Enclosure,
    /// The milestones that can be reached, each from the beginning of its stage. There are none of stages that do
    /// not begin with any probability that is worth following.
    pub milestones: Vec<MilestoneOdds>,
    /// The probability that was too small to be followed: how far all bounds are apart at most.
    pub not_followed: f64,
}

/// When a milestone is reached, if it is, counted from the beginning of its stage.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MilestoneOdds {
    /// The milestone.
    pub milestone: Milestone,
    /// The stage from whose beginning time and probability count.
    pub stage: Stage,
    /// The probability that it is reached at all; in the stage `holding`, before the maneuver is over.
    pub probability: Enclosure,
    /// The time that it takes on average where it is reached, in ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_ms: Option<Enclosure>,
    /// The standard deviation of that time, in ms, without the probability that was not followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deviation_ms: Option<f64>,
    /// By when it is reached with this probability; `None` where it never is.
    pub quantiles: Vec<Quantile>,
    /// The probability that it has been reached, at each point of the grid from the first at which there is one
    /// to the last at which it changes.
    pub distribution: Vec<ReachedBy>,
}

/// A time by which a milestone is reached with some probability.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Quantile {
    /// The probability.
    pub probability: f64,
    /// The first point of the grid at which it is reached with that probability, in ms.
    pub ms: Option<u64>,
}

/// The probability that a milestone has been reached by some time.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct ReachedBy {
    /// The time, in ms.
    pub ms: u64,
    /// The probability.
    #[serde(flatten)]
    pub probability: Enclosure,
}

/// Bounds of the probability that a stage begins.
#[derive(Clone, Copy)]
pub(super) struct Beginning {
    /// The probability that the stage begins, as far as it was followed.
    pub(super) mass: f64,
    /// The probability that was not followed before.
    pub(super) unknown: f64,
}

impl Beginning {
    /// The bounds of the probability of something in the stage, given that it begins: of that `counted` was counted
    /// and `unknown` not followed in the stage. A run that was not followed before may begin the stage or not.
    fn given(self, counted: f64, unknown: f64) -> Enclosure {
        let all = self.mass + self.unknown;
        let upper = ((counted + unknown) / self.mass).max((counted + unknown + self.unknown) / all);
        Enclosure::probability(counted / all, upper)
    }
}

/// Parameters of all figures of a stage.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) grid: TimeGrid,
    /// Nothing is reached later, in the first two stages.
    pub(super) latest: Millis,
    /// How many independent links there are of which one was looked at.
    pub(super) links: u8,
}

/// The probabilities by which times are told.
const QUANTILES: [f64; 5] = [0.5, 0.9, 0.99, 0.999, 0.9999];

impl MilestoneOdds {
    pub(super) fn of(
        milestone: Milestone,
        curve: &[f64],
        flow: &Flow,
        beginning: Beginning,
        frame: Frame,
    ) -> Self {
        let stage = milestone.stage();
        let Frame {
            grid,
            latest,
            links,
        } = frame;
        let at = |tick: usize| {
            let of_one = beginning.given(curve[tick], flow.unknown[tick]);
            if stage == Stage::Holding {
                of_one.complement().all_of(links).complement()
            } else {
                of_one.all_of(links)
            }
        };
        let probability = at(curve.len() - 1);
        let distribution: Vec<ReachedBy> = (0..curve.len())
            .map(|tick| ReachedBy {
                ms: grid.millis(tick),
                probability: at(tick),
            })
            .collect();
        let quantile = |probability| Quantile {
            probability,
            ms: distribution
                .iter()
                .find(|reached| reached.probability.lower >= probability)
                .map(|reached| reached.ms),
        };
        let quantiles = QUANTILES.map(quantile).into();
        // Where the horizon cuts off the distribution, its mean says nothing.
        let moments = (stage != Stage::Holding)
            .then(|| moments(&distribution, probability.width(), latest))
            .flatten();
        Self {
            milestone,
            stage,
            probability,
            mean_ms: moments.map(|(mean, _)| mean),
            deviation_ms: moments.map(|(_, deviation)| deviation),
            quantiles,
            distribution: trimmed(distribution),
        }
    }

    /// The probability that it is reached within a time, in ms.
    #[must_use]
    pub fn within(&self, ms: u64) -> Enclosure {
        let before = self
            .distribution
            .iter()
            .rev()
            .find(|reached| reached.ms <= ms);
        let never = Enclosure::probability(0.0, 0.0);
        before.map_or(never, |reached| reached.probability)
    }
}

/// Mean and standard deviation of the time of an event, in ms, given that it happens. In a run that was not
/// followed it may happen at once, or at the latest possible time.
fn moments(distribution: &[ReachedBy], unknown: f64, latest: Millis) -> Option<(Enclosure, f64)> {
    let total = distribution.last().map(|reached| reached.probability.lower);
    let total = total.filter(|total| *total > 0.0)?;
    let (mut first, mut second, mut before) = (0.0, 0.0, 0.0);
    for reached in distribution {
        #[expect(clippy::cast_precision_loss, reason = "a time in ms is far below 2^52")]
        let ms = reached.ms as f64;
        let lower = reached.probability.lower;
        first += ms * (lower - before);
        second += ms * ms * (lower - before);
        before = lower;
    }
    let mean = Enclosure {
        lower: first / (total + unknown),
        upper: (first + unknown * f64::from(latest.0)) / (total + unknown),
    };
    let variance = second / total - (first / total).powi(2);
    Some((mean, variance.max(0.0).sqrt()))
}

/// Without the points before the first chance and after the last change.
fn trimmed(mut distribution: Vec<ReachedBy>) -> Vec<ReachedBy> {
    let first = distribution
        .iter()
        .position(|reached| reached.probability.lower > 0.0);
    let Some(last) = distribution.last().copied() else {
        return distribution;
    };
    let settled = |reached: &ReachedBy| reached.probability == last.probability;
    let end = distribution.iter().position(settled).unwrap_or(0);
    distribution.truncate(end + 1);
    distribution.drain(..first.unwrap_or(end).min(end));
    distribution
}
