//! Trust in the own clock: a message that is verified by a clock that went back may have been heard before.
//!
//! The newest time that a station has known is its *mark*, which never goes back. A clock that shows less has been put
//! back, or the mark is of a time before a restart that the clock has not reached. Until the clock reaches the mark, the
//! time is not trusted, and nothing signed is accepted. A small step, as between two clocks that differ, only makes the
//! time stand still at the mark.
//!
//! A clock that leaps ahead of one that never does is not trusted either, until it is back, or has gone on from there for
//! a minute: the mark of a clock that was put wrong for a moment would not be reached for long.
//!
//! Messages from before the start are refused: they may have been accepted before a restart, of which nothing is
//! remembered but the mark.

use super::doubt::Doubt;
use super::rejected::Rejected;
use super::time::Time64;

/// How far a clock may leap ahead and be trusted, in µs.
const LEAP_US: u64 = 2_000_000;
/// For how long a clock that has leapt ahead has to go on from there, in ms.
const PROBATION_MS: u64 = 60_000;

/// The time, as far as a station can trust its clock.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct TrustedTime {
    /// The newest time that is known to have been.
    mark: Time64,
    /// A message that was generated before may have been heard before the start.
    start: Time64,
    /// By how much the clock may be behind the mark.
    tolerance_us: u64,
    doubt: Option<Doubt>,
    /// The last time of the clock, and of the clock that never leaps, in ms.
    seen: Option<(Time64, u64)>,
    leap: Option<Leap>,
}

/// A leap ahead.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Leap {
    /// The times of both clocks before it.
    before: (Time64, u64),
    /// When the last leap was, on the clock that has none.
    since_ms: u64,
}

/// The time of a clock that goes on from there.
const fn expected((shown, at_ms): (Time64, u64), now_ms: u64) -> u64 {
    let passed_ms = now_ms.saturating_sub(at_ms);
    shown.0.saturating_add(passed_ms.saturating_mul(1_000))
}

impl TrustedTime {
    /// A station that starts at `now`, and remembers nothing from before. Its clock may go back by `tolerance_us`.
    #[must_use]
    pub const fn starting(now: Time64, tolerance_us: u64) -> Self {
        Self {
            mark: now,
            start: now,
            tolerance_us,
            doubt: None,
            seen: None,
            leap: None,
        }
    }

    /// The same with the mark from before a restart. What was accepted before it was generated within the tolerance
    /// of that mark.
    #[must_use]
    pub fn since(mut self, known: Time64) -> Self {
        let now = self.mark;
        self.mark = now.max(known);
        if known > Time64::default() {
            let accepted = Time64(known.0.saturating_add(self.tolerance_us));
            self.start = self.start.max(accepted);
        }
        self.doubt = self.behind(now);
        self
    }

    /// The newest time that is known to have been.
    #[must_use]
    pub const fn mark(&self) -> Time64 {
        self.mark
    }

    /// Why the clock was not trusted when it was looked at last; `None` if it was.
    #[must_use]
    pub const fn doubt(&self) -> Option<Doubt> {
        self.doubt
    }

    fn behind(&self, now: Time64) -> Option<Doubt> {
        let behind_us = self.mark.0.saturating_sub(now.0);
        (behind_us > self.tolerance_us).then_some(Doubt::Behind(behind_us))
    }

    /// Looks at a clock that shows `now`, when a clock that never leaps shows `steady_ms`.
    pub fn look(&mut self, now: Time64, steady_ms: u64) {
        let leapt = |from| now.0.saturating_sub(expected(from, steady_ms));
        if let Some(seen) = self.seen.filter(|seen| leapt(*seen) > LEAP_US) {
            // A clock that was behind has been set.
            let is_set = matches!(self.doubt, Some(Doubt::Behind(_)));
            let before = self.leap.map_or(seen, |leap| leap.before);
            self.leap = (!is_set).then_some(Leap {
                before,
                since_ms: steady_ms,
            });
        }
        self.seen = Some((now, steady_ms));
        if let Some(leap) = self.leap {
            let ahead_us = leapt(leap.before);
            let is_long = steady_ms.saturating_sub(leap.since_ms) >= PROBATION_MS;
            if ahead_us > LEAP_US && !is_long {
                self.doubt = Some(Doubt::Ahead(ahead_us));
                return;
            }
            self.leap = None;
        }
        self.doubt = self.behind(now);
        self.mark = self.mark.max(now);
    }

    /// The time to judge messages by, of a clock that shows `now`. It never goes back.
    ///
    /// # Errors
    /// When the clock cannot be trusted.
    pub fn read(&mut self, now: Time64) -> Result<Time64, Rejected> {
        if self.leap.is_none() {
            self.doubt = self.behind(now);
        }
        if let Some(doubt) = self.doubt {
            return Err(Rejected::TimeNotTrusted(doubt));
        }
        self.mark = self.mark.max(now);
        Ok(self.mark)
    }

