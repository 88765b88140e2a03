//! The states that one worker owns, in 16 bytes each.
//!
//! An entry is a fingerprint of 92 bits, the level at which the state was found (modulo 256), and 28 bits that
//! hint at the state it was found from. Fingerprint and level say whether a state is known and where it lies; the
//! hints lead back from a state to the initial one, by way of few candidates.
//!
//! The table is 256 smaller ones that grow one at a time, each by an eighth once it is full to four fifths. So
//! to grow takes hardly any memory beside that of the table itself.

/// How many bits of a fingerprint are kept and compared.
pub const FINGERPRINT_BITS: u32 = 92;

const LEVEL_BITS: u32 = 8;
const HINT_BITS: u32 = 28;
const SEGMENT_BITS: u32 = 8;

const _: () = assert!(FINGERPRINT_BITS + LEVEL_BITS + HINT_BITS == 128);

/// The part of a fingerprint that is kept; never 0.
#[derive(
    Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, serde::Serialize, serde::Deserialize,
)]
pub(crate) struct Fingerprint(u128);

impl Fingerprint {
    pub(crate) const fn of(hash: u128) -> Self {
        let kept = hash >> (LEVEL_BITS + HINT_BITS);
        Self(if kept == 0 { 1 } else { kept })
    }

    /// What decides which worker owns the state.
    #[expect(clippy::cast_possible_truncation, reason = "the lowest bits are meant")]
    pub(crate) const fn share(self) -> u64 {
        self.0 as u64
    }

    /// 28 bits that tell it apart from most others.
    pub(crate) const fn hint(self) -> Hint {
        Hint((self.share() >> 32) as u32 & ((1 << HINT_BITS) - 1))
    }

    const fn segment(self) -> usize {
        (self.0 >> (FINGERPRINT_BITS - SEGMENT_BITS)) as usize
    }

    /// Where its search begins among this number of slots.
    #[expect(clippy::cast_possible_truncation, reason = "less than `slots`")]
    const fn slot(self, slots: usize) -> usize {
        let bits = self.0 >> (FINGERPRINT_BITS - SEGMENT_BITS - 64) & u64::MAX as u128;
        ((bits * slots as u128) >> 64) as usize
    }
}

/// Some bits of the fingerprint of the state that another was found from.
#[derive(
    Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, serde::Serialize, serde::Deserialize,
)]
pub(crate) struct Hint(u32);

/// A fingerprint, the lowest bits of its level, and a hint at where it was found from. 0 is empty.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Entry(u128);

impl Entry {
    const EMPTY: Self = Self(0);

    const fn of(fingerprint: Fingerprint, level: u32, from: Hint) -> Self {
        let level = (level as u128 & ((1 << LEVEL_BITS) - 1)) << HINT_BITS;
        Self(fingerprint.0 << (LEVEL_BITS + HINT_BITS) | level | from.0 as u128)
    }

    const fn fingerprint(self) -> Fingerprint {
        Fingerprint(self.0 >> (LEVEL_BITS + HINT_BITS))
    }

    const fn is_at(self, level: u32) -> bool {
        self.0 >> HINT_BITS & ((1 << LEVEL_BITS) - 1) == level as u128 & ((1 << LEVEL_BITS) - 1)
    }

    #[expect(clippy::cast_possible_truncation, reason = "28 bits are meant")]
    const fn from(self) -> Hint {
        Hint(self.0 as u32 & ((1 << HINT_BITS) - 1))
    }
}

#[derive(Default)]
struct Segment {
    slots: Vec<Entry>,
    used: usize,
}

impl Segment {
    /// Where the fingerprint is, or else where it would be.
    fn find(&self, fingerprint: Fingerprint) -> Result<usize, usize> {
        let mut at = fingerprint.slot(self.slots.len());
        loop {
            match self.slots[at] {
                Entry::EMPTY => return Err(at),
                entry if entry.fingerprint() == fingerprint => return Ok(at),
                _ => at = (at + 1) % self.slots.len(),
            }
        }
    }

