//! What was computed once.

use std::hash::{BuildHasher, Hash};
use std::sync::OnceLock;

use rustc_hash::FxBuildHasher;

use crate::lookup::Lookup;

/// A growing table of results by what they are of, for all threads. A result never changes.
pub(crate) struct Memo<K, V> {
    results: boxcar::Vec<(K, V)>,
    lookup: Lookup,
}

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self {
            results: boxcar::Vec::new(),
            lookup: Lookup::default(),
        }
    }
}

impl<K: Eq + Hash, V> Memo<K, V> {
    /// The result, where it is known.
    pub(crate) fn get(&self, of: &K) -> Option<&V> {
        let is_it = |number: u32| self.results[number as usize].0 == *of;
        let number = self.lookup.find(FxBuildHasher.hash_one(of), is_it)?;
        Some(&self.results[number as usize].1)
    }

    /// Keeps a result, and returns the one that is kept: another thread may have come first.
    ///
    /// # Panics
    /// When 2^32 results are exceeded, far beyond what fits in memory.
    pub(crate) fn keep(&self, of: K, result: V) -> &V {
        let locked = self.lookup.lock(FxBuildHasher.hash_one(&of));
        let is_it = |number: u32| self.results[number as usize].0 == of;
        let number = locked
            .find(is_it)
            .unwrap_or_else(|| locked.add(self.results.push((of, result))));
        &self.results[number as usize].1
    }
}

/// The same for results of numbers from 0, which are found without hashing.
pub(crate) struct MemoOfNumbers<V>([OnceLock<Box<[OnceLock<V>]>>; BLOCKS]);

/// As many blocks as 2^32 numbers need, each twice as large as the one before it.
const BLOCKS: usize = 27;
const FIRST_BLOCK: u64 = 64;

impl<V> Default for MemoOfNumbers<V> {
    fn default() -> Self {
        Self(std::array::from_fn(|_| OnceLock::new()))
    }
}

impl<V> MemoOfNumbers<V> {
    /// The result of a number, which `compute` computes where it is not known yet.
    pub(crate) fn get_or_compute(&self, number: u32, compute: impl FnOnce() -> V) -> &V {
        let shifted = u64::from(number) + FIRST_BLOCK;
        let block = (shifted / FIRST_BLOCK).ilog2();
        let len = FIRST_BLOCK << block;
        let results = self.0[block as usize].get_or_init(|| {
            let empty = (0..len).map(|_| OnceLock::new());
            empty.collect()
        });
        let at = usize::try_from(shifted - len).expect("less than 2^32");
        results[at].get_or_init(compute)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_of_a_number_is_computed_once() {
        let memo = MemoOfNumbers::default();
        for number in [0, 1, 63, 64, 191, 192, 1_000_000] {
            assert_eq!(memo.get_or_compute(number, || number), &number);
            assert_eq!(memo.get_or_compute(number, || 5), &number);
        }
    }

    #[test]
    fn the_first_result_is_kept() {
        let memo = Memo::default();
        assert_eq!(memo.get(&1), None);
        assert_eq!(memo.keep(1, 'a'), &'a');
        assert_eq!(memo.keep(1, 'b'), &'a');
        assert_eq!(memo.get(&1), Some(&'a'));
    }
}
