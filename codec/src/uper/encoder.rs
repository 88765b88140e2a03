//! The UPER encoder behind the `rasn::Encode` implementations of the generated types.
//!
//! It knows the same part of X.691 as the decoder. rasn's own encoder has a copy of its code, and of a
//! sort, for every SEQUENCE; that was half of what this crate had to be compiled. rasn's encoder judges
//! this one in `tests/differential.rs`.

use rasn::error::EncodeError;
use rasn::types::constraints::{Bounded, Extensible, Size, Value};
use rasn::types::{self, Choice, Constraints, Constructed, Enumerated, Identifier, Tag, TagTree};
use rasn::{Codec, Encode};

use super::width;

type EncodeResult<T> = Result<T, EncodeError>;

/// Bits in their order.
#[derive(Default)]
pub(super) struct Bits {
    octets: Vec<u8>,
    count: usize,
}

impl Bits {
    /// The bits in whole octets, at least one (X.691 clause 11.1).
    pub(super) fn into_octets(mut self) -> Vec<u8> {
        if self.octets.is_empty() {
            self.octets.push(0);
        }
        self.octets
    }

    fn bit(&mut self, bit: bool) {
        if self.count.is_multiple_of(8) {
            self.octets.push(0);
        }
        self.count += 1;
        if bit {
            self.set(self.count - 1);
        }
    }

    /// Makes a bit that was written a one.
    fn set(&mut self, index: usize) {
        self.octets[index / 8] |= 0x80 >> (index % 8);
    }

    /// The lowest `count` bits of a number, at most 64, the highest first.
    fn number(&mut self, number: u64, count: u32) {
        for index in (0..count).rev() {
            self.bit(number >> index & 1 == 1);
        }
    }

    fn octets(&mut self, octets: &[u8]) {
        for octet in octets {
            self.number((*octet).into(), 8);
        }
    }

    /// A length without a bound (X.691 clause 11.9). A message has no parts of 16384 items.
    fn length(&mut self, length: usize) -> EncodeResult<()> {
        match length {
            0..0x80 => self.number(length as u64, 8),
            0x80..0x4000 => self.number(0x8000 | length as u64, 16),
            _ => return Err(EncodeError::length_exceeds_platform_size(Codec::Uper)),
        }
        Ok(())
    }

    /// A small number, below 64 (X.691 clause 11.6).
    fn small_number(&mut self, number: usize) -> EncodeResult<()> {
        if number >= 64 {
            return unsupported();
        }
        self.number(number as u64, 7);
        Ok(())
    }

    /// An open type: octets with their number (X.691 clause 11.2).
    fn open_type(&mut self, octets: &[u8]) -> EncodeResult<()> {
        self.length(octets.len())?;
        self.octets(octets);
        Ok(())
    }

    /// X.691 clause 13.
    fn integer(&mut self, number: i128, range: &Extensible<Value>) -> EncodeResult<()> {
        let bounds: &Bounded<i128> = &range.constraint;
        let (Some(&min), Some(&max)) = bounds.start_and_end() else {
            return unsupported();
        };
        let is_in_root = (min..=max).contains(&number);
        if range.extensible.is_some() {
            self.bit(!is_in_root);
        } else if !is_in_root {
            let number = number.into();
            let error = EncodeError::value_constraint_not_satisfied(number, bounds, Codec::Uper);
            return Err(error);
        }
        if !is_in_root {
            return self.unbounded(number);
        }
        match (u64::try_from(max - min + 1), u64::try_from(number - min)) {
            (Ok(values), Ok(offset)) => self.number(offset, width(values)),
            _ => return unsupported(),
        }
        Ok(())
    }

    /// An integer without bounds, in as few octets as it takes (X.691 clause 13.2.4).
    fn unbounded(&mut self, number: i128) -> EncodeResult<()> {
        let octets = number.to_be_bytes();
        let significant = 129 - number.unsigned_abs().leading_zeros() as usize;
        let is_exact = number < 0 && number.unsigned_abs().is_power_of_two();
        let length = (significant - usize::from(is_exact)).div_ceil(8).max(1);
        self.open_type(&octets[octets.len() - length..])
    }

