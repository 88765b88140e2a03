//! What was in an envelope: a packet, who vouches for it, and what it may say.

/// Who vouches for a packet: the digest of its certificate (`HashedId8`).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Signer(pub [u8; 8]);

/// What the sender of a packet may say within its service: the first bits of its service specific
/// permissions (SSP).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Permits(Option<u16>);

impl Permits {
    /// Everything: that of a packet which nobody vouches for.
    pub const EVERYTHING: Self = Self(None);

    /// What these bits allow, the first being the most significant.
    #[must_use]
    pub const fn of_bits(bits: u16) -> Self {
        Self(Some(bits))
    }

    /// Whether what a bit stands for may be said, 0 being the first and 15 the last.
    #[must_use]
    pub const fn allows(self, bit: u32) -> bool {
        match self.0 {
            None => true,
            Some(bits) => bit < 16 && bits.wrapping_shl(bit) & 0x8000 != 0,
        }
    }
}

/// What was in an envelope.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Opened<'a> {
    /// Common header, extended header, BTP and message.
    pub plain: &'a [u8],
    /// The ITS-AID under which it was sent.
    pub its_aid: u32,
    /// Who vouches for it.
    pub signer: Signer,
    /// What it may say.
    pub permits: Permits,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_counted_from_the_front() {
        let permits = Permits::of_bits(0xc001);
        let allowed: Vec<_> = (0..32).filter(|bit| permits.allows(*bit)).collect();
        assert_eq!(allowed, [0, 1, 15]);
        assert!((0..32).all(|bit| Permits::EVERYTHING.allows(bit)));
    }
}
