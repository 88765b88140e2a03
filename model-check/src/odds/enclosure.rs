//! A number that is known to lie between two others.

use std::fmt;

use serde::Serialize;

/// A number that is known to lie between two others, as far as floating point goes.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Enclosure {
    /// It is no less than this.
    pub lower: f64,
    /// It is no more than this.
    pub upper: f64,
}

impl Enclosure {
    /// By how much the bounds differ.
    #[must_use]
    pub fn width(self) -> f64 {
        self.upper - self.lower
    }

    /// The middle between the bounds.
    #[must_use]
    pub fn middle(self) -> f64 {
        f64::midpoint(self.lower, self.upper)
    }

    /// The probability of something not happening that happens with this one.
    #[must_use]
    pub fn complement(self) -> Self {
        Self {
            lower: 1.0 - self.upper,
            upper: 1.0 - self.lower,
        }
    }

    /// The probability that all of so many independent things happen, of which each happens with this one.
    #[must_use]
    pub(super) fn all_of(self, things: u8) -> Self {
        let power = |base: f64| base.powi(things.into());
        Self {
            lower: power(self.lower),
            upper: power(self.upper),
        }
    }

    /// The bounds of a probability, which is one: between 0 and 1.
    pub(super) fn probability(lower: f64, upper: f64) -> Self {
        let lower = lower.clamp(0.0, 1.0);
        Self {
            lower,
            upper: upper.clamp(lower, 1.0),
        }
    }
}

impl fmt::Display for Enclosure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.lower, self.upper)
    }
}
