//! The bits of an encoding, read in order.

#![allow(
    clippy::many_single_char_names,
    reason = "eight octets have no better names"
)]
#![allow(
    clippy::inline_always,
    reason = "a reader that goes through memory at every field is several times slower"
)]

use super::error::{Error, Fault};
use super::width;

/// Result of reading: a value and the reader behind it.
pub type Read<'a, T, F> = (T, Reader<'a, F>);

/// The bits of an encoding from one bit on.
///
/// A reader is passed by value and comes back with what was read, so nothing is read twice. It copies
/// nothing and never panics.
///
/// It takes note of a fault, and goes on as if there were none: what is read then is some value, which
/// nobody gets to see. So where the next field begins does not depend on whether this one is valid,
/// which is what makes it easy to prove. What it notes is up to `F`: a message is read with
/// [`Whether`], and once more with [`First`] when there was a fault.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a, F> {
    octets: &'a [u8],
    /// The next bit.
    position: usize,
    /// The bit behind the last one.
    end: usize,
    /// How many SEQUENCEs had unknown extension additions.
    extended: usize,
    faults: F,
}

/// Notes of a reader about the faults that it meets. Nothing else depends on them.
pub trait Faults: Copy {
    /// Nothing noted.
    const NONE: Self;

    /// True if there was a fault.
    #[must_use]
    fn is_any(self) -> bool;

    /// Notes a fault at a bit.
    #[must_use]
    fn noting(self, bit: usize, fault: Fault) -> Self;

    /// Notes that what was met since [`is_any`](Self::is_any) was `before` is in field `index`.
    #[must_use]
    fn within(self, index: usize, before: bool) -> Self;
}

/// A note that there was a fault. A reader that carries no more than that is several times faster than one
/// that carries an error.
///
/// A number, not a `bool`: the padding behind a `bool` would be copied with the reader, in pieces that
/// make a processor wait.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Whether(usize);

impl Faults for Whether {
    const NONE: Self = Self(0);

    #[inline(always)]
    fn is_any(self) -> bool {
        self.0 != 0
    }

    #[inline(always)]
    fn noting(self, _: usize, _: Fault) -> Self {
        Self(1)
    }

    #[inline(always)]
    fn within(self, _: usize, _: bool) -> Self {
        self
    }
}

/// The first fault, and in which field it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct First {
    is_any: bool,
    /// The first one, if there is any.
    error: Error,
}

impl Faults for First {
    const NONE: Self = Self {
        is_any: false,
        error: Error::at(0, Fault::Truncated),
    };

    fn is_any(self) -> bool {
        self.is_any
    }

    fn noting(mut self, bit: usize, fault: Fault) -> Self {
        if !self.is_any {
            self.is_any = true;
            self.error = Error::at(bit, fault);
        }
        self
    }

    fn within(mut self, index: usize, before: bool) -> Self {
        if self.is_any && !before {
            self.error = self.error.within(index);
        }
        self
    }
}

impl Reader<'_, First> {
    /// The reader, if there was no fault.
    ///
    /// # Errors
    /// The first fault.
    pub fn result(self) -> Result<Self, Error> {
        if self.has_failed() {
            Err(self.error())
        } else {
            Ok(self)
        }
    }

    /// The first fault, if there was one.
    pub(crate) const fn error(self) -> Error {
        self.faults.error
    }
}

/// The bits behind an open type that is being read.
#[derive(Clone, Copy, Debug)]
pub struct Outer {
    /// Where the open type began, behind its length.
    start: usize,
    /// The end of what the open type is in.
    end: usize,
}

impl<'a, F: Faults> Reader<'a, F> {
    /// All bits of `octets`.
    #[must_use]
    pub const fn new(octets: &'a [u8]) -> Self {
        Self {
            octets,
            position: 0,
            end: octets.len() * 8,
            extended: 0,
            faults: F::NONE,
        }
    }

    /// The next bit, counted from the start of the encoding.
    #[must_use]
    pub const fn position(self) -> usize {
        self.position
    }

    /// How many bits are left.
    #[must_use]
    pub const fn left(self) -> usize {
        self.end.saturating_sub(self.position)
    }

    /// How many SEQUENCEs had unknown extension additions so far.
    #[must_use]
    pub const fn extended(self) -> usize {
        self.extended
    }

    /// True if there was a fault.
    #[must_use]
    #[inline(always)]
    pub fn has_failed(self) -> bool {
        self.faults.is_any()
    }

