//! The notation of ASN.1, as far as RAM and RMCM use it.
//!
//! [`asn1!`] takes one type assignment and makes the Rust type and its [`Uper`](super::Uper)
//! implementation of it: encoding, decoding, largest size, field names, arbitrary values. A type reads
//! as in `asn1/*.asn`, but for
//!
//! - names, which are in Rust's spelling, and `bool` and `Null` for BOOLEAN and NULL;
//! - what holds the value in Rust: `INTEGER (..) as i16`, or `is u8` when every `u8` is a value;
//! - lists inside of other types, which have a type of their own, `AT MOST` as long as their message
//!   allows;
//! - alternatives that an inner subtype constraint leaves out, of which the number is given:
//!   `3 ABSENT`.
//!
//! A test compares these declarations with the modules.

/// The Rust type of one ASN.1 type assignment, and its encoding.
macro_rules! asn1 {
    // INTEGER, every number of the Rust type.
    ($(#[$meta:meta])* $name:ident ::= INTEGER ($range:expr) is $rust:ident) => {
        $(#[$meta])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub struct $name(pub $rust);

        const _: () = {
            let range: core::ops::Range<$rust> = $range;
            assert!(range.start == $rust::MIN && range.end == $rust::MAX);
        };

        asn1!(@integer $name $rust $rust::MIN, $rust::MAX, false);
    };

    // INTEGER.
    ($(#[$meta:meta])* $name:ident ::= INTEGER $({ $($value:ident($number:expr)),+ })? ($range:expr) as $rust:ident) => {
        asn1!(@bounded [$(#[$meta])*] $name $rust [$($($value $number),+)?] $range, false);
    };
    ($(#[$meta:meta])* $name:ident ::= INTEGER ($range:expr, ...) as $rust:ident) => {
        asn1!(@bounded [$(#[$meta])*] $name $rust [] $range, true);
    };
    (@bounded [$(#[$meta:meta])*] $name:ident $rust:ident [$($value:ident $number:expr),*] $range:expr, $extensible:literal) => {
        $(#[$meta])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub struct $name($rust);

        impl $name {
            const RANGE: core::ops::Range<$rust> = $range;
            /// The smallest number.
            pub const MIN: $rust = Self::RANGE.start;
            /// The largest number.
            pub const MAX: $rust = Self::RANGE.end;
            $(
                #[doc = concat!("The number with the meaning *", stringify!($value), "*.")]
                pub const $value: Self = Self($number);
            )*

            /// The value that is `number`, if that is one.
            #[must_use]
            pub const fn new(number: $rust) -> Option<Self> {
                if Self::MIN <= number && number <= Self::MAX {
                    Some(Self(number))
                } else {
                    None
                }
            }

            /// The value that is nearest to `number`.
            #[must_use]
            pub const fn saturating(number: $rust) -> Self {
                Self(if number < Self::MIN {
                    Self::MIN
                } else if number > Self::MAX {
                    Self::MAX
                } else {
                    number
                })
            }

            /// The number.
            #[must_use]
            pub const fn get(self) -> $rust {
                self.0
            }
        }

        asn1!(@integer $name $rust $name::MIN, $name::MAX, $extensible);
    };
    (@integer $name:ident $rust:ident $min:expr, $max:expr, $extensible:literal) => {
        /// X.691 clause 13.
        impl Uper for $name {
            const MAX_BITS: u32 = $extensible as u32 + width($min as i64, $max as i64);
            const LOWEST: Self = Self($min);

            #[inline]
            fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
                let writer = if $extensible { writer.bits(0, 1) } else { writer };
                writer.integer(self.0.into(), $min.into(), $max.into())
            }

            #[inline]
            fn decode(reader: Reader<'_>) -> Read<'_, Self> {
                let (number, reader) = if $extensible {
                    reader.extensible_integer($min.into(), $max.into())?
                } else {
                    reader.integer($min.into(), $max.into())?
                };
                Ok((Self(number as $rust), reader))
            }

            fn arbitrary<S: Source>(source: &mut S) -> Self {
                Self(source.integer($min.into(), $max.into()) as $rust)
            }
        }
    };

    // BIT STRING of fixed size.
    ($(#[$meta:meta])* $name:ident ::= BIT STRING (SIZE($size:literal)) as $rust:ident) => {
        $(#[$meta])*
        ///
        /// Bit *n* of the string is bit *n* of the number, the lowest being bit 0.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub struct $name($rust);

        impl $name {
            const MASK: $rust = $rust::MAX >> ($rust::BITS - $size);

            /// The string of these bits. Those that the string has no place for are left out.
            #[must_use]
            pub const fn new(bits: $rust) -> Self {
                Self(bits & Self::MASK)
            }

            /// The bits.
            #[must_use]
            pub const fn bits(self) -> $rust {
                self.0
            }
        }

        /// X.691 clause 16.
        impl Uper for $name {
            const MAX_BITS: u32 = $size;
            const LOWEST: Self = Self(0);

            #[inline]
            fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
                let first_highest = self.0.reverse_bits() >> ($rust::BITS - $size);
                writer.bits(first_highest.into(), $size)
            }

            #[inline]
            fn decode(reader: Reader<'_>) -> Read<'_, Self> {
                let (first_highest, reader) = reader.bits($size)?;
                let bits = (first_highest as $rust) << ($rust::BITS - $size);
                Ok((Self(bits.reverse_bits()), reader))
            }

            fn arbitrary<S: Source>(source: &mut S) -> Self {
                Self(source.integer(0, Self::MASK.into()) as $rust)
            }
        }
    };

    // ENUMERATED.
    ($(#[$meta:meta])* $name:ident ::= ENUMERATED { $($variant:ident),+ $(,)? }) => {
        asn1!(@enumerated [$(#[$meta])*] $name [$($variant)+] false);
    };
    ($(#[$meta:meta])* $name:ident ::= ENUMERATED { $($variant:ident),+, ... }) => {
        asn1!(@enumerated [$(#[$meta])*] $name [$($variant)+] true);
    };
    (@enumerated [$(#[$meta:meta])*] $name:ident [$($variant:ident)+] $extensible:literal) => {
        $(#[$meta])*
        #[allow(missing_docs, reason = "a value is its name")]
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub enum $name {
            $($variant,)+
        }

        impl $name {
            /// All values, in their order.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];
        }

        /// X.691 clause 14.
        impl Uper for $name {
            const MAX_BITS: u32 = $extensible as u32 + width(0, Self::ALL.len() as i64 - 1);
            const LOWEST: Self = Self::ALL[0];

            #[inline]
            fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
                writer.bits(*self as u32, Self::MAX_BITS)
            }

            #[inline]
            fn decode(reader: Reader<'_>) -> Read<'_, Self> {
                let (index, reader) = reader.enumerated(Self::ALL.len(), $extensible)?;
                Ok((Self::ALL[index], reader))
            }

            fn arbitrary<S: Source>(source: &mut S) -> Self {
                Self::ALL[source.index(0, Self::ALL.len() - 1)]
            }
        }
    };

    // SEQUENCE OF.
    ($(#[$meta:meta])* $name:ident ::= SEQUENCE (SIZE($range:expr)) OF $type:ident $(AT MOST $capacity:ident)?) => {
        asn1!(@list [$(#[$meta])*] $name $type $range, [$($capacity)?], false);
    };
    ($(#[$meta:meta])* $name:ident ::= SEQUENCE (SIZE($range:expr, ...)) OF $type:ident $(AT MOST $capacity:ident)?) => {
        asn1!(@list [$(#[$meta])*] $name $type $range, [$($capacity)?], true);
    };
    (@list [$(#[$meta:meta])*] $name:ident $type:ident $range:expr, [], $extensible:literal) => {
        $(#[$meta])*
        pub type $name = SequenceOf<$type, { $range.start }, { $range.end }, { $range.end }, $extensible>;
    };
    (@list [$(#[$meta:meta])*] $name:ident $type:ident $range:expr, [$capacity:ident], $extensible:literal) => {
        $(#[$meta])*
        pub type $name = SequenceOf<$type, { $range.start }, { $range.end }, $capacity, $extensible>;
    };

    // SEQUENCE.
    ($(#[$meta:meta])* $name:ident ::= SEQUENCE { $($field:ident $type:ident $($keyword:ident $($default:ident)?)?),+ $(,)? }) => {
        asn1!(@sequence [$(#[$meta])*] $name [$($field [$type $($keyword $($default)?)?])+] false);
    };
    ($(#[$meta:meta])* $name:ident ::= SEQUENCE { $($field:ident $type:ident $($keyword:ident $($default:ident)?)?),+, ... }) => {
        asn1!(@sequence [$(#[$meta])*] $name [$($field [$type $($keyword $($default)?)?])+] true);
    };
    (@sequence [$(#[$meta:meta])*] $name:ident [$($field:ident $kind:tt)+] $extensible:literal) => {
        $(#[$meta])*
        #[allow(missing_docs, reason = "a component is what its type says")]
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub struct $name {
            $(pub $field: component!(type $kind),)+
        }

        const _: () = {
            #[allow(non_camel_case_types, reason = "names of components")]
            enum Index { $($field),+ }

            /// How many components are OPTIONAL or have a DEFAULT.
            const OPTIONAL: u32 = 0 $(+ component!(optional $kind))+;

            assert!([$(Index::$field),+].len() <= FIELDS_MAX);

            /// X.691 clause 19.
            impl Uper for $name {
                const MAX_BITS: u32 = $extensible as u32 + OPTIONAL $(+ component!(bits $kind))+;
                const LOWEST: Self = Self { $($field: component!(lowest $kind),)+ };
                const FIELDS: &'static [Field] = &[$(Field {
                    name: stringify!($field),
                    fields: component!(fields $kind),
                }),+];

                #[inline]
                fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
                    let presence = 0;
                    $(let presence = component!(presence $kind, presence, self.$field);)+
                    let writer = writer.bits(presence, $extensible as u32 + OPTIONAL);
                    $(let writer = component!(encode $kind, writer, self.$field);)+
                    writer
                }

                #[inline]
                fn decode(reader: Reader<'_>) -> Read<'_, Self> {
                    let (is_extended, reader) = reader.bits($extensible as u32)?;
                    let (presence, reader) = reader.bits(OPTIONAL)?;
                    // The bit of the next component is in the place of OPTIONAL.
                    let presence = u64::from(presence) << 1;
                    $(
                        let (presence, is_present) = component!(next $kind, presence, OPTIONAL);
                        let ($field, reader) = match component!(decode $kind, reader, is_present) {
                            Ok(read) => read,
                            Err(error) => return Err(error.within(Index::$field as usize)),
                        };
                    )+
                    let _ = presence;
                    let reader = if is_extended == 1 { reader.skip_additions()? } else { reader };
                    Ok((Self { $($field),+ }, reader))
                }

                fn arbitrary<S: Source>(source: &mut S) -> Self {
                    Self { $($field: component!(arbitrary $kind, source),)+ }
                }
            }
        };
    };

    // CHOICE.
    ($(#[$meta:meta])* $name:ident ::= CHOICE { $($variant:ident $type:ident),+ $(,)? }) => {
        asn1!(@choice [$(#[$meta])*] $name [$($variant $type)+] 0, [] false);
    };
    ($(#[$meta:meta])* $name:ident ::= CHOICE { $($variant:ident $type:ident),+ $(, $absent:literal ABSENT)?, ... $(, $addition:ident $addition_type:ident)* }) => {
        asn1!(@choice [$(#[$meta])*] $name [$($variant $type)+] 0 $(+ $absent)?, [$($addition $addition_type)*] true);
    };
    (@first $variant:ident $type:ident $($rest:ident)*) => {
        Self::$variant(<$type as Uper>::LOWEST)
    };
    (@choice [$(#[$meta:meta])*] $name:ident [$($variant:ident $type:ident)+] $absent:expr, [$($addition:ident $addition_type:ident)*] $extensible:literal) => {
        $(#[$meta])*
        #[allow(missing_docs, reason = "an alternative is what its type says")]
        #[allow(clippy::large_enum_variant, reason = "there is no heap")]
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub enum $name {
            $($variant($type),)+
            $($addition($addition_type),)*
        }

        const _: () = {
            enum Index { $($variant,)+ $($addition,)* }

            /// How many alternatives of the root there are here.
            const ROOT: usize = [$(Index::$variant),+].len();
            /// How many alternatives of the root the type has.
            const COUNT: usize = ROOT + $absent;
            const INDEX_BITS: u32 = width(0, COUNT as i64 - 1);
            const FIELDS: &[Field] = &[
                $(Field { name: "", fields: <$type as Uper>::FIELDS },)+
                $(Field { name: "", fields: <$addition_type as Uper>::FIELDS },)*
            ];

            assert!(FIELDS.len() <= FIELDS_MAX);

            /// X.691 clause 23.
            impl Uper for $name {
                const MAX_BITS: u32 = $extensible as u32 + longest(&[
                    $(INDEX_BITS + <$type as Uper>::MAX_BITS,)+
                    $(open_type::addition_bits::<$addition_type>(),)*
                ]);
                const LOWEST: Self = asn1!(@first $($variant $type)+);
                const FIELDS: &'static [Field] = FIELDS;

                #[inline]
                fn encode<'a>(&self, writer: Writer<'a>) -> Writer<'a> {
                    match self {
                        $(Self::$variant(value) => {
                            let index_bits = $extensible as u32 + INDEX_BITS;
                            value.encode(writer.bits(Index::$variant as u32, index_bits))
                        })+
                        $(Self::$addition(value) => {
                            let index = Index::$addition as usize - ROOT;
                            open_type::encode_addition(value, index, writer)
                        })*
                    }
                }

                #[inline]
                fn decode(reader: Reader<'_>) -> Read<'_, Self> {
                    let start = reader.position();
                    let (is_addition, reader) = reader.bits($extensible as u32)?;
                    if is_addition == 1 {
                        let (index, reader) = reader.small_number()?;
                        $(if index == Some(Index::$addition as usize - ROOT) {
                            let read = open_type::decode::<$addition_type>(reader);
                            return alternative(Index::$addition as usize, read, Self::$addition);
                        })*
                        let _ = (index, reader);
                        return Err(Error::at(start, Fault::UnknownAlternative));
                    }
                    let (index, reader) = reader.index(COUNT)?;
                    $(if index == Index::$variant as usize {
                        let read = <$type as Uper>::decode(reader);
                        return alternative(index, read, Self::$variant);
                    })+
                    Err(Error::at(start, Fault::AbsentAlternative))
                }

                fn arbitrary<S: Source>(source: &mut S) -> Self {
                    let index = source.index(0, FIELDS.len() - 1);
                    $(if index == Index::$variant as usize {
                        return Self::$variant(Uper::arbitrary(source));
                    })+
                    $(if index == Index::$addition as usize {
                        return Self::$addition(Uper::arbitrary(source));
                    })*
                    Self::LOWEST
                }
            }
        };
    };
}

/// One component of a SEQUENCE, by whether it is mandatory, OPTIONAL or has a DEFAULT.
macro_rules! component {
    (type [$type:ident]) => { $type };
    (type [$type:ident OPTIONAL]) => { Option<$type> };
    (type [$type:ident DEFAULT $default:ident]) => { $type };

    (optional [$type:ident]) => { 0 };
    (optional [$type:ident $keyword:ident $($default:ident)?]) => { 1 };

    (bits [$type:ident $($keyword:ident $($default:ident)?)?]) => { <$type as Uper>::MAX_BITS };
    (fields [$type:ident $($keyword:ident $($default:ident)?)?]) => { <$type as Uper>::FIELDS };

    (lowest [$type:ident]) => { <$type as Uper>::LOWEST };
    (lowest [$type:ident OPTIONAL]) => { None };
    (lowest [$type:ident DEFAULT $default:ident]) => { $type::$default };

    (presence [$type:ident], $presence:ident, $value:expr) => { $presence };
    (presence [$type:ident OPTIONAL], $presence:ident, $value:expr) => {
        $presence << 1 | u32::from($value.is_some())
    };
    (presence [$type:ident DEFAULT $default:ident], $presence:ident, $value:expr) => {
        $presence << 1 | u32::from($value != $type::$default)
    };

    (encode [$type:ident], $writer:ident, $value:expr) => { $value.encode($writer) };
    (encode [$type:ident OPTIONAL], $writer:ident, $value:expr) => {
        match &$value {
            Some(value) => value.encode($writer),
            None => $writer,
        }
    };
    (encode [$type:ident DEFAULT $default:ident], $writer:ident, $value:expr) => {
        if $value == $type::$default { $writer } else { $value.encode($writer) }
    };

    (next [$type:ident], $presence:ident, $optional:ident) => { ($presence, true) };
    (next [$type:ident $keyword:ident $($default:ident)?], $presence:ident, $optional:ident) => {
        ($presence << 1, $presence >> $optional & 1 == 1)
    };

    (decode [$type:ident], $reader:ident, $is_present:ident) => {{
        let _: bool = $is_present;
        <$type as Uper>::decode($reader)
    }};
    (decode [$type:ident OPTIONAL], $reader:ident, $is_present:ident) => {
        optional::<$type>($reader, $is_present)
    };
    (decode [$type:ident DEFAULT $default:ident], $reader:ident, $is_present:ident) => {
        defaulted::<$type>($reader, $is_present, $type::$default)
    };

    (arbitrary [$type:ident], $source:ident) => { <$type as Uper>::arbitrary($source) };
    (arbitrary [$type:ident OPTIONAL], $source:ident) => {
        $source.flip().then(|| <$type as Uper>::arbitrary($source))
    };
    (arbitrary [$type:ident DEFAULT $default:ident], $source:ident) => {
        <$type as Uper>::arbitrary($source)
    };
}

/// What the expansions of [`asn1!`] need.
pub(super) mod prelude {
    pub(in crate::core) use super::super::error::{Error, FIELDS_MAX, Fault, Field};
    pub(in crate::core) use super::super::list::SequenceOf;
    pub(in crate::core) use super::super::open_type;
    pub(in crate::core) use super::super::reader::{Read, Reader};
    pub(in crate::core) use super::super::source::Source;
    pub(in crate::core) use super::super::writer::Writer;
    pub(in crate::core) use super::super::{Null, Uper, width};
    pub(in crate::core) use super::{alternative, asn1, component, defaulted, longest, optional};
}

pub(super) use {asn1, component};

use super::Uper;
use super::error::{Error, Fault};
use super::reader::{Read, Reader};

/// The component, if it is present.
#[inline]
pub(super) fn optional<T: Uper>(reader: Reader<'_>, is_present: bool) -> Read<'_, Option<T>> {
    if !is_present {
        return Ok((None, reader));
    }
    let (value, reader) = T::decode(reader)?;
    Ok((Some(value), reader))
}

/// The component if it is present, which it is only if it is not its default (X.691 clause 19.5).
#[inline]
pub(super) fn defaulted<T: Uper>(reader: Reader<'_>, is_present: bool, default: T) -> Read<'_, T> {
    if !is_present {
        return Ok((default, reader));
    }
    match T::decode(reader)? {
        (value, _) if value == default => {
            Err(Error::at(reader.position(), Fault::DefaultSpelledOut))
        }
        read => Ok(read),
    }
}

/// The alternative `index` of a CHOICE.
#[inline]
pub(super) fn alternative<T, C>(
    index: usize,
    read: Read<'_, T>,
    choose: impl FnOnce(T) -> C,
) -> Read<'_, C> {
    match read {
        Ok((value, reader)) => Ok((choose(value), reader)),
        Err(error) => Err(error.within(index)),
    }
}

/// The largest of these numbers of bits.
pub(super) const fn longest(alternatives: &[u32]) -> u32 {
    let (mut longest, mut index) = (0, 0);
    while index < alternatives.len() {
        if alternatives[index] > longest {
            longest = alternatives[index];
        }
        index += 1;
    }
    longest
}
