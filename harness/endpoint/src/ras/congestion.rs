//! Decentralized congestion control: the reactive algorithm of TS 102 687 v1.2.1, clause 5.3, with the table A.1 for
//! packets of up to 1 ms on the air.
//!
//! | busy ratio | below 0.3 | from 0.3 | from 0.4 | from 0.5 | from 0.6 |
//! |---|--:|--:|--:|--:|--:|
//! | state | relaxed | active 1 | active 2 | active 3 | restrictive |
//! | interval, ms | 100 | 200 | 400 | 500 | 1000 |
//!
//! An evaluation moves by one state at most, and is due every 200 ms. Where nobody measures the channel any more,
//! it counts as free. The interval holds back CAM, and RAM outside of sessions: see
//! [`Endpoint::hold_back`](crate::Endpoint::hold_back).

/// How often the state is evaluated, in ms.
pub const EVALUATION_MS: u64 = 200;

/// For how long a measurement counts, in ms.
pub const MEASUREMENT_MS: u64 = 1_000;

/// From which busy ratio on which interval in ms is to be kept, beyond the relaxed state.
const TABLE: [(f64, u64); 5] = [(0.0, 100), (0.3, 200), (0.4, 400), (0.5, 500), (0.6, 1_000)];

/// The state of congestion control.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Reactive {
    /// Which row of the table it is in.
    state: usize,
    /// The newest busy ratio, and when it was measured, in ms.
    measured: Option<(f64, u64)>,
    evaluated_ms: Option<u64>,
}

impl Reactive {
    /// Takes in a busy ratio, from 0 to 1, that was measured at `now_ms`.
    pub const fn measure(&mut self, busy_ratio: f64, now_ms: u64) {
        self.measured = Some((busy_ratio, now_ms));
    }

    /// The busy ratio, as long as it counts.
    #[must_use]
    pub fn busy_ratio(&self, now_ms: u64) -> Option<f64> {
        let counts = |at_ms| now_ms.saturating_sub(at_ms) <= MEASUREMENT_MS;
        self.measured
            .filter(|(_, at_ms)| counts(*at_ms))
            .map(|(ratio, _)| ratio)
    }

    /// Evaluates the state if that is due; the interval to be kept then, in ms.
    pub fn evaluate(&mut self, now_ms: u64) -> Option<u64> {
        let since = |at_ms| now_ms.saturating_sub(at_ms);
        if self.evaluated_ms.map(since) < Some(EVALUATION_MS) && self.evaluated_ms.is_some() {
            return None;
        }
        self.evaluated_ms = Some(now_ms);
        self.approach(self.busy_ratio(now_ms).unwrap_or(0.0));
        Some(self.interval_ms())
    }

    /// One step towards the state that a busy ratio asks for, whenever the last one was.
    pub fn approach(&mut self, busy_ratio: f64) {
        let wanted = TABLE.iter().rposition(|(from, _)| busy_ratio >= *from);
        let wanted = wanted.unwrap_or(0);
        self.state = wanted.clamp(self.state.saturating_sub(1), self.state + 1);
    }

    /// The interval to be kept, in ms.
    #[must_use]
    pub fn interval_ms(&self) -> u64 {
        TABLE
            .get(self.state)
            .map_or(1_000, |(_, interval)| *interval)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The interval after evaluations for so long at one busy ratio.
    fn settled(control: &mut Reactive, busy_ratio: f64, from_ms: u64) -> u64 {
        for step in 0..8 {
            let now_ms = from_ms + step * EVALUATION_MS;
            control.measure(busy_ratio, now_ms);
            control.evaluate(now_ms);
        }
        control.interval_ms()
    }

    #[test]
    fn each_busy_ratio_has_its_interval() {
        let cases = [
            (0.0, 100),
            (0.29, 100),
            (0.3, 200),
            (0.4, 400),
            (0.5, 500),
            (0.59, 500),
            (0.6, 1_000),
            (0.8, 1_000),
            (1.0, 1_000),
        ];
        for (busy_ratio, interval) in cases {
            let mut up = Reactive::default();
            assert_eq!(settled(&mut up, busy_ratio, 0), interval, "{busy_ratio}");
            settled(&mut up, 1.0, 10_000);
            assert_eq!(settled(&mut up, busy_ratio, 20_000), interval);
        }
    }

    #[test]
    fn it_moves_by_one_state_every_200_ms() {
        let mut control = Reactive::default();
        let mut intervals = [0; 10];
        for (step, interval) in (0..10).zip(&mut intervals) {
            let now_ms = 100 * step;
            control.measure(0.8, now_ms);
            control.evaluate(now_ms);
            *interval = control.interval_ms();
        }
        assert_eq!(
            intervals,
            [200, 200, 400, 400, 500, 500, 1_000, 1_000, 1_000, 1_000]
        );
    }

    #[test]
    fn a_channel_that_nobody_measures_any_more_counts_as_free() {
        let mut control = Reactive::default();
        settled(&mut control, 0.8, 0);
        let last_ms = 7 * EVALUATION_MS;
        assert_eq!(control.busy_ratio(last_ms + MEASUREMENT_MS), Some(0.8));
        let later_ms = last_ms + MEASUREMENT_MS + 1;
        assert_eq!(control.busy_ratio(later_ms), None);
        for step in 0..4 {
            control.evaluate(later_ms + step * EVALUATION_MS);
        }
        assert_eq!(control.interval_ms(), 100);
    }
}
