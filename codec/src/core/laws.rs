//! Properties of the core as plain functions, one body for three callers: Kani with symbolic input,
//! proptest with random input, and sweeps over all input. A law panics where it is
//! broken, and at most tells which of its cases it met.
//!
//! # How to call them
//!
//! A law on octets takes any octets. A law on values takes any value; get one from
//! [`Uper::arbitrary`] and a [`Source`](super::Source), of which Kani has a symbolic one and a test a
//! random one. There is no other description of what a valid value is: whatever a symbolic source can
//! give covers the type.
//!
//! Encodings go to buffers of `N` octets, at least [`max_octets`] of the type. `N` is the caller's, so
//! that the proof of a small container does not carry the buffer of a RAM:
//!
//! ```
//! use crossguard_codec::core::{Source, Uper, cdd::BasicContainer, laws, max_octets};
//!
//! // What a Kani harness does with `kani::any` and `kani::assume` in the place of this.
//! struct Highest;
//! impl Source for Highest {
//!     fn integer(&mut self, _low: i64, high: i64) -> i64 {
//!         high
//!     }
//! }
//!
//! const N: usize = max_octets::<BasicContainer>();
//! let value = BasicContainer::arbitrary(&mut Highest);
//! laws::encode_then_decode_is_identity::<BasicContainer, N>(&value);
//! laws::length_is_within_maximum::<BasicContainer, N>(&value);
//! laws::decode_is_total::<BasicContainer>(&[0xFF; N]);
//! ```
//!
//! # Bounds for Kani
//!
//! No loop depends on data without a constant that bounds it:
//!
//! | loop | turns at most |
//! |---|---|
//! | the items of a list | its capacity, 23 in a RAM, 4 in an RMCM |
//! | extension additions that are skipped | 64, and half the octets of the input |
//!
//! So an unwinding bound of `max(capacity, input octets / 2) + 2` suffices, and one of the octets and two
//! more where a law compares them. Values from [`Uper::arbitrary`] meet no extension additions; what
//! skips these is most of what Kani sees of a container, so replace it by a stub where a law allows it.

#![allow(
    clippy::must_use_candidate,
    reason = "a law asserts; which case it met may not matter"
)]
#![allow(clippy::missing_panics_doc, reason = "a law panics where it is broken")]

use super::{Fault, First, Reader, Uper, Writer, decode, encode, max_octets, width};

/// Whatever the octets are, decoding them ends with a value or an error, and a value has been read
/// from bits that are there, no more of them than its type has or extension additions explain.
pub fn decode_is_total<T: Uper>(octets: &[u8]) {
    decode_stays_inside::<T>(octets);
    if let Ok((_, reader)) = T::decode(Reader::new(octets)) {
        assert!(reader.extended() > 0 || reader.position() <= T::MAX_BITS as usize);
    }
}

/// The part of [`decode_is_total`] that holds whatever skips extension additions. Tells whether there is
/// a value.
pub fn decode_stays_inside<T: Uper>(octets: &[u8]) -> bool {
    let bits = octets.len() * 8;
    let mut value = T::LOWEST;
    match value.read(Reader::<First>::new(octets)).result() {
        Ok(reader) => {
            assert!(reader.position() + reader.left() == bits);
            true
        }
        Err(error) => {
            assert!(error.bit <= bits);
            false
        }
    }
}

/// An encoded value decodes to itself, without extension additions.
pub fn encode_then_decode_is_identity<T: Uper, const N: usize>(value: &T) {
    let mut buffer = [0xA5; N];
    let encoded = encode(value, &mut buffer);
    assert!(encoded.is_ok());
    if let Ok(length) = encoded {
        assert!(decode::<T>(&buffer[..length]) == Ok((*value, 0)));
    }
}

/// Octets that decode to a value without extension additions are what the value encodes to: no two
/// encodings mean the same. Tells whether the octets do.
pub fn decode_then_encode_is_identity<T: Uper, const N: usize>(octets: &[u8]) -> bool {
    let Ok((value, 0)) = decode::<T>(octets) else {
        return false;
    };
    let mut buffer = [0xA5; N];
    assert!(encode(&value, &mut buffer) == Ok(octets.len()));
    let mut index = 0;
    while index < N && index < octets.len() {
        assert!(buffer[index] == octets[index]);
        index += 1;
    }
    true
}

/// An encoding has no more bits than its type allows, and no buffer of its octets is too small.
pub fn length_is_within_maximum<T: Uper, const N: usize>(value: &T) {
    assert!(N >= max_octets::<T>());
    let mut buffer = [0; N];
    let writer = value.encode(Writer::new(&mut buffer));
    assert!(writer.position() <= T::MAX_BITS as usize);
    let length = writer.finish();
    assert!(length.is_ok_and(|length| 0 < length && length <= max_octets::<T>()));
}

/// An encoding of which the last `cut` octets are missing is refused as truncated; a buffer that is as
/// much too small is refused as full. A cut of no octets, and one of all, says nothing.
pub fn truncated_is_an_error<T: Uper, const N: usize>(value: &T, cut: usize) {
    let mut buffer = [0xA5; N];
    let Ok(length) = encode(value, &mut buffer) else {
        return;
    };
    if cut == 0 || cut > length || T::MAX_BITS == 0 {
        return;
    }
    let left = length - cut;
    let decoded = decode::<T>(&buffer[..left]);
    assert!(decoded.is_err_and(|error| error.fault == Fault::Truncated && error.bit == left * 8));
    let encoded = encode(value, &mut buffer[..left]);
    assert!(encoded.is_err_and(|error| error.fault == Fault::BufferFull));
}

