//! A discrete-time Markov chain with all its states, and what is asked of it without a limit of time.
//!
//! Probabilities and expected numbers of steps are found by interval iteration: one sequence grows from below, one
//! falls from above, and the answer is between them at every moment. That states from which the goal cannot be
//! reached are known by the graph makes the upper one come down to it.

use super::enclosure::Enclosure;

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

/// How far an iteration goes: until the bounds are this close, or for this many sweeps.
#[derive(Clone, Copy, Debug)]
pub struct Iteration {
    /// How far apart the bounds may be in the end.
    pub width: f64,
    /// How many sweeps over all states there may be.
    pub sweeps: usize,
}

impl Default for Iteration {
    fn default() -> Self {
        Self {
            width: 1e-9,
            sweeps: 100_000,
        }
    }
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

    /// The probability that a state with this label is ever reached.
    #[must_use]
    pub fn ever(&self, label: usize, iteration: Iteration) -> Enclosure {
        let can = self.can_reach(|state| self.has(state, label));
        let is_goal = |state: usize| self.has(state, label);
        let start = |of_others: f64| -> Vec<f64> {
            let value = |state| match (is_goal(state), can[state]) {
                (true, _) => 1.0,
                (false, true) => of_others,
                (false, false) => 0.0,
            };
            (0..self.states()).map(value).collect()
        };
        let open: Vec<usize> = (0..self.states())
            .filter(|&state| can[state] && !is_goal(state))
            .collect();
        let (mut lower, mut upper) = (start(0.0), start(1.0));
        for _ in 0..iteration.sweeps {
            self.sweep(&open, &mut lower, 0.0);
            self.sweep(&open, &mut upper, 0.0);
            if upper[0] - lower[0] <= iteration.width {
                break;
            }
        }
        Enclosure::probability(lower[0], upper[0])
    }

    /// The expected number of steps until the chain stays where it is; `None` where it may go on for ever, or where
    /// no upper bound was found in time.
    #[must_use]
    pub fn expected_steps(&self, iteration: Iteration) -> Option<Enclosure> {
        let can = self.can_reach(|state| self.is_absorbing(state));
        if can.contains(&false) {
            return None;
        }
        let open: Vec<usize> = (0..self.states())
            .filter(|&state| !self.is_absorbing(state))
            .collect();
        let most = self.most_steps(&open, iteration)?;
        let start = |value: f64| {
            let of = |state| if self.is_absorbing(state) { 0.0 } else { value };
            (0..self.states()).map(of).collect::<Vec<f64>>()
        };
        let (mut lower, mut upper) = (start(0.0), start(most));
        for _ in 0..iteration.sweeps {
            self.sweep(&open, &mut lower, 1.0);
            self.sweep(&open, &mut upper, 1.0);
            if upper[0] - lower[0] <= iteration.width {
                break;
            }
        }
        Some(Enclosure {
            lower: lower[0],
            upper: upper[0],
        })
    }

    /// A number of steps that is at least the expected one from every state. If from each state the chain goes on
    /// for more than k steps with at most probability 1/2, it takes no more than 2k steps on average.
    fn most_steps(&self, open: &[usize], iteration: Iteration) -> Option<f64> {
        let mut goes_on = vec![0.0; self.states()];
        for &state in open {
            goes_on[state] = 1.0;
        }
        let mut steps = 0.0;
        for _ in 0..iteration.sweeps {
            steps += 1.0;
            let mut next = vec![0.0; self.states()];
            for &state in open {
                let row = self.row(state).iter();
                next[state] = row.map(|&(to, p)| p * goes_on[to as usize]).sum();
            }
            goes_on = next;
            if goes_on.iter().all(|&probability| probability <= 0.5) {
                return Some(2.0 * steps);
            }
        }
        None
    }

    /// Improves the values of these states in place, the last one first: states are numbered as they are found, so
    /// most transitions lead to later ones.
    fn sweep(&self, open: &[usize], values: &mut [f64], reward: f64) {
        for &state in open.iter().rev() {
            let row = self.row(state).iter();
            values[state] = reward + row.map(|&(to, p)| p * values[to as usize]).sum::<f64>();
        }
    }

