//! Serde views of types that rasn gives none: bit and octet strings as hexadecimal text, as in the JSON
//! encoding rules (ITU-T X.697), character strings as text, and extensible integers as numbers.

use std::fmt::Write as _;

use serde::de::Error;

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
fn from_hex<E: Error>(text: &str, length: usize) -> Result<impl Iterator<Item = bool>, E> {
    let digits: Option<Vec<u32>> = text.chars().map(|digit| digit.to_digit(16)).collect();
    let digits = digits.ok_or_else(|| E::custom("a bit string has hexadecimal digits only"))?;
    if digits.len() != length.div_ceil(8) * 2 {
        return Err(E::custom(format_args!(
            "a bit string of {length} bits is expected"
        )));
    }
    let bits = digits
        .into_iter()
        .flat_map(|digit| (0..4).rev().map(move |bit| digit >> bit & 1 == 1));
    if bits.clone().skip(length).any(|bit| bit) {
        return Err(E::custom("the padding of a bit string is zero"));
    }
    Ok(bits.take(length))
}

/// A bit string of fixed size: `"80"`.
pub(super) mod fixed_bits {
    use rasn::types::FixedBitString;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(in crate::asn1) fn serialize<S: Serializer, const N: usize>(
        bits: &FixedBitString<N>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        super::to_hex(bits.iter().by_vals().take(N)).serialize(serializer)
    }

    pub(in crate::asn1) fn deserialize<'de, D: Deserializer<'de>, const N: usize>(
        deserializer: D,
    ) -> Result<FixedBitString<N>, D::Error> {
        let text = String::deserialize(deserializer)?;
        let mut bits = FixedBitString::ZERO;
        for (index, bit) in super::from_hex(&text, N)?.enumerate() {
            bits.set(index, bit);
        }
        Ok(bits)
    }
}

/// A bit string of any size: `{"value": "80", "length": 1}`.
pub(super) mod bits {
    use rasn::types::BitString;
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

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
        let value = super::to_hex(bits.iter().by_vals());
        Sized {
            value,
            length: bits.len(),
        }
        .serialize(serializer)
    }

    pub(in crate::asn1) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<BitString, D::Error> {
        let Sized { value, length } = Sized::deserialize(deserializer)?;
        if length > LENGTH_MAX {
            return Err(D::Error::custom("the bit string is too long"));
        }
        Ok(super::from_hex(&value, length)?.collect())
    }
}

/// An octet string: `"0280"`.
pub(super) mod octets {
    use rasn::types::OctetString;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(in crate::asn1) fn serialize<S: Serializer>(
        octets: &OctetString,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let bits =
            (octets.iter()).flat_map(|octet| (0..8).rev().map(move |bit| octet >> bit & 1 == 1));
        super::to_hex(bits).serialize(serializer)
    }

    pub(in crate::asn1) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<OctetString, D::Error> {
        let text = String::deserialize(deserializer)?;
        let bits: rasn::types::BitString = super::from_hex(&text, text.len() * 4)?.collect();
        Ok(bits.into_vec().into())
    }
}

/// An integer without bounds of its own: a number, or as text what no number of 64 bits is.
pub(super) mod integer {
    use rasn::types::Integer;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

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

/// Text of some characters only.
macro_rules! text {
    ($(#[$doc:meta])* $view:ident, $type:ident, $from_octets:ident, $octets:ident) => {
        $(#[$doc])*
        pub(super) mod $view {
            use rasn::types::$type;
            use serde::de::Error as _;
            use serde::{Deserialize, Deserializer, Serialize, Serializer};

            pub(in crate::asn1) fn serialize<S: Serializer>(
                text: &$type,
                serializer: S,
            ) -> Result<S::Ok, S::Error> {
                String::from_utf8_lossy(text.$octets()).serialize(serializer)
            }

            pub(in crate::asn1) fn deserialize<'de, D: Deserializer<'de>>(
                deserializer: D,
            ) -> Result<$type, D::Error> {
                let text = String::deserialize(deserializer)?;
                $type::$from_octets(text.as_bytes()).map_err(D::Error::custom)
            }
        }
    };
}

text! {
    /// ASCII.
    ia5, Ia5String, from_iso646_bytes, as_iso646_bytes
}
text! {
    /// Digits and spaces.
    numeric, NumericString, from_bytes, as_bytes
}
