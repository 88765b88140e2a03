//! Probabilities of transitions, as products that hold for every loss rate.
//!
//! Which states there are and which follow which does not depend on the loss rate. So a transition keeps how often
//! something is lost, arrives, or a channel changes in it, and one set of states serves all loss rates.

use super::setup::OddsSetup;
use crate::numbered::Numbered;

/// How often what happens in one transition.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Chances {
    /// Messages that are lost, or links that are bad at first.
    pub(super) lost: u8,
    /// Messages that arrive, or links that are good at first.
    pub(super) arrived: u8,
    pub(super) worsened: u8,
    pub(super) stayed_good: u8,
    pub(super) improved: u8,
    pub(super) stayed_bad: u8,
}

impl Chances {
    fn probability(self, odds: &LinkOdds) -> f64 {
        let power = |base: f64, exponent: u8| base.powi(i32::from(exponent));
        power(odds.loss, self.lost)
            * power(1.0 - odds.loss, self.arrived)
            * power(odds.worsens, self.worsened)
            * power(1.0 - odds.worsens, self.stayed_good)
            * power(odds.improves, self.improved)
            * power(1.0 - odds.improves, self.stayed_bad)
    }
}

/// The probabilities of single events on a link.
struct LinkOdds {
    loss: f64,
    worsens: f64,
    improves: f64,
}

impl LinkOdds {
    /// Of a link that loses this share of messages. The chain of a bursty one has `loss` as its stationary
    /// probability to be bad, and leaves a burst after its mean length.
    fn new(setup: &OddsSetup, loss: f64) -> Self {
        let Some(burst) = setup.burst else {
            return Self {
                loss,
                worsens: 0.0,
                improves: 0.0,
            };
        };
        let improves = f64::from(setup.grid().tick.0) / f64::from(burst.0);
        Self {
            loss,
            worsens: improves * loss / (1.0 - loss),
            improves,
        }
    }
}

/// The products that occur, each once, by number.
#[derive(Default)]
pub(super) struct ChanceTable(Numbered<Chances>);

impl ChanceTable {
    /// The number of a product. Panics beyond 65,536, which the few messages and links of a tick cannot make up.
    pub(super) fn number(&mut self, chances: Chances) -> u16 {
        u16::try_from(self.0.add(chances)).expect("fewer than 65,536 products")
    }

    pub(super) const fn len(&self) -> usize {
        self.0.len()
    }

    /// The probability of each product at this loss rate, by number.
    pub(super) fn at(&self, setup: &OddsSetup, loss: f64) -> Vec<f64> {
        let odds = LinkOdds::new(setup, loss);
        let products = self.0.values().iter();
        products.map(|product| product.probability(&odds)).collect()
    }
}
