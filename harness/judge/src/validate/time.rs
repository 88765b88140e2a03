//! One robot's time: what it was told, held against the clock of its log.
//!
//! The driver of a robot reads the clock when a turn begins, tells the robot how much time has passed, tells
//! it what happened, and writes down what came of it. So two inequalities hold however slow the machine is,
//! because they are about the order in which one thread does things:
//!
//! ```text
//!   record before ──► clock read ──► elapsed time told ──► record of it
//!        atUs     ≤        started + sum of what was told      ≤    atUs
//! ```
//!
//! A log that breaks one of them contradicts itself, and is refused. A late act does not
//! contradict anything: a process may hang. Lateness is counted.

use crossguard_protocol::{Millis, Settings};
use crossguard_robot::trace::Reception;
use serde::Serialize;

use super::fault::Fault;

/// By how much readings of one clock may differ that are kept in milliseconds, and of which one may stand for
/// another somewhat earlier, in µs.
const ROUNDING_US: u64 = 10_000;

/// Steps that came later than the rules of the integrator allow.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Late {
    /// How many.
    pub steps: usize,
    /// By how much the latest of them came after it was due, in ms.
    pub longest_ms: u64,
}

impl Late {
    /// One that came so long after it was due.
    pub(super) fn count(&mut self, late_us: u64) {
        self.steps += 1;
        self.longest_ms = self.longest_ms.max(late_us / 1_000);
    }
}

#[derive(Debug)]
pub(super) struct ToldTime {
    drift_ppm: u64,
    delay_max_us: u64,
    started_us: u64,
    /// When the newest record was written, and the one before it.
    at_us: u64,
    before_us: u64,
    /// The sum of what the robot was told.
    told_ms: u64,
    /// When the record was written that told of time the last time.
    told_at_us: u64,
    /// When a message was received last, with the sum then.
    received: Option<(u64, u64)>,
}

impl ToldTime {
    pub(super) fn new(settings: &Settings, at_us: u64) -> Self {
        Self {
            drift_ppm: settings.drift_ppm.into(),
            delay_max_us: micros(settings.delay_max),
            started_us: at_us,
            at_us,
            before_us: at_us,
            told_ms: 0,
            told_at_us: at_us,
            received: None,
        }
    }

    /// The clock goes on to the next record.
    pub(super) fn tick(&mut self, at_us: u64) -> Result<(), Fault> {
        self.before_us = std::mem::replace(&mut self.at_us, at_us);
        if at_us < self.before_us {
            return Err(Fault::ClockWentBack {
                before_us: self.before_us,
                at_us,
            });
        }
        Ok(())
    }

    /// The robot is told of time, when its next timer was `due`. By how much that comes too late.
    pub(super) fn elapse(
        &mut self,
        elapsed: Millis,
        due: Option<Millis>,
    ) -> Result<Option<u64>, Fault> {
        self.told_ms += u64::from(elapsed.0);
        let told_us = self.told_ms.saturating_mul(1_000);
        let passed_us = self.at_us - self.started_us;
        if told_us > passed_us + self.tolerance_us(passed_us) {
            return Err(Fault::TimeFromNowhere {
                told_ms: self.told_ms,
                passed_ms: passed_us / 1_000,
            });
        }
        let passed_us = self.before_us - self.started_us;
        if told_us + self.tolerance_us(passed_us) < passed_us {
            return Err(Fault::TimeLost {
                told_ms: self.told_ms,
                passed_ms: passed_us / 1_000,
            });
        }
        let due_us = due.map(|due| self.told_at_us + micros(due));
        self.told_at_us = self.at_us;
        Ok(due_us.and_then(|due_us| self.too_late(due_us)))
    }

    /// The robot takes in something else, of the moment until which it was told of time. By how much that
    /// comes too late.
    pub(super) fn take_in(&self) -> Option<u64> {
        self.too_late(self.told_at_us)
    }

    fn too_late(&self, due_us: u64) -> Option<u64> {
        let late_us = self.at_us.saturating_sub(due_us);
        (late_us > self.delay_max_us + ROUNDING_US).then_some(late_us)
    }

    /// Until when the robot is to be told of time, on the log's clock, if a timer is due after so long.
    pub(super) fn overdue_us(&self, due: Option<Millis>) -> Option<u64> {
        due.map(|due| self.told_at_us + micros(due) + self.delay_max_us + ROUNDING_US)
    }

    /// A message was received.
    pub(super) fn receive(&mut self, reception: Reception) -> Result<(), Fault> {
        let Reception {
            arrived_us,
            told_us,
        } = reception;
        if arrived_us > told_us || told_us > self.at_us + ROUNDING_US {
            return Err(Fault::ReceivedBefore {
                arrived_us,
                told_us,
                at_us: self.at_us,
            });
        }
        let waited_us = reception.waited_us();
        // Both times are kept in milliseconds.
        let allowed_us = self.delay_max_us + self.drift_us(self.delay_max_us) + 1_000;
        if waited_us > allowed_us {
            return Err(Fault::TooOld {
                waited_ms: waited_us / 1_000,
                delay_max_ms: self.delay_max_us / 1_000,
            });
        }
        let (since_us, told_before_ms) = self.received.unwrap_or((self.started_us, 0));
        let elapsed_us = (self.told_ms - told_before_ms) * 1_000;
        let expected_us = since_us + elapsed_us;
        if expected_us.abs_diff(told_us) > self.tolerance_us(elapsed_us) {
            return Err(Fault::NotToldFirst {
                taken_us: told_us,
                told_us: expected_us,
            });
        }
        self.received = Some((told_us, self.told_ms));
        Ok(())
    }

    const fn drift_us(&self, us: u64) -> u64 {
        us / 1_000_000 * self.drift_ppm + us % 1_000_000 * self.drift_ppm / 1_000_000
    }

    const fn tolerance_us(&self, us: u64) -> u64 {
        self.drift_us(us) + ROUNDING_US
    }
}

fn micros(time: Millis) -> u64 {
    u64::from(time.0) * 1_000
}
