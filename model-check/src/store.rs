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

use std::hash::Hash;

use crate::model::{Backdrop, ModelState};
use crate::numbered::Numbered;
use crate::scenario::MAX_ROBOTS;

type Pairs = Numbered<(u32, u32)>;

/// States with numbers from 0, in the order in which they were added.
pub(crate) trait Store<T>: Default + Send + Sync {
    fn len(&self) -> usize;

    /// The number of a state, if it was added, before [`Store::freeze`].
    fn find(&self, state: &T) -> Option<u32>;

    /// The number of a state, a new one where it was not added before. Panics where 2^32 states are there.
    fn add(&mut self, state: T) -> u32;

    fn get(&self, number: u32) -> T;

    /// Gives memory back: nothing is added or looked for any more.
    fn freeze(&mut self);
}

/// Each state as it is.
impl<T: Clone + Eq + Hash + Send + Sync> Store<T> for Numbered<T> {
    fn len(&self) -> usize {
        Self::len(self)
    }

    fn find(&self, state: &T) -> Option<u32> {
        Self::find(self, state)
    }

    fn add(&mut self, state: T) -> u32 {
        Self::add(self, state)
    }

    fn get(&self, number: u32) -> T {
        Self::get(self, number).clone()
    }

    fn freeze(&mut self) {
        Self::freeze(self);
    }
}

/// States of the untimed model, compressed.
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

impl Store<ModelState> for States {
    fn len(&self) -> usize {
        self.whole.len()
    }

    fn find(&self, state: &ModelState) -> Option<u32> {
        let (robots, backdrop) = state.parts();
        let pair = |i: usize| self.robots[i].find(&(robots[2 * i], robots[2 * i + 1]));
        let front = self.front.find(&(pair(0)?, pair(1)?))?;
        let backdrop = self.backdrop.find(&backdrop)?;
        let back = self.back.find(&(pair(2)?, backdrop))?;
        self.whole.find(&(front, back))
    }

    fn add(&mut self, state: ModelState) -> u32 {
        let (robots, backdrop) = state.parts();
        let mut pair = |i: usize| self.robots[i].add((robots[2 * i], robots[2 * i + 1]));
        let pairs: [u32; PAIRS] = std::array::from_fn(&mut pair);
        let front = self.front.add((pairs[0], pairs[1]));
        let backdrop = self.backdrop.add(backdrop);
        let back = self.back.add((pairs[2], backdrop));
        self.whole.add((front, back))
    }

    fn get(&self, number: u32) -> ModelState {
        let (front, back) = *self.whole.get(number);
        let (back, backdrop) = *self.back.get(back);
        let (first, second) = *self.front.get(front);
        let mut robots = [0; MAX_ROBOTS];
        for (i, pair) in [first, second, back].into_iter().enumerate() {
            (robots[2 * i], robots[2 * i + 1]) = *self.robots[i].get(pair);
        }
        ModelState::of_parts(robots, *self.backdrop.get(backdrop))
    }

    fn freeze(&mut self) {
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
        let found: Vec<_> = model.reachable().take(2_000).collect();
        let mut states = States::default();
        let numbers: Vec<u32> = (0..).take(found.len()).collect();
        for _ in 0..2 {
            let added = found.iter().map(|state| states.add(state.clone()));
            assert!(added.eq(numbers.iter().copied()));
        }
        assert!(states.len() > 100 && states.front.len() < states.len());
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
