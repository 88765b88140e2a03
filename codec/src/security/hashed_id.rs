//! What certificates are called by (IEEE 1609.2, clause 6.3.25 and 6.3.26).

use std::fmt;

/// The last 8 octets of a certificate's SHA-256, by which it is called.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HashedId8(pub [u8; 8]);

/// The last 3 octets of a certificate's SHA-256, by which it is asked for.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct HashedId3(pub [u8; 3]);

impl HashedId8 {
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

impl fmt::Debug for HashedId8 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "HashedId8({self})")
    }
}
