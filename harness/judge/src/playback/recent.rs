//! A run while it goes on: the last minute in full, and of the time before what still holds.

use std::collections::{HashMap, VecDeque};
use std::mem::{Discriminant, discriminant};

use crossguard_robot::site::Site;
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::trace::{Entry, Record, Timed};

use super::{Playback, Reading};

/// How long a record is kept, in µs, and the most that are kept.
const WINDOW_US: u64 = 60_000_000;
const RECORDS_MAX: usize = 60_000;

/// The most kinds of records of robots that are kept for longer.
const LASTING_MAX: usize = 1_024;

/// A robot, and what kind of record it is.
type RecordKind = (String, Discriminant<Entry>, &'static str);

/// The records that say how a run is now.
#[derive(Debug, Default)]
pub struct Recent {
    /// The last record of each kind that is older than the window.
    lasting: HashMap<RecordKind, Timed>,
    window: VecDeque<Timed>,
    newest_us: u64,
    origin: Option<Site>,
}

impl Recent {
    /// Takes the next record.
    pub fn take(&mut self, timed: Timed) {
        self.newest_us = self.newest_us.max(timed.at_us);
        if self.is_old(&timed) {
            self.keep(timed);
            return;
        }
        self.window.push_back(timed);
        while let Some(first) = self.window.front() {
            if !self.is_old(first) && self.window.len() <= RECORDS_MAX {
                break;
            }
            if let Some(old) = self.window.pop_front() {
                self.keep(old);
            }
        }
    }

    const fn is_old(&self, timed: &Timed) -> bool {
        timed.at_us.saturating_add(WINDOW_US) < self.newest_us
    }

    fn keep(&mut self, old: Timed) {
        let kind = kind(&old.record);
        if self.lasting.len() < LASTING_MAX || self.lasting.contains_key(&kind) {
            self.lasting.insert(kind, old);
        }
    }

    /// The run until this time, in µs since 1970, which may be later than its last record. Its places are measured from
    /// the site of the street, or from the first place that was ever known.
    pub fn playback(&mut self, street: Option<SiteFile>, until_us: u64) -> Playback {
        let mut reading = Reading::default();
        let mut lasting: Vec<_> = self.lasting.values().collect();
        lasting.sort_by_key(|timed| timed.at_us);
        for timed in lasting.into_iter().chain(&self.window) {
            reading.take(timed);
        }
        let is_placed = street.is_some();
        let mut run = reading.finish(street);
        if !is_placed {
            self.origin = self.origin.or_else(|| run.origin());
            run.site = self.origin.unwrap_or(run.site);
        }
        run.to_us = run.to_us.max(until_us);
        run
    }

    /// When the last minute began, in µs since the first record of a run of [`Self::playback`].
    #[must_use]
    pub fn window_from(&self, run: &Playback) -> u64 {
        let first = self.window.front();
        first.map_or(0, |timed| run.since(timed.at_us))
    }
}

/// Records of one kind replace each other.
fn kind(record: &Record) -> RecordKind {
    let message = match &record.entry {
        Entry::Sent { message, .. } | Entry::Heard { message, .. } => message.name(),
        _ => "",
    };
    (record.robot.clone(), discriminant(&record.entry), message)
}
