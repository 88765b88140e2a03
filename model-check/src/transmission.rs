//! One message on its way from one robot to another.

/// One message on its way to one receiver.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Transmission {
    /// The sender's place in the scenario.
    pub from: u8,
    /// The receiver's.
    pub to: u8,
    /// Number of the interned message.
    pub message: u16,
}

/// A transmission in four bytes with a tag that is not 0, or none. States are compared and hashed by the million.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) struct PackedTransmission(u32);

impl PackedTransmission {
    pub(crate) const EMPTY: Self = Self(0);

    pub(crate) const fn is_empty(self) -> bool {
        self.0 == 0
    }

    pub(crate) const fn of(transmission: Transmission) -> Self {
        Self::tagged(transmission, 1)
    }

    pub(crate) const fn tagged(Transmission { from, to, message }: Transmission, tag: u8) -> Self {
        let [high, low] = message.to_be_bytes();
        Self(u32::from_be_bytes([tag, from << 4 | to, high, low]))
    }

    pub(crate) const fn tag(self) -> u8 {
        self.0.to_be_bytes()[0]
    }

    pub(crate) const fn broadcast(self) -> u32 {
        self.0 & !(0xf << 16)
    }

    pub(crate) const fn transmission(self) -> Option<Transmission> {
        if self.is_empty() {
            return None;
        }
        let [_, from_to, high, low] = self.0.to_be_bytes();
        let message = u16::from_be_bytes([high, low]);
        Some(Transmission {
            from: from_to >> 4,
            to: from_to & 0xf,
            message,
        })
    }
}
