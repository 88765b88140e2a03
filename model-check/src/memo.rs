//! Results that are computed once.

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
    /// The number under which a result is kept, where it is known.
    pub(crate) fn find(&self, of: &K) -> Option<u32> {
        let is_it = |number: u32| self.at(number).0 == *of;
        self.lookup.find(FxBuildHasher.hash_one(of), is_it)
    }

    /// Keeps a result, and returns the number of the one that is kept: another thread may have come first.
    /// Panics beyond 2^32 results, which fit in no memory.
    pub(crate) fn add(&self, of: K, result: V) -> u32 {
        let locked = self.lookup.lock(FxBuildHasher.hash_one(&of));
        let known = locked.find(|number| self.at(number).0 == of);
        known.unwrap_or_else(|| locked.add(self.results.push((of, result))))
    }

    /// The key and the result that have a number.
    pub(crate) fn at(&self, number: u32) -> &(K, V) {
        &self.results[number as usize]
    }

    pub(crate) fn get(&self, of: &K) -> Option<&V> {
        Some(&self.at(self.find(of)?).1)
    }

    /// The result, which `compute` computes where it is not known yet.
    pub(crate) fn get_or_compute(&self, of: K, compute: impl FnOnce(&K) -> V) -> &V {
        let number = self.find(&of).unwrap_or_else(|| {
            let result = compute(&of);
            self.add(of, result)
        });
        &self.at(number).1
    }

    /// Keeps a result, and returns the one that is kept.
    pub(crate) fn keep(&self, of: K, result: V) -> &V {
        &self.at(self.add(of, result)).1
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
