//! Values with numbers.

use std::hash::{BuildHasher, Hash};

use hashbrown::HashTable;
use rustc_hash::FxBuildHasher;

/// Values, each stored once, with numbers from 0 in the order in which they were added.
pub(crate) struct Numbered<T> {
    values: Vec<T>,
    /// Numbers by the hashes of their values.
    numbers: HashTable<u32>,
}

impl<T> Default for Numbered<T> {
    fn default() -> Self {
        Self {
            values: Vec::new(),
            numbers: HashTable::new(),
        }
    }
}

impl<T> Numbered<T> {
    pub(crate) const fn len(&self) -> usize {
        self.values.len()
    }

    pub(crate) fn values(&self) -> &[T] {
        &self.values
    }

    pub(crate) fn get(&self, number: u32) -> &T {
        &self.values[number as usize]
    }

    /// Gives memory back: nothing is added or looked for any more.
    pub(crate) fn freeze(&mut self) {
        self.numbers = HashTable::new();
        self.values.shrink_to_fit();
    }
}

impl<T: Eq + Hash> Numbered<T> {
    /// The number of a value, if it was added, before [`Numbered::freeze`].
    pub(crate) fn find(&self, value: &T) -> Option<u32> {
        self.find_hashed(hash(value), value)
    }

    fn find_hashed(&self, hashed: u64, value: &T) -> Option<u32> {
        let is_it = |number: &u32| self.values[*number as usize] == *value;
        self.numbers.find(hashed, is_it).copied()
    }

    /// The number of a value, a new one where it was not there. Panics where 2^32 values are there.
    pub(crate) fn add(&mut self, value: T) -> u32 {
        let hashed = hash(&value);
        if let Some(known) = self.find_hashed(hashed, &value) {
            return known;
        }
        let fresh = u32::try_from(self.values.len()).expect("fewer than 2^32 values");
        self.values.push(value);
        let rehash = |&number: &u32| hash(&self.values[number as usize]);
        self.numbers.insert_unique(hashed, fresh, rehash);
        fresh
    }
}

fn hash(value: &impl Hash) -> u64 {
    FxBuildHasher.hash_one(value)
}
