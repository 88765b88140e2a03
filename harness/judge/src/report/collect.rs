//! What the page shows of a run, gathered record by record. All of it is bounded.

use std::collections::BTreeMap;

use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::{Settings, StationId};
use crossguard_robot::trace::{Entry, LogError, Merged, Record, Timed};

use super::around::AroundRun;
use super::crowd::{PeopleRun, Span};
use crate::facts::{Area, Direction, Fact, Observer, Placed, View};
use crate::playback::{Playback, Reading};
use crate::timing::Timing;

/// How many states of a robot are kept, and how many points of its way.
const STATES: usize = 1_000;
const POINTS: usize = 2_000;

/// A run.
pub(super) struct Run {
    pub(super) robots: Vec<RobotRun>,
    /// The first and the last record, in µs since 1970.
    pub(super) from_us: u64,
    pub(super) to_us: u64,
    pub(super) timing: Timing,
    /// The same run, for its messages and trials.
    pub(super) playback: Playback,
    /// Where followers were commanded to, all in all.
    pub(super) areas: Vec<Area>,
}

/// What there is of a robot.
#[derive(Default)]
pub(super) struct RobotRun {
    pub(super) name: String,
    pub(super) stations: Vec<StationId>,
    pub(super) boots: Vec<u16>,
    /// The settings of its last boot.
    pub(super) settings: Option<Settings>,
    pub(super) records: u64,
    pub(super) steps: u64,
    pub(super) sent: u64,
    pub(super) heard: u64,
    pub(super) lost: u64,
    pub(super) states: Vec<Span<View>>,
    /// How many were left out.
    pub(super) states_more: u64,
    /// When its corridor was open, and why it was closed.
    pub(super) corridor: Vec<Span<String>>,
    pub(super) way: Vec<(f64, f64)>,
    /// The people at its crossing.
    pub(super) people: PeopleRun,
    /// Who was on its map.
    pub(super) around: AroundRun,
    pub(super) counters: BTreeMap<CauseName, u64>,
    /// Those of the boots before.
    counters_before: BTreeMap<CauseName, u64>,
    pub(super) has_stopped: bool,
    last_us: u64,
    /// Whether it has booted, and nothing is known of it since.
    is_fresh: bool,
    /// How many of its places are left out between two that are kept.
    stride: usize,
    places: usize,
}

impl Run {
    /// What `logs` tell.
    pub(super) fn of(mut logs: Merged) -> Result<Self, LogError> {
        let mut run = Self {
            robots: Vec::new(),
            from_us: u64::MAX,
            to_us: 0,
            timing: Timing::default(),
            playback: Playback::default(),
            areas: Vec::new(),
        };
        let (mut reading, mut observer) = (Reading::default(), Observer::default());
        while let Some(timed) = logs.take()? {
            let facts = observer.take(&timed.record);
            reading.take(&timed, facts.clone());
            let Timed { log, at_us, record } = timed;
            run.from_us = run.from_us.min(at_us);
            run.to_us = run.to_us.max(at_us);
            run.timing.record(log, at_us, &record);
            run.robot(&record).records += 1;
            for fact in facts {
                run.take((at_us, record.at_us), &record.robot, fact);
            }
            let robot = run.robot(&record);
            robot.last_us = at_us;
            if let Entry::Started { settings, .. } = &record.entry {
                robot.settings = Some((**settings).clone());
            }
        }
        run.playback = reading.finish(None);
        for robot in &mut run.robots {
            robot.end();
        }
        Ok(run)
    }

    fn robot(&mut self, record: &Record) -> &mut RobotRun {
        let known = self.robots.iter().position(|it| it.name == record.robot);
        let place = known.unwrap_or_else(|| {
            self.robots.push(RobotRun {
                name: record.robot.clone(),
                stride: 1,
                ..RobotRun::default()
            });
            self.robots.len() - 1
        });
        &mut self.robots[place]
    }

    /// Takes a fact in, at a time since 1970 and on the clock of its log.
    fn take(&mut self, (at_us, log_us): (u64, u64), robot: &str, fact: Fact) {
        let fact = match fact {
            Fact::Corridor {
                is_open,
                since_us,
                why,
            } => Fact::Corridor {
                is_open,
                since_us: at_us.saturating_sub(log_us.saturating_sub(since_us)),
                why,
            },
            fact => fact,
        };
        if let Fact::Areas(areas) = fact {
            for area in areas {
                let is_known =
                    |it: &Area| (it.task, it.to, it.from) == (area.task, area.to, area.from);
                if !self.areas.iter().any(is_known) && self.areas.len() < POINTS {
                    self.areas.push(area);
                }
            }
            return;
        }
        if let Some(robot) = self.robots.iter_mut().find(|it| it.name == robot) {
            robot.take(at_us, fact);
        }
    }