    /// Notes the fault.
    #[must_use]
    #[inline(always)]
    pub(crate) fn fail(mut self, bit: usize, fault: Fault) -> Self {
        self.faults = self.faults.noting(bit, fault);
        self
    }

    /// Says that field `index` has been read. `had_failed` tells whether there was a fault before it.
    #[must_use]
    #[inline(always)]
    pub(crate) fn behind_field(mut self, index: usize, had_failed: bool) -> Self {
        self.faults = self.faults.within(index, had_failed);
        self
    }

    /// Skips `count` bits, which are fewer than 2^32. There is a [`Fault::Truncated`] when fewer are
    /// left.
    #[must_use]
    #[inline(always)]
    pub fn skip(mut self, count: usize) -> Self {
        self.position += count;
        if self.position > self.end {
            return self.fail(self.end, Fault::Truncated);
        }
        self
    }

    /// The next `count` bits as a number, first bit highest. `count` is at most 32. There is a
    /// [`Fault::Truncated`] when fewer are left.
    #[must_use]
    #[inline(always)]
    pub fn bits(self, count: u32) -> Read<'a, u32, F> {
        debug_assert!(count <= 32);
        if count == 0 {
            return (0, self);
        }
        let aligned = self.window() << (self.position % 8);
        let number = aligned >> (64 - count);
        (number as u32, self.skip(count as usize))
    }

    /// The octets from that of the next bit on, first octet highest. What is behind the encoding is
    /// zero.
    #[inline(always)]
    fn window(self) -> u64 {
        match self.octets.get(self.position / 8..) {
            Some(&[a, b, c, d, e, f, g, h, ..]) => u64::from_be_bytes([a, b, c, d, e, f, g, h]),
            Some(last) => last_window(last),
            None => 0,
        }
    }

    /// The next bit.
    #[must_use]
    #[inline(always)]
    pub fn bit(self) -> Read<'a, bool, F> {
        let (bit, reader) = self.bits(1);
        (bit == 1, reader)
    }

    /// An integer from `min` to `max` (X.691 clause 11.5). There is a [`Fault::Value`] for a larger
    /// one.
    #[must_use]
    #[inline(always)]
    pub fn integer(self, min: i64, max: i64) -> Read<'a, i64, F> {
        self.integer_of(self.position, min, max)
    }

    /// As [`integer`](Self::integer), of a field that begins at bit `start`.
    #[inline(always)]
    fn integer_of(self, start: usize, min: i64, max: i64) -> Read<'a, i64, F> {
        let (offset, reader) = self.bits(width(min, max));
        let number = min + i64::from(offset);
        if number > max {
            return (min, reader.fail(start, Fault::Value { number, min, max }));
        }
        (number, reader)
    }

    /// As [`integer`](Self::integer), of a type with an extension marker (X.691 clause 13.1). There is
    /// a [`Fault::BeyondRoot`] for one behind the marker.
    #[must_use]
    #[inline(always)]
    pub fn extensible_integer(self, min: i64, max: i64) -> Read<'a, i64, F> {
        self.root().integer_of(self.position, min, max)
    }

    /// The extension bit of an INTEGER or a size, which has to be clear. There is a
    /// [`Fault::BeyondRoot`] when it is set.
    #[must_use]
    #[inline(always)]
    pub fn root(self) -> Self {
        let (is_beyond, reader) = self.bit();
        if is_beyond {
            return reader.fail(self.position, Fault::BeyondRoot);
        }
        reader
    }

    /// The index of an alternative, below `count` (X.691 clauses 14.2 and 23.6). There is a
    /// [`Fault::UnknownAlternative`] for a larger one.
    #[must_use]
    #[inline(always)]
    pub fn index(self, count: usize) -> Read<'a, usize, F> {
        let (index, reader) = self.bits(width(0, count as i64 - 1));
        let index = index as usize;
        if index >= count {
            return (0, reader.fail(self.position, Fault::UnknownAlternative));
        }
        (index, reader)
    }

    /// The index of a value of an ENUMERATED that has `count` values and no additions that are known
    /// (X.691 clause 14). There is a [`Fault::UnknownAlternative`] for a value that is not known.
    #[must_use]
    #[inline(always)]
    pub fn enumerated(self, count: usize, is_extensible: bool) -> Read<'a, usize, F> {
        if !is_extensible {
            return self.index(count);
        }
        let (is_addition, reader) = self.bit();
        let (index, behind) = reader.index(count);
        if is_addition {
            let (_, mut addition) = reader.small_number();
            addition.position = behind.position;
            return (0, addition.fail(self.position, Fault::UnknownAlternative));
        }
        (index, behind)
    }

    /// A normally small number below 64 (X.691 clause 11.6); `None` for a larger one.
    #[must_use]
    pub fn small_number(self) -> Read<'a, Option<usize>, F> {
        let (is_large, reader) = self.bit();
        if is_large {
            return (None, reader);
        }
        let (number, reader) = reader.bits(6);
        (Some(number as usize), reader)
    }

    /// A length determinant in octets (X.691 clause 11.9), which no message can exceed in its two
    /// shorter forms. The encoding of a type has at least one octet (X.691 clause 11.1).
    fn length(self) -> Read<'a, usize, F> {
        let (first, reader) = self.bits(8);
        let (length, least, reader) = match first {
            0..0x80 => (first, 1, reader),
            0x80..0xC0 => {
                let (second, reader) = reader.bits(8);
                ((first & 0x3F) << 8 | second, 0x80, reader)
            }
            _ => return (0, reader.fail(self.position, Fault::Truncated)),
        };
        if length < least {
            return (0, reader.fail(self.position, Fault::Length));
        }
        (length as usize, reader)
    }

    /// The inside of an open type (X.691 clause 11.2). [`close`](Self::close) ends it. There is a
    /// [`Fault::Length`], or a [`Fault::Truncated`] when there is less than the length says.
    #[must_use]
    pub fn open(self) -> Read<'a, Outer, F> {
        let (length, reader) = self.length();
        let (start, end) = (reader.position, reader.end);
        let mut inner = reader.skip(length * 8);
        inner.end = inner.position;
        inner.position = start;
        (Outer { start, end }, inner)
    }

    /// The reader behind an open type, all of which has been read but for its padding. There is a
    /// [`Fault::Padding`], or a [`Fault::Length`] when the open type has more octets than its value.
    #[must_use]
    pub fn close(self, outer: Outer) -> Self {
        let mut reader = self.padding(outer.start);
        if reader.left() > 0 {
            reader = reader.fail(reader.position, Fault::Length);
        }
        reader.end = outer.end;
        reader
    }

    /// Skips the zero bits that fill the last octet of an encoding that began at bit `start`. An
    /// encoding without bits has one octet all the same (X.691 clause 11.1). There is a
    /// [`Fault::Padding`] when they are not zero.
    #[must_use]
    pub fn padding(self, start: usize) -> Self {
        let count = match self.position - start {
            0 => 8,
            used => (8 - used as u32 % 8) % 8,
        };
        match self.bits(count) {
            (0, reader) => reader,
            (_, reader) => reader.fail(self.position, Fault::Padding),
        }
    }

    /// Skips the extension additions of a SEQUENCE (X.691 clauses 19.7 to 19.9), none of which is
    /// known.
    #[must_use]
    #[inline(always)]
    pub fn skip_additions(self) -> Self {
        let behind = self.behind_additions();
        // Part by part, or else a reader would go through memory also where there are no additions.
        Self {
            octets: self.octets,
            position: behind.position,
            end: self.end,
            extended: self.extended + 1,
            faults: behind.faults,
        }
    }

    /// The reader behind extension additions. Every turn of the loop takes two octets, so the input
    /// bounds it.
    #[cold]
    fn behind_additions(self) -> Self {
        let (last, reader) = self.small_number();
        let Some(last) = last else {
            return reader.fail(self.position, Fault::TooManyAdditions);
        };
        let bitmap_start = reader.position;
        let count = last as u32 + 1;
        let (high, reader) = reader.bits(count.saturating_sub(32));
        let (low, mut reader) = reader.bits(count.min(32));
        let present = high.count_ones() + low.count_ones();
        if present == 0 {
            return reader.fail(bitmap_start, Fault::NoAddition);
        }
        let mut skipped = 0;
        while skipped < present && !reader.has_failed() {
            let (length, behind) = reader.length();
            reader = behind.skip(length * 8);
            skipped += 1;
        }
        reader
    }
}

/// As [`Reader::window`], where fewer than eight octets are left. Of a window five octets count,
/// whatever bit of its first one the bits begin at.
#[cold]
fn last_window(octets: &[u8]) -> u64 {
    let octet = |index: usize| {
        if index < octets.len() {
            octets[index]
        } else {
            0
        }
    };
    u64::from_be_bytes([octet(0), octet(1), octet(2), octet(3), octet(4), 0, 0, 0])
}
