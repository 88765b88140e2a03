//! The notation of ASN.1, as far as RAM and RMCM use it.
//!
//! [`asn1!`] takes one type assignment and makes the Rust type and its [`Uper`](super::Uper)
//! implementation of it: encoding, decoding, largest size, field names, arbitrary values. A type reads
//! as in `asn1/*.asn`, but for
//!
//! - names, which are in Rust's spelling; those of values of an ENUMERATED have that of ASN.1 behind them where it does
//!   not follow: `Alt001_00 "alt-001-00"`; and `bool` and `Null` for BOOLEAN and NULL;
//! - what holds the value in Rust: `INTEGER (..) as i16`, or `is u8` when every `u8` is a value;
//! - lists inside of other types, which have a type of their own, `AT MOST` as long as their message
//!   allows;
//! - alternatives that an inner subtype constraint leaves out, of which the number is given:
//!   `3 ABSENT`.
//!
//! The values of an ENUMERATED have the names of ASN.1 in JSON; JSON of whole messages is that of the rasn types. The
//! declarations are generated from the modules by `tests/generated`.

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
            fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
                let (number, reader) = if $extensible {
                    reader.extensible_integer($min.into(), $max.into())
                } else {
                    reader.integer($min.into(), $max.into())
                };
                self.0 = number as $rust;
                reader
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

            /// The string of these bits. Bits that the string has no place for are left out.
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
            fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
                let (first_highest, reader) = reader.bits($size);
                let bits = (first_highest as $rust) << ($rust::BITS - $size);
                self.0 = bits.reverse_bits();
                reader
            }

            fn arbitrary<S: Source>(source: &mut S) -> Self {
                Self(source.integer(0, Self::MASK.into()) as $rust)
            }
        }
    };

    // ENUMERATED.
    ($(#[$meta:meta])* $name:ident ::= ENUMERATED { $($variant:ident $($json:literal)?),+ }) => {
        asn1!(@enumerated [$(#[$meta])*] $name [$($variant [$($json)?])+] false);
    };
    ($(#[$meta:meta])* $name:ident ::= ENUMERATED { $($variant:ident $($json:literal)?),+, ... }) => {
        asn1!(@enumerated [$(#[$meta])*] $name [$($variant [$($json)?])+] true);
    };
    (@enumerated [$(#[$meta:meta])*] $name:ident [$($variant:ident [$($json:literal)?])+] $extensible:literal) => {
        $(#[$meta])*
        #[allow(missing_docs, reason = "a value is its name")]
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
        #[serde(rename_all = "camelCase")]
        pub enum $name {
            $($(#[serde(rename = $json)])? $variant,)+
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
            fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
                let (index, reader) = reader.enumerated(Self::ALL.len(), $extensible);
                *self = Self::ALL[index];
                reader
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
    ($(#[$meta:meta])* $name:ident ::= SEQUENCE { $($field:ident $type:ident $($keyword:ident $($default:ident)?)?),+ }) => {
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
            #[allow(clippy::enum_variant_names, reason = "names of components")]
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
                fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
                    let (is_extended, reader) = if $extensible {
                        reader.bit()
                    } else {
                        (false, reader)
                    };
                    let (presence, reader) = reader.bits(OPTIONAL);
                    // The bit of the next component is in the place of OPTIONAL.
                    let presence = u64::from(presence) << 1;
                    $(
                        let (presence, is_present) = component!(next $kind, presence, OPTIONAL);
                        let had_failed = reader.has_failed();
                        let reader = component!(read $kind, self.$field, reader, is_present)
                            .behind_field(Index::$field as usize, had_failed);
                    )+
                    let _ = presence;
                    if is_extended && !reader.has_failed() {
                        reader.skip_additions()
                    } else {
                        reader
                    }
                }

                fn arbitrary<S: Source>(source: &mut S) -> Self {
                    Self { $($field: component!(arbitrary $kind, source),)+ }
                }
            }
        };
    };

    // CHOICE.
    ($(#[$meta:meta])* $name:ident ::= CHOICE { $($variant:ident $type:ident),+ }) => {
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
            #[allow(clippy::enum_variant_names, reason = "names of alternatives")]
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
                fn read<'a, F: Faults>(&mut self, reader: Reader<'a, F>) -> Reader<'a, F> {
                    let start = reader.position();
                    let (is_addition, reader) = if $extensible {
                        reader.bit()
                    } else {
                        (false, reader)
                    };
                    if is_addition {
                        let (index, reader) = reader.small_number();
                        $(if index == Some(Index::$addition as usize - ROOT) {
                            let had_failed = reader.has_failed();
                            let (value, reader) = open_type::decode::<$addition_type, _>(reader);
                            *self = Self::$addition(value);
                            return reader.behind_field(Index::$addition as usize, had_failed);
                        })*
                        let _ = index;
                        return reader.fail(start, Fault::UnknownAlternative);
                    }
                    let (index, reader) = reader.index(COUNT);
                    $(if index == Index::$variant as usize {
                        let had_failed = reader.has_failed();
                        let mut value = <$type as Uper>::LOWEST;
                        let reader = value.read(reader);
                        *self = Self::$variant(value);
                        return reader.behind_field(index, had_failed);
                    })+
                    reader.fail(start, Fault::AbsentAlternative)
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

    (read [$type:ident], $slot:expr, $reader:ident, $is_present:ident) => {{
        let _: bool = $is_present;
        $slot.read($reader)
    }};
    (read [$type:ident OPTIONAL], $slot:expr, $reader:ident, $is_present:ident) => {
        read_optional(&mut $slot, $reader, $is_present)
    };
    (read [$type:ident DEFAULT $default:ident], $slot:expr, $reader:ident, $is_present:ident) => {
        read_defaulted(&mut $slot, $reader, $is_present)
    };

    (arbitrary [$type:ident], $source:ident) => { <$type as Uper>::arbitrary($source) };
    (arbitrary [$type:ident OPTIONAL], $source:ident) => {
        $source.flip().then(|| <$type as Uper>::arbitrary($source))
    };
    (arbitrary [$type:ident DEFAULT $default:ident], $source:ident) => {
        <$type as Uper>::arbitrary($source)
    };
}

/// Names that the expansions of [`asn1!`] need.
pub(super) mod prelude {
    pub(in crate::core) use super::{asn1, component, longest, read_defaulted, read_optional};
    pub(in crate::core) use crate::core::error::{FIELDS_MAX, Fault, Field};
    pub(in crate::core) use crate::core::list::SequenceOf;
    pub(in crate::core) use crate::core::open_type;
    pub(in crate::core) use crate::core::reader::{Faults, Reader};
    pub(in crate::core) use crate::core::source::Source;
    pub(in crate::core) use crate::core::writer::Writer;
    pub(in crate::core) use crate::core::{Null, Uper, width};
    // Types of one module use those of others.
    pub(in crate::core) use crate::core::{cdd::*, common::*, vam::*};
    pub(in crate::core) use serde::{Deserialize, Serialize};
}

pub(super) use {asn1, component};

use super::Uper;
use super::error::Fault;
use super::reader::{Faults, Reader};

/// Reads the component, if it is present.
#[inline]
pub(super) fn read_optional<'a, T: Uper, F: Faults>(
    slot: &mut Option<T>,
    reader: Reader<'a, F>,
    is_present: bool,
) -> Reader<'a, F> {
    if !is_present {
        return reader;
    }
    slot.insert(T::LOWEST).read(reader)
}

/// Reads the component if it is present, which it is only if it is not its default (X.691 clause
/// 19.5). The slot holds the default.
#[inline]
pub(super) fn read_defaulted<'a, T: Uper, F: Faults>(
    slot: &mut T,
    reader: Reader<'a, F>,
    is_present: bool,
) -> Reader<'a, F> {
    if !is_present {
        return reader;
    }
    let mut value = T::LOWEST;
    let behind = value.read(reader);
    if value == *slot {
        return behind.fail(reader.position(), Fault::DefaultSpelledOut);
    }
    *slot = value;
    behind
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
