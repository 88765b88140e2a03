//! Names of certificates: digests (IEEE 1609.2, clause 6.3.25 and 6.3.26).

use std::fmt;
use std::str::FromStr;

/// The last 8 octets of a certificate's SHA-256, by which it is called.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HashedId8(pub [u8; 8]);

/// The last 3 octets of a certificate's SHA-256, by which it is asked for.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct HashedId3(pub [u8; 3]);

impl HashedId8 {
    /// The end of a certificate's digest.
    #[allow(
        clippy::many_single_char_names,
        reason = "eight octets, in their order"
    )]
    pub(super) const fn of(digest: &[u8; 32]) -> Self {
        let [.., a, b, c, d, e, f, g, h] = *digest;
        Self([a, b, c, d, e, f, g, h])
    }

    /// The short form.
    #[must_use]
    pub const fn short(self) -> HashedId3 {
        let [.., a, b, c] = self.0;
        HashedId3([a, b, c])
    }
}

impl fmt::Display for HashedId8 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|octet| write!(f, "{octet:02x}"))
    }
}

/// A text that is no name of a certificate.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("16 hexadecimal digits are wanted, as 'crossguard pki show' tells them")]
pub struct NoHashedId8;

impl FromStr for HashedId8 {
    type Err = NoHashedId8;

    fn from_str(text: &str) -> Result<Self, NoHashedId8> {
        let is_digits = text.len() == 16 && text.bytes().all(|it| it.is_ascii_hexdigit());
        let number = is_digits.then(|| u64::from_str_radix(text, 16));
        match number {
            Some(Ok(number)) => Ok(Self(number.to_be_bytes())),
            _ => Err(NoHashedId8),
        }
    }
}

impl fmt::Debug for HashedId8 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "HashedId8({self})")
    }
}
