//! Arbitrary values of the generated types: a `rasn::Decoder` that makes its values up.
//!
//! Every value that it makes is valid by its ASN.1 type, with sizes and numbers before extension
//! markers only.

use crossguard_codec::core::Source as _;
use crossguard_codec::{Identifiers, Pdu};
use rasn::de::Error as _;
use rasn::error::DecodeError;
use rasn::types::{self, Constraints, Constructed, DecodeChoice, Enumerated, Tag, TagTree};
use rasn::{Codec, Decode};

use super::core::Random;

type Result<T> = std::result::Result<T, DecodeError>;

/// A message of another station than a robot that `seed` stands for, with its header.
pub fn foreign<M: Decode + Pdu>(seed: u64) -> M {
    let (protocol_version, message_id) = M::expected_header(&Identifiers::default());
    // The first two numbers of a message are those of its header.
    let forced = vec![message_id.into(), protocol_version.into()];
    M::decode(&mut Imagination::new(seed, forced)).expect("every type is supported")
}

/// A value of any type that `seed` stands for.
pub fn any<T: Decode>(seed: u64) -> T {
    T::decode(&mut Imagination::new(seed, Vec::new())).expect("every type is supported")
}

struct Imagination {
    random: Random,
    /// Numbers that come first, the next one last.
    forced: Vec<i128>,
}

impl Imagination {
    const fn new(seed: u64, forced: Vec<i128>) -> Self {
        let random = Random(seed);
        Self { random, forced }
    }

    fn flip(&mut self) -> bool {
        self.random.flip()
    }

    fn below(&mut self, count: usize) -> usize {
        self.random.index(0, count - 1)
    }

    /// Often the smallest or the largest one.
    fn within(&mut self, min: i128, max: i128) -> i128 {
        let number = |bound: i128| i64::try_from(bound).expect("at most 64 bits");
        self.random.integer(number(min), number(max)).into()
    }

    fn size(&mut self, constraints: &Constraints) -> usize {
        let size = constraints
            .size()
            .expect("lists and strings have sizes")
            .constraint;
        let (min, max) = (*size.as_start().unwrap(), *size.as_end().unwrap());
        usize::try_from(self.within(min as i128, max as i128)).unwrap()
    }

    #[expect(clippy::unused_self, reason = "as methods of the trait")]
    fn unused<T>(&self) -> Result<T> {
        Err(DecodeError::custom(
            "no module uses such a type",
            Codec::Uper,
        ))
    }
}

macro_rules! unused {
    ($($method:ident($($argument:ty),*) -> $type:ty;)*) => {$(
        fn $method(&mut self, _: Tag, $(_: $argument),*) -> Result<$type> {
            self.unused()
        }
    )*};
}

impl rasn::Decoder for Imagination {
    type Ok = ();
    type Error = DecodeError;
    type AnyDecoder<const R: usize, const E: usize> = Self;

    fn codec(&self) -> Codec {
        Codec::Uper
    }

    fn decode_null(&mut self, _: Tag) -> Result<()> {
        Ok(())
    }

    fn decode_bool(&mut self, _: Tag) -> Result<bool> {
        Ok(self.flip())
    }

    fn decode_integer<I: types::IntegerType>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> Result<I> {
        let bounds = constraints
            .value()
            .expect("integers have bounds")
            .constraint;
        let (min, max) = (*bounds.as_start().unwrap(), *bounds.as_end().unwrap());
        let number = self.forced.pop().unwrap_or_else(|| self.within(min, max));
        I::try_from(number).or_else(|_| self.unused())
    }

    fn decode_enumerated<E: Enumerated>(&mut self, _: Tag) -> Result<E> {
        Ok(E::VARIANTS[self.below(E::VARIANTS.len())])
    }

    fn decode_bit_string(&mut self, _: Tag, constraints: &Constraints) -> Result<types::BitString> {
        let size = self.size(constraints);
        Ok((0..size).map(|_| self.flip()).collect())
    }

    fn decode_sequence<const RC: usize, const EC: usize, D, DF, F>(
        &mut self,
        _: Tag,
        _: Option<DF>,
        decode_fn: F,
    ) -> Result<D>
    where
        D: Constructed<RC, EC>,
        DF: FnOnce() -> D,
        F: FnOnce(&mut Self) -> Result<D>,
    {
        decode_fn(self)
    }

