//! The states that one worker owns, in less than 16 bytes each.
//!
//! The table keeps of each state a fingerprint of 92 bits, the level at which the state was found (modulo 256), and 28
//! bits that hint at the state it was found from. Fingerprint and level say whether a state is known and where it
//! lies; the hints lead back from a state to the initial one, by way of few candidates.
//!
//! The table is 256 smaller ones, each an array of buckets. A fingerprint may lie in one of two buckets (cuckoo
//! hashing), each chosen by one half of it. An entry is 14 bytes, since its place says the leading bits of the half
//! that chose it, and 9 of them are a bucket of two cache lines. The smaller tables grow one at a time, each by a
//! sixteenth once it is full to 61 parts of 64. So to grow takes hardly any memory beside that of the table itself.

use std::collections::BTreeSet;
use std::hash::Hash;
use std::ops::{Index, IndexMut};

use siphasher::sip128::{Hasher128, SipHasher13};

/// How many bits of a fingerprint are kept and compared.
pub const FINGERPRINT_BITS: u32 = 92;

const LEVEL_BITS: u32 = 8;
const HINT_BITS: u32 = 28;
const SEGMENT_BITS: u32 = 8;
/// Bits of a fingerprint that choose a bucket of its segment.
const HALF_BITS: u32 = (FINGERPRINT_BITS - SEGMENT_BITS) / 2;
/// The number of these bits that are left once the bucket is known.
const REST_BITS: u32 = 33;
const ENTRY_BITS: u32 = HINT_BITS + LEVEL_BITS + 1 + HALF_BITS + REST_BITS;
const ENTRY_BYTES: usize = (ENTRY_BITS / 8) as usize;

const SLOTS: usize = 9;
const BUCKET_BYTES: usize = 128;
/// Buckets are allocated by this number, so that those of smaller tables leave no gaps in memory that larger ones do not fit
/// into.
const BLOCK: usize = 256;
/// As few blocks of a segment as leave no more than [`REST_BITS`].
const BLOCKS_MIN: usize = (1 << (HALF_BITS - REST_BITS)) / BLOCK;
/// As many blocks of a segment as 64 bits can place: 9 * 10^9 states of one worker, in 137 GB.
const BLOCKS_MAX: usize = (1 << (u64::BITS - HALF_BITS)) / BLOCK;
/// How many entries are moved to make room for another before the segment grows.
const MOVES_MAX: u32 = 200;

const _: () = assert!(SEGMENT_BITS + 2 * HALF_BITS == FINGERPRINT_BITS);
const _: () = assert!(ENTRY_BITS.is_multiple_of(8));
const _: () = assert!(SLOTS * ENTRY_BYTES < BUCKET_BYTES);

const fn lowest(bits: u32) -> u128 {
    (1 << bits) - 1
}

/// The part of a fingerprint that is kept.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) struct Fingerprint(u128);

impl Fingerprint {
    /// Of a state, which is a few numbers of parts; they are the same for all workers.
    pub(crate) fn of(state: &impl Hash) -> Self {
        let mut hasher = SipHasher13::new();
        state.hash(&mut hasher);
        Self::of_hash(hasher.finish128().into())
    }

    pub(crate) const fn of_hash(hash: u128) -> Self {
        Self(hash >> (u128::BITS - FINGERPRINT_BITS))
    }

    /// The number that decides which worker owns the state.
    #[expect(clippy::cast_possible_truncation, reason = "the lowest bits are meant")]
    pub(crate) const fn share(self) -> u64 {
        self.0 as u64
    }

    /// 28 bits that tell it apart from most others.
    pub(crate) const fn hint(self) -> Hint {
        Hint((self.share() >> 32) as u32 & ((1 << HINT_BITS) - 1))
    }

    const fn segment(self) -> usize {
        (self.0 >> (2 * HALF_BITS)) as usize
    }

    /// The bits that choose its bucket on this side.
    #[expect(clippy::cast_possible_truncation, reason = "42 bits are meant")]
    const fn half(self, side: Side) -> u64 {
        (match side {
            Side::High => self.0 >> HALF_BITS & lowest(HALF_BITS),
            Side::Low => self.0 & lowest(HALF_BITS),
        }) as u64
    }

    const fn of_parts(segment: usize, side: Side, half: u64, other: u64) -> Self {
        let (high, low) = match side {
            Side::High => (half, other),
            Side::Low => (other, half),
        };
        Self((segment as u128) << (2 * HALF_BITS) | (high as u128) << HALF_BITS | low as u128)
    }
}

