//! What the paper's text lets happen, P1 to P9 and P11 to P14, each with where it comes from and the rule that
//! closes it; P10, which the text closes itself; and P0, which holds, so that the model is not taken for one
//! in which anything can happen.

use serde::Serialize;

/// A property that the paper's text does not keep.
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
    P11,
    P12,
    P13,
    P14,
}

/// What the text says about a hazard.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
pub enum HazardKind {
    /// The text states the rule from which it follows.
    Stated,
    /// The text has no rule for the case.
    Silent,
    /// The text can be read in more than one way.
    Ambiguous,
}

/// Where in the paper a hazard comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Passage {
    /// The section: `III-A`.
    pub section: &'static str,
    /// The paragraph in it.
    pub paragraph: &'static str,
    /// A few words of it, to find it by.
    #[serde(skip)]
    pub words: &'static str,
}

impl HazardKind {
    /// In one word, as pages have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stated => "Stated",
            Self::Silent => "Silent",
            Self::Ambiguous => "Ambiguous",
        }
    }
}

impl Hazard {
    /// All hazards, in order.
    pub const ALL: [Self; 13] = [
        Self::P1,
        Self::P2,
        Self::P3,
        Self::P4,
        Self::P5,
        Self::P6,
        Self::P7,
        Self::P8,
        Self::P9,
        Self::P11,
        Self::P12,
        Self::P13,
        Self::P14,
    ];

    /// Whether it is that somebody waits for ever, and nothing happens any more.
    pub(super) const fn is_without_end(self) -> bool {
        matches!(self, Self::P5 | Self::P8 | Self::P9 | Self::P12 | Self::P13)
    }

    /// One bit for each.
    pub(super) const fn bit(self) -> u16 {
        1 << self as u16
    }
}
