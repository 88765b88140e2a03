//! The strict UPER decoder behind the `rasn::Decode` implementations of the generated types.
//!
//! It knows the part of X.691 that the modules of `asn1/*.asn` use: bounded integers, BOOLEAN, NULL,
//! ENUMERATED, BIT STRING, OCTET STRING, `IA5String`, `NumericString`, `UTF8String`, SEQUENCE, SEQUENCE
//! OF and CHOICE. Every other type is [`Fault::Unsupported`].

use rasn::types::constraints::{Bounded, Extensible, Size};
use rasn::types::{self, Constraints, Constructed, DecodeChoice, Enumerated, Tag, TagTree};
use rasn::{Codec, Decode};

use super::source::{Additions, BitSource, RasnError};
use super::width;
use crate::core::Fault;

type DecodeResult<T> = Result<T, RasnError>;

/// Decoder of one type; the components of a SEQUENCE have one for them all.
pub(super) struct Decoder<'s, 'a> {
    source: &'s BitSource<'a>,
    /// Presence bits of the OPTIONAL and DEFAULT components, the last one lowest.
    presence: u64,
    /// How many of them are yet to come.
    optional_left: u32,
    /// Whether the extension bit of the SEQUENCE is set.
    is_extended: bool,
    /// Its extension additions, once the root has been read.
    additions: Option<Additions>,
}

impl<'s, 'a> Decoder<'s, 'a> {
    pub(super) fn new(source: &'s BitSource<'a>) -> Self {
        Self {
            source,
            presence: 0,
            optional_left: 0,
            is_extended: false,
            additions: None,
        }
    }

    /// An index below `count`, in as few bits as that takes.
    fn index(&self, count: usize) -> DecodeResult<usize> {
        let start = self.source.position();
        let index = self.source.bits(width(count as u64))?;
        match usize::try_from(index) {
            Ok(index) if index < count => Ok(index),
            _ => Err(self.source.reject_at(start, Fault::UnknownAlternative)),
        }
    }

    /// The length of a list or string whose size is limited by `size`.
    fn size(&self, size: Option<&Extensible<Size>>) -> DecodeResult<usize> {
        let start = self.source.position();
        let unsupported = || self.source.reject_at(start, Fault::Unsupported);
        let size = size.ok_or_else(unsupported)?;
        if size.extensible.is_some() && self.source.bit()? {
            return Err(self.source.reject_at(start, Fault::BeyondRoot));
        }
        let (Some(&min), Some(&max)) = size.constraint.start_and_end() else {
            return Err(unsupported());
        };
        let offset = self.source.bits(width((max - min) as u64 + 1))?;
        match usize::try_from(offset)
            .ok()
            .and_then(|offset| min.checked_add(offset))
        {
            Some(length) if length <= max => Ok(length),
            _ => Err(self.source.reject_at(start, Fault::Size { min, max })),
        }
    }

    /// Whether the next OPTIONAL or DEFAULT component is present.
    fn is_present(&mut self) -> DecodeResult<bool> {
        match self.optional_left.checked_sub(1) {
            Some(left) => {
                self.optional_left = left;
                Ok(self.presence >> left & 1 == 1)
            }
            None => self.unsupported(),
        }
    }

    /// The characters of a string, each a number of this many bits (X.691 clause 30).
    fn characters(&self, constraints: &Constraints, bits: u32) -> DecodeResult<Vec<u8>> {
        let length = self.size(constraints.size())?;
        let character = |_| self.source.bits(bits).map(|bits| bits.to_be_bytes()[7]);
        (0..length).map(character).collect()
    }

    fn unsupported<T>(&self) -> DecodeResult<T> {
        Err(self
            .source
            .reject_at(self.source.position(), Fault::Unsupported))
    }
}

/// Methods for types that the modules do not use.
macro_rules! unsupported {
    ($($method:ident($($argument:ty),*) -> $type:ty;)*) => {$(
        fn $method(&mut self, _: Tag, $(_: $argument),*) -> DecodeResult<$type> {
            self.unsupported()
        }
    )*};
}

impl rasn::Decoder for Decoder<'_, '_> {
    type Ok = ();
    type Error = RasnError;
    type AnyDecoder<const R: usize, const E: usize> = Self;

    fn codec(&self) -> Codec {
        Codec::Uper
    }

    fn decode_null(&mut self, _: Tag) -> DecodeResult<()> {
        Ok(())
    }

    fn decode_bool(&mut self, _: Tag) -> DecodeResult<bool> {
        self.source.bit()
    }

