//! The states of one stage, numbered in the order in which they are found, with the ways between them.

use super::stage::{Marks, Stage};
use super::team::{TeamModel, TeamState, Ways};
use super::weight::ChanceTable;
use crate::numbered::Numbered;

/// A way from one state to another: so many different ones have the same chances.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Arc {
    pub(super) to: u32,
    pub(super) chances: u16,
    pub(super) times: u16,
}

/// The states of a stage, worked out when they are asked for.
pub(super) struct StageSpace<'a> {
    pub(super) stage: Stage,
    pub(super) model: &'a mut TeamModel,
    states: Numbered<TeamState>,
    /// The ways from each state, once they are worked out.
    arcs: Vec<Option<Box<[Arc]>>>,
    pub(super) chances: ChanceTable,
}

impl<'a> StageSpace<'a> {
    pub(super) fn new(model: &'a mut TeamModel, stage: Stage) -> Self {
        Self {
            stage,
            model,
            states: Numbered::default(),
            arcs: Vec::new(),
            chances: ChanceTable::default(),
        }
    }

    pub(super) const fn states(&self) -> usize {
        self.states.len()
    }

    pub(super) fn transitions(&self) -> usize {
        self.arcs.iter().flatten().map(|arcs| arcs.len()).sum()
    }

    pub(super) fn state(&self, number: u32) -> &TeamState {
        self.states.get(number)
    }

    pub(super) fn marks(&self, number: u32) -> Marks {
        self.state(number).marks
    }

    pub(super) fn ends(&self, number: u32) -> bool {
        self.marks(number).ends(self.stage)
    }

    /// The number of a state, a new one if it was not seen before. Panics beyond 2^32 states, which fit in no memory.
    pub(super) fn number(&mut self, state: TeamState) -> u32 {
        let number = self.states.add(state);
        self.arcs.resize(self.states.len(), None);
        number
    }

    pub(super) fn arcs(&mut self, number: u32) -> &[Arc] {
        if self.arcs[number as usize].is_none() {
            let ways = self.model.ways(self.stage, self.states.get(number));
            self.arcs[number as usize] = Some(self.arcs_of(ways).into());
        }
        self.arcs[number as usize].as_deref().unwrap_or_default()
    }

    fn arcs_of(&mut self, ways: Ways) -> Vec<Arc> {
        let mut row: Vec<Arc> = Vec::with_capacity(ways.len());
        for (chances, state) in ways {
            let (to, chances) = (self.number(state), self.chances.number(chances));
            let same = row
                .iter_mut()
                .find(|arc| (arc.to, arc.chances) == (to, chances));
            match same {
                Some(arc) => arc.times += 1,
                None => row.push(Arc {
                    to,
                    chances,
                    times: 1,
                }),
            }
        }
        row
    }

    /// The states in which all runs begin, with their probabilities at a loss rate.
    pub(super) fn start(&mut self, loss: f64) -> Vec<(u32, f64)> {
        let ways = self.model.start();
        let arcs = self.arcs_of(ways);
        let probabilities = self.probabilities(loss);
        let start = arcs
            .iter()
            .map(|arc| (arc.to, probability(*arc, &probabilities)));
        start.collect()
    }

    /// The states in which this stage begins after those in which the one before it was completed.
    pub(super) fn enter(&mut self, before: &[(TeamState, f64)]) -> Vec<(u32, f64)> {
        let entered = before.iter().map(|(state, mass)| {
            let entered = self.model.enter(self.stage, state);
            (self.number(entered), *mass)
        });
        entered.collect()
    }

    /// The probability of each product of chances at a loss rate. States that are found later may bring new ones.
    pub(super) fn probabilities(&self, loss: f64) -> Vec<f64> {
        self.chances.at(self.model.setup(), loss)
    }
}

/// The probability of a way, where those of the products are these.
pub(super) fn probability(arc: Arc, of_products: &[f64]) -> f64 {
    f64::from(arc.times) * of_products[usize::from(arc.chances)]
}
