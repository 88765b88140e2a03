//! Serde views of types that rasn gives none: bit and octet strings as hexadecimal text, as in the JSON
//! encoding rules (ITU-T X.697), and extensible integers as numbers.

use std::fmt::Write as _;

use rasn::types::{BitString, FixedBitString, Integer, OctetString};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The octets of `bits`, first bit first, padded with zero bits.
fn to_hex(bits: impl Iterator<Item = bool>) -> String {
    let mut text = String::new();
    let (mut octet, mut count) = (0_u8, 0);
    for bit in bits {
        octet = octet << 1 | u8::from(bit);
        count += 1;
        if count == 8 {
            let _ = write!(text, "{octet:02x}");
            (octet, count) = (0, 0);
        }
    }
    if count > 0 {
        let _ = write!(text, "{:02x}", octet << (8 - count));
    }
    text
}

/// The `length` bits that `text` stands for.
fn from_hex(text: &str, length: usize) -> Result<BitString, String> {
    let digits: Option<Vec<u32>> = text.chars().map(|digit| digit.to_digit(16)).collect();
    let digits = digits.ok_or("a bit string has hexadecimal digits only")?;
    if digits.len() != length.div_ceil(8) * 2 {
        return Err(format!("a bit string of {length} bits is expected"));
    }
    let bits = digits.into_iter();
    let bits = bits.flat_map(|digit| (0..4).rev().map(move |bit| digit >> bit & 1 == 1));
    if bits.clone().skip(length).any(|bit| bit) {
        return Err("the padding of a bit string is zero".to_owned());
    }
    Ok(bits.take(length).collect())
}

/// A view as text.
macro_rules! text {
    ($(#[$doc:meta])* $view:ident, $type:ident $(<$size:ident>)?, $to_text:expr, $from_text:expr) => {
        $(#[$doc])*
        pub(super) mod $view {
            use super::*;

            pub(in crate::asn1) fn serialize<S: Serializer $(, const $size: usize)?>(
                value: &$type $(<$size>)?,
                serializer: S,
            ) -> Result<S::Ok, S::Error> {
                let to_text: fn(&$type $(<$size>)?) -> String = $to_text;
                to_text(value).serialize(serializer)
            }

            pub(in crate::asn1) fn deserialize<'de, D: Deserializer<'de> $(, const $size: usize)?>(
                deserializer: D,
            ) -> Result<$type $(<$size>)?, D::Error> {
                let from_text: fn(&str) -> Result<$type $(<$size>)?, _> = $from_text;
                let text = String::deserialize(deserializer)?;
                from_text(&text).map_err(D::Error::custom)
            }
        }
    };
}

text! {
    /// A bit string of fixed size: `"80"`.
    fixed_bits, FixedBitString<N>,
    |bits| to_hex(bits.iter().by_vals().take(N)),
    |text| {
        let mut bits = FixedBitString::ZERO;
        let read = from_hex(text, N)?;
        bits[..N].copy_from_bitslice(&read);
        Ok::<_, String>(bits)
    }
}
text! {
    /// An octet string: `"0280"`.
    octets, OctetString,
    |octets| to_hex(BitString::from_slice(octets).iter().by_vals()),
    |text| from_hex(text, text.len() * 4).map(|bits| bits.into_vec().into())
}
/// A bit string of any size: `{"value": "80", "length": 1}`.
pub(super) mod bits {
    use super::{BitString, Deserialize, Deserializer, Serialize, Serializer, from_hex, to_hex};
    use serde::de::Error as _;

    /// No message has a longer one.
    const LENGTH_MAX: usize = 8 * crate::size::MESSAGE_LEN_MAX;

    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Sized {
        value: String,
        length: usize,
    }

    pub(in crate::asn1) fn serialize<S: Serializer>(
        bits: &BitString,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let (value, length) = (to_hex(bits.iter().by_vals()), bits.len());
        Sized { value, length }.serialize(serializer)
    }

    pub(in crate::asn1) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<BitString, D::Error> {
        let Sized { value, length } = Sized::deserialize(deserializer)?;
        if length > LENGTH_MAX {
            return Err(D::Error::custom("the bit string is too long"));
        }
        from_hex(&value, length).map_err(D::Error::custom)
    }
}

/// An integer without bounds of its own: a number, or as text what no number of 64 bits is.
pub(super) mod integer {
    use super::{Deserialize, Deserializer, Integer, Serialize, Serializer};

    pub(in crate::asn1) fn serialize<S: Serializer>(
        integer: &Integer,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match i64::try_from(integer) {
            Ok(number) => number.serialize(serializer),
            Err(_) => integer.to_string().serialize(serializer),
        }
    }

    pub(in crate::asn1) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Integer, D::Error> {
        i64::deserialize(deserializer).map(Integer::from)
    }
}
