//! The clock of a run, and the wall clock.

use std::time::{Instant, SystemTime};

use crossguard_codec::si::timestamp_its;
use crossguard_endpoint::Moment;

use crate::attachment::unix_us;

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
    Moment {
        now_ms: now_us / 1_000,
        timestamp_its: timestamp_now(),
    }
}

/// `TimestampIts` by the system's clock.
pub(crate) fn timestamp_now() -> u64 {
    let unix_ms = unix_us(SystemTime::now()) / 1_000;
    timestamp_its(i64::try_from(unix_ms).unwrap_or(i64::MAX))
}
