//! Time as a value: durations in milliseconds and countdowns that live in the state.
//!
//! Nothing in this crate reads a clock. Elapsed time enters as an input, the time that is left is
//! part of the state, so a run replays exactly and a timed model of it is finite.

/// A duration in milliseconds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Millis(pub u32);

impl Millis {
    /// No time at all.
    pub const ZERO: Self = Self(0);
    /// The longest duration that a timer of the protocol may have: one day.
    pub const MAX_TIMER: Self = Self(86_400_000);

    /// The sum, or the largest value where it does not fit.
    #[must_use]
    pub const fn saturating_add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }

    /// The difference, or zero where `other` is larger.
    #[must_use]
    pub const fn saturating_sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }
}

/// A countdown: off, or armed with the time that is left, in milliseconds.
///
/// A countdown at zero is *due*: its timer fires once, in the step that brought it there.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "Option<u32>", from = "Option<u32>"))]
pub struct Countdown(u32);

impl Countdown {
    /// Not armed.
    pub const OFF: Self = Self(u32::MAX);

    /// Armed with `left` milliseconds. No timer has [`u32::MAX`]: that number stands for *off*.
    #[must_use]
    pub const fn armed(left: Millis) -> Self {
        Self(left.0)
    }

    /// The time that is left, `None` when off.
    #[must_use]
    pub const fn left(self) -> Option<Millis> {
        if self.is_armed() {
            Some(Millis(self.0))
        } else {
            None
        }
    }

    /// True if the countdown is armed.
    #[must_use]
    pub const fn is_armed(self) -> bool {
        self.0 != Self::OFF.0
    }

    /// True if the countdown has reached zero.
    #[must_use]
    pub const fn is_due(self) -> bool {
        self.0 == 0
    }

    /// Lets `elapsed` pass, never below zero.
    pub(crate) const fn elapse(&mut self, elapsed: Millis) {
        if self.is_armed() {
            self.0 = self.0.saturating_sub(elapsed.0);
        }
    }

    /// True if the time left is at most `limit`; an unarmed countdown is within every limit.
    pub(crate) const fn is_within(self, limit: Millis) -> bool {
        !self.is_armed() || self.0 <= limit.0
    }
}

impl From<Countdown> for Option<u32> {
    fn from(countdown: Countdown) -> Self {
        countdown.left().map(|left| left.0)
    }
}

impl From<Option<u32>> for Countdown {
    fn from(left: Option<u32>) -> Self {
        left.map_or(Self::OFF, |left| Self::armed(Millis(left)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_countdown_stops_at_zero_and_an_unarmed_one_stays_off() {
        let mut armed = Countdown::armed(Millis(5));
        armed.elapse(Millis(3));
        assert_eq!(armed.left(), Some(Millis(2)));
        armed.elapse(Millis(3));
        assert!(armed.is_due());
        let mut off = Countdown::OFF;
        off.elapse(Millis(u32::MAX));
        assert_eq!(off, Countdown::OFF);
    }
}
