//! An opened packet: its signer, and its permissions.

use crossguard_protocol::StationId;

use super::Headers;
use crate::service::Service;

/// Signer of a packet: the digest of its certificate (`HashedId8`), or of its mirror, so that both are one.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Signer(pub [u8; 8]);

/// Permissions of the sender of a packet within its service: the first bits of its service specific
/// permissions (SSP).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Permits {
    bits: Option<u16>,
    /// The station id that they are given to.
    station: Option<StationId>,
}

impl Signer {
    /// The station id that goes with a ticket which names none: as random as its name, and gone with it.
    #[must_use]
    pub const fn station(self) -> StationId {
        let [a, b, c, d, ..] = self.0;
        StationId(u32::from_be_bytes([a, b, c, d]))
    }
}

impl Permits {
    /// Everything: that of a packet which nobody vouches for.
    pub const EVERYTHING: Self = Self {
        bits: None,
        station: None,
    };

    /// The permissions of these bits, the first being the most significant, for the station with this id alone if there is one.
    #[cfg(any(test, feature = "security"))]
    pub(super) const fn new(bits: u16, station: Option<StationId>) -> Self {
        Self {
            bits: Some(bits),
            station,
        }
    }

    /// The station id that a sender with this ticket goes by.
    #[must_use]
    pub fn station(self, signer: Signer) -> StationId {
        self.station.unwrap_or_else(|| signer.station())
    }

    /// True if the permission of a bit is given, 0 being the first and 15 the last.
    #[must_use]
    pub const fn allows(self, bit: u32) -> bool {
        match self.bits {
            None => true,
            Some(bits) => bit < 16 && bits.wrapping_shl(bit) & 0x8000 != 0,
        }
    }
}

/// The vouched-for parts of a packet.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Opened {
    /// Its signer.
    pub signer: Signer,
    /// Its permissions.
    pub permits: Permits,
}

/// A packet for this station, taken apart. Nothing is said of whether it can be relied on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Admitted<'a> {
    /// Its headers.
    pub headers: Headers,
    /// Which service it is for.
    pub service: Service,
    /// The message in it.
    pub message: &'a [u8],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_counted_from_the_front() {
        let permits = Permits::new(0xc001, None);
        let allowed: Vec<_> = (0..32).filter(|bit| permits.allows(*bit)).collect();
        assert_eq!(allowed, [0, 1, 15]);
        assert!((0..32).all(|bit| Permits::EVERYTHING.allows(bit)));
    }
}
