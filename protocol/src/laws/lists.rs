//! Laws of the list with a capacity, over lists of up to four numbers, and of the list of outputs.

use crate::list::{Full, List};
use crate::output::{Output, Outputs, Sink};

/// The list that the laws are about.
pub type Numbers = List<u8, 4>;

/// The first `length` of `items`.
#[must_use]
pub fn numbers(items: [u8; 4], length: usize) -> Numbers {
    items.into_iter().take(length).collect()
}

/// A list holds the first items of what it was made of, in order.
pub fn holds_what_it_was_made_of(items: [u8; 4], length: usize) {
    let list = numbers(items, length);
    assert!(list.is_dense());
    assert_eq!(list.len(), length.min(4));
    assert_eq!(list.is_empty(), length == 0);
    for (i, item) in list.iter().enumerate() {
        assert_eq!(*item, items[i]);
    }
}

/// A push appends, or leaves a full list as it is.
pub fn pushes_to_the_end(list: Numbers, item: u8) {
    let mut after = list;
    if after.push(item) == Err(Full) {
        assert!(list.len() == 4 && after == list);
        return;
    }
    assert!(after.is_dense() && after.len() == list.len() + 1);
    assert_eq!(after.iter().last(), Some(&item));
    assert!(after.iter().zip(list.iter()).all(|(a, b)| a == b));
}

/// Removal takes the first match out and leaves the others in order.
pub fn removes_the_first(list: Numbers, item: u8) {
    let mut after = list;
    let removed = after.remove_first(|&present| present == item);
    assert!(after.is_dense());
    let Some(at) = list.iter().position(|&present| present == item) else {
        assert!(removed.is_none() && after == list);
        return;
    };
    assert_eq!(removed, Some(item));
    assert_eq!(after.len() + 1, list.len());
    for (i, &present) in list.iter().enumerate() {
        if i != at {
            let j = if i < at { i } else { i - 1 };
            assert_eq!(after.iter().nth(j), Some(&present));
        }
    }
}

/// Ranked insertion into a sorted list keeps it sorted and drops nothing but the largest.
pub fn inserts_by_rank(list: Numbers, item: u8) {
    let sorted = |list: &Numbers| list.iter().zip(list.iter().skip(1)).all(|(a, b)| a <= b);
    if !sorted(&list) {
        return;
    }
    let mut after = list;
    after.insert_ranked(item, |a, b| a < b);
    assert!(after.is_dense() && sorted(&after));
    assert_eq!(after.len(), (list.len() + 1).min(4));
    // As often in it as before and once more for the item, except for the largest of a full list.
    let count = |list: &Numbers, n: u8| list.iter().filter(|&&present| present == n).count();
    let dropped = (list.len() == 4).then(|| list.iter().copied().max().unwrap_or(item).max(item));
    for &n in list.iter().chain([&item]) {
        let expected = count(&list, n) + usize::from(n == item) - usize::from(dropped == Some(n));
        assert_eq!(count(&after, n), expected);
    }
}

/// A list is dense exactly if nothing stands behind a gap.
pub fn tells_of_gaps(slots: [Option<u8>; 4]) {
    let has_gap = (1..4).any(|i| slots[i].is_some() && slots[i - 1].is_none());
    assert!(Numbers::of_slots(slots).is_dense() != has_gap);
}

/// The outputs of a step have one RAM at most, and everything else as often as it was put in.
pub fn outputs_hold_one_ram(rams: [bool; 4], length: usize) {
    let mut outputs = Outputs::default();
    assert!(outputs.is_empty());
    let (mut expected, mut has_ram) = (0, false);
    for &is_ram in rams.iter().take(length) {
        outputs.push(if is_ram {
            Output::SendRam
        } else {
            Output::LockIdentity
        });
        expected += usize::from(!is_ram || !has_ram);
        has_ram |= is_ram;
        assert!(outputs.len() == expected && !outputs.is_empty());
    }
}
