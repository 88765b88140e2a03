//! SEQUENCE OF, with a capacity and without heap.

use core::fmt;
use core::ops::Deref;

use super::error::{Fault, Field};
use super::reader::{Faults, Reader};
use super::source::Source;
use super::writer::Writer;
use super::{Uper, width};

/// A list of `MIN` to `CAPACITY` items whose type allows `MAX` of them, and more behind its extension
/// marker if it is `EXTENSIBLE`. It reads as a slice.
///
/// Equal lists are equal in every bit.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct SequenceOf<
    T,
    const MIN: usize,
    const MAX: usize,
    const CAPACITY: usize,
    const EXTENSIBLE: bool,
> {
    /// The items, and behind them the lowest value.
    items: [T; CAPACITY],
    length: usize,
}

impl<T: Uper, const MIN: usize, const MAX: usize, const CAPACITY: usize, const EXTENSIBLE: bool>
    SequenceOf<T, MIN, MAX, CAPACITY, EXTENSIBLE>
{
    /// How many items the list can hold.
    pub const CAPACITY: usize = CAPACITY;

    const SIZE_BITS: u32 = {
        assert!(MIN <= CAPACITY && CAPACITY <= MAX && MAX <= 255);
        width(MIN as i64, MAX as i64)
    };

    /// The list of these items; `None` when they are fewer than `MIN` or more than `CAPACITY`.
    #[must_use]
    pub fn new(items: &[T]) -> Option<Self> {
        Self::collect(items.iter().copied())
    }

    /// The list of these items; `None` when they are fewer than `MIN` or more than `CAPACITY`.
    #[must_use]
    pub fn collect(items: impl IntoIterator<Item = T>) -> Option<Self> {
        let mut list = Self::LOWEST;
        list.length = 0;
        for item in items {
            *list.items.get_mut(list.length)? = item;
            list.length += 1;
        }
        (list.length >= MIN).then_some(list)
    }
}

impl<T, const MIN: usize, const MAX: usize, const CAPACITY: usize, const EXTENSIBLE: bool> Deref
    for SequenceOf<T, MIN, MAX, CAPACITY, EXTENSIBLE>
{
    type Target = [T];

    fn deref(&self) -> &[T] {
        self.items.get(..self.length).unwrap_or_default()
    }
}

impl<T: fmt::Debug, const MIN: usize, const MAX: usize, const CAPACITY: usize, const E: bool>
    fmt::Debug for SequenceOf<T, MIN, MAX, CAPACITY, E>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

/// X.691 clause 20.
impl<T: Uper, const MIN: usize, const MAX: usize, const CAPACITY: usize, const EXTENSIBLE: bool>
    Uper for SequenceOf<T, MIN, MAX, CAPACITY, EXTENSIBLE>
{
    const MAX_BITS: u32 = EXTENSIBLE as u32 + Self::SIZE_BITS + CAPACITY as u32 * T::MAX_BITS;
    const LOWEST: Self = Self {
        items: [T::LOWEST; CAPACITY],
        length: MIN,
    };
    const FIELDS: &'static [Field] = T::FIELDS;

    fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
        let writer = writer.bits(0, u32::from(EXTENSIBLE));
        let mut writer = writer.integer(self.length as i64, MIN as i64, MAX as i64);
        let mut index = 0;
        while index < CAPACITY && index < self.length {
            writer = self.items[index].encode(writer);
            index += 1;
        }
        writer
    }

    fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
        let start = reader.position();
        let reader = if EXTENSIBLE { reader.root() } else { reader };
        let (offset, mut reader) = reader.bits(Self::SIZE_BITS);
        let length = MIN + offset as usize;
        if length > MAX {
            return reader.fail(start, Fault::Size { min: MIN, max: MAX });
        }
        if length > CAPACITY {
            let (found, max) = (length, CAPACITY);
            return reader.fail(start, Fault::TooMany { found, max });
        }
        self.length = length;
        let mut index = 0;
        while index < CAPACITY && index < length {
            reader = self.items[index].read(reader);
            index += 1;
        }
        reader
    }

    fn arbitrary<S: Source>(source: &mut S) -> Self {
        let mut list = Self::LOWEST;
        list.length = source.index(MIN, CAPACITY);
        let mut index = 0;
        while index < CAPACITY && index < list.length {
            list.items[index] = T::arbitrary(source);
            index += 1;
        }
        list
    }
}