    /// X.691 clause 13.
    fn decode_integer<I: types::IntegerType>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<I> {
        let start = self.source.position();
        let Some(value) = constraints.value() else {
            return self.unsupported();
        };
        if value.extensible.is_some() && self.source.bit()? {
            return Err(self.source.reject_at(start, Fault::BeyondRoot));
        }
        let bounds: &Bounded<i128> = &value.constraint;
        let (Some(&min), Some(&max)) = bounds.start_and_end() else {
            return self.unsupported();
        };
        let (Ok(values), Ok(min), Ok(max)) = (
            u64::try_from(max - min + 1),
            i64::try_from(min),
            i64::try_from(max),
        ) else {
            return self.unsupported();
        };
        let offset = self.source.bits(width(values))?;
        let number = min.checked_add_unsigned(offset).unwrap_or(i64::MAX);
        let fault = || {
            self.source
                .reject_at(start, Fault::Value { number, min, max })
        };
        if number > max {
            return Err(fault());
        }
        I::try_from(number).map_err(|_| fault())
    }

    /// X.691 clause 14.
    fn decode_enumerated<E: Enumerated>(&mut self, _: Tag) -> DecodeResult<E> {
        let start = self.source.position();
        let is_addition = E::EXTENDED_VARIANTS.is_some() && self.source.bit()?;
        let value = if is_addition {
            self.source
                .small_number()?
                .and_then(E::from_extended_enumeration_index)
        } else {
            E::from_enumeration_index(self.index(E::variance())?)
        };
        value.ok_or_else(|| self.source.reject_at(start, Fault::UnknownAlternative))
    }

    /// X.691 clause 16.
    fn decode_bit_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<types::BitString> {
        let length = self.size(constraints.size())?;
        (0..length).map(|_| self.source.bit()).collect()
    }

    /// X.691 clause 19.
    fn decode_sequence<const RC: usize, const EC: usize, D, DF, F>(
        &mut self,
        _: Tag,
        _: Option<DF>,
        decode_fn: F,
    ) -> DecodeResult<D>
    where
        D: Constructed<RC, EC>,
        DF: FnOnce() -> D,
        F: FnOnce(&mut Self) -> DecodeResult<D>,
    {
        const {
            assert!(D::FIELDS.number_of_optional_and_default_fields() <= 64);
        }
        let marker = self.source.position();
        let is_extended = D::IS_EXTENSIBLE && self.source.bit()?;
        #[expect(clippy::cast_possible_truncation, reason = "at most 64")]
        let optional_left = D::FIELDS.number_of_optional_and_default_fields() as u32;
        let presence = self.source.bits(optional_left)?;
        let mut components = Decoder {
            source: self.source,
            presence,
            optional_left,
            is_extended,
            additions: None,
        };
        let value = decode_fn(&mut components)?;
        if is_extended {
            let additions = match components.additions {
                Some(additions) => additions,
                None => self.source.additions()?,
            };
            self.source.skip_additions(marker, EC, additions)?;
        }
        Ok(value)
    }

    /// X.691 clause 20. The list grows to its length at most, which is known and small.
    fn decode_sequence_of<D: Decode>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<Vec<D>> {
        let length = self.size(constraints.size())?;
        let mut list = Vec::with_capacity(length);
        for _ in 0..length {
            list.push(D::decode(&mut Decoder::new(self.source))?);
        }
        Ok(list)
    }

    /// X.691 clause 23.
    fn decode_choice<D: DecodeChoice>(&mut self, constraints: &Constraints) -> DecodeResult<D> {
        let start = self.source.position();
        let unknown = || self.source.reject_at(start, Fault::UnknownAlternative);
        let is_addition = constraints.extensible() && self.source.bit()?;
        let variants = if is_addition {
            D::EXTENDED_VARIANTS.unwrap_or(&[])
        } else {
            D::VARIANTS
        };
        let index = if is_addition {
            self.source.small_number()?.ok_or_else(unknown)?
        } else {
            self.index(variants.len())?
        };
        // Automatic tags: every alternative has a tag of its own.
        let Some(&TagTree::Leaf(tag)) = variants.get(index) else {
            return Err(unknown());
        };
        let mut alternative = Decoder::new(self.source);
        if is_addition {
            self.source.open_type(|| D::from_tag(&mut alternative, tag))
        } else {
            D::from_tag(&mut alternative, tag)
        }
    }

    fn decode_explicit_prefix<D: Decode>(&mut self, tag: Tag) -> DecodeResult<D> {
        if D::IS_CHOICE {
            D::decode(self)
        } else {
            D::decode_with_tag(self, tag)
        }
    }

    fn decode_optional_with_explicit_prefix<D: Decode>(
        &mut self,
        tag: Tag,
    ) -> DecodeResult<Option<D>> {
        self.decode_optional_with_tag(tag)
    }

    fn decode_optional<D: Decode>(&mut self) -> DecodeResult<Option<D>> {
        self.decode_optional_with_tag(D::TAG)
    }

    fn decode_optional_with_tag<D: Decode>(&mut self, tag: Tag) -> DecodeResult<Option<D>> {
        let is_present = self.is_present()?;
        is_present
            .then(|| D::decode_with_tag(self, tag))
            .transpose()
    }

    fn decode_optional_with_constraints<D: Decode>(
        &mut self,
        constraints: &Constraints,
    ) -> DecodeResult<Option<D>> {
        self.decode_optional_with_tag_and_constraints(D::TAG, constraints)
    }

