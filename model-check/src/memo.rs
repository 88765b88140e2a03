//! What was computed once.

use std::hash::Hash;

use dashmap::DashMap;
use rustc_hash::FxBuildHasher;

/// A growing table of results by what they are of, for all threads. A result never changes.
pub(crate) struct Memo<K, V>(DashMap<K, V, FxBuildHasher>);

impl<K: Eq + Hash, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(DashMap::default())
    }
}

impl<K: Eq + Hash, V: Clone> Memo<K, V> {
    /// The result, where it is known.
    pub(crate) fn get(&self, of: &K) -> Option<V> {
        self.0.get(of).map(|result| result.clone())
    }

    /// Keeps a result, and returns the one that is kept: another thread may have come first.
    pub(crate) fn keep(&self, of: K, result: V) -> V {
        self.0.entry(of).or_insert(result).clone()
    }

    /// All that is known.
    pub(crate) fn all(&self) -> Vec<(K, V)>
    where
        K: Clone,
    {
        let known = self.0.iter();
        let all = known.map(|entry| (entry.key().clone(), entry.value().clone()));
        all.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_result_is_kept() {
        let memo = Memo::default();
        assert_eq!(memo.get(&1), None);
        assert_eq!(memo.keep(1, 'a'), 'a');
        assert_eq!(memo.keep(1, 'b'), 'a');
        assert_eq!(memo.get(&1), Some('a'));
        assert_eq!(memo.all(), [(1, 'a')]);
    }
}
