//! Canonical unaligned PER (ITU-T X.691) of the types of rasn, by an encoder and a strict decoder of our
//! own behind the traits that rasn derives.
//!
//! rasn's decoder is lenient where a receiver has to be strict: it takes padding that is not zero and
//! components that spell out their DEFAULT, and does not say where unknown extension additions were.
//! [`decode`] accepts exactly the canonical encodings, skips unknown extension additions, and names
//! the field that is wrong. What it has decoded is encoded again and compared, so the claim does not
//! rest on the decoder alone. rasn's own encoder judges ours in the tests.
//!
//! ```text
//! octets ──► decoder (rasn's Decode, our bits) ──► value ──► encoder (rasn's Encode) ─┐
//!    │                    └─► where additions were skipped                            ├─► equal?
//!    └──────────────────────────► octets without these additions ────────────────────┘
//! ```

mod decoder;
mod encoder;
mod source;

use std::iter;

use rasn::error::{DecodeErrorKind, EncodeErrorKind};
use rasn::types::BitString;

use crate::core::Fault;
use crate::error::{DecodeError, EncodeError, FieldPath};
use decoder::Decoder;
use encoder::{Bits, Encoder};
use source::{BitSource, Edit, RasnError};

/// A decoded value, and how many SEQUENCEs in it had unknown extension additions.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Decoded<T> {
    /// The value.
    pub value: T,
    /// How many SEQUENCEs had additions, which were skipped.
    pub extended: usize,
}

/// The canonical encoding of `value`, padded to whole octets.
///
/// # Errors
/// When a number or size is not one of its type.
pub fn encode<T: rasn::Encode>(value: &T) -> Result<Vec<u8>, EncodeError> {
    let mut bits = Bits::default();
    let encoded = value.encode(&mut Encoder::new(&mut bits));
    encoded.map_err(|error| inexpressible(&error))?;
    Ok(bits.into_octets())
}

/// Why a value has no encoding.
fn inexpressible(error: &rasn::error::EncodeError) -> EncodeError {
    match &*error.kind {
        EncodeErrorKind::ValueConstraintNotSatisfied { value, expected } => EncodeError::Value {
            number: i64::try_from(value).unwrap_or(i64::MAX),
            allowed: expected.to_string(),
        },
        EncodeErrorKind::SizeConstraintNotSatisfied { size, expected }
        | EncodeErrorKind::InvalidLength {
            length: size,
            expected,
        } => EncodeError::Size {
            size: *size,
            allowed: expected.to_string(),
        },
        other => EncodeError::Other(other.to_string()),
    }
}

/// How many bits a number of this many values has.
const fn width(values: u64) -> u32 {
    match values {
        0 | 1 => 0,
        _ => (values - 1).ilog2() + 1,
    }
}

/// The value whose canonical encoding `octets` are, but for unknown extension additions.
///
/// # Errors
/// Why the octets are not such an encoding, and which field says so.
pub fn decode<T>(octets: &[u8]) -> Result<Decoded<T>, DecodeError>
where
    T: rasn::Decode + rasn::Encode,
{
    let source = BitSource::new(octets);
    let decoded = T::decode(&mut Decoder::new(&source)).and_then(|value| {
        let bits = source.position();
        source.padding(0)?;
        Ok((value, bits))
    });
    let (value, bits) = decoded.map_err(|rejected| malformed(&source, &rejected))?;
    if source.left() > 0 {
        return Err(DecodeError::TrailingOctets {
            count: source.left() / 8,
        });
    }
    let (extended, edits) = source.into_edits();
    if edits.is_empty() {
        check_canonical(octets, &value)?;
    } else {
        check_canonical(&without_additions(octets, bits, &edits), &value)?;
    }
    Ok(Decoded { value, extended })
}

/// What is wrong with the octets, and in which field.
fn malformed(source: &BitSource<'_>, rejected: &RasnError) -> DecodeError {
    let mut kind = &*rejected.kind;
    let field = FieldPath::named(iter::from_fn(|| {
        let DecodeErrorKind::FieldError { name, nested } = kind else {
            return None;
        };
        kind = &*nested.kind;
        Some(*name)
    }));
    // Whatever rasn itself might reject is something that the modules do not use.
    let unsupported = (source.position(), Fault::Unsupported);
    let (bit, fault) = source.fault().unwrap_or(unsupported);
    DecodeError::Malformed { field, bit, fault }
}

/// The encoding that a sender without unknown additions would have sent; `octets` has this many
/// `bits` before its padding.
fn without_additions(octets: &[u8], bits: usize, edits: &[Edit]) -> Vec<u8> {
    let received = BitString::from_slice(octets);
    let mut known = BitString::new();
    let mut next = 0;
    for Edit {
        start,
        end,
        instead,
    } in edits
    {
        known.extend_from_bitslice(&received[next..*start]);
        known.extend(instead);
        next = *end;
    }
    known.extend_from_bitslice(&received[next..bits]);
    known.resize(known.len().next_multiple_of(8), false);
    known.into_vec()
}

/// Compares `octets` with the encoding of `value`.
fn check_canonical<T: rasn::Encode>(octets: &[u8], value: &T) -> Result<(), DecodeError> {
    let encoded = encode(value).unwrap_or_default();
    let first_difference = octets.iter().zip(&encoded).position(|(a, b)| a != b);
    let bit = match first_difference {
        None if octets.len() == encoded.len() => return Ok(()),
        None => octets.len().min(encoded.len()) * 8,
        Some(octet) => octet * 8 + (octets[octet] ^ encoded[octet]).leading_zeros() as usize,
    };
    Err(DecodeError::NotCanonical { bit })
}
