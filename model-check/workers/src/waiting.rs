//! States that wait to be expanded, in half the memory that they take as they are.

use crossguard_model_check::model::ModelState;

use crate::table::Hint;

/// A state that waits, with the hint at it.
pub(crate) type Waiting = (ModelState, Hint);

/// How many states are kept as they are.
const OPEN: usize = 1 << 15;

/// States in no order that matters. All but the last ones are written down in about half the octets.
#[derive(Default)]
pub(crate) struct Queue {
    open: Vec<Waiting>,
    written: Vec<Box<[u8]>>,
}

impl Queue {
    pub(crate) fn push(&mut self, state: Waiting) {
        self.open.push(state);
        if self.open.len() == OPEN {
            let written = postcard::to_allocvec(&self.open).expect("states can be written");
            self.written.push(written.into());
            self.open.clear();
        }
    }

    pub(crate) fn pop(&mut self) -> Option<Waiting> {
        if self.open.is_empty()
            && let Some(written) = self.written.pop()
        {
            self.open = postcard::from_bytes(&written).expect("it was written here");
        }
        self.open.pop()
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.open.is_empty() && self.written.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use crossguard_model_check::model::Model;
    use crossguard_model_check::scenario::Scenario;

    use super::*;
    use crate::table::Fingerprint;

    #[test]
    fn what_is_pushed_is_popped_once() {
        let state = Model::new(Scenario::load("stable").unwrap()).initial();
        let count = u32::try_from(3 * OPEN + 5).unwrap();
        let hint = |n: u32| Fingerprint::of(u128::from(n + 1) << 68).hint();
        let mut queue = Queue::default();
        for n in 0..count {
            queue.push((state.clone(), hint(n)));
        }
        assert_eq!(queue.written.len(), 3);
        let mut popped: Vec<_> = std::iter::from_fn(|| queue.pop()).collect();
        popped.sort_by_key(|(_, hint)| *hint);
        let pushed: Vec<_> = (0..count).map(|n| (state.clone(), hint(n))).collect();
        assert!(popped == pushed && queue.is_empty());
    }

    #[test]
    fn written_states_take_less_memory() {
        let state = Model::new(Scenario::load("stable").unwrap()).initial();
        let mut queue = Queue::default();
        for _ in 0..OPEN {
            queue.push((state.clone(), Fingerprint::of(u128::MAX).hint()));
        }
        let octets: usize = queue.written.iter().map(|written| written.len()).sum();
        assert!(octets * 3 < 2 * OPEN * size_of::<Waiting>());
    }
}
