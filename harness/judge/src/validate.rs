//! Whether logs tell what could have happened.
//!
//! ```text
//!   log of one robot ──┐                      ┌─► every step is one of the transition function
//!   log of another ────┼─► in causal order ───┼─► what is put out is sent, what is heard is stepped
//!   log of several ────┘  (sent before heard) ├─► every reception matches a transmission
//!                                             └─► no property is broken: Monitor
//! ```
//!
//! Logs may come from different machines. Their clocks are not compared: a log waits at a reception
//! until the log of the sender has come to the transmission. Each record is looked at once, so the
//! time grows with the length of the logs alone.
//!
//! Times are judged by what one log says of one clock, which is [never put](crossguard_robot::runtime::Clock):
//!
//! | what a log shows | |
//! |---|---|
//! | The robot is told of more time than has passed, or of less than had passed at its record before | refused: no robot that reads its clock first can have written that, however slow its machine is |
//! | A message is taken in before the time up to then is told | refused |
//! | A message is taken in that waited for longer than `delay_max` | refused |
//! | A timer is told later than `delay_max` after it is due; a step is taken later than `delay_max` after the time that the robot was told last | counted, with the longest: a process may hang |
//! | I10 is broken among robots that share a log, and so a clock | refused, unless a robot was late or silent: its lease then outlasts a safety timer, as the rules say |
//!
//! A leader whose followers have accepted commands to places less than a metre apart is refused: two bodies would
//! meet there.
//!
//! W1, W2 and W4 are judged for people who step on the road as soon as a sign shows go.
//!
//! P1 to P4 are judged where a log has people, the outline of a road and positions of robots; P3 where it has vehicles.
//!
//! And what no log shows: people out of sight, whether a sign ended when its time was over, and whether a body was
//! where its application said; how long messages were under way, since the clocks of sender and receiver are not
//! compared; for how long one waited in a socket of a process that hung, but for the limit that its
//! thread vouches for; I10 between robots with logs of their own. Where receptions do not say when they arrived,
//! how many is counted.
//!
//! A log that ends in the middle is from a process that was killed. Receptions of its messages after its
//! end cannot be matched, and are counted.

mod clock;
mod crossing;
mod fault;
mod ground;
mod road;
mod robot;
mod targets;
mod time;
mod traffic;

pub use fault::Fault;
pub use time::Late;
pub use traffic::Coming;

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::fmt;
use std::io::BufRead;

use crossguard_codec::Service;
use crossguard_model_check::monitor::Monitor;
use crossguard_model_check::properties::PropertyId;
use crossguard_protocol::{Event, Input, StationId};
use serde::Serialize;

use clock::{BrokenAt, ClockEntry, SharedClock};
pub use crossguard_robot::trace::Log;
use crossguard_robot::trace::{Entry, Record, Records};
use crossing::Crossing;
use road::Crossings;
use robot::Follow;

/// Content of valid logs.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Validated {
    /// How many robots.
    pub robots: usize,
    /// How many records.
    pub records: usize,
    /// How many steps of the transition function.
    pub steps: usize,
    /// How many messages were sent.
    pub sent: usize,
    /// How many receptions were matched with their transmissions.
    pub heard: usize,
    /// How many were heard from stations that none of the logs is of.
    pub from_strangers: usize,
    /// How many were heard from robots after the end of their logs.
    pub beyond_logs: usize,
    /// How many messages were taken in of which the logs do not say how long they had waited.
    pub of_unknown_age: usize,
    /// Steps that came later than the rules allow.
    pub late: Late,
    /// How many records the robots themselves say are missing, because the log was full.
    pub missing: u64,
    /// The robots whose logs end in the middle of a run, because they lost power or were killed.
    pub cut_off: Vec<String>,
    /// The properties that had something to say, and were kept.
    pub properties: Vec<String>,
    /// Properties that were not judged, and why.
    pub not_judged: Vec<String>,
    /// How often P1 to P4 were judged, and within what, or why they were not.
    pub crossing: Vec<String>,
}

/// Why logs are not valid: the first record that does not fit.
#[derive(Debug)]
pub struct Invalid {
    /// The log.
    pub log: String,
    /// The line in it, counted from 1.
    pub line: usize,
    /// The robot, where the line says one.
    pub robot: Option<String>,
    /// The fault.
    pub fault: Box<Fault>,
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.log.is_empty() {
            write!(f, "{}, ", self.log)?;
        }
        write!(f, "line {}: ", self.line)?;
        if let Some(robot) = &self.robot {
            write!(f, "{robot} ")?;
        }
        write!(f, "{}", self.fault)
    }
}

