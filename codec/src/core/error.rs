//! Why bits are not a value: one flat error that a proof can copy, and names that nobody needs until a
//! person reads them.

use thiserror::Error;

/// A fault, its bit, and its field.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Error {
    /// The fault.
    pub fault: Fault,
    /// Where the bits of the field begin, counted from the start of the encoding.
    pub bit: usize,
    /// Which field it is.
    path: Path,
}

/// The way to a field: a nibble per level, outermost lowest, index plus one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Path(u64);

/// A component of a SEQUENCE or an alternative of a CHOICE, for the names in messages.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// The name of a component in Rust's spelling; empty for an alternative.
    pub name: &'static str,
    /// Its fields.
    pub fields: &'static [Field],
}

/// How many components a SEQUENCE and alternatives a CHOICE may have, for a nibble to tell them apart.
pub(crate) const FIELDS_MAX: usize = 15;

impl Error {
    /// An error in what begins at `bit`.
    pub(crate) const fn at(bit: usize, fault: Fault) -> Self {
        let path = Path(0);
        Self { fault, bit, path }
    }

    /// The same error, seen from the SEQUENCE or CHOICE whose field `index` has it. Deeper than 16
    /// levels the innermost ones are forgotten; no message is as deep.
    pub(crate) const fn within(self, index: usize) -> Self {
        let path = Path(self.path.0 << 4 | (index as u64 + 1));
        Self { path, ..self }
    }

    /// The names of the components that lead to the field, outermost first, in the type whose
    /// [`FIELDS`](super::Uper::FIELDS) these are.
    pub fn names(self, fields: &'static [Field]) -> impl Iterator<Item = &'static str> {
        self.path.names(fields)
    }

    /// The way to the field.
    pub(crate) const fn path(self) -> Path {
        self.path
    }
}

impl Path {
    /// The names of the components, as [`Error::names`].
    pub(crate) fn names(self, fields: &'static [Field]) -> impl Iterator<Item = &'static str> {
        let (mut path, mut fields) = (self.0, fields);
        core::iter::from_fn(move || {
            let index = usize::try_from((path & 0xF).checked_sub(1)?).ok()?;
            let field = fields.get(index)?;
            path >>= 4;
            fields = field.fields;
            Some(field.name)
        })
        .filter(|name| !name.is_empty())
    }
}

/// Faults of the bits of a field.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum Fault {
    /// The message ends too early.
    #[error("the message ends within it")]
    Truncated,
    /// A number that the type does not have.
    #[error("{number} is not within {min}..{max}")]
    Value {
        /// The number.
        number: i64,
        /// The smallest one of the type.
        min: i64,
        /// The largest one of the type.
        max: i64,
    },
    /// A list or string of a size that the type does not have.
    #[error("its size is not within {min}..{max}")]
    Size {
        /// The smallest size of the type.
        min: usize,
        /// The largest size of the type.
        max: usize,
    },
    /// A list of a size that its type has, and its message has not.
    #[error("it has {found} items, {max} are allowed")]
    TooMany {
        /// How many items it has.
        found: usize,
        /// How many it may have.
        max: usize,
    },
    /// A size or number behind an extension marker; this crate uses only those before it.
    #[error("its size or value is behind an extension marker, which is not supported")]
    BeyondRoot,
    /// An alternative of a CHOICE or ENUMERATED that this crate does not know; a newer one may.
    #[error("its alternative is unknown")]
    UnknownAlternative,
    /// An alternative of a CHOICE that an inner subtype constraint leaves out, which PER does not see.
    #[error("its alternative is left out here")]
    AbsentAlternative,
    /// A component that equals its DEFAULT is spelled out.
    #[error("it spells out its default")]
    DefaultSpelledOut,
    /// A length that is zero, has a shorter form, or does not fit what it is the length of.
    #[error("its length determinant is wrong")]
    Length,
    /// The extension bit is set, and no extension addition is present.
    #[error("it announces extension additions and has none")]
    NoAddition,
    /// More than 64 extension additions.
    #[error("it has more than 64 extension additions, which is not supported")]
    TooManyAdditions,
    /// Padding that is not zero.
    #[error("its padding is not zero")]
    Padding,
    /// There is more behind the message.
    #[error("{octets} octets follow its end")]
    Trailing {
        /// How many octets.
        octets: usize,
    },
    /// The buffer for the encoding ends too early.
    #[error("the buffer ends within it")]
    BufferFull,
}