    fn insert(&mut self, fingerprint: Fingerprint, entry: Entry) -> bool {
        if self.used * 5 >= self.slots.len() * 4 {
            self.grow();
        }
        let Err(at) = self.find(fingerprint) else {
            return false;
        };
        self.slots[at] = entry;
        self.used += 1;
        true
    }

    fn grow(&mut self) {
        let slots = self.slots.len() + (self.slots.len() / 8).max(16);
        let before = std::mem::replace(&mut self.slots, vec![Entry::EMPTY; slots]);
        for entry in before {
            if entry != Entry::EMPTY
                && let Err(at) = self.find(entry.fingerprint())
            {
                self.slots[at] = entry;
            }
        }
    }
}

/// All states that one worker owns.
pub(crate) struct Table {
    segments: Vec<Segment>,
}

impl Table {
    pub(crate) fn new() -> Self {
        let segments = (0..1 << SEGMENT_BITS).map(|_| Segment::default());
        Self {
            segments: segments.collect(),
        }
    }

    /// Whether the state was not known before; it is known from now on.
    pub(crate) fn insert(&mut self, fingerprint: Fingerprint, level: u32, from: Hint) -> bool {
        let entry = Entry::of(fingerprint, level, from);
        self.segments[fingerprint.segment()].insert(fingerprint, entry)
    }

    /// The states that may have been found at this level and that one of these hints may mean, each with the
    /// hint at where it was found from.
    pub(crate) fn meant(
        &self,
        level: u32,
        hints: &std::collections::BTreeSet<Hint>,
    ) -> Vec<(Fingerprint, Hint)> {
        let entries = self.segments.iter().flat_map(|segment| &segment.slots);
        entries
            .filter(|entry| **entry != Entry::EMPTY && entry.is_at(level))
            .map(|entry| (entry.fingerprint(), entry.from()))
            .filter(|(fingerprint, _)| hints.contains(&fingerprint.hint()))
            .collect()
    }

    /// Bytes that the table takes.
    pub(crate) fn bytes(&self) -> usize {
        let slots = self.segments.iter().map(|segment| segment.slots.capacity());
        slots.sum::<usize>() * size_of::<Entry>()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Numbers that look random (`SplitMix64`, twice).
    fn hash(n: u64) -> u128 {
        let mix = |n: u64| {
            let n = (n ^ n >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let n = (n ^ n >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            n ^ n >> 31
        };
        u128::from(mix(n.wrapping_mul(0x9e37_79b9_7f4a_7c15))) << 64 | u128::from(mix(!n))
    }

    #[test]
    fn each_state_is_new_once_and_takes_at_most_two_slots() {
        let mut table = Table::new();
        let states = 300_000;
        for is_first in [true, false] {
            for n in 0..states {
                let is_new = table.insert(Fingerprint::of(hash(n)), 0, Hint(0));
                assert_eq!(is_new, is_first);
            }
        }
        let used: usize = table.segments.iter().map(|segment| segment.used).sum();
        assert_eq!(used, usize::try_from(states).unwrap());
        let least = used * 16 * 5 / 4;
        assert!(table.bytes() >= least && table.bytes() <= least * 6 / 5);
    }

    #[test]
    fn hints_lead_from_a_state_to_where_it_was_found_from() {
        let mut table = Table::new();
        let mut from = Fingerprint::of(hash(0));
        table.insert(from, 0, Hint(0));
        for n in 1..1_000 {
            let next = Fingerprint::of(hash(n));
            table.insert(next, u32::try_from(n).unwrap(), from.hint());
            from = next;
        }
        let mut hint = from.hint();
        for n in (0..1_000_u32).rev() {
            let meant = table.meant(n, &BTreeSet::from([hint]));
            assert!(
                meant
                    .iter()
                    .any(|(found, _)| *found == Fingerprint::of(hash(n.into())))
            );
            hint = meant[0].1;
        }
    }

    #[test]
    fn a_fingerprint_that_would_be_empty_is_not() {
        let mut table = Table::new();
        assert!(table.insert(Fingerprint::of(0), 0, Hint(0)));
        assert!(!table.insert(Fingerprint::of(0), 0, Hint(0)));
    }
}
