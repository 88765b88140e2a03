//! How far from right the robot's wall clock is, as its GNSS receiver or its time service says.
//!
//! Nothing of a session waits for it. While it is known, the robot shows it, and drops packets that were sent longer
//! ago than their lifetime by their own time stamps; so it is to be told only where the other stations keep time, too.

use std::fmt::{self, Display, Formatter};

use serde::{Deserialize, Serialize};

/// For how long a word on the clock holds, in ms: a clock that runs freely is off by a few milliseconds then.
pub const HOLDS_MS: u64 = 300_000;

/// The largest error that can be told, in ms: of a clock that is further off nothing can be said.
pub const ERROR_MAX_MS: u32 = 10_000;

/// How the wall clock is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ClockQuality {
    /// The largest error that it may have, in ms; `None` when nothing keeps it right.
    pub error_ms: Option<u32>,
}

impl Display for ClockQuality {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.error_ms {
            Some(error_ms) => write!(f, "clock right to {error_ms} ms"),
            None => f.write_str("clock not known to be right"),
        }
    }
}

/// What was said of the clock last.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WallClock {
    said: Option<(ClockQuality, u64)>,
}

impl WallClock {
    /// Somebody says how the clock is. What is to be logged of it.
    pub(crate) fn say(&mut self, quality: ClockQuality, now_ms: u64) -> Option<ClockQuality> {
        let before = self.said.replace((quality, now_ms));
        let is_news = before.is_none_or(|(before, _)| before != quality);
        is_news.then_some(quality)
    }

    /// Looks whether the last word on it still holds. What is to be logged when it does not.
    pub(crate) fn check(&mut self, now_ms: u64) -> Option<ClockQuality> {
        let (quality, at_ms) = self.said?;
        let holds = now_ms.saturating_sub(at_ms) < HOLDS_MS;
        if holds || quality.error_ms.is_none() {
            return None;
        }
        self.say(ClockQuality { error_ms: None }, now_ms)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_on_the_clock_is_told_once_and_does_not_hold_for_ever() {
        let mut clock = WallClock::default();
        let good = ClockQuality { error_ms: Some(5) };
        let lost = ClockQuality { error_ms: None };
        assert_eq!(clock.check(0), None);
        assert_eq!(clock.say(good, 1_000), Some(good));
        assert_eq!(clock.say(good, 2_000), None);
        assert_eq!(clock.check(2_000 + HOLDS_MS - 1), None);
        assert_eq!(clock.check(2_000 + HOLDS_MS), Some(lost));
        assert_eq!(clock.check(2_001 + HOLDS_MS), None);
        assert_eq!(clock.say(good, 2_002 + HOLDS_MS), Some(good));
        assert_eq!(clock.say(lost, 2_003 + HOLDS_MS), Some(lost));
    }
}
