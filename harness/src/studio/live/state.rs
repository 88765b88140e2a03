//! Present state of all logs together.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use crossguard_endpoint::counters::CauseName;
use crossguard_judge::facts::{Fact, Observer};
use crossguard_judge::playback::{Moment, Overview, Recent, Stretch};
use crossguard_robot::site_file::SiteFile;
use serde::Serialize;

use super::tail::{Tail, TailState, Taken};

/// How many robots and causes of drops are counted.
const ROBOTS_MAX: usize = 32;
const CAUSES_MAX: usize = 256;

/// State of the logs so far.
pub(super) struct State {
    street: Option<SiteFile>,
    names: Vec<String>,
    recent: Recent,
    observer: Observer,
    robots: BTreeMap<String, Heard>,
    logs: Vec<LogNow>,
    /// The newest record's time by its robot's clock, in µs since 1970, and when it came.
    newest: Option<(u64, Instant)>,
}

/// Records of one robot: the time of the last one, and drops.
struct Heard {
    /// When something of it came last.
    last: Instant,
    drops: BTreeMap<CauseName, Dropped>,
}

/// How many were dropped for one cause.
#[derive(Clone, Copy, Default)]
struct Dropped {
    /// In the boots before.
    before: u64,
    /// Since it booted.
    since: u64,
}

/// Data of the page.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Now {
    overview: Overview,
    moment: Moment,
    /// How long ago each robot wrote something, in ms, in the order of the overview.
    ages: Vec<u64>,
    logs: Vec<LogNow>,
}

/// How it is with one log.
#[derive(Clone, Serialize)]
pub(super) struct LogNow {
    name: String,
    /// Its fault; empty where it is followed.
    trouble: String,
    /// How often it began anew.
    restarts: u32,
}

impl State {
    pub(super) fn new(logs: &[PathBuf], street: Option<SiteFile>) -> Self {
        let names: Vec<_> = logs.iter().map(|path| path.display().to_string()).collect();
        let logs = names.iter().map(|name| LogNow {
            name: name.clone(),
            trouble: String::new(),
            restarts: 0,
        });
        Self {
            street,
            logs: logs.collect(),
            names,
            recent: Recent::default(),
            observer: Observer::default(),
            robots: BTreeMap::new(),
            newest: None,
        }
    }

    /// Takes what came in the log at this place.
    pub(super) fn take(&mut self, place: usize, tail: &Tail, taken: Taken) {
        let log = &mut self.logs[place];
        log.restarts = tail.restarts;
        log.trouble = match &tail.state {
            TailState::Followed => String::new(),
            TailState::Missing(cause) | TailState::Broken(cause) => cause.clone(),
        };
        let now = Instant::now();
        let came = now.checked_sub(taken.age).unwrap_or(now);
        for timed in taken.records {
            if self.newest.is_none_or(|(at_us, _)| at_us <= timed.at_us) {
                self.newest = Some((timed.at_us, came));
            }
            let facts = self.observer.take(&timed.record);
            if self.robots.len() < ROBOTS_MAX || self.robots.contains_key(&timed.record.robot) {
                let robot = self.robots.entry(timed.record.robot.clone());
                let robot = robot.or_insert_with(|| Heard {
                    last: came,
                    drops: BTreeMap::new(),
                });
                robot.last = robot.last.max(came);
                for fact in facts {
                    robot.count(fact);
                }
            }
            self.recent.take(timed);
        }
    }

    /// The run as it is now. Time goes on while nothing is written, so that a lease that nobody renews runs down.
    pub(super) fn now(&mut self) -> Now {
        let (newest_us, came) = self.newest.unwrap_or((0, Instant::now()));
        let passed = u64::try_from(came.elapsed().as_micros()).unwrap_or(u64::MAX);
        let until_us = newest_us.saturating_add(if newest_us == 0 { 0 } else { passed });
        let playback = self.recent.playback(self.street.clone(), until_us);
        let mut overview = playback.overview(&self.names);
        let window = Stretch {
            from: self.recent.window_from(&playback),
            to: overview.lasted,
        };
        let mut moment = playback.moment(overview.lasted, Some(window), false);
        let causes: BTreeSet<_> = self
            .robots
            .values()
            .flat_map(|it| it.drops.keys())
            .collect();
        overview.causes = causes
            .iter()
            .map(|cause| [cause.layer.name().to_owned(), cause.reason.to_string()])
            .collect();
        for (shown, robot) in overview.robots.iter().zip(&mut moment.robots) {
            let heard = self.robots.get(&shown.name);
            robot.drops = causes
                .iter()
                .map(|cause| heard.map_or(0, |heard| heard.dropped(cause)))
                .collect();
        }
        let age = |name: &str| self.robots.get(name).map(|it| it.last.elapsed());
        let ages = overview.robots.iter().map(|it| age(&it.name));
        Now {
            ages: ages.map(|it| ms(it.unwrap_or(Duration::MAX))).collect(),
            overview,
            moment,
            logs: self.logs.clone(),
        }
    }
}

fn ms(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}

impl Heard {
    fn count(&mut self, fact: Fact) {
        match fact {
            Fact::Started { .. } => {
                for dropped in self.drops.values_mut() {
                    dropped.before += dropped.since;
                    dropped.since = 0;
                }
            }
            Fact::Counted { cause, count }
                if self.drops.len() < CAUSES_MAX || self.drops.contains_key(&cause) =>
            {
                self.drops.entry(cause).or_default().since = count;
            }
            _ => {}
        }
    }

    fn dropped(&self, cause: &CauseName) -> u64 {
        let dropped = self.drops.get(cause);
        dropped.map_or(0, |it| it.before + it.since)
    }
}
