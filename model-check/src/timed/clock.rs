//! Ticks, and what drifting clocks show of them.

use crossguard_protocol::{Millis, Settings};

/// Time in the model: it passes in ticks, and each robot's clock shows more or less of each.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Clock {
    /// True time of one tick.
    pub tick: Millis,
    /// Time that a clock as slow as it may be shows of a tick.
    pub slow: Millis,
    /// Time that a clock as fast as it may be shows of a tick.
    pub fast: Millis,
}

impl Clock {
    /// The clock of a model with ticks of `tick`, whose robots' clocks run within `drift_ppm`;
    /// `None` when that drift is less than a millisecond of a tick, but not zero.
    #[must_use]
    pub fn new(tick: Millis, drift_ppm: u32) -> Option<Self> {
        let drift = u64::from(tick.0) * u64::from(drift_ppm) / 1_000_000;
        let drift = u32::try_from(drift).ok()?;
        if drift == 0 && drift_ppm > 0 {
            return None;
        }
        let (slow, fast) = (Millis(tick.0 - drift), Millis(tick.0 + drift));
        Some(Self { tick, slow, fast })
    }

    /// Whether clocks drift at all.
    #[must_use]
    pub fn drifts(&self) -> bool {
        self.slow != self.fast
    }

    /// Time that the clock of the robot at `place` shows of a tick in which the clocks of the robots in
    /// `fast`, one bit each, are fast.
    pub(super) const fn elapsed(&self, fast: u8, place: u8) -> Millis {
        if fast & 1 << place == 0 {
            self.slow
        } else {
            self.fast
        }
    }

    /// True time of this number of ticks.
    #[must_use]
    pub const fn millis(&self, ticks: u8) -> Millis {
        Millis(self.tick.0 * ticks as u32)
    }
}

/// The longest true time in which a timer of `timer` runs out and its robot takes that in: the robot may look at
/// its clock late by `delay_max`, and the clock may be slow by the drift.
///
/// Both times are on the robot's own clock, here as in
/// [`Inequality::LeaseWithinSafety`](crossguard_protocol::Inequality::LeaseWithinSafety): an endpoint has no other
/// clock to keep `delay_max` by, and on a slow one that is longer in true time.
#[must_use]
pub fn longest(timer: Millis, settings: &Settings) -> Millis {
    let million = 1_000_000;
    let shown = u64::from(timer.saturating_add(settings.delay_max).0);
    let on_slow_clock = (shown * million).div_ceil(million - u64::from(settings.drift_ppm));
    Millis(u32::try_from(on_slow_clock).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drifting_clock_shows_more_or_less_of_a_tick_by_whole_milliseconds_within_the_drift() {
        let clock = Clock::new(Millis(55), 90_910).unwrap();
        assert_eq!((clock.slow, clock.fast), (Millis(50), Millis(60)));
        let perfect = Clock::new(Millis(50), 0).unwrap();
        assert!(!perfect.drifts());
        assert_eq!(Clock::new(Millis(50), 19_999), None);
        assert!(Clock::new(Millis(50), 20_000).unwrap().drifts());
    }

    #[test]
    fn a_timer_lasts_longest_on_a_slow_clock_that_is_told_late() {
        let settings = Settings {
            drift_ppm: 20_000,
            delay_max: Millis(50),
            ..Settings::default()
        };
        // 930 ms and 50 ms late, by a clock that shows 98 ms of 100.
        assert_eq!(longest(Millis(930), &settings), Millis(1_000));
        assert_eq!(longest(Millis(931), &settings), Millis(1_002));
    }
}
