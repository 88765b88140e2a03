//! The bits of an encoding, read in order.

#![allow(
    clippy::inline_always,
    reason = "a reader that goes through memory at every field is several times slower"
)]

use super::error::{Error, Fault};
use super::width;

/// What reading gives: a value and the reader behind it.
pub type Read<'a, T> = Result<(T, Reader<'a>), Error>;

/// The bits of an encoding from one bit on.
///
/// A reader is passed by value and comes back with what was read, so nothing is read twice, and after
/// an error there is no reader left to go on with. It copies nothing and never panics.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    octets: &'a [u8],
    /// The next bit.
    position: usize,
    /// The bit behind the last one.
    end: usize,
    /// How many SEQUENCEs had unknown extension additions.
    extended: usize,
}

/// What is behind an open type that is being read.
#[derive(Clone, Copy, Debug)]
pub struct Outer {
    /// Where the open type began, behind its length.
    start: usize,
    /// The end of what the open type is in.
    end: usize,
}

/// How many bits of a window count, whatever bit of its first octet they begin at.
const WINDOW_OCTETS: usize = 5;

impl<'a> Reader<'a> {
    /// All bits of `octets`.
    #[must_use]
    pub const fn new(octets: &'a [u8]) -> Self {
        Self {
            octets,
            position: 0,
            end: octets.len() * 8,
            extended: 0,
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
        self.end - self.position
    }

    /// How many SEQUENCEs had unknown extension additions so far.
    #[must_use]
    pub const fn extended(self) -> usize {
        self.extended
    }

    /// Skips `count` bits.
    ///
    /// # Errors
    /// [`Fault::Truncated`] when fewer are left.
    #[inline(always)]
    pub fn skip(self, count: usize) -> Result<Self, Error> {
        if count > self.left() {
            return Err(Error::at(self.end, Fault::Truncated));
        }
        let position = self.position + count;
        Ok(Self { position, ..self })
    }

    /// The next `count` bits as a number, first bit highest. `count` is at most 32.
    ///
    /// # Errors
    /// [`Fault::Truncated`] when fewer are left.
    #[inline(always)]
    pub fn bits(self, count: u32) -> Read<'a, u32> {
        debug_assert!(count <= 32);
        let reader = self.skip(count as usize)?;
        let aligned = self.window() << (self.position % 8);
        // Twice, since a shift by 64 is none.
        let number = aligned >> 1 >> (63 - count);
        Ok((number as u32, reader))
    }

    /// The octets from that of the next bit on, first octet highest. What is behind the encoding is
    /// zero.
    #[inline(always)]
    fn window(self) -> u64 {
        let first = self.position / 8;
        match self.octets.get(first..).and_then(<[u8]>::first_chunk::<8>) {
            Some(octets) => u64::from_be_bytes(*octets),
            None => self.last_window(first),
        }
    }

    /// As [`window`](Self::window), where fewer than eight octets are left.
    #[cold]
    fn last_window(self, first: usize) -> u64 {
        let mut window = 0;
        for index in 0..WINDOW_OCTETS {
            let octet = self.octets.get(first + index).copied().unwrap_or(0);
            window |= u64::from(octet) << (56 - 8 * index);
        }
        window
    }

