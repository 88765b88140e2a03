//! Canonical octet encoding rules (ITU-T X.696), as far as envelopes and certificates need them.
//!
//! Octets come from strangers: nothing is reserved for what they announce, nothing recurses, and what
//! a caller needs for a hash it gets as the octets that were received.

use super::rejected::Malformed;

/// Octets that are yet to be read.
#[derive(Clone, Copy, Debug)]
pub(super) struct OerReader<'a>(&'a [u8]);

type OerRead<T> = Result<T, Malformed>;

impl<'a> OerReader<'a> {
    pub(super) const fn new(octets: &'a [u8]) -> Self {
        Self(octets)
    }

    /// Octets that are yet to be read.
    pub(super) const fn rest(&self) -> &'a [u8] {
        self.0
    }

    /// The next octets.
    pub(super) fn take(&mut self, length: usize, field: &'static str) -> OerRead<&'a [u8]> {
        let (taken, rest) = self
            .0
            .split_at_checked(length)
            .ok_or(Malformed::Truncated(field))?;
        self.0 = rest;
        Ok(taken)
    }

    /// The next octets, as many as the caller says.
    pub(super) fn array<const N: usize>(&mut self, field: &'static str) -> OerRead<[u8; N]> {
        let (first, rest) = self
            .0
            .split_first_chunk()
            .ok_or(Malformed::Truncated(field))?;
        self.0 = rest;
        Ok(*first)
    }

    /// One octet: a preamble, tag, enumerated value or `Uint8`.
    pub(super) fn octet(&mut self, field: &'static str) -> OerRead<u8> {
        self.array(field).map(u8::from_be_bytes)
    }

    pub(super) fn u16(&mut self, field: &'static str) -> OerRead<u16> {
        self.array(field).map(u16::from_be_bytes)
    }

    pub(super) fn u32(&mut self, field: &'static str) -> OerRead<u32> {
        self.array(field).map(u32::from_be_bytes)
    }

    pub(super) fn i32(&mut self, field: &'static str) -> OerRead<i32> {
        self.array(field).map(i32::from_be_bytes)
    }

    pub(super) fn u64(&mut self, field: &'static str) -> OerRead<u64> {
        self.array(field).map(u64::from_be_bytes)
    }

    /// An octet that has one value.
    pub(super) fn expect(&mut self, value: u8, field: &'static str) -> OerRead<()> {
        match self.octet(field)? {
            found if found == value => Ok(()),
            found => Err(Malformed::Value { field, found }),
        }
    }

    /// A length determinant, in its shortest form.
    pub(super) fn length(&mut self, field: &'static str) -> OerRead<usize> {
        let first = self.octet(field)?;
        if first < 0x80 {
            return Ok(usize::from(first));
        }
        let length = match first {
            0x81 => usize::from(self.octet(field)?),
            0x82 => usize::from(self.u16(field)?),
            // Nothing that fits in a packet is longer than 65535 octets.
            _ => return Err(Malformed::TooMany(field)),
        };
        let shortest = if first == 0x81 { 0x80 } else { 0x100 };
        if length < shortest {
            return Err(Malformed::NotCanonical(field));
        }
        Ok(length)
    }

    /// A length and as many octets: an OCTET STRING, a `UTF8String`, an open type.
    pub(super) fn opaque(&mut self, field: &'static str) -> OerRead<&'a [u8]> {
        let length = self.length(field)?;
        self.take(length, field)
    }

    /// `INTEGER (0..MAX)` that fits in 32 bits, as every ITS-AID does.
    pub(super) fn unsigned(&mut self, field: &'static str) -> OerRead<u32> {
        let octets = self.opaque(field)?;
        match octets {
            [] | [0, _, ..] => Err(Malformed::NotCanonical(field)),
            [_, _, _, _, _, ..] => Err(Malformed::TooMany(field)),
            octets => Ok(octets.iter().fold(0, |n, octet| n << 8 | u32::from(*octet))),
        }
    }

    /// `INTEGER` without bounds that fits in 8 bits, as chain lengths do.
    pub(super) fn small_integer(&mut self, field: &'static str) -> OerRead<i8> {
        match self.opaque(field)? {
            [octet] => Ok(i8::from_be_bytes([*octet])),
            [] => Err(Malformed::NotCanonical(field)),
            _ => Err(Malformed::TooMany(field)),
        }
    }

    /// How many elements a SEQUENCE OF has.
    pub(super) fn quantity(&mut self, max: u32, field: &'static str) -> OerRead<u32> {
        match self.unsigned(field)? {
            quantity if quantity <= max => Ok(quantity),
            _ => Err(Malformed::TooMany(field)),
        }
    }

    /// The extension additions of a SEQUENCE, each in its place if it is present; of those behind
    /// the first `N`, nothing.
    ///
    /// The size of the presence bitmap is that of the sender's version; any is taken.
    pub(super) fn additions<const N: usize>(
        &mut self,
        field: &'static str,
    ) -> OerRead<[Option<&'a [u8]>; N]> {
        let bitmap = self.opaque(field)?;
        let (unused, bits) = match bitmap {
            [unused, bits @ ..] if *unused < 8 && (1..=8).contains(&bits.len()) => (*unused, bits),
            _ => return Err(Malformed::Value { field, found: 0 }),
        };
        if bits.iter().all(|octet| *octet == 0) {
            // None is present: then there is no bitmap either.
            return Err(Malformed::NotCanonical(field));
        }
        let count = bits.len() * 8 - usize::from(unused);
        let mut additions = [None; N];
        for at in 0..bits.len() * 8 {
            if bits[at / 8] & (0x80 >> (at % 8)) == 0 {
                continue;
            }
            if at >= count {
                return Err(Malformed::NotCanonical(field));
            }
            let content = self.opaque(field)?;
            if let Some(addition) = additions.get_mut(at) {
                *addition = Some(content);
            }
        }
        Ok(additions)
    }

    /// Nothing may be left.
    pub(super) const fn finish(self, field: &'static str) -> OerRead<()> {
        if self.0.is_empty() {
            Ok(())
        } else {
            Err(Malformed::Trailing(field))
        }
    }
}

/// Appends a length determinant in its shortest form.
pub(super) fn put_length(length: usize, to: &mut Vec<u8>) {
    match u16::try_from(length).unwrap_or(u16::MAX).to_be_bytes() {
        [0, low @ 0..=0x7f] => to.push(low),
        [0, low] => to.extend([0x81, low]),
        [high, low] => to.extend([0x82, high, low]),
    }
}

/// Appends an `INTEGER (0..MAX)`.
pub(super) fn put_unsigned(value: u32, to: &mut Vec<u8>) {
    let octets = value.to_be_bytes();
    let first = octets.iter().position(|octet| *octet != 0).unwrap_or(3);
    put_length(octets.len() - first, to);
    to.extend_from_slice(&octets[first..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_integers_have_one_form() {
        for length in [0, 1, 0x7f, 0x80, 0xff, 0x100, 1_500] {
            let mut octets = Vec::new();
            put_length(length, &mut octets);
            assert_eq!(OerReader::new(&octets).length("l"), Ok(length));
        }
        for value in [
            0,
            36,
            127,
            128,
            638,
            16_480,
            2_112_640,
            270_549_118,
            u32::MAX,
        ] {
            let mut octets = Vec::new();
            put_unsigned(value, &mut octets);
            assert_eq!(OerReader::new(&octets).unsigned("i"), Ok(value));
        }
        let not_canonical = Err(Malformed::NotCanonical("l"));
        for octets in [&[0x81, 0x7f][..], &[0x82, 0, 0xff]] {
            assert_eq!(OerReader::new(octets).length("l"), not_canonical);
        }
        for octets in [&[0][..], &[2, 0, 36]] {
            assert!(OerReader::new(octets).unsigned("i").is_err());
        }
    }

    #[test]
    fn what_is_announced_is_not_believed() {
        let huge = [8, 0x7f, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff];
        assert_eq!(
            OerReader::new(&huge).quantity(8, "q"),
            Err(Malformed::TooMany("q"))
        );
        assert_eq!(
            OerReader::new(&[0x84, 0xff, 0xff, 0xff, 0xff]).opaque("o"),
            Err(Malformed::TooMany("o"))
        );
    }

    #[test]
    fn additions_of_older_and_newer_senders_are_found() {
        // HeaderInfo of 2016 knows two additions, that of 2022 four.
        for octets in [
            [2, 6, 0x80, 5, 1, 1, 0xaa, 0xbb, 0xcc],
            [2, 4, 0x80, 5, 1, 1, 0xaa, 0xbb, 0xcc],
        ] {
            let mut reader = OerReader::new(&octets);
            let [first, second] = reader.additions("a").unwrap();
            assert_eq!(first, Some(&octets[4..]));
            assert_eq!(second, None);
            assert_eq!(reader.finish("a"), Ok(()));
        }
        let beyond = [2, 6, 0x20, 1, 0];
        assert_eq!(
            OerReader::new(&beyond).additions::<2>("a"),
            Err(Malformed::NotCanonical("a"))
        );
    }
}