    /// The length of a list or string (X.691 clauses 16, 17, 20).
    fn size(&mut self, length: usize, size: Option<&Extensible<Size>>) -> EncodeResult<()> {
        let Some(size) = size else {
            return self.length(length);
        };
        let (Some(&min), Some(&max)) = size.constraint.start_and_end() else {
            return unsupported();
        };
        let is_in_root = (min..=max).contains(&length);
        if size.extensible.is_some() {
            self.bit(!is_in_root);
        } else if !is_in_root {
            let error =
                EncodeError::size_constraint_not_satisfied(length, &size.constraint, Codec::Uper);
            return Err(error);
        }
        if !is_in_root {
            return self.length(length);
        }
        self.number((length - min) as u64, width((max - min) as u64 + 1));
        Ok(())
    }

    /// Marks the SEQUENCE at `marker` as extended, and writes its additions (X.691 clause 19.7).
    fn additions(&mut self, marker: usize, additions: &[Option<Vec<u8>>]) -> EncodeResult<()> {
        self.set(marker);
        self.small_number(additions.len() - 1)?;
        for addition in additions {
            self.bit(addition.is_some());
        }
        for octets in additions.iter().flatten() {
            self.open_type(octets)?;
        }
        Ok(())
    }
}

/// Something that the modules do not use.
fn unsupported<T>() -> EncodeResult<T> {
    let error = rasn::enc::Error::custom("no module uses such a type", Codec::Uper);
    Err(error)
}

/// Encoder of one type; the components of a SEQUENCE have one for them all.
pub(super) struct Encoder<'w> {
    bits: &'w mut Bits,
    /// The presence bit of the next OPTIONAL or DEFAULT component, within a SEQUENCE.
    presence: Option<usize>,
    /// The extension additions of the SEQUENCE, each as an open type if it is present.
    additions: Vec<Option<Vec<u8>>>,
}

impl<'w> Encoder<'w> {
    pub(super) fn new(bits: &'w mut Bits) -> Self {
        Self {
            bits,
            presence: None,
            additions: Vec::new(),
        }
    }

    /// Says whether the next OPTIONAL or DEFAULT component is present.
    fn present(&mut self, is_present: bool) {
        if let Some(index) = &mut self.presence {
            if is_present {
                self.bits.set(*index);
            }
            *index += 1;
        }
    }

    /// The characters of a string, each a number of this many bits (X.691 clause 30).
    fn characters(
        &mut self,
        numbers: impl ExactSizeIterator<Item = u64>,
        constraints: &Constraints,
        bits: u32,
    ) -> EncodeResult<()> {
        self.bits.size(numbers.len(), constraints.size())?;
        numbers.for_each(|number| self.bits.number(number, bits));
        Ok(())
    }
}

/// Methods for types that the modules do not use.
macro_rules! unsupported {
    ($($method:ident($($argument:ty),*);)*) => {$(
        fn $method(&mut self, _: Tag, $(_: $argument,)* _: Identifier) -> EncodeResult<()> {
            unsupported()
        }
    )*};
}

impl rasn::Encoder<'_> for Encoder<'_> {
    type Ok = ();
    type Error = EncodeError;
    type AnyEncoder<'b, const R: usize, const E: usize> = Encoder<'b>;

    fn codec(&self) -> Codec {
        Codec::Uper
    }

    fn encode_null(&mut self, _: Tag, _: Identifier) -> EncodeResult<()> {
        Ok(())
    }

    fn encode_bool(&mut self, _: Tag, value: bool, _: Identifier) -> EncodeResult<()> {
        self.bits.bit(value);
        Ok(())
    }

