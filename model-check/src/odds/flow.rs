//! Transient analysis: where the probability is at each point of the grid.
//!
//! The whole probability starts in the first states and flows forward, tick by tick. Small shares of it are no longer
//! followed, the smallest first, as many as the width allows that the bounds may have. Their sum is kept: it could be
//! anywhere, so every probability is known to lie between what was counted and that much more.

use super::space::{StageSpace, probability};
use super::stage::{Milestone, Stage};
use super::team::TeamState;
use crate::exploration::Stop;

/// A share of less than this is not followed whatever the width allows: it is below what floating point tells apart
/// in a sum of probabilities.
const NEGLIGIBLE: f64 = 1e-17;

/// After so many ticks half of the width has been allowed, where a stage has no horizon.
const HALF_WIDTH_TICKS: f64 = 30.0;

/// The probabilities of one stage, by tick.
pub(super) struct Flow {
    /// For each milestone of the stage, the probability that it has been reached, at each tick from the first.
    pub(super) reached: Vec<(Milestone, Vec<f64>)>,
    /// The probability that was not followed any further, at each tick.
    pub(super) unknown: Vec<f64>,
    /// The states in which the stage was completed, each with its probability.
    pub(super) completed: Vec<(TeamState, f64)>,
}

/// When an analysis of a stage is over, in ticks.
#[derive(Clone, Copy)]
pub(super) struct FlowLimits {
    /// The last tick that is asked for.
    pub(super) horizon: Option<usize>,
    /// A request that still stands ends then.
    pub(super) help: Option<usize>,
    /// How much of the probability need not be followed.
    pub(super) width: f64,
}

impl FlowLimits {
    /// How much of the probability need not be followed up to this tick.
    #[expect(clippy::cast_precision_loss, reason = "ticks are few")]
    fn allowed(&self, tick: usize) -> f64 {
        let tick = (tick + 1) as f64;
        self.width
            * match self.horizon {
                Some(horizon) => tick / (horizon + 1) as f64,
                None => 1.0 - (-tick / HALF_WIDTH_TICKS).exp2(),
            }
    }
}

/// The share up to which all shares together come to no more than `allowed`, to a power of two.
fn threshold(shares: &[(u32, f64)], allowed: f64) -> f64 {
    const POWERS: i32 = 64;
    let mut sums = [0.0; POWERS as usize];
    for (_, share) in shares {
        // A share of up to 2^-k is in the sum of k.
        let power = -share.log2();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is within the powers"
        )]
        let power = power.clamp(0.0, f64::from(POWERS - 1)) as usize;
        sums[power] += share;
    }
    let (mut sum, mut threshold) = (0.0, NEGLIGIBLE);
    for (power, of_power) in (0..POWERS).zip(sums).rev() {
        sum += of_power;
        if sum > allowed {
            break;
        }
        threshold = 2.0_f64.powi(-power);
    }
    threshold.max(NEGLIGIBLE)
}

/// The most states that a stage may have: they take about 200 bytes each.
const STATES_MAX: usize = 12_000_000;

/// Why an analysis was given up.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum FlowCut {
    /// The caller asked to stop.
    #[error("it was told to stop before it was done")]
    Stopped,
    /// There are too many states.
    #[error(
        "the stage has more than {0} states: with bounds that are farther apart, links one at a time, fewer followers or \
         lower loss rates there are fewer"
    )]
    TooLarge(usize),
}

/// The probability of each state, by its number.
#[derive(Default)]
struct Mass {
    of: Vec<f64>,
    states: Vec<u32>,
}

impl Mass {
    fn add(&mut self, state: u32, mass: f64) {
        let at = state as usize;
        if self.of.len() <= at {
            self.of.resize(at + 1, 0.0);
        }
        if self.of[at] == 0.0 && mass > 0.0 {
            self.states.push(state);
        }
        self.of[at] += mass;
    }

    fn drain(&mut self) -> Vec<(u32, f64)> {
        let states = std::mem::take(&mut self.states);
        let taken = states.into_iter().map(|state| {
            let mass = std::mem::take(&mut self.of[state as usize]);
            (state, mass)
        });
        taken.collect()
    }
}

/// Lets the probability flow from `start`, at this loss rate, until it has come to an end or to the horizon.
pub(super) fn flow(
    space: &mut StageSpace<'_>,
    loss: f64,
    start: &[(u32, f64)],
    limits: FlowLimits,
    stop: &Stop,
) -> Result<Flow, FlowCut> {
    let milestones: Vec<Milestone> = space.stage.milestones().collect();
    let mut found = Flow {
        reached: milestones
            .iter()
            .map(|&milestone| (milestone, Vec::new()))
            .collect(),
        unknown: Vec::new(),
        completed: Vec::new(),
    };
    let mut here = Mass::default();
    for &(state, mass) in start {
        here.add(state, mass);
    }
    let (mut over, mut completed) = (vec![0.0; milestones.len()], Mass::default());
    let (mut unknown, mut products) = (0.0, space.probabilities(loss));
    for tick in 0.. {
        let mut going = Vec::new();
        let mut reached = vec![0.0; milestones.len()];
        for (state, mass) in here.drain() {
            let marks = space.marks(state);
            let is_over = space.ends(state);
            let sums = if is_over { &mut over } else { &mut reached };
            for (sum, &milestone) in sums.iter_mut().zip(&milestones) {
                *sum += if marks.has(milestone) { mass } else { 0.0 };
            }
            if is_over {
                if !marks.has_failed() && space.stage != Stage::Holding {
                    completed.add(state, mass);
                }
            } else {
                going.push((state, mass));
            }
        }
        let threshold = threshold(&going, limits.allowed(tick) - unknown);
        going.retain(|(_, share)| {
            let is_followed = *share > threshold;
            unknown += if is_followed { 0.0 } else { *share };
            is_followed
        });
        for (((_, curve), over), now) in found.reached.iter_mut().zip(&over).zip(&reached) {
            curve.push(over + now);
        }
        found.unknown.push(unknown);
        if going.is_empty() || limits.horizon == Some(tick) {
            break;
        }
        if stop.is_requested() {
            return Err(FlowCut::Stopped);
        }
        if space.states() > STATES_MAX {
            return Err(FlowCut::TooLarge(STATES_MAX));
        }
        for (state, mass) in going {
            // The request ends with the next tick, before anything arrives in it.
            if limits.help == Some(tick + 1) && space.model.is_requesting(space.state(state)) {
                continue;
            }
            // Ways that are only now worked out may bring new products.
            let _ = space.arcs(state);
            if space.chances.len() > products.len() {
                products = space.probabilities(loss);
            }
            for arc in space.arcs(state) {
                here.add(arc.to, mass * probability(*arc, &products));
            }
        }
    }
    found.completed = completed
        .drain()
        .into_iter()
        .map(|(state, mass)| (space.state(state).clone(), mass))
        .collect();
    Ok(found)
}