    /// The next bit.
    ///
    /// # Errors
    /// [`Fault::Truncated`] when there is none.
    #[inline(always)]
    pub fn bit(self) -> Read<'a, bool> {
        let (bit, reader) = self.bits(1)?;
        Ok((bit == 1, reader))
    }

    /// An integer from `min` to `max` (X.691 clause 11.5).
    ///
    /// # Errors
    /// [`Fault::Value`] for a larger one.
    #[inline(always)]
    pub fn integer(self, min: i64, max: i64) -> Read<'a, i64> {
        let (offset, reader) = self.bits(width(min, max))?;
        let number = min + i64::from(offset);
        if number > max {
            let fault = Fault::Value { number, min, max };
            return Err(Error::at(self.position, fault));
        }
        Ok((number, reader))
    }

    /// As [`integer`](Self::integer), of a type with an extension marker (X.691 clause 13.1).
    ///
    /// # Errors
    /// [`Fault::Value`] for a larger one, [`Fault::BeyondRoot`] for one behind the marker.
    pub fn extensible_integer(self, min: i64, max: i64) -> Read<'a, i64> {
        let read = self.root()?.integer(min, max);
        read.map_err(|error| match error.fault {
            Fault::Value { .. } => Error::at(self.position, error.fault),
            _ => error,
        })
    }

    /// The extension bit of an INTEGER or a size, which has to be clear.
    ///
    /// # Errors
    /// [`Fault::BeyondRoot`] when it is set.
    #[inline(always)]
    pub fn root(self) -> Result<Self, Error> {
        match self.bit()? {
            (false, reader) => Ok(reader),
            (true, _) => Err(Error::at(self.position, Fault::BeyondRoot)),
        }
    }

    /// The index of an alternative, below `count` (X.691 clauses 14.2 and 23.6).
    ///
    /// # Errors
    /// [`Fault::UnknownAlternative`] for a larger one.
    #[inline(always)]
    pub fn index(self, count: usize) -> Read<'a, usize> {
        let (index, reader) = self.bits(width(0, count as i64 - 1))?;
        let index = index as usize;
        if index >= count {
            return Err(Error::at(self.position, Fault::UnknownAlternative));
        }
        Ok((index, reader))
    }

    /// The index of a value of an ENUMERATED that has `count` values and no additions that are known
    /// (X.691 clause 14).
    ///
    /// # Errors
    /// [`Fault::UnknownAlternative`] for a value that is not known.
    #[inline(always)]
    pub fn enumerated(self, count: usize, is_extensible: bool) -> Read<'a, usize> {
        if !is_extensible {
            return self.index(count);
        }
        match self.bit()? {
            (false, reader) => reader.index(count),
            (true, reader) => {
                reader.small_number()?;
                Err(Error::at(self.position, Fault::UnknownAlternative))
            }
        }
    }

    /// A normally small number below 64 (X.691 clause 11.6); `None` for a larger one.
    ///
    /// # Errors
    /// [`Fault::Truncated`].
    pub fn small_number(self) -> Read<'a, Option<usize>> {
        match self.bit()? {
            (true, reader) => Ok((None, reader)),
            (false, reader) => {
                let (number, reader) = reader.bits(6)?;
                Ok((Some(number as usize), reader))
            }
        }
    }

    /// A length determinant in octets (X.691 clause 11.9), which no message can exceed in its two
    /// shorter forms. The encoding of a type has at least one octet (X.691 clause 11.1).
    fn length(self) -> Read<'a, usize> {
        let (first, reader) = self.bits(8)?;
        let (length, least, reader) = match first {
            0..0x80 => (first, 1, reader),
            0x80..0xC0 => {
                let (second, reader) = reader.bits(8)?;
                ((first & 0x3F) << 8 | second, 0x80, reader)
            }
            _ => return Err(Error::at(self.position, Fault::Truncated)),
        };
        if length < least {
            return Err(Error::at(self.position, Fault::Length));
        }
        Ok((length as usize, reader))
    }

    /// The inside of an open type (X.691 clause 11.2). [`close`](Self::close) ends it.
    ///
    /// # Errors
    /// [`Fault::Length`], and [`Fault::Truncated`] when there is less than the length says.
    pub fn open(self) -> Read<'a, Outer> {
        let (length, reader) = self.length()?;
        let (start, end) = (reader.position, reader.end);
        let inner_end = reader.skip(length * 8)?.position;
        let inner = Self {
            end: inner_end,
            ..reader
        };
        Ok((Outer { start, end }, inner))
    }

    /// What is behind an open type, all of which has been read but for its padding.
    ///
    /// # Errors
    /// [`Fault::Padding`], and [`Fault::Length`] when the open type has more octets than its value.
    pub fn close(self, outer: Outer) -> Result<Self, Error> {
        let reader = self.padding(outer.start)?;
        if reader.left() > 0 {
            return Err(Error::at(reader.position, Fault::Length));
        }
        let end = outer.end;
        Ok(Self { end, ..reader })
    }

    /// Skips the zero bits that fill the last octet of an encoding that began at bit `start`. An
    /// encoding without bits has one octet all the same (X.691 clause 11.1).
    ///
    /// # Errors
    /// [`Fault::Padding`] when they are not zero.
    pub fn padding(self, start: usize) -> Result<Self, Error> {
        let count = match self.position - start {
            0 => 8,
            used => (8 - used as u32 % 8) % 8,
        };
        match self.bits(count)? {
            (0, reader) => Ok(reader),
            _ => Err(Error::at(self.position, Fault::Padding)),
        }
    }

    /// Skips the extension additions of a SEQUENCE (X.691 clauses 19.7 to 19.9), none of which is
    /// known. Every turn of the loop takes two octets, so the input bounds it.
    ///
    /// # Errors
    /// When they are not well-formed.
    pub fn skip_additions(self) -> Result<Self, Error> {
        let (last, reader) = self.small_number()?;
        let Some(last) = last else {
            return Err(Error::at(self.position, Fault::TooManyAdditions));
        };
        let bitmap_start = reader.position;
        let count = last as u32 + 1;
        let (high, reader) = reader.bits(count.saturating_sub(32))?;
        let (low, mut reader) = reader.bits(count.min(32))?;
        let present = high.count_ones() + low.count_ones();
        if present == 0 {
            return Err(Error::at(bitmap_start, Fault::NoAddition));
        }
        for _ in 0..present {
            let (length, behind) = reader.length()?;
            reader = behind.skip(length * 8)?;
        }
        let extended = reader.extended + 1;
        Ok(Self { extended, ..reader })
    }
}