    fn decode_sequence_of<D: Decode>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> Result<Vec<D>> {
        (0..self.size(constraints))
            .map(|_| D::decode(self))
            .collect()
    }

    fn decode_choice<D: DecodeChoice>(&mut self, _: &Constraints) -> Result<D> {
        let alternatives: Vec<_> = D::VARIANTS
            .iter()
            .chain(D::EXTENDED_VARIANTS.unwrap_or(&[]))
            .collect();
        match alternatives[self.below(alternatives.len())] {
            TagTree::Leaf(tag) => D::from_tag(self, *tag),
            TagTree::Choice(_) => self.unused(),
        }
    }

    fn decode_explicit_prefix<D: Decode>(&mut self, tag: Tag) -> Result<D> {
        if D::IS_CHOICE {
            D::decode(self)
        } else {
            D::decode_with_tag(self, tag)
        }
    }

    fn decode_optional_with_explicit_prefix<D: Decode>(&mut self, tag: Tag) -> Result<Option<D>> {
        self.decode_optional_with_tag(tag)
    }

    fn decode_optional<D: Decode>(&mut self) -> Result<Option<D>> {
        self.decode_optional_with_tag(D::TAG)
    }

    fn decode_optional_with_tag<D: Decode>(&mut self, tag: Tag) -> Result<Option<D>> {
        let is_present = self.flip();
        is_present
            .then(|| D::decode_with_tag(self, tag))
            .transpose()
    }

    fn decode_optional_with_constraints<D: Decode>(
        &mut self,
        constraints: &Constraints,
    ) -> Result<Option<D>> {
        self.decode_optional_with_tag_and_constraints(D::TAG, constraints)
    }

    fn decode_optional_with_tag_and_constraints<D: Decode>(
        &mut self,
        tag: Tag,
        constraints: &Constraints,
    ) -> Result<Option<D>> {
        let is_present = self.flip();
        is_present
            .then(|| D::decode_with_tag_and_constraints(self, tag, constraints))
            .transpose()
    }

    unused! {
        decode_any() -> types::Any;
        decode_object_identifier() -> types::ObjectIdentifier;
        decode_ia5_string(&Constraints) -> types::Ia5String;
        decode_numeric_string(&Constraints) -> types::NumericString;
        decode_utf8_string(&Constraints) -> types::Utf8String;
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

    fn decode_real<R: types::RealType>(&mut self, _: Tag, _: &Constraints) -> Result<R> {
        self.unused()
    }

    fn decode_octet_string<'b, T>(&'b mut self, _: Tag, constraints: &Constraints) -> Result<T>
    where
        T: From<&'b [u8]> + From<Vec<u8>>,
    {
        let size = match constraints.size() {
            Some(_) => self.size(constraints),
            None => 1 + self.below(200),
        };
        Ok(T::from(self.random.octets(size)))
    }

    fn decode_set_of<D: Decode + Eq + std::hash::Hash>(
        &mut self,
        _: Tag,
        _: &Constraints,
    ) -> Result<types::SetOf<D>> {
        self.unused()
    }

    fn decode_set<const RC: usize, const EC: usize, FIELDS, SET, D, F>(
        &mut self,
        _: Tag,
        _: D,
        _: F,
    ) -> Result<SET>
    where
        SET: Decode + Constructed<RC, EC>,
        FIELDS: Decode,
        D: Fn(&mut Self, usize, Tag) -> Result<FIELDS>,
        F: FnOnce(Vec<FIELDS>) -> Result<SET>,
    {
        self.unused()
    }

    fn decode_extension_addition_with_explicit_tag_and_constraints<D: Decode>(
        &mut self,
        tag: Tag,
        constraints: &Constraints,
    ) -> Result<Option<D>> {
        self.decode_extension_addition_with_tag_and_constraints(tag, constraints)
    }

    fn decode_extension_addition_with_tag_and_constraints<D: Decode>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
    ) -> Result<Option<D>> {
        if self.flip() {
            return Ok(None);
        }
        // rasn does not give the constraints that the type of the addition has itself.
        if constraints.size().is_none() && constraints.value().is_none() {
            D::decode(self).map(Some)
        } else {
            D::decode_with_constraints(self, constraints).map(Some)
        }
    }

    fn decode_extension_addition_group<const RC: usize, const EC: usize, D>(
        &mut self,
    ) -> Result<Option<D>>
    where
        D: Decode + Constructed<RC, EC>,
    {
        self.unused()
    }
}
