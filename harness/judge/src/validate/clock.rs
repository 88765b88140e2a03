//! I10 on logs: no leader has a lease on a follower that has lost contact. Robots that write one log share its
//! clock, so that their states can be held against each other at one moment. Clocks of different logs are not
//! compared.
//!
//! Robots write from threads of their own, so a record may be somewhat late in the log. Steps are held back
//! for a second of the log's time, and judged in the order of its clock.
//!
//! I10 follows from timers that are told in time. A robot that hangs breaks the rule that it rests on, and so
//! does one that was killed; what is broken meanwhile is not held against the protocol, and I10 counts as not
//! judged.

use std::collections::{BTreeMap, HashMap};

use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::timed::{has_lease_on_lost, leases};
use crossguard_protocol::Robot;
use crossguard_robot::trace::{HELD_US, SAME_CLOCK_US};

use super::fault::Fault;

/// Entry of a robot, for the judge of its clock.
pub(super) enum ClockEntry {
    Boot {
        robot: Box<Robot>,
        /// For how long a step that comes late may have an effect, in µs.
        effect_us: u64,
    },
    Step {
        after: Box<Robot>,
        /// Whether it came later than the rules allow.
        is_late: bool,
        /// When the next step comes too late.
        overdue_us: Option<u64>,
    },
    Stop,
}

struct Item {
    robot: String,
    line: usize,
    deed: ClockEntry,
}

/// Where I10 is broken.
#[derive(Debug)]
pub(super) struct BrokenAt {
    pub(super) robot: String,
    pub(super) line: usize,
}

impl BrokenAt {
    pub(super) const fn fault() -> Fault {
        Fault::Broken(PropertyId::I10)
    }
}

/// The robots of one log.
#[derive(Default)]
pub(super) struct SharedClock {
    /// When the clock showed 0, in µs since 1970.
    began_us: Option<i128>,
    seats: HashMap<String, ClockUser>,
    held: BTreeMap<(u64, u64), Item>,
    taken: u64,
    newest_us: u64,
    /// When a robot was late the last time, and which.
    late: Option<(u64, String)>,
    /// How many robots have been on one clock at most.
    robots: usize,
    /// Whether a lease has stood while more than one robot was there.
    has_met_premise: bool,
    /// Why what was seen is not held against the protocol.
    excuse: Option<String>,
}

struct ClockUser {
    /// `None` while it is down.
    state: Option<Box<Robot>>,
    effect_us: u64,
    overdue_us: Option<u64>,
}

impl SharedClock {
    /// A robot is about to boot, at a time of day. If the clock is another one than before, another run was
    /// appended.
    pub(super) fn show(&mut self, at_us: u64, unix_ms: u64) -> Result<(), BrokenAt> {
        let began_us = i128::from(unix_ms) * 1_000 - i128::from(at_us);
        let is_same = |known: i128| (known - began_us).unsigned_abs() <= SAME_CLOCK_US;
        if !self.began_us.is_none_or(is_same) {
            self.finish()?;
            *self = Self {
                robots: self.robots,
                has_met_premise: self.has_met_premise,
                excuse: self.excuse.take(),
                ..Self::default()
            };
        }
        self.began_us.get_or_insert(began_us);
        Ok(())
    }

    pub(super) fn take(
        &mut self,
        at_us: u64,
        robot: &str,
        line: usize,
        deed: ClockEntry,
    ) -> Result<(), BrokenAt> {
        let robot = robot.to_owned();
        self.newest_us = self.newest_us.max(at_us);
        self.held
            .insert((at_us, self.taken), Item { robot, line, deed });
        self.taken += 1;
        while let Some(first) = self.held.first_entry()
            && first.key().0.saturating_add(HELD_US) <= self.newest_us
        {
            let at_us = first.key().0;
            let item = first.remove();
            self.judge(at_us, item)?;
        }
        Ok(())
    }

    /// Judges what is still held back.
    pub(super) fn finish(&mut self) -> Result<(), BrokenAt> {
        while let Some(((at_us, _), item)) = self.held.pop_first() {
            self.judge(at_us, item)?;
        }
        Ok(())
    }

    /// Whether I10 was put to the test, or else why not.
    pub(super) fn verdict(&self) -> Result<(), String> {
        match &self.excuse {
            Some(excuse) => Err(excuse.clone()),
            None if self.robots < 2 => Err(
                "no two robots share a clock, and clocks of different logs are not compared"
                    .to_owned(),
            ),
            None if !self.has_met_premise => Err("no leader had a lease".to_owned()),
            None => Ok(()),
        }
    }

    fn judge(&mut self, at_us: u64, item: Item) -> Result<(), BrokenAt> {
        let Item { robot, line, deed } = item;
        match deed {
            ClockEntry::Boot {
                robot: booted,
                effect_us,
            } => {
                let seat = ClockUser {
                    state: Some(booted),
                    effect_us,
                    overdue_us: None,
                };
                self.seats.insert(robot, seat);
                self.robots = self.robots.max(self.seats.len());
                Ok(())
            }
            ClockEntry::Stop => {
                if let Some(seat) = self.seats.get_mut(&robot) {
                    (seat.state, seat.overdue_us) = (None, None);
                }
                Ok(())
            }
            ClockEntry::Step {
                after,
                is_late,
                overdue_us,
            } => {
                if is_late {
                    self.late = Some((at_us, robot.clone()));
                }
                self.has_met_premise |= self.seats.len() > 1 && leases(&after).next().is_some();
                let Some(seat) = self.seats.get_mut(&robot) else {
                    return Ok(());
                };
                (seat.state, seat.overdue_us) = (Some(after), overdue_us);
                let up = self.seats.values().filter_map(|seat| seat.state.as_deref());
                if !has_lease_on_lost(&up) {
                    return Ok(());
                }
                match self.excuse(at_us) {
                    Some(excuse) => {
                        self.excuse.get_or_insert(excuse);
                        Ok(())
                    }
                    None => Err(BrokenAt { robot, line }),
                }
            }
        }
    }

    /// Which robot breaks the rule that I10 rests on, if one does.
    fn excuse(&self, at_us: u64) -> Option<String> {
        let is_overdue = |seat: &ClockUser| seat.overdue_us.is_some_and(|due_us| due_us < at_us);
        let mut overdue = self.seats.iter().filter(|(_, seat)| is_overdue(seat));
        let effect_us = self.seats.values().map(|seat| seat.effect_us).max();
        let late = self
            .late
            .as_ref()
            .filter(|(since_us, _)| at_us.saturating_sub(*since_us) <= effect_us.unwrap_or(0));
        let robot = overdue.next().map(|(robot, _)| robot);
        let robot = robot.or_else(|| late.map(|(_, robot)| robot))?;
        Some(format!(
            "{robot} was not told of time when a timer was due, so a lease outlasted a safety timer"
        ))
    }
}
