//! The rasn types of the ASN.1 modules in `asn1/*.asn`.
//!
//! The modules are the source of truth and part of the product; a robot in C++ can feed them to its
//! own compiler. `generated.rs` follows from them by rasn-compiler and is never edited; a test
//! compares the two. What is generated keeps the names of ASN.1, in Rust's spelling for fields and
//! in its own for types and alternatives, and its serde view has the names of ASN.1 throughout.
//!
//! The types hold any number that fits their Rust type. Whether a value is within its ASN.1 range is
//! checked where it is [encoded](encode) or [decoded](decode), or converted to the type of the
//! [core](crate::core), which is what the endpoint has. RAM, RMCM, the basic container and the
//! shape of a cluster convert both ways.
//!
//! Encodings are rasn's as it is: the decoder takes every encoding of a value, as stations on the road
//! send them (a DEFAULT spelled out, padding that is not zero, extension additions of a newer sender),
//! and the encoder makes the canonical one.

mod conversion;
#[rustfmt::skip]
#[allow(
    missing_docs,
    rustdoc::all,
    clippy::all,
    clippy::pedantic,
    reason = "generated from the ASN.1 modules, which are documented themselves"
)]
mod generated;
mod view;

use rasn::error::DecodeErrorKind as Kind;

use crate::error::{DecodeError, EncodeError, FieldPath};

pub use generated::{
    crossguard_cam as cam, crossguard_cdd as cdd, crossguard_cdd211 as cdd211,
    crossguard_common as common, crossguard_cpm as cpm, crossguard_ram as ram,
    crossguard_rmcm as rmcm, crossguard_vam as vam,
};

/// A decoded value, and whether its encoding was the canonical one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Decoded<T> {
    /// The value.
    pub value: T,
    /// True if it encodes to the octets again. It does not where a sender spells out a DEFAULT, or knows
    /// extension additions that this crate does not.
    pub is_canonical: bool,
}

/// The canonical encoding of `value`, padded to whole octets.
///
/// # Errors
/// When a number or size is not one of its type.
pub fn encode<T: rasn::Encode>(value: &T) -> Result<Vec<u8>, EncodeError> {
    rasn::uper::encode(value).map_err(|error| EncodeError::Other(error.kind.to_string()))
}

/// The value that `octets` encode.
///
/// # Errors
/// Why they encode none, and which field says so.
pub fn decode<T>(octets: &[u8]) -> Result<Decoded<T>, DecodeError>
where
    T: rasn::Decode + rasn::Encode,
{
    let value = rasn::uper::decode(octets).map_err(|error| malformed(&error))?;
    let is_canonical = encode(&value).is_ok_and(|again| again == octets);
    Ok(Decoded {
        value,
        is_canonical,
    })
}

/// The value at the front of `octets`, and how many octets follow it.
///
/// # Errors
/// As of [`decode`].
pub(crate) fn decode_front<T: rasn::Decode>(octets: &[u8]) -> Result<(T, usize), DecodeError> {
    let decoded = rasn::uper::decode_with_remainder(octets);
    let (value, rest) = decoded.map_err(|error| malformed(&error))?;
    Ok((value, rest.len()))
}

/// The fault of the octets, and its field.
fn malformed(error: &rasn::error::DecodeError) -> DecodeError {
    let (mut kind, mut names) = (&*error.kind, Vec::new());
    loop {
        kind = match kind {
            Kind::FieldError { name, nested } => {
                names.push(*name);
                &*nested.kind
            }
            Kind::ChoiceIndexExceedsPlatformWidth { present, .. } => &*present.kind,
            _ => break,
        };
    }
    let field = FieldPath::named(names);
    let (cause, detail) = match kind {
        Kind::UnexpectedExtraData { length } if field.names().next().is_none() => {
            return DecodeError::TrailingOctets { count: *length };
        }
        Kind::Incomplete { .. } | Kind::Eof => {
            ("truncated", "the message ends within it".to_owned())
        }
        Kind::ValueConstraintNotSatisfied { value, expected } => {
            let detail = format!("{value} is not within {expected}");
            ("value out of range", detail)
        }
        Kind::IntegerOverflow { .. } => ("value out of range", kind.to_string()),
        Kind::SizeConstraintNotSatisfied { expected, .. } => {
            let detail = format!("its size is not within {expected}");
            ("size out of range", detail)
        }
        Kind::EnumerationIndexNotFound { .. } | Kind::ChoiceIndexNotFound { .. } => {
            let detail = "its alternative is unknown".to_owned();
            ("unknown alternative", detail)
        }
        _ => ("malformed extension", kind.to_string()),
    };
    DecodeError::Foreign {
        field,
        cause,
        detail,
    }
}
