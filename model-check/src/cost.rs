//! What an exploration costs: processor time and memory, as the kernel counts them.
//!
//! Both are those of the whole process, so they mean something where it does nothing else. They are
//! known on Linux only.

use std::fs;
use std::sync::OnceLock;
use std::time::Duration;

use serde::Serialize;

/// What a check cost.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Cost {
    /// Seconds of processor time, of all threads together, in user and kernel mode.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub processor_seconds: Option<f64>,
    /// Distinct states per second of processor time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub states_per_second_per_core: Option<f64>,
    /// Bytes of memory per distinct state: the peak resident memory, less what was resident before. Where
    /// an earlier check has left so much memory behind that this could be wrong by a tenth, it is not told.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bytes_per_state: Option<f64>,
}

/// Measures from when it is started.
#[derive(Clone, Copy, Debug)]
pub struct Meter {
    processor_time: Option<Duration>,
    is_peak_reset: bool,
    resident: Option<usize>,
}

impl Meter {
    /// Begins to measure.
    #[must_use]
    pub fn start() -> Self {
        memory_at_first();
        // Makes the kernel forget the peak of before.
        let is_peak_reset = fs::write("/proc/self/clear_refs", "5").is_ok();
        Self {
            processor_time: processor_time(Of::Itself),
            is_peak_reset,
            resident: memory("VmRSS:"),
        }
    }

    /// What has been spent since then, for this number of distinct states.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "figures for people")]
    pub fn read(self, states: usize) -> Cost {
        let spent = processor_time(Of::Itself)
            .zip(self.processor_time)
            .map(|(now, before)| now.saturating_sub(before).as_secs_f64());
        let bytes = memory("VmHWM:")
            .zip(memory_at_first().zip(self.resident))
            .filter(|_| self.is_peak_reset)
            .and_then(|(peak, (at_first, before))| grown(peak, at_first, before));
        let states = states as f64;
        Cost {
            processor_seconds: spent,
            // The kernel counts in hundredths of a second.
            states_per_second_per_core: spent
                .filter(|seconds| *seconds >= 0.1)
                .map(|seconds| states / seconds),
            bytes_per_state: bytes.map(|bytes| bytes as f64 / states),
        }
    }
}

/// By how much memory has grown to `peak`. The process may use again what was left between `at_first` and
/// `before` by an earlier check, or not, so the growth is known only where this makes little difference.
fn grown(peak: usize, at_first: usize, before: usize) -> Option<usize> {
    let least = peak.saturating_sub(before.max(at_first));
    let most = peak.saturating_sub(before.min(at_first));
    (most - least <= least / 10).then_some(least.midpoint(most))
}

fn memory_at_first() -> Option<usize> {
    static BYTES: OnceLock<Option<usize>> = OnceLock::new();
    *BYTES.get_or_init(|| memory("VmRSS:"))
}

/// A memory figure of this process in bytes, from `/proc/self/status`.
fn memory(key: &str) -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with(key))?;
    let kilobytes: usize = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}

/// Whose processor time.
#[derive(Clone, Copy, Debug)]
pub enum Of {
    /// That of this process.
    Itself,
    /// That of processes that it started and that have ended.
    Children,
}

/// Processor time in user and kernel mode, from `/proc/self/stat`; `None` where there is none.
#[must_use]
pub fn processor_time(of: Of) -> Option<Duration> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // Fields are counted from behind the program's name, which may hold spaces.
    let (_, fields) = stat.rsplit_once(')')?;
    let first = match of {
        Of::Itself => 11,
        Of::Children => 13,
    };
    let mut fields = fields.split_whitespace().skip(first);
    let user: u64 = fields.next()?.parse().ok()?;
    let kernel: u64 = fields.next()?.parse().ok()?;
    // A tick is 10 ms on Linux, whatever the kernel's own.
    Some(Duration::from_millis(10 * (user + kernel)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_that_an_earlier_check_has_left_behind_is_not_counted_twice() {
        assert_eq!(grown(1_100, 100, 100), Some(1_000), "the first check");
        assert_eq!(grown(1_100, 100, 150), Some(975), "little was left");
        assert_eq!(grown(1_100, 100, 900), None, "most was there before");
        assert_eq!(grown(900, 100, 900), None, "nothing was taken");
        assert_eq!(grown(1_100, 150, 100), Some(975), "less than at first");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn what_is_spent_is_counted() {
        let meter = Meter::start();
        let before = processor_time(Of::Itself).unwrap();
        let mut filled = Vec::new();
        while processor_time(Of::Itself).unwrap() < before + Duration::from_millis(200) {
            filled.extend(std::iter::repeat_n(1_u8, 1 << 20));
        }
        let cost = meter.read(1);
        assert!(cost.processor_seconds.unwrap() >= 0.2);
        assert!(cost.states_per_second_per_core.unwrap() <= 5.0);
        assert!(cost.bytes_per_state.is_none_or(|bytes| bytes > 1e6));
        assert!(filled.len() > 1 << 20);
    }
}
