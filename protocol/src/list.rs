//! A list with a capacity, without heap and without unsafe code.
//!
//! Items are read and changed in loops over the slots, and not by an index or a reference that was
//! found before: a proof knows at each turn of a loop which slot it is about. The loops count, for
//! the pointers and control flow of the iterators of slices are most of what a proof would be about.

use core::fmt;

/// Up to `N` items in order. Equal lists are equal bit for bit, so a state that holds one can be
/// hashed and compared.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct List<T, const N: usize>([Option<T>; N]);

/// The list is full; the item was not added.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Full;

impl<T: Copy, const N: usize> List<T, N> {
    /// The empty list.
    pub const EMPTY: Self = Self([None; N]);

    /// Appends `item`.
    ///
    /// # Errors
    /// [`Full`] when the list already holds `N` items.
    pub fn push(&mut self, item: T) -> Result<(), Full> {
        let mut i = 0;
        while i < N {
            if self.0[i].is_none() {
                self.0[i] = Some(item);
                return Ok(());
            }
            i += 1;
        }
        Err(Full)
    }

    /// Inserts `item` before the first item for which `goes_before` says so. A full list drops its
    /// last item, or `item` itself where that would be the last.
    pub(crate) fn insert_ranked(&mut self, item: T, goes_before: impl Fn(&T, &T) -> bool) {
        let mut carried = item;
        let mut i = 0;
        while i < N {
            match self.0[i] {
                Some(present) if !goes_before(&carried, &present) => {}
                Some(present) => {
                    self.0[i] = Some(carried);
                    carried = present;
                }
                None => {
                    self.0[i] = Some(carried);
                    return;
                }
            }
            i += 1;
        }
    }

    /// Removes the first item that satisfies `condition` and closes the gap.
    pub(crate) fn remove_first(&mut self, condition: impl Fn(&T) -> bool) -> Option<T> {
        let mut removed = None;
        let mut i = 0;
        while i < N {
            match self.0[i] {
                None => break,
                Some(item) if removed.is_some() => {
                    self.0[i - 1] = Some(item);
                    self.0[i] = None;
                }
                Some(item) if condition(&item) => {
                    removed = Some(item);
                    self.0[i] = None;
                }
                Some(_) => {}
            }
            i += 1;
        }
        removed
    }

    /// Changes the first item that satisfies `condition` and returns the result of `change`, `None` where there is
    /// no such item.
    pub(crate) fn update_first<R>(
        &mut self,
        condition: impl Fn(&T) -> bool,
        change: impl FnOnce(&mut T) -> R,
    ) -> Option<R> {
        let mut i = 0;
        while i < N {
            if let Some(item) = &mut self.0[i]
                && condition(item)
            {
                return Some(change(item));
            }
            i += 1;
        }
        None
    }

    /// The first `count` items, of which there are as many, each changed by `of`.
    pub(crate) fn first<U: Copy>(&self, count: usize, of: impl Fn(&T) -> U) -> List<U, N> {
        let mut made = List::EMPTY;
        let mut i = 0;
        while i < count {
            made.0[i] = self.0[i].as_ref().map(&of);
            i += 1;
        }
        made
    }

    /// How many items the list holds.
    #[must_use]
    pub fn len(&self) -> usize {
        let mut i = 0;
        while i < N && self.0[i].is_some() {
            i += 1;
        }
        i
    }

    /// True if the list holds nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        N == 0 || self.0[0].is_none()
    }

    /// The items in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> + Clone {
        Iter {
            slots: &self.0,
            next: 0,
        }
    }

    /// The items in order, to change them.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.0.iter_mut().map_while(Option::as_mut)
    }

    /// The list of these slots, dense or not.
    #[cfg(any(test, feature = "laws"))]
    pub(crate) const fn of_slots(slots: [Option<T>; N]) -> Self {
        Self(slots)
    }

    /// True if no item stands behind a gap; true for every list that this type's methods made.
    pub(crate) fn is_dense(&self) -> bool {
        let mut i = self.len();
        while i < N {
            if self.0[i].is_some() {
                return false;
            }
            i += 1;
        }
        true
    }
}

