//! RAM and RMCM bit by bit: the codec that runs on the robots and that Kani proves.
//!
//! A value of these types is valid by construction, so encoding cannot fail, and a decoder accepts
//! exactly the canonical unaligned PER encodings (ITU-T X.691) of such values, with or without unknown
//! extension additions. Nothing here needs a heap or the standard library, and nothing panics.
//!
//! ```text
//!   asn1/*.asn ──► notation: asn1!{ BasicContainer ::= SEQUENCE { .. } }
//!                  │ makes
//!   octets ──► Reader ──► Uper::read   ──► value ──► Uper::encode ──► Writer ──► octets
//!                  └── Error: field, bit, fault              arbitrary ◄── Source
//! ```
//!
//! - [`cdd`], [`common`], [`vam`], [`ram`] and [`rmcm`] declare the types of the module of that name
//!   in `asn1/*.asn`, in its notation, and are generated from it. Sizes, names and arbitrary values
//!   follow from the same lines.
//! - [`laws`] are properties of these types as functions, for Kani, proptest and sweeps alike.
//!
//! The rasn types of [`asn1`](crate::asn1) are the reference: differential tests compare the two on
//! values and on octets. JSON is theirs. An alternative of an ENUMERATED or CHOICE that a newer sender may
//! know is an error, as it is there: a message that says something unknown where the protocol reads
//! is not half understood.

#![allow(
    clippy::cast_lossless,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "there is no `From` in constants; what is cast fits, which the laws show"
)]
#![allow(
    clippy::items_after_statements,
    reason = "assertions stand in front of what they are for"
)]

pub mod cdd;
pub mod common;
mod defaults;
mod error;
pub mod laws;
mod list;
mod notation;
mod open_type;
pub mod ram;
mod reader;
pub mod rmcm;
mod source;
pub mod vam;
mod writer;

pub(crate) use error::Path;
pub use error::{Error, Fault, Field};
pub use list::SequenceOf;
pub use reader::{Faults, First, Outer, Read, Reader, Whether};
pub use source::Source;
pub use writer::Writer;

/// A type with a canonical unaligned PER encoding (ITU-T X.691).
pub trait Uper: Copy + Eq {
    /// How many bits the longest encoding has.
    const MAX_BITS: u32;
    /// The value whose every number is the lowest one, every list the shortest, every CHOICE the
    /// first alternative, and without what is OPTIONAL.
    const LOWEST: Self;
    /// The names of what it consists of, for [`Error::names`].
    const FIELDS: &'static [Field] = &[];

    /// Writes the encoding.
    #[must_use]
    fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a>;

    /// Reads the value that the next bits encode into `self`, which holds [`LOWEST`](Self::LOWEST) and
    /// keeps what is not there: nothing that is absent is copied. The reader keeps which field they do
    /// not encode, and why; `self` holds some value then.
    #[must_use]
    fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F>;

    /// The value that the next bits encode, and the reader behind it.
    ///
    /// # Errors
    /// Which field they do not encode, and why.
    #[inline]
    fn decode(reader: Reader<'_, First>) -> Result<Read<'_, Self, First>, Error> {
        let mut value = Self::LOWEST;
        let reader = value.read(reader).result()?;
        Ok((value, reader))
    }

    /// Any value, as the source wants.
    fn arbitrary<S: Source>(source: &mut S) -> Self;
}

/// Octets of the longest encoding of `T` as a message of its own.
#[must_use]
pub const fn max_octets<T: Uper>() -> usize {
    match T::MAX_BITS.div_ceil(8) {
        0 => 1,
        octets => octets as usize,
    }
}

/// Encodes `value` into the front of `buffer`, and tells how many octets that takes.
///
/// # Errors
/// [`Fault::BufferFull`]; with [`max_octets`] the buffer has room for every value.
pub fn encode<T: Uper>(value: &T, buffer: &mut [u8]) -> Result<usize, Error> {
    value.encode(Writer::new(buffer)).finish()
}

/// The value whose encoding `octets` are, and how many SEQUENCEs in it had unknown extension
/// additions.
///
/// # Errors
/// Which field is wrong, and why.
pub fn decode<T: Uper>(octets: &[u8]) -> Result<(T, usize), Error> {
    // In place from the start: a message is large, and would be copied for each name that it gets.
    let mut decoded = Ok((T::LOWEST, 0));
    if let Ok((value, extended)) = &mut decoded {
        let reader = read_message(value, Reader::<Whether>::new(octets));
        *extended = reader.extended();
        if reader.has_failed() {
            decoded = Err(diagnose::<T>(octets));
        }
    }
    decoded
}

/// Why [`decode`] refuses `octets`.
#[cold]
fn diagnose<T: Uper>(octets: &[u8]) -> Error {
    let mut value = T::LOWEST;
    read_message(&mut value, Reader::<First>::new(octets)).error()
}

/// Reads the value that `reader` has all octets of, with its padding.
#[inline]
fn read_message<'a, T: Uper, F: Faults>(value: &mut T, reader: Reader<'a, F>) -> Reader<'a, F> {
    let reader = value.read(reader).padding(0);
    match reader.left() / 8 {
        0 => reader,
        octets => reader.fail(reader.position(), Fault::Trailing { octets }),
    }
}

/// Bits of an integer from `min` to `max`, of a size, or of an index (X.691 clause 11.5). There are at
/// most 2^32 of them.
pub(crate) const fn width(min: i64, max: i64) -> u32 {
    64 - (max - min).leading_zeros()
}

/// NULL has no bits (X.691 clause 18).
pub type Null = ();

impl Uper for Null {
    const MAX_BITS: u32 = 0;
    const LOWEST: Self = ();

    fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
        writer
    }

    fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
        reader
    }

    fn arbitrary<S: Source>(_: &mut S) -> Self {}
}

/// BOOLEAN is one bit (X.691 clause 12).
impl Uper for bool {
    const MAX_BITS: u32 = 1;
    const LOWEST: Self = false;

    #[inline]
    fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
        writer.bits(u32::from(*self), 1)
    }

    #[inline]
    fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
        let behind;
        (*self, behind) = reader.bit();
        behind
    }

    fn arbitrary<S: Source>(source: &mut S) -> Self {
        source.flip()
    }
}
