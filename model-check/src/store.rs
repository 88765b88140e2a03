//! States, each stored once, by sharing of their parts.
//!
//! A state is a row of numbers: of its robots, and of what is around them. Two neighbours are stored as a pair, which has a
//! number itself, and so on up to one pair per state. Parts take far fewer values than there are states, so nearly all
//! memory is that of the last pairs. Nothing is lost: states are equal where their pairs are. This is tree compression
//! (Laarman, van de Pol and Weber, *Parallel Recursive State Compression for Free*, 2011).
//!
//! ```text
//!   robot 0  robot 1   robot 2  robot 3   robot 4  robot 5   backdrop
//!       └─ pair ─┘         └─ pair ─┘         └─ pair ─┘          │
//!            └────── pair ──────┘                  └───── pair ───┘
//!                        └─────────── state ───────────┘
//! ```

use crate::model::{Backdrop, ModelState};
use crate::numbered::Numbered;
use crate::scenario::MAX_ROBOTS;

type Pairs = Numbered<(u32, u32)>;

/// States with numbers from 0, in the order in which they were added.
#[derive(Default)]
pub(crate) struct States {
    backdrop: Numbered<Backdrop>,
    /// Pairs of robots, by their places.
    robots: [Pairs; PAIRS],
    /// Pairs of the first two of these.
    front: Pairs,
    /// Pairs of the last of these with the backdrop.
    back: Pairs,
    whole: Pairs,
}

/// How many pairs of robots there are; the drawing above is about three.
const PAIRS: usize = MAX_ROBOTS / 2;
const _: () = assert!(PAIRS == 3 && MAX_ROBOTS.is_multiple_of(2));

impl States {
    pub(crate) fn len(&self) -> usize {
        self.whole.len()
    }

    /// The number of a state, if it was added, before [`States::freeze`].
    pub(crate) fn find(&self, state: &ModelState) -> Option<u32> {
        let (robots, backdrop) = state.parts();
        let pair = |i: usize| self.robots[i].find(&(robots[2 * i], robots[2 * i + 1]));
        let front = self.front.find(&(pair(0)?, pair(1)?))?;
        let backdrop = self.backdrop.find(&backdrop)?;
        let back = self.back.find(&(pair(2)?, backdrop))?;
        self.whole.find(&(front, back))
    }

    /// The number of a state, a new one where it was not added before.
    ///
    /// # Panics
    /// Where 2^32 states are there.
    pub(crate) fn add(&mut self, state: &ModelState) -> u32 {
        let (robots, backdrop) = state.parts();
        let mut pair = |i: usize| self.robots[i].add((robots[2 * i], robots[2 * i + 1]));
        let pairs: [u32; PAIRS] = std::array::from_fn(&mut pair);
        let front = self.front.add((pairs[0], pairs[1]));
        let backdrop = self.backdrop.add(backdrop);
        let back = self.back.add((pairs[2], backdrop));
        self.whole.add((front, back))
    }

    /// The state of a number.
    pub(crate) fn get(&self, number: u32) -> ModelState {
        let (front, back) = *self.whole.get(number);
        let (back, backdrop) = *self.back.get(back);
        let (first, second) = *self.front.get(front);
        let mut robots = [0; MAX_ROBOTS];
        for (i, pair) in [first, second, back].into_iter().enumerate() {
            (robots[2 * i], robots[2 * i + 1]) = *self.robots[i].get(pair);
        }
        ModelState::of_parts(robots, *self.backdrop.get(backdrop))
    }

    /// Gives memory back: nothing is added or looked for any more.
    pub(crate) fn freeze(&mut self) {
        self.backdrop.freeze();
        for pairs in &mut self.robots {
            pairs.freeze();
        }
        self.front.freeze();
        self.back.freeze();
        self.whole.freeze();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use crate::scenario::Scenario;

    #[test]
    fn a_state_is_what_its_number_says() {
        let model = Model::new(Scenario::load("stable").unwrap());
        let mut found = vec![model.initial()];
        let mut states = States::default();
        let mut at = 0;
        while at < found.len() && found.len() < 2_000 {
            let mut actions = Vec::new();
            model.actions_in(&found[at], &mut actions);
            for action in actions {
                if let Some((next, _)) = model.successor(&found[at], action) {
                    found.push(next);
                }
            }
            at += 1;
        }
        let numbers: Vec<u32> = found.iter().map(|state| states.add(state)).collect();
        assert!(states.len() > 100 && states.len() < found.len());
        assert!(states.front.len() < states.len());
        for (state, &number) in found.iter().zip(&numbers) {
            assert_eq!(
                (states.get(number), states.find(state)),
                (state.clone(), Some(number))
            );
        }
        states.freeze();
        for (state, &number) in found.iter().zip(&numbers) {
            assert_eq!(states.get(number), *state);
        }
    }
}