    /// From which states a goal can be reached at all.
    fn can_reach(&self, is_goal: impl Fn(usize) -> bool) -> Vec<bool> {
        let mut can: Vec<bool> = (0..self.states()).map(is_goal).collect();
        loop {
            let mut has_changed = false;
            for state in (0..self.states()).rev() {
                let leads = |&(to, p): &(u32, f64)| p > 0.0 && can[to as usize];
                if !can[state] && self.row(state).iter().any(leads) {
                    can[state] = true;
                    has_changed = true;
                }
            }
            if !has_changed {
                return can;
            }
        }
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

    fn is_close(enclosure: Enclosure, value: f64) -> bool {
        enclosure.lower - 1e-12 <= value
            && value <= enclosure.upper + 1e-12
            && enclosure.width() < 1e-8
    }

    #[test]
    fn a_repeated_message_arrives_as_the_geometric_series_says() {
        for loss in [0.0, 0.1, 0.5, 0.9] {
            let chain = repeated(loss, 4);
            for steps in 0..=4_u8 {
                let by_hand = 1.0 - loss.powi(i32::from(steps));
                assert!((chain.within(0, steps.into()) - by_hand).abs() < 1e-12);
            }
            let ever = chain.ever(0, Iteration::default());
            assert!(is_close(ever, 1.0 - loss.powi(4)), "{loss}: {ever}");
            // 1 + p + p^2 + p^3 tries.
            let tries = 1.0 + loss + loss.powi(2) + loss.powi(3);
            let expected = chain.expected_steps(Iteration::default()).unwrap();
            assert!(is_close(expected, tries), "{loss}: {expected}");
        }
    }

    #[test]
    fn a_message_that_is_repeated_for_ever_takes_the_inverse_of_its_chance() {
        let mut chain = MarkovChain::new(vec!["arrived".to_owned()]);
        chain.push(0, [(0, 0.75), (1, 0.25)]);
        chain.push(1, []);
        assert!(is_close(chain.ever(0, Iteration::default()), 1.0));
        let expected = chain.expected_steps(Iteration::default()).unwrap();
        assert!(is_close(expected, 4.0), "{expected}");
    }

    #[test]
    fn a_gambler_is_ruined_as_often_as_the_closed_form_says() {
        // From 2 of 5, a step up with probability 0.4.
        let order = [2_u32, 1, 3, 4, 0, 5];
        let at =
            |money: u32| u32::try_from(order.iter().position(|it| *it == money).unwrap()).unwrap();
        let mut chain = MarkovChain::new(vec!["rich".to_owned()]);
        for money in order {
            match money {
                0 => chain.push(0, []),
                5 => chain.push(1, []),
                _ => chain.push(0, [(at(money + 1), 0.4), (at(money - 1), 0.6)]),
            }
        }
        let ratio: f64 = 0.6 / 0.4;
        let rich = (1.0 - ratio.powi(2)) / (1.0 - ratio.powi(5));
        assert!(is_close(chain.ever(0, Iteration::default()), rich));
        let steps = (2.0 - 5.0 * rich) / (0.6 - 0.4);
        let expected = chain.expected_steps(Iteration::default()).unwrap();
        assert!(is_close(expected, steps), "{expected} and not {steps}");
    }

    #[test]
    fn the_bounds_are_bounds_after_few_sweeps_too() {
        let mut chain = MarkovChain::new(vec!["arrived".to_owned()]);
        chain.push(0, [(0, 0.9), (1, 0.05), (2, 0.05)]);
        chain.push(1, []);
        chain.push(0, []);
        for sweeps in 1..30 {
            let few = Iteration { width: 0.0, sweeps };
            let ever = chain.ever(0, few);
            assert!(ever.lower <= 0.5 && 0.5 <= ever.upper, "{sweeps}: {ever}");
            if let Some(expected) = chain.expected_steps(few) {
                assert!(
                    expected.lower <= 10.0 && 10.0 <= expected.upper,
                    "{sweeps}: {expected}"
                );
            }
        }
    }

    #[test]
    fn a_chain_that_never_rests_has_no_expected_end() {
        let mut chain = MarkovChain::new(vec![]);
        chain.push(0, [(1, 0.5), (2, 0.5)]);
        chain.push(0, []);
        chain.push(0, [(3, 1.0)]);
        chain.push(0, [(2, 1.0)]);
        assert_eq!(chain.expected_steps(Iteration::default()), None);
    }
}
