//! JSON of the core's values, with the names of ASN.1: numbers, and bit strings as hexadecimal text
//! like in the JSON encoding rules (ITU-T X.697). What is read is a value, or an error.

use core::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serializer};

/// Reads a number from `min` to `max`.
pub(super) fn number<'de, D: Deserializer<'de>>(
    deserializer: D,
    min: i64,
    max: i64,
) -> Result<i64, D::Error> {
    let number = i64::deserialize(deserializer)?;
    if (min..=max).contains(&number) {
        Ok(number)
    } else {
        let message = format_args!("{number} is not a number from {min} to {max}");
        Err(D::Error::custom(message))
    }
}

/// Writes a bit string of `size` bits. `bits` has its first bit as the highest one.
pub(super) fn write_bits<S: Serializer>(
    bits: u32,
    size: u32,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&Hexadecimal { bits, size })
}

/// Reads what [`write_bits`] writes.
pub(super) fn read_bits<'de, D: Deserializer<'de>>(
    deserializer: D,
    size: u32,
) -> Result<u32, D::Error> {
    deserializer.deserialize_str(Digits { size })
}

/// Octets as digits, two for each.
struct Hexadecimal {
    bits: u32,
    size: u32,
}

impl fmt::Display for Hexadecimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let octets = self.bits.to_be_bytes();
        let mut octets = octets.iter().take(self.size.div_ceil(8) as usize);
        octets.try_for_each(|octet| write!(f, "{octet:02x}"))
    }
}

/// Expects a bit string of `size` bits.
struct Digits {
    size: u32,
}

impl Visitor<'_> for Digits {
    type Value = u32;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a bit string of {} bits as hexadecimal text", self.size)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<u32, E> {
        let digits = self.size.div_ceil(8) * 2;
        if text.len() != digits as usize {
            return Err(E::custom(format_args!(
                "a bit string of {} bits is expected",
                self.size
            )));
        }
        let mut bits = 0;
        for digit in text.chars() {
            let digit = digit.to_digit(16);
            let digit =
                digit.ok_or_else(|| E::custom("a bit string has hexadecimal digits only"))?;
            bits = bits << 4 | digit;
        }
        bits <<= u32::BITS - digits * 4;
        if bits << (self.size - 1) << 1 != 0 {
            return Err(E::custom("the padding of a bit string is zero"));
        }
        Ok(bits)
    }
}