    fn encode_integer<I: types::IntegerType>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
        value: &I,
        _: Identifier,
    ) -> EncodeResult<()> {
        match (value.to_i128(), constraints.value()) {
            (Some(number), Some(range)) => self.bits.integer(number, range),
            _ => unsupported(),
        }
    }

    /// X.691 clause 14.
    fn encode_enumerated<E: Enumerated>(
        &mut self,
        _: Tag,
        value: &E,
        _: Identifier,
    ) -> EncodeResult<()> {
        let index = value.enumeration_index();
        let is_addition = value.is_extended_variant();
        if E::EXTENDED_VARIANTS.is_some() {
            self.bits.bit(is_addition);
        }
        if is_addition {
            return self.bits.small_number(index);
        }
        self.bits.number(index as u64, width(E::variance() as u64));
        Ok(())
    }

    fn encode_bit_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
        value: &types::BitStr,
        _: Identifier,
    ) -> EncodeResult<()> {
        self.bits.size(value.len(), constraints.size())?;
        value.iter().by_vals().for_each(|bit| self.bits.bit(bit));
        Ok(())
    }

    fn encode_octet_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
        value: &[u8],
        _: Identifier,
    ) -> EncodeResult<()> {
        self.bits.size(value.len(), constraints.size())?;
        self.bits.octets(value);
        Ok(())
    }

    fn encode_ia5_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
        value: &types::Ia5String,
        _: Identifier,
    ) -> EncodeResult<()> {
        let characters = value.as_iso646_bytes().iter();
        self.characters(characters.map(|octet| (*octet).into()), constraints, 7)
    }

    fn encode_numeric_string(
        &mut self,
        _: Tag,
        constraints: &Constraints,
        value: &types::NumericString,
        _: Identifier,
    ) -> EncodeResult<()> {
        // A space is the first of the eleven characters.
        let index = |octet: &u8| u64::from(octet.checked_sub(b'0').map_or(0, |digit| digit + 1));
        self.characters(value.as_bytes().iter().map(index), constraints, 4)
    }

    /// As octets (X.691 clause 30.6); its size counts characters, and PER does not see it.
    fn encode_utf8_string(
        &mut self,
        _: Tag,
        _: &Constraints,
        value: &str,
        _: Identifier,
    ) -> EncodeResult<()> {
        self.bits.open_type(value.as_bytes())
    }

    /// X.691 clause 19.
    fn encode_sequence<'b, const RC: usize, const EC: usize, C, F>(
        &'b mut self,
        _: Tag,
        encoder_scope: F,
        _: Identifier,
    ) -> EncodeResult<()>
    where
        C: Constructed<RC, EC>,
        F: FnOnce(&mut Encoder<'b>) -> EncodeResult<()>,
    {
        let marker = self.bits.count;
        if C::IS_EXTENSIBLE {
            self.bits.bit(false);
        }
        let presence = self.bits.count;
        for _ in 0..C::FIELDS.number_of_optional_and_default_fields() {
            self.bits.bit(false);
        }
        let mut components = Encoder::new(self.bits);
        components.presence = Some(presence);
        encoder_scope(&mut components)?;
        if components.additions.iter().any(Option::is_some) {
            return components.bits.additions(marker, &components.additions);
        }
        Ok(())
    }

    fn encode_sequence_of<E: Encode>(
        &mut self,
        _: Tag,
        value: &[E],
        constraints: &Constraints,
        _: Identifier,
    ) -> EncodeResult<()> {
        self.bits.size(value.len(), constraints.size())?;
        let mut items = Encoder::new(self.bits);
        value.iter().try_for_each(|item| item.encode(&mut items))
    }

    /// X.691 clause 23.
    fn encode_choice<E: Encode + Choice>(
        &mut self,
        constraints: &Constraints,
        tag: Tag,
        encode_fn: impl FnOnce(&mut Self) -> EncodeResult<Tag>,
        _: Identifier,
    ) -> EncodeResult<()> {
        let index = |alternatives: &[TagTree]| {
            let mut alternatives = alternatives.iter();
            alternatives.position(|one| matches!(one, TagTree::Leaf(leaf) if *leaf == tag))
        };
        let root = index(E::VARIANTS);
        if constraints.extensible() {
            self.bits.bit(root.is_none());
        }
        if let Some(index) = root {
            let count = E::VARIANTS.len() as u64;
            self.bits.number(index as u64, width(count));
            return encode_fn(self).map(drop);
        }
        let Some(index) = E::EXTENDED_VARIANTS.and_then(index) else {
            return Err(EncodeError::variant_not_in_choice(Codec::Uper));
        };
        self.bits.small_number(index)?;
        let before = std::mem::take(self.bits);
        let encoded = encode_fn(self);
        let addition = std::mem::replace(self.bits, before);
        encoded?;
        self.bits.open_type(&addition.into_octets())
    }

    fn encode_explicit_prefix<V: Encode>(
        &mut self,
        tag: Tag,
        value: &V,
        _: Identifier,
    ) -> EncodeResult<()> {
        if V::IS_CHOICE {
            value.encode(self)
        } else {
            value.encode_with_tag(self, tag)
        }
    }

    fn encode_some<E: Encode>(&mut self, value: &E, _: Identifier) -> EncodeResult<()> {
        self.present(true);
        value.encode(self)
    }

    fn encode_some_with_tag_and_constraints<E: Encode>(
        &mut self,
        tag: Tag,
        constraints: &Constraints,
        value: &E,
        identifier: Identifier,
    ) -> EncodeResult<()> {
        self.present(true);
        value.encode_with_tag_and_constraints(self, tag, constraints, identifier)
    }

    fn encode_none<E: Encode>(&mut self, _: Identifier) -> EncodeResult<()> {
        self.present(false);
        Ok(())
    }

    fn encode_none_with_tag(&mut self, _: Tag, _: Identifier) -> EncodeResult<()> {
        self.present(false);
        Ok(())
    }

    /// X.691 clause 19.9.
    fn encode_extension_addition<E: Encode>(
        &mut self,
        _: Tag,
        constraints: &Constraints,
        value: E,
        _: Identifier,
    ) -> EncodeResult<()> {
        if !value.is_present() {
            self.additions.push(None);
            return Ok(());
        }
        let mut bits = Bits::default();
        let mut addition = Encoder::new(&mut bits);
        // rasn does not give the constraints that the type of the addition has itself.
        if constraints.size().is_none() && constraints.value().is_none() {
            value.encode(&mut addition)?;
        } else {
            value.encode_with_constraints(&mut addition, constraints)?;
        }
        self.additions.push(Some(bits.into_octets()));
        Ok(())
    }

    unsupported! {
        encode_any(&types::Any);
        encode_object_identifier(&[u32]);
        encode_general_string(&Constraints, &types::GeneralString);
        encode_graphic_string(&Constraints, &types::GraphicString);
        encode_visible_string(&Constraints, &types::VisibleString);
        encode_printable_string(&Constraints, &types::PrintableString);
        encode_teletex_string(&Constraints, &types::TeletexString);
        encode_bmp_string(&Constraints, &types::BmpString);
        encode_generalized_time(&types::GeneralizedTime);
        encode_utc_time(&types::UtcTime);
        encode_date(&types::Date);
    }

    fn encode_real<R: types::RealType>(
        &mut self,
        _: Tag,
        _: &Constraints,
        _: &R,
        _: Identifier,
    ) -> EncodeResult<()> {
        unsupported()
    }

    fn encode_set<'b, const RC: usize, const EC: usize, C, F>(
        &'b mut self,
        _: Tag,
        _: F,
        _: Identifier,
    ) -> EncodeResult<()>
    where
        C: Constructed<RC, EC>,
        F: FnOnce(&mut Encoder<'b>) -> EncodeResult<()>,
    {
        unsupported()
    }

    fn encode_set_of<E: Encode + Eq + std::hash::Hash>(
        &mut self,
        _: Tag,
        _: &types::SetOf<E>,
        _: &Constraints,
        _: Identifier,
    ) -> EncodeResult<()> {
        unsupported()
    }

    fn encode_extension_addition_group<const RC: usize, const EC: usize, E>(
        &mut self,
        _: Option<&E>,
        _: Identifier,
    ) -> EncodeResult<()>
    where
        E: Encode + Constructed<RC, EC>,
    {
        unsupported()
    }
}
