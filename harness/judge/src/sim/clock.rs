//! A robot's clock in virtual time: it runs a little fast or slow, and never goes back.

/// A clock whose rate is off by this many parts per million.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Drifting {
    ppm: i64,
}

const MILLION: i64 = 1_000_000;

impl Drifting {
    pub(super) const fn new(ppm: i64) -> Self {
        Self { ppm }
    }

    /// Time of the clock at a true time, both in microseconds since the run began.
    pub(super) fn shows_us(self, true_us: u64) -> u64 {
        scale(true_us, MILLION + self.ppm, MILLION)
    }

    /// The first true time at which the clock shows so much or more.
    pub(super) fn true_us(self, shown_us: u64) -> u64 {
        let mut at = scale(shown_us, MILLION, MILLION + self.ppm);
        while self.shows_us(at) < shown_us {
            at += 1;
        }
        at
    }
}

fn scale(time: u64, by: i64, over: i64) -> u64 {
    let scaled = i128::from(time) * i128::from(by) / i128::from(over);
    u64::try_from(scaled).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fast_clock_shows_more_and_every_time_is_reached() {
        let fast = Drifting::new(1_000);
        assert_eq!(fast.shows_us(1_000_000), 1_001_000);
        for ppm in [-1_000, -1, 0, 1, 1_000] {
            let clock = Drifting::new(ppm);
            for shown in [0, 1, 999, 100_000, 123_456_789] {
                let at = clock.true_us(shown);
                assert!(clock.shows_us(at) >= shown, "{ppm} {shown}");
                assert!(at == 0 || clock.shows_us(at - 1) < shown, "{ppm} {shown}");
            }
        }
    }
}
