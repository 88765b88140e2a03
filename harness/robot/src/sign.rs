//! The sign of a leader: what people at the road see.
//!
//! It shows *stop*, or *go* until a time that the last act named. A display compares that time with the clock, so
//! *go* ends although the robot's thread hangs and tells nothing. A sign is shared: the
//! application sets it, people and displays look at it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crossguard_codec::{PublicSignal, SignalMeans, SignalsShown};
use crossguard_protocol::Millis;

/// A sign. Times are microseconds on the clock of its robot.
#[derive(Clone, Debug, Default)]
pub struct Sign {
    /// When *go* ends; 0 for *stop*.
    ends_us: Arc<AtomicU64>,
}

impl Sign {
    /// Shows *go* from `now_us` on, for this long; an earlier end is replaced.
    pub fn go(&self, now_us: u64, time: Millis) {
        let ends_us = now_us.saturating_add(u64::from(time.0) * 1_000);
        self.ends_us.store(ends_us, Ordering::SeqCst);
    }

    /// Shows *stop*.
    pub fn stop(&self) {
        self.ends_us.store(0, Ordering::SeqCst);
    }

    /// Whether it shows *go* at `now_us`.
    #[must_use]
    pub fn shows_go(&self, now_us: u64) -> bool {
        now_us < self.ends_us.load(Ordering::SeqCst)
    }

    /// When what it shows at `now_us` ends, unless it is told otherwise; `None` for *stop*.
    #[must_use]
    pub fn ends_us(&self, now_us: u64) -> Option<u64> {
        let ends_us = self.ends_us.load(Ordering::SeqCst);
        (now_us < ends_us).then_some(ends_us)
    }
}

/// Signals in a robot's RAM; none of a robot that cannot show anything.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shown {
    /// Signals that it was told to show, and their means.
    told: Option<SignalsShown>,
    /// Signal to vehicles instead, while it holds them back.
    pub(crate) holds_back: Option<PublicSignal>,
}

impl Shown {
    /// Nothing is shown yet, by these means.
    pub(crate) fn by(means: Option<SignalMeans>) -> Self {
        let told = means.map(|means| SignalsShown {
            to_vehicles: PublicSignal::None,
            to_pedestrians: PublicSignal::None,
            means,
        });
        Self {
            told,
            ..Self::default()
        }
    }

    /// Shows this from now on; without means, by those of before.
    pub(crate) fn show(&mut self, signals: SignalsShown) {
        let means = match signals.means {
            SignalMeans(0) => self.means(),
            means => means,
        };
        self.told = Some(SignalsShown { means, ..signals });
    }

    /// By which means it shows anything, if by any.
    pub(crate) fn means(self) -> SignalMeans {
        self.told.map(|shown| shown.means).unwrap_or_default()
    }

    /// Signals in a RAM, of a leader whose sign shows *go* or not, or of a robot that has no sign now.
    pub(crate) fn told(self, by_sign: Option<bool>) -> Option<SignalsShown> {
        let shown = self.told?;
        let to_pedestrians = match by_sign {
            Some(true) => PublicSignal::Go,
            Some(false) => PublicSignal::Stop,
            None => shown.to_pedestrians,
        };
        Some(SignalsShown {
            to_vehicles: self.holds_back.unwrap_or(shown.to_vehicles),
            to_pedestrians,
            means: shown.means,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn go_ends_by_itself_and_may_be_extended_or_ended() {
        let sign = Sign::default();
        assert!(!sign.shows_go(0));
        sign.go(1_000_000, Millis(1_900));
        assert_eq!(sign.ends_us(2_899_999), Some(2_900_000));
        assert_eq!(sign.ends_us(2_900_000), None);
        let seen = sign.clone();
        assert!(seen.shows_go(2_899_999) && !seen.shows_go(2_900_000));
        sign.go(1_100_000, Millis(1_900));
        assert!(seen.shows_go(2_900_000) && !seen.shows_go(3_000_000));
        sign.stop();
        assert!(!seen.shows_go(1_100_000));
    }
}