impl std::error::Error for Invalid {}

/// Validates one log.
///
/// # Errors
/// The first record that does not fit.
pub fn one(lines: impl BufRead) -> Result<Validated, Invalid> {
    all(vec![Log::new("", lines)])
}

/// Validates logs of robots that were together.
///
/// # Errors
/// The first record that does not fit.
pub fn all(logs: Vec<Log<'_>>) -> Result<Validated, Invalid> {
    let mut robots = LoggedRobots::default();
    let mut cursors = Vec::new();
    for log in logs {
        cursors.push(Cursor::new(log)?);
    }
    while let Some(next) = robots.choose(&cursors) {
        let cursor = &mut cursors[next];
        if let Some(record) = cursor.head.take() {
            let line = cursor.records.line();
            let unix_us = cursor.records.unix_us(&record);
            robots
                .take(record, &mut cursor.clock, line, unix_us)
                .map_err(|refusal| cursor.refused(refusal))?;
            cursor.advance()?;
        }
        let cursor = &mut cursors[next];
        if cursor.head.is_none() {
            let judged = cursor.clock.finish();
            judged.map_err(|broken| cursor.refused(Refusal::Clock(broken)))?;
            robots.end(cursor);
        }
    }
    Ok(robots.finish(cursors.iter().map(|cursor| &cursor.clock)))
}

/// A log, and how far it has been read.
struct Cursor<'a> {
    records: Records<'a>,
    head: Option<Record>,
    /// The robots that it is of.
    robots: BTreeSet<String>,
    /// The same, at moments of their common clock.
    clock: SharedClock,
}

/// Why a record is not taken.
enum Refusal {
    /// It does not fit.
    Record(String, Fault),
    /// An earlier one, which was held back, does not fit to those of other robots at its time.
    Clock(BrokenAt),
}

impl<'a> Cursor<'a> {
    fn new(log: Log<'a>) -> Result<Self, Invalid> {
        let mut cursor = Self {
            records: Records::new(log),
            head: None,
            robots: BTreeSet::new(),
            clock: SharedClock::default(),
        };
        cursor.advance()?;
        Ok(cursor)
    }

    fn advance(&mut self) -> Result<(), Invalid> {
        let next = self.records.take();
        self.head = next.map_err(|why| self.invalid(None, why.into()))?;
        if let Some(record) = &self.head
            && !self.robots.contains(&record.robot)
        {
            self.robots.insert(record.robot.clone());
        }
        Ok(())
    }

    /// About when the next record was written, in µs since 1970.
    fn unix_us(&self) -> u64 {
        self.head
            .as_ref()
            .map_or(0, |head| self.records.unix_us(head))
    }

    fn refused(&self, refusal: Refusal) -> Invalid {
        match refusal {
            Refusal::Record(robot, fault) => self.invalid(Some(robot), fault),
            Refusal::Clock(BrokenAt { robot, line }) => Invalid {
                line,
                ..self.invalid(Some(robot), BrokenAt::fault())
            },
        }
    }

    fn invalid(&self, robot: Option<String>, fault: Fault) -> Invalid {
        Invalid {
            log: self.records.name().to_owned(),
            line: self.records.line(),
            robot,
            fault: Box::new(fault),
        }
    }
}

/// All robots of the logs, and what has been on the air between them.
struct LoggedRobots {
    monitor: Monitor,
    crossings: Crossings,
    crossing: Crossing,
    robots: BTreeMap<String, Follow>,
    /// The messages that were sent, each with its kind and octets.
    sent: HashSet<Vec<u8>>,
    /// By which robot a station id is or was used.
    stations: HashMap<StationId, String>,
    /// Robots whose newest run is not over.
    running: BTreeSet<String>,
    validated: Validated,
}

impl Default for LoggedRobots {
    fn default() -> Self {
        Self {
            // Logs are merged by cause and effect, not by true time; that is for each log's own clock.
            monitor: Monitor::new(false),
            crossings: Crossings::default(),
            crossing: Crossing::default(),
            robots: BTreeMap::new(),
            sent: HashSet::new(),
            stations: HashMap::new(),
            running: BTreeSet::new(),
            validated: Validated::default(),
        }
    }
}