    fn decode_optional_with_tag_and_constraints<D: Decode>(
        &mut self,
        tag: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<Option<D>> {
        let is_present = self.is_present()?;
        is_present
            .then(|| D::decode_with_tag_and_constraints(self, tag, constraints))
            .transpose()
    }

    unsupported! {
        decode_any() -> types::Any;
        decode_object_identifier() -> types::ObjectIdentifier;
        decode_visible_string(&Constraints) -> types::VisibleString;
        decode_general_string(&Constraints) -> types::GeneralString;
        decode_graphic_string(&Constraints) -> types::GraphicString;
        decode_printable_string(&Constraints) -> types::PrintableString;
        decode_teletex_string(&Constraints) -> types::TeletexString;
        decode_bmp_string(&Constraints) -> types::BmpString;
        decode_utc_time() -> types::UtcTime;
        decode_generalized_time() -> types::GeneralizedTime;
        decode_date() -> types::Date;
    }

    fn decode_real<R: types::RealType>(&mut self, _: Tag, _: &Constraints) -> DecodeResult<R> {
        self.unsupported()
    }

    /// X.691 clause 17.
    fn decode_octet_string<'b, T>(
        &'b mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<T>
    where
        T: From<&'b [u8]> + From<Vec<u8>>,
    {
        let length = match constraints.size() {
            Some(size) => self.size(Some(size))?,
            None => self.source.length()?,
        };
        self.source.octets(length).map(T::from)
    }

    fn decode_ia5_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<types::Ia5String> {
        let start = self.source.position();
        let characters = self.characters(constraints, 7)?;
        types::Ia5String::from_iso646_bytes(&characters)
            .map_err(|_| self.source.reject_at(start, Fault::Characters))
    }

    /// Eleven characters, of which each is its index in four bits.
    fn decode_numeric_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<types::NumericString> {
        let start = self.source.position();
        let indices = self.characters(constraints, 4)?;
        let characters = indices.into_iter();
        let characters = characters.map(|index| b" 0123456789".get(usize::from(index)).copied());
        let characters: Option<Vec<u8>> = characters.collect();
        characters
            .and_then(|characters| types::NumericString::from_bytes(&characters).ok())
            .ok_or_else(|| self.source.reject_at(start, Fault::Characters))
    }

    /// As octets (X.691 clause 30.6); its size counts characters, and PER does not see it.
    fn decode_utf8_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<types::Utf8String> {
        let start = self.source.position();
        let reject = |fault| self.source.reject_at(start, fault);
        let octets = self.source.octets(self.source.length()?)?;
        let text = String::from_utf8(octets).map_err(|_| reject(Fault::Characters))?;
        let size = constraints.size().map(|size| &size.constraint);
        let Some((Some(&min), Some(&max))) = size.map(|size| size.start_and_end()) else {
            return Err(reject(Fault::Unsupported));
        };
        if !(min..=max).contains(&text.chars().count()) {
            return Err(reject(Fault::Size { min, max }));
        }
        Ok(text)
    }

    fn decode_set_of<D: Decode + Eq + std::hash::Hash>(
        &mut self,
        _: Tag,
        _: &Constraints,
    ) -> DecodeResult<types::SetOf<D>> {
        self.unsupported()
    }

    fn decode_set<const RC: usize, const EC: usize, FIELDS, SET, D, F>(
        &mut self,
        _: Tag,
        _: D,
        _: F,
    ) -> DecodeResult<SET>
    where
        SET: Decode + Constructed<RC, EC>,
        FIELDS: Decode,
        D: Fn(&mut Self, usize, Tag) -> DecodeResult<FIELDS>,
        F: FnOnce(Vec<FIELDS>) -> DecodeResult<SET>,
    {
        self.unsupported()
    }

    fn decode_extension_addition_with_explicit_tag_and_constraints<D: Decode>(
        &mut self,
        tag: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<Option<D>> {
        self.decode_extension_addition_with_tag_and_constraints(tag, constraints)
    }

    /// X.691 clause 19.9.
    fn decode_extension_addition_with_tag_and_constraints<D: Decode>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> DecodeResult<Option<D>> {
        if !self.is_extended {
            return Ok(None);
        }
        let mut additions = match self.additions.take() {
            Some(additions) => additions,
            None => self.source.additions()?,
        };
        let is_present = additions.next_is_present();
        self.additions = Some(additions);
        if !is_present {
            return Ok(None);
        }
        let mut addition = Decoder::new(self.source);
        let read = || {
            // rasn does not give the constraints that the type of the addition has itself.
            if constraints.size().is_none() && constraints.value().is_none() {
                D::decode(&mut addition)
            } else {
                D::decode_with_constraints(&mut addition, constraints)
            }
        };
        self.source.open_type(read).map(Some)
    }

    fn decode_extension_addition_group<const RC: usize, const EC: usize, D>(
        &mut self,
    ) -> DecodeResult<Option<D>>
    where
        D: Decode + Constructed<RC, EC>,
    {
        self.unsupported()
    }
}
