//! Processor time and memory, as the kernel of Linux counts them for a process.

use std::fs;
use std::time::Duration;

/// Measures a process from when it is started.
pub(crate) struct Meter {
    processor_time: Option<Duration>,
    resident: Option<usize>,
}

impl Meter {
    pub(crate) fn start() -> Self {
        Self {
            processor_time: processor_time(Of::Itself),
            resident: memory("VmRSS:"),
        }
    }

    /// Seconds of processor time since then, and bytes of memory for each of so many states: the peak resident memory, less
    /// what was resident before.
    #[expect(clippy::cast_precision_loss, reason = "figures for people")]
    pub(crate) fn read(self, states: usize) -> Option<(f64, f64)> {
        let spent = processor_time(Of::Itself)?.saturating_sub(self.processor_time?);
        let bytes = memory("VmHWM:")?.saturating_sub(self.resident?);
        Some((spent.as_secs_f64(), bytes as f64 / states as f64))
    }
}

/// A memory figure of this process in bytes, from `/proc/self/status`.
fn memory(key: &str) -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with(key))?;
    let kilobytes: usize = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}

/// Processes whose processor time is counted.
#[derive(Clone, Copy)]
pub(crate) enum Of {
    /// This process.
    Itself,
    /// Processes that it started and that have ended.
    Children,
}

/// Processor time in user and kernel mode, from `/proc/self/stat`; `None` where there is none.
pub(crate) fn processor_time(of: Of) -> Option<Duration> {
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