impl LoggedRobots {
    /// The log whose next record is taken: the earliest log that need not wait for another one. If each log waits, it is the
    /// earliest log that waits for a station without a log, which may be a stranger; or else the earliest log. `None` when all logs
    /// are at their ends.
    fn choose(&self, cursors: &[Cursor]) -> Option<usize> {
        let with_head = || (0..cursors.len()).filter(|&i| cursors[i].head.is_some());
        let earliest = |i: &usize| cursors[*i].unix_us();
        let alone = with_head().nth(1).is_none();
        let ready = with_head().filter(|&i| alone || !self.must_wait(cursors, i));
        let is_of_stranger = |i: &usize| {
            let record = cursors[*i].head.as_ref();
            record.is_some_and(|it| matches!(it.entry, Entry::Heard { from, .. } if !self.stations.contains_key(&from)))
        };
        ready
            .min_by_key(earliest)
            .or_else(|| with_head().filter(is_of_stranger).min_by_key(earliest))
            .or_else(|| with_head().min_by_key(earliest))
    }

    /// Whether another log may still bring what the next record of this one needs.
    fn must_wait(&self, cursors: &[Cursor], i: usize) -> bool {
        let Some(record) = &cursors[i].head else {
            return false;
        };
        match &record.entry {
            Entry::Heard { octets, .. } => !self.sent.contains(octets),
            // The run before of the same robot, in another log, comes first.
            Entry::Started { .. } => {
                let others = cursors.iter().enumerate().filter(|(other, _)| *other != i);
                let before = |cursor: &Cursor| cursor.robots.contains(&record.robot);
                self.running.contains(&record.robot)
                    && others
                        .into_iter()
                        .any(|(_, cursor)| cursor.head.is_some() && before(cursor))
            }
            _ => false,
        }
    }

    fn take(
        &mut self,
        record: Record,
        clock: &mut SharedClock,
        line: usize,
        unix_us: u64,
    ) -> Result<(), Refusal> {
        self.validated.records += 1;
        let Record {
            at_us,
            robot,
            entry,
        } = record;
        if let Entry::Started { unix_ms, speed, .. } = entry {
            clock.show(at_us, unix_ms).map_err(Refusal::Clock)?;
            self.crossing.start(&robot, speed.unwrap_or(1.0));
        }
        let crossed = self.robots.get(&robot).map_or(Ok(()), |follow| {
            let known = (&follow.config, &follow.identifiers);
            self.crossing.take(&robot, unix_us, &entry, known)
        });
        let deed = match self.take_entry(&robot, at_us, entry) {
            Ok(deed) => deed,
            Err(fault) => return Err(Refusal::Record(robot, fault)),
        };
        if let Some(deed) = deed {
            let judged = clock.take(at_us, &robot, line, deed);
            judged.map_err(Refusal::Clock)?;
        }
        // A fault in the record itself goes before.
        crossed.map_err(|fault| Refusal::Record(robot, fault))
    }

    /// Takes in an entry. Returns what the judge of the robots of a clock needs of it.
    fn take_entry(
        &mut self,
        robot: &str,
        at_us: u64,
        entry: Entry,
    ) -> Result<Option<ClockEntry>, Fault> {
        if let Entry::Started { .. } = entry {
            self.start(robot, at_us, entry)?;
            let started = &self.robots[robot];
            return Ok(Some(ClockEntry::Boot {
                robot: Box::new(started.robot.clone()),
                effect_us: u64::from(started.config.settings().t_safety.0) * 1_000,
            }));
        }
        let follow = self.robots.get_mut(robot).ok_or(Fault::NotStarted)?;
        follow.time.tick(at_us)?;
        match entry {
            Entry::Started { .. }
            | Entry::Zone(_)
            | Entry::People(_)
            | Entry::Around(_)
            | Entry::Channel(_)
            | Entry::Clock(_)
            | Entry::Hindered { .. } => Ok(None),
            Entry::Step {
                input,
                outputs,
                state,
            } => {
                self.validated.steps += 1;
                self.crossings.told(&follow.robot, input, &mut self.monitor);
                let late_us = follow.step(input, &outputs, &state)?;
                if let Some(late_us) = late_us {
                    self.validated.late.count(late_us);
                }
                if let Input::Local(Event::IdentityChanged(station, _)) = input {
                    self.stations.insert(station, robot.to_owned());
                }
                let broken = self.monitor.step(follow.place, input, &outputs, &state);
                let broken =
                    broken.or_else(|| self.crossings.shown(&outputs, &state, &mut self.monitor));
                let overdue_us = follow.time.overdue_us(follow.robot.next_due());
                match broken {
                    Some(broken) => Err(Fault::Broken(broken)),
                    None => Ok(Some(ClockEntry::Step {
                        after: state,
                        is_late: late_us.is_some(),
                        overdue_us,
                    })),
                }
            }
            Entry::Sent {
                message, octets, ..
            } => {
                self.validated.sent += 1;
                follow.sent(message, &octets)?;
                self.sent.insert(octets);
                Ok(None)
            }
            Entry::Heard {
                message,
                from,
                reception,
                octets,
            } => {
                follow.heard(message, from, reception, &octets)?;
                self.validated.of_unknown_age += usize::from(reception.is_none());
                self.match_reception(robot, (message, from), &octets)
                    .map(|()| None)
            }
            Entry::Dropped { cause, .. } => {
                follow.dropped(&cause);
                Ok(None)
            }
            Entry::Unrecorded { counters } => {
                follow.unrecorded(&counters);
                Ok(None)
            }
            Entry::Stopped { counters } => {
                self.validated.missing += follow.stopped(&counters)?;
                self.running.remove(robot);
                self.monitor.crash(follow.place);
                Ok(Some(ClockEntry::Stop))
            }
        }
    }