    /// Checks that a message that was generated at this time cannot have been accepted before the start.
    ///
    /// # Errors
    /// When it can.
    pub fn check(&self, generated: Time64) -> Result<(), Rejected> {
        if generated < self.start {
            return Err(Rejected::BeforeStart);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND_US: u64 = 1_000_000;
    const TOLERANCE_US: u64 = 220_000;

    fn at(us: u64) -> Time64 {
        Time64(1_000 * SECOND_US + us)
    }

    fn starting() -> TrustedTime {
        TrustedTime::starting(at(0), TOLERANCE_US)
    }

    #[test]
    fn a_clock_that_was_put_back_is_trusted_again_when_it_reaches_the_mark() {
        let mut time = starting();
        assert_eq!(time.read(at(10 * SECOND_US)), Ok(at(10 * SECOND_US)));
        let put_back = time.read(at(6 * SECOND_US));
        let doubt = Doubt::Behind(4 * SECOND_US);
        assert_eq!(put_back, Err(Rejected::TimeNotTrusted(doubt)));
        assert_eq!(time.doubt(), Some(doubt));
        let still = time.read(at(10 * SECOND_US - TOLERANCE_US - 1));
        assert!(still.is_err());
        // Within the tolerance, the time stands still.
        let near = time.read(at(10 * SECOND_US - TOLERANCE_US));
        assert_eq!(near, Ok(at(10 * SECOND_US)));
        assert_eq!(time.read(at(11 * SECOND_US)), Ok(at(11 * SECOND_US)));
        assert_eq!(time.mark(), at(11 * SECOND_US));
    }

    #[test]
    fn nothing_from_before_the_start_is_taken() {
        let time = starting();
        let before = Time64(at(0).0 - 1);
        assert_eq!(time.check(before), Err(Rejected::BeforeStart));
        assert_eq!(time.check(at(0)), Ok(()));
        // Before the restart, a message was taken that was as far ahead as it may be.
        let time = starting().since(at(0));
        assert_eq!(time.check(at(TOLERANCE_US - 1)), Err(Rejected::BeforeStart));
        assert_eq!(time.check(at(TOLERANCE_US)), Ok(()));
    }

    #[test]
    fn a_clock_that_starts_before_the_mark_is_not_trusted() {
        let mut time = starting().since(at(5 * SECOND_US));
        assert_eq!(time.doubt(), Some(Doubt::Behind(5 * SECOND_US)));
        assert!(time.read(at(SECOND_US)).is_err());
        assert!(time.read(at(5 * SECOND_US)).is_ok());
        assert_eq!(time.check(at(5 * SECOND_US)), Err(Rejected::BeforeStart));
    }

    #[test]
    fn a_clock_that_leaps_ahead_is_trusted_when_it_is_back_or_has_gone_on_for_a_minute() {
        let mut time = starting();
        let hour_us = 3_600 * SECOND_US;
        let mut look = |shown_us, steady_ms| {
            time.look(at(shown_us), steady_ms);
            let shown = time.read(at(shown_us));
            assert_eq!(shown.is_ok(), time.doubt().is_none());
            (time.doubt(), time.mark())
        };
        assert_eq!(look(0, 500), (None, at(0)));
        // So much is what clocks that are corrected do.
        assert_eq!(look(3 * SECOND_US, 1_500), (None, at(3 * SECOND_US)));
        let leapt = look(3 * SECOND_US + hour_us, 1_500);
        assert_eq!(leapt, (Some(Doubt::Ahead(hour_us)), at(3 * SECOND_US)));
        let back = look(5 * SECOND_US, 3_500);
        assert_eq!(back, (None, at(5 * SECOND_US)));
        let again = look(5 * SECOND_US + hour_us, 3_500);
        assert!(again.0.is_some());
        let soon = look(64 * SECOND_US + hour_us, 62_500);
        assert_eq!(soon, (Some(Doubt::Ahead(hour_us)), at(5 * SECOND_US)));
        let later = look(65 * SECOND_US + hour_us, 63_500);
        assert_eq!(later, (None, at(65 * SECOND_US + hour_us)));
    }

    #[test]
    fn a_clock_that_was_behind_may_be_set() {
        let mut time = starting().since(at(100 * SECOND_US));
        time.look(at(0), 0);
        assert!(time.doubt().is_some());
        time.look(at(500 * SECOND_US), 1);
        assert_eq!(time.doubt(), None);
        assert_eq!(time.mark(), at(500 * SECOND_US));
    }
}