/// Some bits of the fingerprint of the state that another was found from.
#[derive(
    Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, serde::Serialize, serde::Deserialize,
)]
pub(crate) struct Hint(u32);

/// Which half of a fingerprint has chosen its bucket.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Side {
    High,
    Low,
}

impl Side {
    const fn other(self) -> Self {
        match self {
            Self::High => Self::Low,
            Self::Low => Self::High,
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct State {
    fingerprint: Fingerprint,
    /// Modulo 256.
    level: u8,
    from: Hint,
}

/// From the lowest bit: a hint, a level, the side, the other half of the fingerprint, and what the place does not
/// say of the half that has chosen it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Entry(u128);

impl Entry {
    const LEVEL: u32 = HINT_BITS;
    const SIDE: u32 = Self::LEVEL + LEVEL_BITS;
    const OTHER: u32 = Self::SIDE + 1;
    const REST: u32 = Self::OTHER + HALF_BITS;

    /// Of a state that lies in the bucket that begins with this half of a fingerprint.
    const fn of(state: State, side: Side, begin: u64) -> Self {
        let rest = state.fingerprint.half(side) - begin;
        let other = state.fingerprint.half(side.other());
        Self(
            state.from.0 as u128
                | (state.level as u128) << Self::LEVEL
                | (matches!(side, Side::Low) as u128) << Self::SIDE
                | (other as u128) << Self::OTHER
                | (rest as u128) << Self::REST,
        )
    }

    /// Whether they are entries of the same fingerprint, if they are in the same bucket.
    const fn is_of_the_fingerprint_of(self, other: Self) -> bool {
        self.0 >> Self::SIDE == other.0 >> Self::SIDE
    }

    const fn side(self) -> Side {
        if self.0 >> Self::SIDE & 1 == 0 {
            Side::High
        } else {
            Side::Low
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "8 bits are meant")]
    const fn level(self) -> u8 {
        (self.0 >> Self::LEVEL) as u8
    }

    #[expect(clippy::cast_possible_truncation, reason = "28 and 42 bits are meant")]
    const fn state(self, segment: usize, begin: u64) -> State {
        let half = begin + (self.0 >> Self::REST) as u64;
        let other = (self.0 >> Self::OTHER & lowest(HALF_BITS)) as u64;
        State {
            fingerprint: Fingerprint::of_parts(segment, self.side(), half, other),
            level: self.level(),
            from: Hint((self.0 & lowest(HINT_BITS)) as u32),
        }
    }
}

/// Entries in two cache lines. The last octet is their number.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Bucket([u8; BUCKET_BYTES]);

impl Bucket {
    const EMPTY: Self = Self([0; BUCKET_BYTES]);
    const LEN: usize = BUCKET_BYTES - 1;

    const fn len(&self) -> usize {
        self.0[Self::LEN] as usize
    }

    fn entry(&self, slot: usize) -> Entry {
        let mut word = [0; 16];
        let at = slot * ENTRY_BYTES;
        word[..ENTRY_BYTES].copy_from_slice(&self.0[at..at + ENTRY_BYTES]);
        Entry(u128::from_le_bytes(word))
    }

    fn set(&mut self, slot: usize, entry: Entry) {
        let at = slot * ENTRY_BYTES;
        self.0[at..at + ENTRY_BYTES].copy_from_slice(&entry.0.to_le_bytes()[..ENTRY_BYTES]);
    }

    fn entries(&self) -> impl Iterator<Item = Entry> {
        (0..self.len()).map(|slot| self.entry(slot))
    }

    /// Whether there was a free slot for the entry, which it has now.
    fn put(&mut self, entry: Entry) -> bool {
        let len = self.len();
        let is_free = len < SLOTS;
        if is_free {
            self.set(len, entry);
            self.0[Self::LEN] += 1;
        }
        is_free
    }

    /// One octet of each of its cache lines.
    const fn touch(&self) -> u8 {
        self.0[0] ^ self.0[Self::LEN]
    }

    /// Puts an entry into a slot that is not free, and returns what was there.
    fn replace(&mut self, slot: usize, entry: Entry) -> Entry {
        let before = self.entry(slot);
        self.set(slot, entry);
        before
    }
}

struct Buckets(Vec<Box<[Bucket]>>);

impl Buckets {
    fn new(blocks: usize) -> Self {
        let block = || vec![Bucket::EMPTY; BLOCK].into_boxed_slice();
        Self((0..blocks).map(|_| block()).collect())
    }

    const fn len(&self) -> usize {
        self.0.len() * BLOCK
    }

    fn iter(&self) -> impl Iterator<Item = &Bucket> {
        self.0.iter().flatten()
    }
}

impl Index<usize> for Buckets {
    type Output = Bucket;

    fn index(&self, bucket: usize) -> &Bucket {
        &self.0[bucket / BLOCK][bucket % BLOCK]
    }
}

impl IndexMut<usize> for Buckets {
    fn index_mut(&mut self, bucket: usize) -> &mut Bucket {
        &mut self.0[bucket / BLOCK][bucket % BLOCK]
    }
}

/// The states whose fingerprints have the same leading bits.
struct Segment {
    number: usize,
    buckets: Buckets,
    used: usize,
}

impl Segment {
    /// The bucket that a half of a fingerprint chooses, and the half that it begins with.
    fn place(&self, half: u64) -> (usize, u64) {
        let buckets = self.buckets.len() as u128;
        let bucket = usize::try_from((u128::from(half) * buckets) >> HALF_BITS);
        let bucket = bucket.expect("less than the buckets");
        (bucket, self.begin(bucket))
    }

    /// The smallest half of a fingerprint that chooses a bucket.
    fn begin(&self, bucket: usize) -> u64 {
        ((bucket as u64) << HALF_BITS).div_ceil(self.buckets.len() as u64)
    }

    fn has(&self, state: State) -> bool {
        [Side::High, Side::Low].into_iter().any(|side| {
            let (bucket, begin) = self.place(state.fingerprint.half(side));
            let sought = Entry::of(state, side, begin);
            let mut entries = self.buckets[bucket].entries();
            entries.any(|entry| entry.is_of_the_fingerprint_of(sought))
        })
    }

    /// Reads from where a state may lie.
    fn touch(&self, fingerprint: Fingerprint) -> u8 {
        if self.used == 0 {
            return 0;
        }
        let [high, low] = [Side::High, Side::Low].map(|side| {
            let (bucket, _) = self.place(fingerprint.half(side));
            self.buckets[bucket].touch()
        });
        high ^ low
    }

    /// Whether there was a free slot on this side.
    fn put(&mut self, state: State, side: Side) -> bool {
        let (bucket, begin) = self.place(state.fingerprint.half(side));
        self.buckets[bucket].put(Entry::of(state, side, begin))
    }

    fn insert(&mut self, state: State) -> bool {
        if self.used > 0 && self.has(state) {
            return false;
        }
        if self.used * 64 >= self.buckets.len() * SLOTS * 61 {
            self.grow();
        }
        self.add(state, Side::High);
        self.used += 1;
        true
    }

    /// Adds a state that is not there, first on this side. Where both buckets are full, another state makes room
    /// and goes to its other side.
    fn add(&mut self, mut state: State, mut side: Side) {
        loop {
            for moves in 0..MOVES_MAX {
                if self.put(state, side) || self.put(state, side.other()) {
                    return;
                }
                (state, side) = self.exchange(state, side, moves);
            }
            self.grow();
        }
    }

    /// Puts a state in the place of another one of its bucket on this side. Returns the other state, and where it
    /// was not.
    fn exchange(&mut self, state: State, side: Side, moves: u32) -> (State, Side) {
        let (bucket, begin) = self.place(state.fingerprint.half(side));
        let [some_bits, ..] = state.fingerprint.share().to_le_bytes();
        let slot = (usize::from(some_bits) + moves as usize) % SLOTS;
        let displaced = self.buckets[bucket].replace(slot, Entry::of(state, side, begin));
        let other_side = displaced.side().other();
        (displaced.state(self.number, begin), other_side)
    }

    /// Makes it larger by a sixteenth. The order of buckets is that of halves, so all states move in that order.
    fn grow(&mut self) {
        let blocks = self.buckets.0.len();
        assert!(
            blocks < BLOCKS_MAX,
            "more states than one worker can keep: take more workers"
        );
        let blocks = blocks + (blocks / 16).max(1);
        let larger = Self {
            number: self.number,
            buckets: Buckets::new(blocks.clamp(BLOCKS_MIN, BLOCKS_MAX)),
            used: self.used,
        };
        let before = std::mem::replace(self, larger);
        for (state, side) in before.states() {
            self.add(state, side);
        }
    }

    fn states(&self) -> impl Iterator<Item = (State, Side)> {
        let buckets = self.buckets.iter().enumerate();
        buckets.flat_map(move |(at, bucket)| {
            let begin = self.begin(at);
            let entries = bucket.entries();
            entries.map(move |entry| (entry.state(self.number, begin), entry.side()))
        })
    }
}

pub(crate) struct Table {
    segments: Vec<Segment>,
}

impl Table {
    pub(crate) fn new() -> Self {
        let segments = (0..1 << SEGMENT_BITS).map(|number| Segment {
            number,
            buckets: Buckets::new(0),
            used: 0,
        });
        Self {
            segments: segments.collect(),
        }
    }

    /// Has the processor fetch from memory what [`Table::insert`] of these states will read, of all of them at once
    /// and not of one after the other.
    pub(crate) fn fetch(&self, states: impl Iterator<Item = Fingerprint>) {
        let touched = states.map(|state| self.segments[state.segment()].touch(state));
        std::hint::black_box(touched.fold(0, std::ops::BitXor::bitxor));
    }

    /// Whether the state was not known before; it is known from now on.
    pub(crate) fn insert(&mut self, fingerprint: Fingerprint, level: u32, from: Hint) -> bool {
        let [level, ..] = level.to_le_bytes();
        self.segments[fingerprint.segment()].insert(State {
            fingerprint,
            level,
            from,
        })
    }

    /// The states that may have been found at this level and that one of these hints may mean, each with the
    /// hint at where it was found from.
    pub(crate) fn meant(&self, level: u32, hints: &BTreeSet<Hint>) -> Vec<(Fingerprint, Hint)> {
        let [level, ..] = level.to_le_bytes();
        let states = self.segments.iter().flat_map(Segment::states);
        states
            .filter(|(state, _)| state.level == level && hints.contains(&state.fingerprint.hint()))
            .map(|(state, _)| (state.fingerprint, state.from))
            .collect()
    }

    pub(crate) fn bytes(&self) -> usize {
        let buckets = self.segments.iter().map(|segment| segment.buckets.len());
        buckets.sum::<usize>() * size_of::<Bucket>()
    }
}

#[cfg(test)]
mod tests {
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
    fn each_state_is_new_once_and_takes_less_than_16_bytes() {
        let mut table = Table::new();
        let states = 8_000_000;
        for is_first in [true, false] {
            for n in 0..states {
                let is_new = table.insert(Fingerprint::of_hash(hash(n)), 0, Hint(1));
                assert_eq!(is_new, is_first);
            }
        }
        let used: usize = table.segments.iter().map(|segment| segment.used).sum();
        assert_eq!(used, usize::try_from(states).unwrap());
        assert_eq!(
            table.segments.iter().flat_map(Segment::states).count(),
            used
        );
        assert!(table.bytes() < used * 16, "{} bytes", table.bytes());
    }

    #[test]
    fn a_state_comes_back_as_it_was_put_in() {
        let mut table = Table::new();
        let states: BTreeSet<_> = (0..2_000_000)
            .map(|n| Fingerprint::of_hash(hash(n)))
            .collect();
        for state in &states {
            table.insert(*state, 300, state.hint());
        }
        let kept = table.segments.iter().flat_map(Segment::states);
        let kept = kept.map(|(state, _)| {
            assert_eq!((state.level, state.from), (44, state.fingerprint.hint()));
            state.fingerprint
        });
        assert!(kept.collect::<BTreeSet<_>>() == states);
    }

    #[test]
    fn hints_lead_from_a_state_to_where_it_was_found_from() {
        let mut table = Table::new();
        let mut from = Fingerprint::of_hash(hash(0));
        table.insert(from, 0, from.hint());
        for n in 1..1_000 {
            let next = Fingerprint::of_hash(hash(n));
            table.insert(next, u32::try_from(n).unwrap(), from.hint());
            from = next;
        }
        let mut hint = from.hint();
        for n in (0..1_000_u32).rev() {
            let meant = table.meant(n, &BTreeSet::from([hint]));
            assert!(
                meant
                    .iter()
                    .any(|(found, _)| *found == Fingerprint::of_hash(hash(n.into())))
            );
            hint = meant[0].1;
        }
    }

    #[test]
    fn a_fingerprint_of_zeros_is_one_as_well() {
        let mut table = Table::new();
        assert!(table.insert(Fingerprint::of_hash(0), 0, Fingerprint::of_hash(0).hint()));
        assert!(!table.insert(Fingerprint::of_hash(0), 0, Hint(1)));
    }
}