    fn start(&mut self, robot: &str, at_us: u64, entry: Entry) -> Result<(), Fault> {
        let Entry::Started {
            station,
            boot,
            epoch,
            settings,
            identifiers,
            ..
        } = entry
        else {
            return Ok(());
        };
        let before = self.robots.get(robot);
        if before.is_some_and(|before| !before.may_reboot_with(boot)) {
            return Err(Fault::BootReused(boot));
        }
        let place = match before {
            Some(before) => before.place,
            None => self.monitor.add(station),
        };
        let follow = Follow::started(place, at_us, station, (boot, epoch), *settings, identifiers)?;
        self.monitor.boot(place, &follow.robot, &follow.config);
        self.stations.insert(station, robot.to_owned());
        self.running.insert(robot.to_owned());
        self.robots.insert(robot.to_owned(), follow);
        Ok(())
    }

    /// A reception must match a transmission, if a log of the sender should have it.
    fn match_reception(
        &mut self,
        robot: &str,
        (message, from): (Service, StationId),
        octets: &[u8],
    ) -> Result<(), Fault> {
        if self.sent.contains(octets) {
            self.validated.heard += 1;
            return Ok(());
        }
        // Such messages change nothing in the protocol, and a unit beside a robot may send them in its name.
        if !matches!(message, Service::Ram | Service::Rmcm) {
            self.validated.from_strangers += 1;
            return Ok(());
        }
        match self.stations.get(&from) {
            None => {
                self.validated.from_strangers += 1;
                self.monitor.has_strangers();
                Ok(())
            }
            // A robot does not hear itself: a stranger speaks in its name, and the protocol ignores it.
            Some(sender) if sender == robot => {
                self.validated.from_strangers += 1;
                Ok(())
            }
            // It may have booted again since.
            Some(sender) if self.validated.cut_off.contains(sender) => {
                self.validated.beyond_logs += 1;
                self.monitor.has_strangers();
                Ok(())
            }
            Some(_) => Err(Fault::NoTransmission(from)),
        }
    }

    /// A log is at its end: robots of it that run on are cut off.
    fn end(&mut self, cursor: &Cursor) {
        for robot in cursor.robots.intersection(&self.running) {
            self.crossing.forget(robot);
            self.validated.cut_off.push(robot.clone());
        }
    }

    fn finish<'a>(self, clocks: impl Iterator<Item = &'a SharedClock>) -> Validated {
        let met = self.monitor.premises_met();
        let mut properties: Vec<_> = met.map(|id| id.to_string()).collect();
        let verdicts: Vec<_> = clocks.map(SharedClock::verdict).collect();
        let i10 = PropertyId::I10.name();
        if verdicts.iter().any(Result::is_ok) {
            properties.push(i10.to_owned());
        }
        let reasons: BTreeSet<_> = verdicts.into_iter().filter_map(Result::err).collect();
        let reasons = reasons.into_iter().map(|why| format!("{i10}: {why}"));
        Validated {
            robots: self.robots.len(),
            properties,
            not_judged: reasons.collect(),
            crossing: self.crossing.verdict(),
            ..self.validated
        }
    }
}

#[cfg(all(test, feature = "full"))]
mod tests;
