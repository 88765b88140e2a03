//! What the paper's wording lets happen, P1 to P12, each with the rule that closes it; and P0, which
//! holds, so that nobody takes the model for one in which anything can happen.

/// A property of the paper's wording.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[allow(missing_docs, reason = "the ids are those of the table in `text`")]
pub enum Hazard {
    P1,
    P2,
    P3,
    P4,
    P5,
    P6,
    P7,
    P8,
    P9,
    P10,
    P11,
    P12,
}

impl Hazard {
    /// All hazards, in order.
    pub const ALL: [Self; 12] = [
        Self::P1,
        Self::P2,
        Self::P3,
        Self::P4,
        Self::P5,
        Self::P6,
        Self::P7,
        Self::P8,
        Self::P9,
        Self::P10,
        Self::P11,
        Self::P12,
    ];

    /// Whether it is that somebody waits for ever, and nothing happens any more.
    pub(super) const fn is_without_end(self) -> bool {
        matches!(self, Self::P5 | Self::P8 | Self::P9 | Self::P10 | Self::P12)
    }

    /// One bit for each.
    pub(super) const fn bit(self) -> u16 {
        1 << self as u16
    }
}
