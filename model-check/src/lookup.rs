//! The numbers of values, found by the hashes of the values.
//!
//! Threads look for a value a thousand times before they add one. So to look takes no lock and writes nothing, and
//! threads that look at the same time do not slow each other down; to add takes the lock of one shard.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// The numbers of values that somebody else keeps. Numbers are added and never removed.
#[derive(Default)]
pub(crate) struct Lookup {
    shards: [Shard; SHARDS],
}

const SHARD_BITS: u32 = 4;
const SHARDS: usize = 1 << SHARD_BITS;

/// As many tables as 2^32 numbers need, the first one of [`FIRST`] slots.
const TABLES: usize = 28;
const FIRST: usize = 64;

/// Open-addressed tables, each twice as large as the one before it. The newest has all numbers; a thread may still look
/// into an older one, finds nothing at worst, and looks again under the lock.
#[derive(Default)]
#[repr(align(64))]
struct Shard {
    newest: AtomicUsize,
    tables: [OnceLock<Box<[AtomicU64]>>; TABLES],
    used: Mutex<usize>,
}

/// A tag, which is 32 bits of a hash, and above zero a number and one.
const fn slot(tag: u32, number: u32) -> u64 {
    ((tag as u64) << 32) + number as u64 + 1
}

impl Lookup {
    /// The number of the value with this hash that is the one.
    pub(crate) fn find(&self, hashed: u64, is_it: impl Fn(u32) -> bool) -> Option<u32> {
        let (shard, tag) = self.place(hashed);
        shard.find(tag, is_it)
    }

    /// Waits until no other thread adds a value whose hash is alike.
    pub(crate) fn lock(&self, hashed: u64) -> Locked<'_> {
        let (shard, tag) = self.place(hashed);
        let used = shard.used.lock().unwrap_or_else(PoisonError::into_inner);
        Locked { shard, used, tag }
    }

    #[expect(clippy::cast_possible_truncation, reason = "some bits are meant")]
    fn place(&self, hashed: u64) -> (&Shard, u32) {
        let mixed = hashed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let shard = &self.shards[(mixed >> (u64::BITS - SHARD_BITS)) as usize];
        (shard, (mixed >> (32 - SHARD_BITS)) as u32)
    }
}

/// The right to add one number.
pub(crate) struct Locked<'a> {
    shard: &'a Shard,
    used: MutexGuard<'a, usize>,
    tag: u32,
}

impl Locked<'_> {
    /// The number of the value that is the one: another thread may have come first.
    pub(crate) fn find(&self, is_it: impl Fn(u32) -> bool) -> Option<u32> {
        self.shard.find(self.tag, is_it)
    }

    /// Adds the number that the value has got. Panics from 2^32 - 1 on, which fit in no memory.
    pub(crate) fn add(mut self, number: usize) -> u32 {
        let number = u32::try_from(number).ok().filter(|it| *it < u32::MAX);
        let number = number.expect("fewer than 2^32 distinct values");
        self.shard.add(&mut self.used, slot(self.tag, number));
        number
    }
}

impl Shard {
    fn find(&self, tag: u32, is_it: impl Fn(u32) -> bool) -> Option<u32> {
        let table = self.tables[self.newest.load(Ordering::Acquire)].get()?;
        let mask = table.len() - 1;
        let mut at = tag as usize & mask;
        loop {
            let slot = table[at].load(Ordering::Acquire);
            let number = u32::try_from(slot & u64::from(u32::MAX))
                .ok()?
                .checked_sub(1)?;
            if slot >> 32 == u64::from(tag) && is_it(number) {
                return Some(number);
            }
            at = (at + 1) & mask;
        }
    }

    /// Adds a slot under the lock that guards the number of them.
    fn add(&self, used: &mut usize, slot: u64) {
        let newest = self.newest.load(Ordering::Relaxed);
        let table = self.tables[newest].get_or_init(|| empty(FIRST << newest));
        let is_full = *used * 4 >= table.len() * 3;
        let table = if is_full {
            let larger = self.tables[newest + 1].get_or_init(|| empty(table.len() * 2));
            for slot in table {
                let slot = slot.load(Ordering::Relaxed);
                if slot != 0 {
                    put(larger, slot);
                }
            }
            self.newest.store(newest + 1, Ordering::Release);
            larger
        } else {
            table
        };
        put(table, slot);
        *used += 1;
    }
}

fn empty(slots: usize) -> Box<[AtomicU64]> {
    (0..slots).map(|_| AtomicU64::new(0)).collect()
}

/// Puts a slot into the first free place from where its tag points.
fn put(table: &[AtomicU64], slot: u64) {
    let mask = table.len() - 1;
    let mut at = usize::try_from(slot >> 32).unwrap_or_default() & mask;
    while table[at].load(Ordering::Relaxed) != 0 {
        at = (at + 1) & mask;
    }
    table[at].store(slot, Ordering::Release);
}

#[cfg(test)]
mod tests {
    use std::hash::BuildHasher;
    use std::thread;

    use rustc_hash::FxBuildHasher;

    use super::*;

    /// Values that all threads add at once, each with a hash that `hash` makes of it.
    fn numbered_by_threads(count: usize, hash: impl Fn(usize) -> u64 + Sync) {
        let (numbers, values) = (Lookup::default(), boxcar::Vec::new());
        let number = |value: usize| {
            let is_it = |number: u32| values[number as usize] == value;
            let known = numbers.find(hash(value), is_it);
            known.unwrap_or_else(|| {
                let locked = numbers.lock(hash(value));
                let known = locked.find(is_it);
                known.unwrap_or_else(|| locked.add(values.push(value)))
            })
        };
        let of_thread = |seed: usize| -> Vec<u32> {
            let mut numbers = vec![0; count];
            for n in 0..count {
                let value = (n * 7919 + seed * 104_729) % count;
                numbers[value] = number(value);
            }
            numbers
        };
        let heard: Vec<_> = thread::scope(|scope| {
            let threads: Vec<_> = (0..4)
                .map(|seed| scope.spawn(move || of_thread(seed)))
                .collect();
            threads.into_iter().map(|it| it.join().unwrap()).collect()
        });
        assert_eq!(values.count(), count);
        for numbers in &heard {
            assert_eq!(numbers, &heard[0]);
        }
        for (value, &number) in heard[0].iter().enumerate() {
            assert_eq!(values[number as usize], value);
        }
    }

    #[test]
    fn threads_agree_on_numbers() {
        numbered_by_threads(40_001, |value| FxBuildHasher.hash_one(value));
    }

    #[test]
    fn values_of_equal_hashes_are_told_apart() {
        numbered_by_threads(301, |value| value as u64 % 3);
    }

    #[test]
    fn what_was_not_added_is_not_found() {
        let numbers = Lookup::default();
        assert_eq!(numbers.find(7, |_| true), None);
        assert_eq!(numbers.lock(7).find(|_| true), None);
        assert_eq!(numbers.lock(7).add(5), 5);
        assert_eq!(numbers.find(7, |number| number == 5), Some(5));
        assert_eq!(numbers.find(7, |_| false), None);
    }
}