/// An encoding in which a padding bit is set is refused. `bit` counts the padding from its end; one
/// that is none says nothing.
pub fn padding_is_zero<T: Uper, const N: usize>(value: &T, bit: usize) {
    let mut buffer = [0; N];
    let bits = value.encode(Writer::new(&mut buffer)).position();
    let Ok(length) = encode(value, &mut buffer) else {
        return;
    };
    if bit >= length * 8 - bits {
        return;
    }
    buffer[length - 1 - bit / 8] |= 1 << (bit % 8);
    let decoded = decode::<T>(&buffer[..length]);
    assert!(decoded.is_err_and(|error| error.fault == Fault::Padding));
}

/// `count` bits are read as they were written, behind `before` bits and in front of others, and these
/// are what they were. Both counts are taken modulo 33, and this many bits of the numbers.
pub fn bits_are_read_as_written(before: (u32, u32), number: (u32, u32), after: (u32, u32)) {
    let parts = [before, number, after].map(|(number, count)| {
        let count = count % 33;
        let mask = ((1_u64 << count) - 1) as u32;
        (number & mask, count)
    });
    let mut buffer = [0xA5; 12];
    let mut writer = Writer::new(&mut buffer);
    let mut position = 0;
    for (number, count) in parts {
        writer = writer.bits(number, count);
        position += count as usize;
        assert!(writer.position() == position);
    }
    let length = writer.finish();
    assert!(length == Ok(position.div_ceil(8).max(1)));
    let mut reader = Reader::<First>::new(&buffer);
    for (number, count) in parts {
        let (read, behind) = reader.bits(count);
        assert!(read == number && !behind.has_failed());
        reader = behind;
    }
    assert!(reader.position() == position);
    assert!(length.is_ok_and(|length| Reader::<First>::new(&buffer[..length]).left() >= position));
}

/// Reading `count` bits, modulo 33, from octets that have fewer is an error at their end; from others
/// it goes on by `count`. `position` is where reading begins.
pub fn reading_stops_at_the_end(octets: &[u8], position: usize, count: u32) {
    let count = count % 33;
    let bits = octets.len() * 8;
    let reader = Reader::<First>::new(octets).skip(position);
    assert!(reader.has_failed() == (position > bits));
    if position > bits {
        return;
    }
    let (number, behind) = reader.bits(count);
    match behind.result() {
        Ok(behind) => {
            assert!(behind.position() == position + count as usize && behind.position() <= bits);
            assert!(u64::from(number) >> count == 0);
        }
        Err(error) => {
            assert!(position + count as usize > bits);
            assert!(error.fault == Fault::Truncated && error.bit == bits);
        }
    }
}

/// The reader depends on the bits ahead alone, not on their place: it returns the same `count` bits,
/// modulo 33, behind `before` bits as at the front of the octets shifted by `before` bits. Returns whether the
/// octets have that many bits.
pub fn what_is_ahead_decides<const N: usize>(octets: &[u8; N], before: usize, count: u32) -> bool {
    let count = count % 33;
    if before + count as usize > N * 8 {
        return false;
    }
    let mut moved = [0; N];
    let mut index = 0;
    while index + before / 8 < N {
        let high = octets[index + before / 8];
        let low = match octets.get(index + before / 8 + 1) {
            Some(low) => *low,
            None => 0,
        };
        let both = u16::from_be_bytes([high, low]) << (before % 8);
        moved[index] = both.to_be_bytes()[0];
        index += 1;
    }
    let (there, behind) = Reader::<First>::new(octets).skip(before).bits(count);
    let (here, first) = Reader::<First>::new(&moved).bits(count);
    assert!(there == here && !behind.has_failed() && !first.has_failed());
    assert!(behind.position() - before == first.position());
    true
}

/// An integer from `min` to `max` takes as few bits as that, is read as it was written, and one beyond
/// `max` is an error. There are at most 2^32 of them; bounds in the wrong order say nothing.
pub fn integers_keep_their_bounds(min: i64, max: i64, bits: u32) {
    let Some(largest) = max
        .checked_sub(min)
        .and_then(|most| u32::try_from(most).ok())
    else {
        return;
    };
    let count = width(min, max);
    assert!(u64::from(largest) >> count == 0);
    assert!(count == 0 || largest >> (count - 1) == 1);
    let offset = u32::try_from(u64::from(bits) & ((1 << count) - 1)).unwrap_or(0);
    let mut buffer = [0xA5; 4];
    let length = Writer::new(&mut buffer).bits(offset, count).finish();
    assert!(length.is_ok());
    let number = min + i64::from(offset);
    let (read, reader) = Reader::<First>::new(&buffer).integer(min, max);
    match reader.result() {
        Ok(reader) => {
            assert!(read == number && number <= max && reader.position() == count as usize);
            let mut again = [0xA5; 4];
            assert!(Writer::new(&mut again).integer(read, min, max).finish() == length);
            assert!(u32::from_be_bytes(again) == u32::from_be_bytes(buffer));
        }
        Err(error) => {
            assert!(number > max && error.bit == 0);
            assert!(error.fault == Fault::Value { number, min, max });
        }
    }
}

/// Additions behind an extension bit are skipped, or refused, without a panic: at most one SEQUENCE more
/// has additions, and only bits that are there are gone.
pub fn skipping_additions_is_total(octets: &[u8]) {
    let reader = Reader::<First>::new(octets);
    match reader.skip_additions().result() {
        Ok(behind) => {
            // A bitmap of one bit, a length, an octet.
            assert!(behind.position() >= 7 + 1 + 8 + 8);
            assert!(behind.position() <= octets.len() * 8);
            assert!(behind.extended() == 1);
        }
        Err(error) => assert!(error.bit <= octets.len() * 8),
    }
}