    /// The name of a station: that of its robot, if there is one.
    pub(super) fn name_of(&self, station: StationId) -> String {
        let robot = self.robots.iter().find(|it| it.stations.contains(&station));
        robot.map_or_else(|| format!("station {station}"), |robot| robot.name.clone())
    }
}

impl RobotRun {
    fn take(&mut self, at_us: u64, fact: Fact) {
        match fact {
            Fact::Started { station, boot } => {
                self.end();
                self.has_stopped = false;
                self.is_fresh = true;
                self.boots.push(boot);
                self.is(station);
            }
            Fact::State(view) => {
                self.is(view.station);
                self.state(at_us, view);
            }
            Fact::Place(placed) => self.place(&placed),
            Fact::Step { .. } => self.steps += 1,
            Fact::Message(message) => match message.direction {
                Direction::Sent => self.sent += 1,
                Direction::Heard => self.heard += 1,
                Direction::Lost => self.lost += 1,
            },
            Fact::Corridor {
                is_open,
                since_us,
                why,
            } => self.corridor(since_us, is_open, why),
            Fact::Counted { cause, count } => {
                let before = self.counters_before.get(&cause).copied().unwrap_or(0);
                self.counters.insert(cause, before + count);
            }
            Fact::Zone(outline) => self.people.zone = outline,
            Fact::People(sight) => self.people.see(at_us, &sight),
            Fact::Cluster(cluster) => self.people.announce(at_us, cluster),
            Fact::Stopped => self.has_stopped = true,
            Fact::Around(around) => self.around.see(at_us, &around),
            Fact::Note { .. } | Fact::Areas(_) => {}
        }
    }

    fn is(&mut self, station: StationId) {
        if !self.stations.contains(&station) {
            self.stations.push(station);
        }
    }

    fn state(&mut self, at_us: u64, view: View) {
        let is_fresh = std::mem::replace(&mut self.is_fresh, false);
        if !is_fresh {
            self.close_state(at_us);
        }
        // What does not show in the picture does not end a span.
        let looks = |view: &View| (view.state, view.role, view.session, view.executes);
        let count = self.states.len();
        match self.states.last_mut() {
            Some(last) if !is_fresh && looks(&last.what) == looks(&view) => {
                last.what = view;
                return;
            }
            _ if count >= STATES => {
                self.states_more += 1;
                return;
            }
            _ => {}
        }
        self.states.push(Span {
            from_us: at_us,
            to_us: at_us,
            what: view,
        });
    }

    fn close_state(&mut self, at_us: u64) {
        if let Some(last) = self.states.last_mut()
            && self.states_more == 0
        {
            last.to_us = at_us;
        }
    }

    fn corridor(&mut self, at_us: u64, is_open: bool, why: String) {
        if is_open {
            self.corridor.push(Span {
                from_us: at_us,
                to_us: u64::MAX,
                what: String::new(),
            });
        } else if let Some(last) = self.corridor.last_mut() {
            last.to_us = at_us;
            last.what = if why.is_empty() {
                "robot lost power".to_owned()
            } else {
                why
            };
        }
    }

    /// Keeps a place; every second one is let go of when there are too many.
    fn place(&mut self, placed: &Placed) {
        self.places += 1;
        let place = (placed.latitude, placed.longitude);
        if !self.places.is_multiple_of(self.stride) || self.way.last() == Some(&place) {
            return;
        }
        self.way.push(place);
        if self.way.len() >= POINTS {
            let mut keep = false;
            self.way.retain(|_| {
                keep = !keep;
                keep
            });
            self.stride *= 2;
        }
    }

    /// Nothing more is known of this boot.
    fn end(&mut self) {
        let last_us = self.last_us;
        self.close_state(last_us);
        self.people.end(last_us);
        if let Some(last) = self.corridor.last_mut() {
            last.to_us = last.to_us.min(last_us);
        }
        self.counters_before.clone_from(&self.counters);
    }
}
