//! A run that can be looked at as it was at any time, as data for a page.
//!
//! ```text
//!   logs ──► Playback ──┬──► Overview: robots, states over time, trials, times, extent of the street
//!                       └──► Moment: bodies, people, timers, leases, drops, and the messages around a time
//! ```
//!
//! Both are small however long the logs are: the overview has no more spans of states than a screen has
//! columns, and a moment has the messages next to it. Times are microseconds since the first record, places
//! are metres to the east and north of the site.

mod messages;
mod moment;
mod overview;
mod recent;
mod tracks;

pub use messages::{MessageRow, Rows};
pub use moment::{Moment, RobotMoment, SavedRun, Stretch};
pub use overview::{Overview, StateSpan, Trial};
pub use recent::Recent;

use std::collections::HashMap;

use crossguard_protocol::{Output, StationId};
use crossguard_robot::site::Site;
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::trace::{Entry, Log, Merged, Record, Records, Timed};

use crate::facts::{Fact, Observer};
use crate::timing::Timing;
use messages::Messages;
use tracks::Track;

/// How many records and robots are kept. The others are counted.
const RECORDS_MAX: u64 = 3_000_000;
const ROBOTS_MAX: usize = 32;

/// A run.
#[derive(Default)]
pub struct Playback {
    /// The first and the last record, in µs since 1970.
    from_us: u64,
    to_us: u64,
    site: Site,
    street: Option<SiteFile>,
    robots: Vec<Track>,
    messages: Messages,
    timing: Timing,
    /// Why logs could not be read to their ends.
    troubles: Vec<String>,
    records: u64,
    left_out: u64,
}

/// Where something is, in metres to the east and to the north of the site, to the centimetre.
pub type Metres = [f64; 2];

impl Playback {
    /// The run in `logs`. A log that cannot be read to its end is taken as far as it goes, and
    /// [`Overview::troubles`] says why it ends there.
    #[must_use]
    pub fn of(mut logs: Merged, street: Option<SiteFile>) -> Self {
        let mut reading = Reading::default();
        loop {
            match logs.take() {
                Ok(Some(timed)) => reading.take(&timed),
                Ok(None) => break,
                Err(error) => reading.run.troubles.push(error.to_string()),
            }
        }
        reading.finish(street)
    }

    /// A time since the first record, from one since 1970.
    const fn since(&self, at_us: u64) -> u64 {
        at_us.saturating_sub(self.from_us)
    }

    fn metres(&self, (latitude, longitude): (f64, f64)) -> Metres {
        let place = self.site.place(latitude, longitude);
        [place.east, place.north].map(|metres| (metres * 100.0).round() / 100.0)
    }
}

/// When a line of a log was written, in µs since 1970; where it is no record, when the record before it was. `None`
/// where there is none before it.
#[must_use]
pub fn written_us(log: Log<'_>, line: usize) -> Option<u64> {
    let mut records = Records::new(log);
    let mut at_us = None;
    while records.line() < line {
        match records.take() {
            Ok(Some(record)) => at_us = Some(records.unix_us(&record)),
            Ok(None) | Err(_) => break,
        }
    }
    at_us
}

/// A run while its logs are read.
#[derive(Default)]
pub(crate) struct Reading {
    run: Playback,
    observer: Observer,
}

impl Reading {
    /// Takes the next record.
    pub(crate) fn take(&mut self, timed: &Timed) {
        let Timed { log, at_us, record } = timed;
        let facts = self.observer.take(record);
        let Some(robot) = self.robot(&record.robot) else {
            self.run.left_out += 1;
            return;
        };
        if self.run.records >= RECORDS_MAX {
            self.run.left_out += 1;
            return;
        }
        if self.run.records == 0 {
            self.run.from_us = *at_us;
        }
        self.run.records += 1;
        self.run.from_us = self.run.from_us.min(*at_us);
        self.run.to_us = self.run.to_us.max(*at_us);
        self.run.timing.record(*log, *at_us, record);
        self.step(robot, *at_us, record);
        for fact in facts {
            self.fact(robot, *at_us, record.at_us, fact);
        }
    }

    fn robot(&mut self, name: &str) -> Option<u16> {
        let robots = &mut self.run.robots;
        let known = robots.iter().position(|it| it.name == name);
        let place = known.unwrap_or(robots.len());
        if place >= ROBOTS_MAX {
            return None;
        }
        if known.is_none() {
            robots.push(Track::new(name));
        }
        u16::try_from(place).ok()
    }

    /// Takes in state that no fact tells: timers, and until when the sign shows go.
    fn step(&mut self, robot: u16, at_us: u64, record: &Record) {
        let Entry::Step { outputs, state, .. } = &record.entry else {
            return;
        };
        let track = &mut self.run.robots[usize::from(robot)];
        let timers = state.timers();
        let timers = timers.iter().map(|(timer, left)| (*timer, left.0));
        track.timers.push(at_us, timers.collect());
        for output in outputs.iter() {
            match output {
                Output::CorridorOpened(time) | Output::CorridorExtended(time) => {
                    track.sign.push(at_us, Some(time.0));
                }
                Output::CorridorClosed(_) => track.sign.push(at_us, None),
                _ => {}
            }
        }
    }

    fn fact(&mut self, robot: u16, at_us: u64, log_us: u64, fact: Fact) {
        match fact {
            Fact::Message(message) => self.run.messages.message(robot, at_us, &message),
            Fact::Note { is_warning, text } => {
                self.run.messages.note(robot, at_us, is_warning, &text);
            }
            Fact::Corridor {
                is_open,
                since_us,
                why,
            } => {
                let since_us = at_us.saturating_sub(log_us.saturating_sub(since_us));
                let track = &mut self.run.robots[usize::from(robot)];
                track.corridor(since_us, is_open, why);
            }
            fact => self.run.robots[usize::from(robot)].take(at_us, fact),
        }
    }

    /// The run, after its last record.
    pub(crate) fn finish(mut self, street: Option<SiteFile>) -> Playback {
        let run = &mut self.run;
        let mut robots: HashMap<StationId, u16> = HashMap::new();
        for (place, track) in (0..).zip(&run.robots) {
            robots.extend(track.stations.iter().map(|station| (*station, place)));
        }
        let name = |(id, place): (&StationId, &u16)| (*id, &*run.robots[usize::from(*place)].name);
        run.messages.names = robots.iter().map(name).collect();
        run.messages.finish(&robots, run.robots.len());
        run.site = match &street {
            Some(street) => street.site,
            None => run.origin().unwrap_or(Site {
                latitude: 0.0,
                longitude: 0.0,
                ..Site::default()
            }),
        };
        run.street = street;
        self.run
    }
}

impl Playback {
    /// A site at the first place that anything has, if anything has one.
    fn origin(&self) -> Option<Site> {
        let first = |track: &Track| {
            let place = track.places.first().map(|placed| placed.degrees());
            place.or_else(|| Some(*track.zone.first()?.waiting.first()?))
        };
        let (latitude, longitude) = self.robots.iter().find_map(first)?;
        Some(Site {
            latitude,
            longitude,
            ..Site::default()
        })
    }
}
