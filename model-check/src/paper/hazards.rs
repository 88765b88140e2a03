//! Hazards that the paper's text allows, each with its source and the rule that closes it: P1 to P9 and P11 to P14, and
//! on the road W1 to W4 and W7.

use serde::{Deserialize, Serialize};

macro_rules! hazards {
    ($($id:ident)*) => {
        /// A property that the paper's text does not keep.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[allow(missing_docs, reason = "the ids are those of the table in `hazards.toml`")]
        pub enum Hazard {
            $($id,)*
        }

        impl Hazard {
            /// All hazards, in order.
            pub const ALL: [Self; [$(stringify!($id)),*].len()] = [$(Self::$id),*];
        }
    };
}

hazards! { P1 P2 P3 P4 P5 P6 P7 P8 P9 P11 P12 P13 P14 W1 W2 W3 W4 W7 }

/// Relation of the text to a hazard.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Deserialize, Serialize)]
pub enum HazardKind {
    /// The text states the rule from which it follows.
    Stated,
    /// The text has no rule for the case.
    Silent,
    /// The text can be read in more than one way.
    Ambiguous,
}

/// Where in the paper a hazard comes from.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize, Serialize)]
pub struct Passage {
    /// The section: `III-A`.
    pub section: String,
    /// The paragraph in it.
    pub paragraph: String,
    /// A few words of it, to find it by.
    #[serde(skip_serializing)]
    pub words: String,
}

impl Hazard {
    /// Whether it is that somebody waits for ever, and nothing happens any more.
    pub(super) const fn is_without_end(self) -> bool {
        use Hazard::{P5, P8, P9, P12, P13, W7};
        matches!(self, P5 | P8 | P9 | P12 | P13 | W7)
    }

    /// Whether it is about the road, and a property that the kit's own scenarios keep.
    pub(super) const fn is_on_road(self) -> bool {
        matches!(self, Self::W1 | Self::W2 | Self::W3 | Self::W4 | Self::W7)
    }

    pub(super) const fn bit(self) -> u32 {
        1 << self as u32
    }
}
