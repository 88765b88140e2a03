//! Values that many states share are stored once and named by a small number.
//!
//! A global state holds robots, messages and a history; each of them takes few distinct values over
//! a whole exploration. A state that holds their numbers is small, and comparing and hashing it is
//! cheap. Numbers are given in the order of first use, so they may differ between runs with several
//! threads; the states they make up do not.

use std::hash::Hash;
use std::sync::Arc;

use crate::canonical::{Names, Renamable, Renamings};
use crate::memo::Memo;

/// A growing set of values, each with a number and the set of names that occur in it.
pub(crate) struct Interner<T> {
    values: Memo<T, u32>,
    renamings: Arc<Renamings>,
    /// Numbers of renamed values, by value and renaming.
    renamed: Memo<(u32, u32), u32>,
}

impl<T: Renamable + Clone + Eq + Hash> Interner<T> {
    /// The number of `value`, a new one if it was not seen before. Panics beyond 2^32 values, which fit in no memory.
    pub(crate) fn number(&self, value: T) -> u32 {
        self.number_with(value, |value| self.renamings.set(Names::of(value)))
    }

    /// The number of a value after the renaming of this number.
    pub(crate) fn renamed(&self, number: u32, renaming: u32) -> u32 {
        self.renamed_by(number, renaming, || {
            let mut ranks = self.renamings.ranks(renaming);
            self.number(self.value(number).renamed(&mut ranks))
        })
    }
}

impl<T: Clone + Eq + Hash> Interner<T> {
    pub(crate) fn new(renamings: &Arc<Renamings>) -> Self {
        Self {
            values: Memo::default(),
            renamings: Arc::clone(renamings),
            renamed: Memo::default(),
        }
    }

    /// The same for a value in which no names occur.
    pub(crate) fn number_nameless(&self, value: T) -> u32 {
        self.number_with(value, |_| Renamings::EMPTY)
    }

    /// The number of a value after the renaming of this number, which `rename` carries out. Few renamings ever meet one
    /// value, so each is carried out once.
    pub(crate) fn renamed_by(
        &self,
        number: u32,
        renaming: u32,
        rename: impl FnOnce() -> u32,
    ) -> u32 {
        if self.names(number) == Renamings::EMPTY {
            return number;
        }
        let renamed = self
            .renamed
            .get_or_compute((number, renaming), |_| rename());
        *renamed
    }

    pub(crate) fn names(&self, number: u32) -> u32 {
        self.values.at(number).1
    }

    /// The number of a value in which the set of names of this number occurs.
    pub(crate) fn number_with(&self, value: T, names: impl FnOnce(&T) -> u32) -> u32 {
        if let Some(number) = self.values.find(&value) {
            return number;
        }
        let names = names(&value);
        self.values.add(value, names)
    }

    pub(crate) fn value(&self, number: u32) -> &T {
        &self.values.at(number).0
    }
}
