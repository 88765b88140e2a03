//! A discrete-time Markov chain with all its states.

/// A discrete-time Markov chain. State 0 is the first one.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct MarkovChain {
    /// Where the transitions of each state begin; one entry more than there are states.
    offsets: Vec<usize>,
    transitions: Vec<(u32, f64)>,
    label_names: Vec<String>,
    /// One bit for each label that a state has.
    labels: Vec<u8>,
}

impl MarkovChain {
    /// A chain without states, whose states may have these labels.
    ///
    /// # Panics
    /// When there are more than eight labels.
    #[must_use]
    pub fn new(label_names: Vec<String>) -> Self {
        assert!(label_names.len() <= 8, "at most eight labels");
        Self {
            offsets: vec![0],
            label_names,
            ..Self::default()
        }
    }

    /// Adds a state with one bit for each of its labels, and its transitions: to which state, with which
    /// probability. Those of a state come to 1 together; no transitions at all are one to itself.
    ///
    /// # Panics
    /// When 2^32 states are exceeded, far beyond what fits in memory.
    pub fn push(&mut self, labels: u8, transitions: impl IntoIterator<Item = (u32, f64)>) {
        let from = self.transitions.len();
        self.transitions.extend(transitions);
        let state = u32::try_from(self.labels.len()).expect("fewer than 2^32 states");
        if self.transitions.len() == from {
            self.transitions.push((state, 1.0));
        }
        self.offsets.push(self.transitions.len());
        self.labels.push(labels);
    }

    /// How many states it has.
    #[must_use]
    pub fn states(&self) -> usize {
        self.labels.len()
    }

    /// How many transitions it has.
    #[must_use]
    pub fn transitions(&self) -> usize {
        self.transitions.len()
    }

    /// The names of the labels.
    #[must_use]
    pub fn label_names(&self) -> &[String] {
        &self.label_names
    }

    /// The transitions of a state.
    #[must_use]
    pub fn row(&self, state: usize) -> &[(u32, f64)] {
        &self.transitions[self.offsets[state]..self.offsets[state + 1]]
    }

    /// Whether a state has the label of this number.
    #[must_use]
    pub fn has(&self, state: usize, label: usize) -> bool {
        self.labels[state] & 1 << label != 0
    }

    /// Whether the chain stays in a state for ever.
    #[must_use]
    pub fn is_absorbing(&self, state: usize) -> bool {
        self.row(state).iter().all(|&(to, _)| to as usize == state)
    }

    /// The probability that a state with this label is reached within so many steps.
    #[must_use]
    pub fn within(&self, label: usize, steps: usize) -> f64 {
        let mut here = vec![0.0; self.states()];
        here[0] = 1.0;
        let mut reached = 0.0;
        for step in 0..=steps {
            for (state, mass) in here.iter_mut().enumerate() {
                if self.has(state, label) {
                    reached += std::mem::take(mass);
                }
            }
            if step == steps {
                break;
            }
            let mut next = vec![0.0; self.states()];
            for (state, mass) in here.iter().enumerate().filter(|(_, mass)| **mass > 0.0) {
                for &(to, probability) in self.row(state) {
                    next[to as usize] += mass * probability;
                }
            }
            here = next;
        }
        reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A message that is repeated up to `tries` times and lost with this probability each time: the state after so
    /// many tries, then lost for good, then arrived.
    fn repeated(loss: f64, tries: u32) -> MarkovChain {
        let mut chain = MarkovChain::new(vec!["arrived".to_owned()]);
        for attempt in 0..tries {
            chain.push(0, [(attempt + 1, loss), (tries + 1, 1.0 - loss)]);
        }
        chain.push(0, []);
        chain.push(1, []);
        chain
    }

    #[test]
    fn a_repeated_message_arrives_as_the_geometric_series_says() {
        for loss in [0.0, 0.1, 0.5, 0.9] {
            let chain = repeated(loss, 4);
            for steps in 0..=4_u8 {
                let by_hand = 1.0 - loss.powi(i32::from(steps));
                assert!((chain.within(0, steps.into()) - by_hand).abs() < 1e-12);
            }
        }
    }
}
