//! The bits of an encoding, written in order.

#![allow(
    clippy::many_single_char_names,
    reason = "eight octets have no better names"
)]

use super::error::{Error, Fault};
use super::width;

/// A buffer, written up to one bit.
///
/// A writer is passed by value and comes back. What the buffer has no room for is dropped, and
/// [`finish`](Self::finish) says so; a buffer for the [`MAX_BITS`](super::Uper::MAX_BITS) of a type
/// has room for every value. It never panics.
#[derive(Debug)]
pub struct Writer<'a> {
    octets: &'a mut [u8],
    /// The next bit.
    position: usize,
    /// The bits of the octet that is begun, highest, and zeros.
    begun: u64,
}

impl<'a> Writer<'a> {
    /// Writes from the first bit of `octets` on, whatever they hold.
    #[must_use]
    pub const fn new(octets: &'a mut [u8]) -> Self {
        Self {
            octets,
            position: 0,
            begun: 0,
        }
    }

    /// The next bit.
    #[must_use]
    pub const fn position(&self) -> usize {
        self.position
    }

    /// Writes the lowest `count` bits of `number`, the highest of them first. `count` is at most 32,
    /// and the other bits of the number are zero.
    #[must_use]
    #[inline]
    pub fn bits(mut self, number: u32, count: u32) -> Self {
        debug_assert!(count <= 32 && u64::from(number) >> count == 0);
        if count == 0 {
            return self;
        }
        // Twice, since a shift by 64 is none.
        let aligned = u64::from(number) << (63 - count) << 1;
        let window = self.begun | aligned >> (self.position % 8);
        let first = self.position / 8;
        self.put(first, window);
        self.position += count as usize;
        self.begun = window << (8 * (self.position / 8 - first));
        self
    }

    /// Writes a window of octets, highest first. Octets that are not begun yet become zero.
    #[inline]
    fn put(&mut self, first: usize, window: u64) {
        let window = window.to_be_bytes();
        match self.octets.get_mut(first..) {
            Some([a, b, c, d, e, f, g, h, ..]) => {
                [*a, *b, *c, *d, *e, *f, *g, *h] = window;
            }
            Some(last) => put_last(last, window),
            None => {}
        }
    }

    /// Writes an integer from `min` to `max` (X.691 clause 11.5).
    #[must_use]
    #[inline]
    pub fn integer(self, number: i64, min: i64, max: i64) -> Self {
        debug_assert!(min <= number && number <= max);
        // No range has more than 2^32 numbers.
        self.bits((number - min) as u32, width(min, max))
    }

    /// Writes zero bits up to the end of an octet, counted from bit `start`.
    #[must_use]
    pub fn padding(self, start: usize) -> Self {
        let count = (8 - (self.position - start) as u32 % 8) % 8;
        self.bits(0, count)
    }

    /// How many octets the encoding has, which ends here. The rest of the last one is zero, and an
    /// encoding without bits has one octet all the same (X.691 clause 11.1).
    ///
    /// # Errors
    /// [`Fault::BufferFull`] when the buffer had no room for it.
    pub fn finish(self) -> Result<usize, Error> {
        let writer = match self.position {
            0 => self.bits(0, 8),
            _ => self,
        };
        let length = writer.position.div_ceil(8);
        if length > writer.octets.len() {
            return Err(Error::at(writer.octets.len() * 8, Fault::BufferFull));
        }
        Ok(length)
    }
}

/// As [`Writer::put`], where fewer than eight octets are left. 32 bits touch five octets at most.
#[cold]
fn put_last(octets: &mut [u8], window: [u8; 8]) {
    let mut put = |index: usize| {
        if index < octets.len() {
            octets[index] = window[index];
        }
    };
    put(0);
    put(1);
    put(2);
    put(3);
    put(4);
}