/// The items of a list in order.
struct Iter<'a, T, const N: usize> {
    slots: &'a [Option<T>; N],
    next: usize,
}

impl<T, const N: usize> Clone for Iter<'_, T, N> {
    fn clone(&self) -> Self {
        Self { ..*self }
    }
}

#[expect(
    clippy::while_let_on_iterator,
    reason = "without the detour over a reference"
)]
impl<'a, T, const N: usize> Iterator for Iter<'a, T, N> {
    type Item = &'a T;

    fn next(&mut self) -> Option<&'a T> {
        if self.next >= N {
            return None;
        }
        let item = self.slots[self.next].as_ref();
        self.next += 1;
        item
    }

    fn all<F: FnMut(&'a T) -> bool>(&mut self, mut holds: F) -> bool {
        while let Some(item) = self.next() {
            if !holds(item) {
                return false;
            }
        }
        true
    }

    fn any<F: FnMut(&'a T) -> bool>(&mut self, mut holds: F) -> bool {
        while let Some(item) = self.next() {
            if holds(item) {
                return true;
            }
        }
        false
    }

    fn find<P: FnMut(&&'a T) -> bool>(&mut self, mut holds: P) -> Option<&'a T> {
        while let Some(item) = self.next() {
            if holds(&item) {
                return Some(item);
            }
        }
        None
    }

    fn find_map<R, F: FnMut(&'a T) -> Option<R>>(&mut self, mut of: F) -> Option<R> {
        while let Some(item) = self.next() {
            let found = of(item);
            if found.is_some() {
                return found;
            }
        }
        None
    }
}

impl<T: Copy, const N: usize> Default for List<T, N> {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl<T: Copy, const N: usize> FromIterator<T> for List<T, N> {
    /// The first `N` items.
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        let mut list = Self::EMPTY;
        for (slot, item) in list.0.iter_mut().zip(items) {
            *slot = Some(item);
        }
        list
    }
}

impl<T: Copy + fmt::Debug, const N: usize> fmt::Debug for List<T, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(feature = "serde")]
mod serialization {
    use core::fmt;
    use core::marker::PhantomData;

    use serde::de::{Error, SeqAccess, Visitor};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::List;

    impl<T: Copy + Serialize, const N: usize> Serialize for List<T, N> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_seq(self.iter())
        }
    }

    impl<'de, T: Copy + Deserialize<'de>, const N: usize> Deserialize<'de> for List<T, N> {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserializer.deserialize_seq(Items(PhantomData))
        }
    }

    struct Items<T, const N: usize>(PhantomData<T>);

    impl<'de, T: Copy + Deserialize<'de>, const N: usize> Visitor<'de> for Items<T, N> {
        type Value = List<T, N>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "at most {N} items")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
            let mut list = List::EMPTY;
            while let Some(item) = items.next_element()? {
                list.push(item)
                    .map_err(|_| A::Error::invalid_length(N + 1, &self))?;
            }
            Ok(list)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::lists as laws;

    /// All lists of up to four of the numbers 0 to 3.
    #[test]
    fn lists_are_changed_as_their_laws_say() {
        for digits in 0..=u8::MAX {
            let items = [6, 4, 2, 0].map(|shift| digits >> shift & 3);
            laws::tells_of_gaps(items.map(|item| (item > 0).then_some(item)));
            for length in 0..=4 {
                laws::holds_what_it_was_made_of(items, length);
                let list = laws::numbers(items, length);
                for item in 0..4 {
                    laws::pushes_to_the_end(list, item);
                    laws::removes_the_first(list, item);
                    laws::inserts_by_rank(list, item);
                }
            }
        }
    }

    #[test]
    fn what_holds_of_all_items_and_of_any() {
        let list = List::<u8, 4>::from_iter([1, 2, 3]);
        assert!(list.iter().all(|&item| item < 4) && !list.iter().all(|&item| item < 3));
        assert!(list.iter().any(|&item| item == 3) && !list.iter().any(|&item| item == 4));
        assert_eq!(list.iter().find(|&&item| item > 1), Some(&2));
    }
}
