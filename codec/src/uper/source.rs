//! The octets of a message, read bit by bit.

use std::cell::{Cell, RefCell};

use crate::core::Fault;

/// Error of the rasn traits. It carries the field; what is wrong is kept in the source.
pub(super) type RasnError = rasn::error::DecodeError;

/// The octets of a message and how far they have been read.
///
/// The decoders of nested types share one source, so it is read through a shared reference.
pub(super) struct BitSource<'a> {
    octets: &'a [u8],
    /// The next bit.
    position: Cell<usize>,
    /// The bit behind the last one.
    end: Cell<usize>,
    /// What is wrong, and at which bit.
    fault: Cell<Option<(usize, Fault)>>,
    /// How many SEQUENCEs had extension additions that were skipped.
    extended: Cell<usize>,
    /// What a sender without these additions would have sent in their place.
    edits: RefCell<Vec<Edit>>,
}

/// Bits of the message, and what stands there without unknown extension additions.
#[derive(Clone, Debug)]
pub(super) struct Edit {
    /// The first bit.
    pub(super) start: usize,
    /// The bit behind the last one.
    pub(super) end: usize,
    /// The bits in their place.
    pub(super) instead: Vec<bool>,
}

/// The extension additions of one SEQUENCE: which of them are present.
#[derive(Clone, Copy, Debug)]
pub(super) struct Additions {
    /// Where their number stands.
    start: usize,
    /// The first bit behind their presence bits.
    end: usize,
    /// How many there may be.
    count: usize,
    /// How many of them have been asked for.
    next: usize,
    /// Presence bits, the first addition highest of `count`.
    presence: u64,
}

impl Additions {
    /// Whether the next one is present.
    pub(super) fn next_is_present(&mut self) -> bool {
        let is_present = self.is_present(self.next);
        self.next += 1;
        is_present
    }

    fn is_present(&self, index: usize) -> bool {
        index < self.count && self.presence >> (self.count - 1 - index) & 1 == 1
    }
}

impl<'a> BitSource<'a> {
    pub(super) fn new(octets: &'a [u8]) -> Self {
        Self {
            octets,
            position: Cell::new(0),
            end: Cell::new(octets.len() * 8),
            fault: Cell::new(None),
            extended: Cell::new(0),
            edits: RefCell::new(Vec::new()),
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
    pub(super) fn reject_at(&self, bit: usize, fault: Fault) -> RasnError {
        self.fault.set(Some((bit, fault)));
        <RasnError as rasn::de::Error>::custom("malformed", rasn::Codec::Uper)
    }

    /// What was noted last.
    pub(super) fn fault(&self) -> Option<(usize, Fault)> {
        self.fault.get()
    }

    /// Skips `count` bits.
    pub(super) fn skip(&self, count: usize) -> Result<(), RasnError> {
        if count > self.left() {
            return Err(self.reject_at(self.end.get(), Fault::Truncated));
        }
        self.position.set(self.position.get() + count);
        Ok(())
    }

    /// The next `count` bits as a number, at most 64.
    pub(super) fn bits(&self, count: u32) -> Result<u64, RasnError> {
        let first = self.position.get();
        self.skip(count as usize)?;
        let bits = first..first + count as usize;
        Ok(bits.fold(0, |number, bit| number << 1 | u64::from(self.bit_at(bit))))
    }

    pub(super) fn bit(&self) -> Result<bool, RasnError> {
        self.bits(1).map(|bit| bit == 1)
    }

    /// The next octets, which need not begin at an octet.
    pub(super) fn octets(&self, count: usize) -> Result<Vec<u8>, RasnError> {
        if count * 8 > self.left() {
            return Err(self.reject_at(self.end.get(), Fault::Truncated));
        }
        let octet = |_| {
            let octet = self.bits(8)?;
            Ok(u8::try_from(octet).unwrap_or(u8::MAX))
        };
        (0..count).map(octet).collect()
    }

    fn bit_at(&self, bit: usize) -> bool {
        self.octets[bit / 8] >> (7 - bit % 8) & 1 == 1
    }

    /// A length determinant in octets (X.691 clause 11.9), which no message can exceed in its
    /// two shorter forms.
    pub(super) fn length(&self) -> Result<usize, RasnError> {
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
        read: impl FnOnce() -> Result<T, RasnError>,
    ) -> Result<T, RasnError> {
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
    fn skip_open_type(&self) -> Result<(), RasnError> {
        let length = self.length()?;
        self.skip(length * 8)
    }

    /// Reads the zero bits that fill the last octet of an encoding that began at bit `start`. An
    /// encoding without bits has one octet all the same (X.691 clause 11.1).
    pub(super) fn padding(&self, start: usize) -> Result<(), RasnError> {
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
    pub(super) fn small_number(&self) -> Result<Option<usize>, RasnError> {
        if self.bit()? {
            return Ok(None);
        }
        Ok(usize::try_from(self.bits(6)?).ok())
    }

    /// Which extension additions a SEQUENCE has (X.691 clause 19.7 and 19.8).
    pub(super) fn additions(&self) -> Result<Additions, RasnError> {
        let start = self.position();
        let Some(last) = self.small_number()? else {
            return Err(self.reject_at(start, Fault::TooManyAdditions));
        };
        let bitmap_start = self.position();
        #[expect(clippy::cast_possible_truncation, reason = "at most 64")]
        let presence = self.bits(last as u32 + 1)?;
        if presence == 0 {
            return Err(self.reject_at(bitmap_start, Fault::NoAddition));
        }
        Ok(Additions {
            start,
            end: self.position(),
            count: last + 1,
            next: 0,
            presence,
        })
    }

    /// Skips the extension additions of a SEQUENCE behind the additions that are known and have been read.
    /// `marker` is its extension bit.
    pub(super) fn skip_additions(
        &self,
        marker: usize,
        known: usize,
        additions: Additions,
    ) -> Result<(), RasnError> {
        let start = self.position();
        let unknown = (known..additions.count).filter(|&index| additions.is_present(index));
        let unknown = unknown.count();
        for _ in 0..unknown {
            self.skip_open_type()?;
        }
        let end = self.position();
        let known: Vec<bool> = (0..known)
            .map(|index| additions.is_present(index))
            .collect();
        let mut edits = self.edits.borrow_mut();
        let mut replace = |start, end, instead| {
            edits.push(Edit {
                start,
                end,
                instead,
            });
        };
        if unknown > 0 {
            self.extended.set(self.extended.get() + 1);
        }
        if known.contains(&true) {
            // The number of known ones in the place of that of the sender's.
            let last = known.len() - 1;
            let number = (0..7).rev().map(|bit| last >> bit & 1 == 1);
            replace(
                additions.start,
                additions.end,
                number.chain(known).collect(),
            );
            replace(start, end, Vec::new());
        } else {
            replace(marker, marker + 1, vec![false]);
            replace(additions.start, end, Vec::new());
        }
        Ok(())
    }

    /// How many SEQUENCEs had additions that were skipped, and what stands there without them, in the
    /// order of the bits.
    pub(super) fn into_edits(self) -> (usize, Vec<Edit>) {
        let mut edits = self.edits.into_inner();
        edits.sort_by_key(|edit| (edit.start, edit.end));
        (self.extended.get(), edits)
    }
}
