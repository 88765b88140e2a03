//! The octets of a message, read bit by bit.

use std::cell::{Cell, RefCell};

use crate::core::Fault;

/// Error of the rasn traits. It carries the field; what is wrong is kept in the source.
pub(super) type Rejected = rasn::error::DecodeError;

/// The octets of a message and how far they have been read.
///
/// The decoders of nested types share one source, so it is read through a shared reference.
pub(super) struct Source<'a> {
    octets: &'a [u8],
    /// The next bit.
    position: Cell<usize>,
    /// The bit behind the last one.
    end: Cell<usize>,
    /// What is wrong, and at which bit.
    fault: Cell<Option<(usize, Fault)>>,
    /// Extension additions that were skipped, in the order of their bits.
    skipped: RefCell<Vec<Skipped>>,
}

/// The unknown extension additions of one SEQUENCE, by their bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Skipped {
    /// The extension bit.
    pub(super) marker: usize,
    /// The first bit behind the root.
    pub(super) start: usize,
    /// The bit behind the last addition.
    pub(super) end: usize,
}

impl<'a> Source<'a> {
    pub(super) fn new(octets: &'a [u8]) -> Self {
        Self {
            octets,
            position: Cell::new(0),
            end: Cell::new(octets.len() * 8),
            fault: Cell::new(None),
            skipped: RefCell::new(Vec::new()),
        }
    }

    /// The next bit.
    pub(super) fn position(&self) -> usize {
        self.position.get()
    }

    /// How many bits are left.
    pub(super) fn left(&self) -> usize {
        self.end.get() - self.position.get()
    }

    /// Notes what is wrong with the bits from `bit` on.
    pub(super) fn reject_at(&self, bit: usize, fault: Fault) -> Rejected {
        self.fault.set(Some((bit, fault)));
        <Rejected as rasn::de::Error>::custom("malformed", rasn::Codec::Uper)
    }

    /// What was noted last.
    pub(super) fn fault(&self) -> Option<(usize, Fault)> {
        self.fault.get()
    }

    /// Skips `count` bits.
    pub(super) fn skip(&self, count: usize) -> Result<(), Rejected> {
        if count > self.left() {
            return Err(self.reject_at(self.end.get(), Fault::Truncated));
        }
        self.position.set(self.position.get() + count);
        Ok(())
    }

    /// The next `count` bits as a number, at most 64.
    pub(super) fn bits(&self, count: u32) -> Result<u64, Rejected> {
        let first = self.position.get();
        self.skip(count as usize)?;
        let bits = first..first + count as usize;
        Ok(bits.fold(0, |number, bit| number << 1 | u64::from(self.bit_at(bit))))
    }

    pub(super) fn bit(&self) -> Result<bool, Rejected> {
        self.bits(1).map(|bit| bit == 1)
    }

    fn bit_at(&self, bit: usize) -> bool {
        self.octets[bit / 8] >> (7 - bit % 8) & 1 == 1
    }

    /// A length determinant in octets (X.691 clause 11.9), which no message can exceed in its
    /// two shorter forms.
    fn length(&self) -> Result<usize, Rejected> {
        let start = self.position();
        let mut length = self.bits(8)?;
        if length >= 0x80 {
            if length >= 0xC0 {
                return Err(self.reject_at(start, Fault::Truncated));
            }
            length = (length & 0x3F) << 8 | self.bits(8)?;
            if length < 0x80 {
                return Err(self.reject_at(start, Fault::Length));
            }
        }
        let length = usize::try_from(length).unwrap_or(usize::MAX);
        // The encoding of a type has at least one octet (X.691 clause 11.1).
        if length == 0 {
            return Err(self.reject_at(start, Fault::Length));
        }
        Ok(length)
    }

    /// Reads an open type with `read`, which must use all of it but the padding.
    pub(super) fn open_type<T>(
        &self,
        read: impl FnOnce() -> Result<T, Rejected>,
    ) -> Result<T, Rejected> {
        let length = self.length()?;
        if length * 8 > self.left() {
            return Err(self.reject_at(self.end.get(), Fault::Truncated));
        }
        let outer_end = self.end.get();
        let start = self.position();
        self.end.set(start + length * 8);
        let value = read()?;
        self.padding(start)?;
        if self.left() > 0 {
            return Err(self.reject_at(self.position(), Fault::Length));
        }
        self.end.set(outer_end);
        Ok(value)
    }

    /// Skips an open type.
    fn skip_open_type(&self) -> Result<(), Rejected> {
        let length = self.length()?;
        self.skip(length * 8)
    }

    /// Reads the zero bits that fill the last octet of an encoding that began at bit `start`. An
    /// encoding without bits has one octet all the same (X.691 clause 11.1).
    pub(super) fn padding(&self, start: usize) -> Result<(), Rejected> {
        let bit = self.position();
        let used = bit - start;
        #[expect(clippy::cast_possible_truncation, reason = "at most 8")]
        let count = (used.max(1).next_multiple_of(8) - used) as u32;
        if self.bits(count)? != 0 {
            return Err(self.reject_at(bit, Fault::Padding));
        }
        Ok(())
    }

    /// A normally small number below 64 (X.691 clause 11.6); `None` for a larger one.
    pub(super) fn small_number(&self) -> Result<Option<usize>, Rejected> {
        if self.bit()? {
            return Ok(None);
        }
        Ok(usize::try_from(self.bits(6)?).ok())
    }

    /// Skips the extension additions of a SEQUENCE (X.691 clause 19.7 to 19.9), none of which is
    /// known. `marker` is its extension bit.
    pub(super) fn skip_additions(&self, marker: usize) -> Result<(), Rejected> {
        let start = self.position();
        let Some(last) = self.small_number()? else {
            return Err(self.reject_at(start, Fault::TooManyAdditions));
        };
        let bitmap_start = self.position();
        let mut present = 0;
        for _ in 0..=last {
            present += usize::from(self.bit()?);
        }
        if present == 0 {
            return Err(self.reject_at(bitmap_start, Fault::NoAddition));
        }
        for _ in 0..present {
            self.skip_open_type()?;
        }
        let end = self.position();
        self.skipped
            .borrow_mut()
            .push(Skipped { marker, start, end });
        Ok(())
    }

    /// The extension additions that were skipped, in the order of their bits.
    pub(super) fn into_skipped(self) -> Vec<Skipped> {
        self.skipped.into_inner()
    }
}
