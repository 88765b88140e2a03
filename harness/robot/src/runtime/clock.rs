//! The clock of a run, and the wall clock.

use std::time::{Instant, SystemTime, UNIX_EPOCH};

use crossguard_codec::si::timestamp_its;
use crossguard_endpoint::Moment;

/// A clock that several robots share, so that their logs line up.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    start: Instant,
}

impl Clock {
    /// A clock that starts now.
    #[must_use]
    pub fn start() -> Self {
        Self {
            start: Instant::now(),
        }
    }

    /// Microseconds since the start.
    #[must_use]
    pub fn now_us(&self) -> u64 {
        u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX)
    }

    /// This moment.
    #[must_use]
    pub fn moment(&self) -> Moment {
        moment_at(self.now_us())
    }

    /// Its time at an instant, in ms; 0 before the start.
    pub(super) fn at_ms(&self, instant: Instant) -> u64 {
        let since = instant.saturating_duration_since(self.start);
        u64::try_from(since.as_millis()).unwrap_or(u64::MAX)
    }

    /// The same; below 0 before the start.
    pub(super) fn signed_ms(&self, instant: Instant) -> i64 {
        let before = self.start.saturating_duration_since(instant).as_millis();
        let after = self.at_ms(instant);
        i64::try_from(after).unwrap_or(i64::MAX) - i64::try_from(before).unwrap_or(i64::MAX)
    }
}

/// Seconds on the clock of the body.
#[expect(clippy::cast_precision_loss, reason = "centuries of microseconds fit")]
pub(super) fn seconds(us: u64) -> f64 {
    us as f64 / 1e6
}

/// This moment, which the clock shows as `now_us`.
pub(super) fn moment_at(now_us: u64) -> Moment {
    let unix_ms = i64::try_from(unix_us() / 1_000).unwrap_or(i64::MAX);
    Moment {
        now_ms: now_us / 1_000,
        timestamp_its: timestamp_its(unix_ms),
    }
}

pub(super) fn unix_us() -> u64 {
    let now = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    u64::try_from(now.as_micros()).unwrap_or(u64::MAX)
}
