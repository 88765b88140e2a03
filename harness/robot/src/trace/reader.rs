//! Reading logs: record by record, and those of several robots as one.

use std::collections::BTreeMap;
use std::io::BufRead;

use super::{Entry, Record};
use crate::lines::{LineError, read_line};
use crate::perception;

/// How long a record is held back for one that is late in its log, in µs.
pub const HELD_US: u64 = 1_000_000;

/// By how much two robots that share a clock may disagree about when that showed 0, in µs.
pub const SAME_CLOCK_US: u128 = 10_000;

/// A log to be read.
pub struct Log<'a> {
    /// Its name in messages.
    pub name: String,
    /// Its lines.
    pub lines: Box<dyn BufRead + 'a>,
}

impl<'a> Log<'a> {
    /// A log of this name.
    pub fn new(name: impl Into<String>, lines: impl BufRead + 'a) -> Self {
        let (name, lines) = (name.into(), Box::new(lines));
        Self { name, lines }
    }
}

/// Why a log cannot be read on.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// A line cannot be read.
    #[error(transparent)]
    Line(#[from] LineError),
    /// It holds nothing.
    #[error("there is nothing in this log")]
    Empty,
    /// Its first line is what a sensor saw.
    #[error(
        "is a frame of a sensor, and no record: this file is for --perceived; give the logs alone"
    )]
    Frames,
    /// A line is no record.
    #[error("is not a record: {0}")]
    NotARecord(serde_json::Error),
}

/// Which log cannot be read on, and where.
#[derive(Debug, thiserror::Error)]
#[error("{log}, line {line}: {cause}")]
pub struct LogError {
    /// The log.
    pub log: String,
    /// The line in it, counted from 1.
    pub line: usize,
    /// Why.
    pub cause: Unreadable,
}

/// The records of a log, one after the other.
pub struct Records<'a> {
    log: Log<'a>,
    lines: Lines,
}

impl<'a> Records<'a> {
    /// The records of `log`.
    #[must_use]
    pub fn new(log: Log<'a>) -> Self {
        let lines = Lines::default();
        Self { log, lines }
    }

    /// Name of the log.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.log.name
    }

    /// The line of the record that was taken last, counted from 1.
    #[must_use]
    pub const fn line(&self) -> usize {
        self.lines.line
    }

    /// Takes the next record; `None` at the end. A last line without an end that is no record was cut
    /// off when the robot was killed, and is no error.
    ///
    /// # Errors
    /// When the file cannot be read, is empty, or a line is no record.
    pub fn take(&mut self) -> Result<Option<Record>, Unreadable> {
        let text = read_line(&mut self.log.lines)?;
        self.lines.record(&text)
    }

    /// When a record was written, in microseconds since 1970 by the clock of the robot's machine.
    #[must_use]
    pub fn unix_us(&self, record: &Record) -> u64 {
        self.lines.unix_us(record)
    }
}

/// The lines of a log so far, and its clock.
#[derive(Debug, Default)]
pub struct Lines {
    line: usize,
    /// When the log's clock showed 0, in µs since 1970, as far as is known.
    began_us: Option<i128>,
    at_us: u64,
}

impl Lines {
    /// How many lines there were.
    #[must_use]
    pub const fn line(&self) -> usize {
        self.line
    }

    /// The record in the next line; `None` in an empty text, which is the end, and in a last line that was cut off.
    ///
    /// # Errors
    /// The log is empty, or the line is no record.
    pub fn record(&mut self, text: &[u8]) -> Result<Option<Record>, Unreadable> {
        self.line += 1;
        if text.is_empty() {
            return match self.line {
                1 => Err(Unreadable::Empty),
                _ => Ok(None),
            };
        }
        let record = match serde_json::from_slice::<Record>(text) {
            Ok(record) => record,
            Err(_) if !text.ends_with(b"\n") && self.line > 1 => return Ok(None),
            Err(_)
                if self.line == 1 && perception::parse(&String::from_utf8_lossy(text)).is_ok() =>
            {
                return Err(Unreadable::Frames);
            }
            Err(cause) => return Err(Unreadable::NotARecord(cause)),
        };
        self.follow_clock(&record);
        Ok(Some(record))
    }

    /// All records of a file have one clock, unless it goes back: then another run was appended. Robots that
    /// share a log begin at their own moments, so that the first record of one may be somewhat late in it.
    fn follow_clock(&mut self, record: &Record) {
        if let Entry::Started { unix_ms, .. } = record.entry {
            let began_us = i128::from(unix_ms) * 1_000 - i128::from(record.at_us);
            let is_of_another = |known: i128| {
                record.at_us < self.at_us && (known - began_us).unsigned_abs() > SAME_CLOCK_US
            };
            if self.began_us.is_none_or(is_of_another) {
                self.began_us = Some(began_us);
            }
        }
        self.at_us = record.at_us;
    }

    /// When a record was written, in microseconds since 1970 by the clock of the robot's machine.
    #[must_use]
    pub fn unix_us(&self, record: &Record) -> u64 {
        let at_us = self.began_us.unwrap_or(0) + i128::from(record.at_us);
        u64::try_from(at_us).unwrap_or(0)
    }
}

/// The records of several logs in the order of time, as the clocks of their machines tell it.
///
/// Clocks of different machines are not corrected: where they are apart, a message may be heard before
/// it is sent. `validate` of `crossguard-judge` orders by cause and effect instead.
///
/// Robots that share a log write it from threads of their own, so that a record may be a moment late in it:
/// for that each is held back for a second of the logs' time.
pub struct Merged<'a> {
    sources: Vec<OpenLog<'a>>,
    /// Records that are held back, by time and by the order of reading, each with the number of its log.
    held: BTreeMap<(u64, u64), (usize, Record)>,
    read: u64,
    newest_us: u64,
    /// Why a log cannot be read on, until that is told: the record before comes first.
    failed: Option<LogError>,
}

/// A record of one of several logs.
#[derive(Debug)]
pub struct Timed {
    /// Which log, in the order in which they were given.
    pub log: usize,
    /// When, in microseconds since 1970 by the clock of the robot's machine.
    pub at_us: u64,
    /// The record.
    pub record: Record,
}

struct OpenLog<'a> {
    records: Records<'a>,
    /// The next record, with its time.
    head: Option<(u64, Record)>,
}

impl OpenLog<'_> {
    fn advance(&mut self) -> Result<(), LogError> {
        let taken = self.records.take().map_err(|cause| LogError {
            log: self.records.name().to_owned(),
            line: self.records.line(),
            cause,
        })?;
        self.head = taken.map(|record| (self.records.unix_us(&record), record));
        Ok(())
    }
}

impl<'a> Merged<'a> {
    /// The records of `logs`.
    ///
    /// # Errors
    /// Which log cannot be read, and why.
    pub fn new(logs: Vec<Log<'a>>) -> Result<Self, LogError> {
        let mut sources = Vec::new();
        for log in logs {
            let records = Records::new(log);
            let mut source = OpenLog {
                records,
                head: None,
            };
            source.advance()?;
            sources.push(source);
        }
        Ok(Self {
            sources,
            held: BTreeMap::new(),
            read: 0,
            newest_us: 0,
            failed: None,
        })
    }

    /// Takes the next record; `None` at the end of all. After an error, it goes on with what was read before it and
    /// with the other logs.
    ///
    /// # Errors
    /// Which log cannot be read on, in which line, and why.
    pub fn take(&mut self) -> Result<Option<Timed>, LogError> {
        while let Some(Timed { log, at_us, record }) = self.read()? {
            self.newest_us = self.newest_us.max(at_us);
            self.held.insert((at_us, self.read), (log, record));
            self.read += 1;
            let is_due = |at_us: u64| at_us.saturating_add(HELD_US) <= self.newest_us;
            if self
                .held
                .first_key_value()
                .is_some_and(|(key, _)| is_due(key.0))
            {
                break;
            }
        }
        let first = self.held.pop_first();
        Ok(first.map(|((at_us, _), (log, record))| Timed { log, at_us, record }))
    }

    /// Reads the next record of the log whose next is the earliest.
    fn read(&mut self) -> Result<Option<Timed>, LogError> {
        if let Some(error) = self.failed.take() {
            return Err(error);
        }
        let heads = self.sources.iter_mut().enumerate();
        let with_head = heads.filter(|(_, source)| source.head.is_some());
        let earliest =
            with_head.min_by_key(|(_, source)| source.head.as_ref().map(|(at_us, _)| *at_us));
        let Some((log, source)) = earliest else {
            return Ok(None);
        };
        let taken = source.head.take();
        self.failed = source.advance().err();
        Ok(taken.map(|(at_us, record)| Timed { log, at_us, record }))
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::{Config, StationId};

    use super::*;
    use crate::trace::write;

    fn started(robot: &str, at_us: u64, unix_ms: u64) -> Record {
        Record {
            at_us,
            robot: robot.to_owned(),
            entry: Entry::Started {
                station: StationId(1),
                boot: 1,
                epoch: None,
                settings: Box::new(Config::default().settings().clone()),
                identifiers: crossguard_codec::Identifiers::default(),
                unix_ms,
                speed: None,
            },
        }
    }

    fn log(records: &[Record]) -> Log<'static> {
        let mut text = Vec::new();
        for record in records {
            write(&mut text, record).unwrap();
        }
        Log::new("some.jsonl", std::io::Cursor::new(text))
    }

    fn times(logs: Vec<Log<'static>>) -> Vec<(u64, String)> {
        let mut merged = Merged::new(logs).unwrap();
        std::iter::from_fn(|| merged.take().unwrap())
            .map(|it| (it.at_us, it.record.robot))
            .collect()
    }

    #[test]
    fn logs_of_different_clocks_are_merged_by_the_time_of_day() {
        let ari = log(&[started("ARI", 5_000, 1_000), Record::stopped("ARI", 25_000)]);
        let go2 = log(&[
            started("Go2", 70_000, 1_010),
            Record::stopped("Go2", 71_000),
        ]);
        let (a, g) = ("ARI".to_owned(), "Go2".to_owned());
        let expected = vec![
            (1_000_000, a.clone()),
            (1_010_000, g.clone()),
            (1_011_000, g),
            (1_020_000, a),
        ];
        assert_eq!(times(vec![ari, go2]), expected);
    }

    #[test]
    fn two_robots_on_one_clock_stay_on_it_and_an_appended_run_has_its_own() {
        let log = log(&[
            started("ARI", 10, 1_000),
            started("Go2", 400, 1_001),
            Record::stopped("ARI", 500),
            started("ARI", 0, 9_000),
        ]);
        let times: Vec<_> = times(vec![log])
            .into_iter()
            .map(|(at_us, _)| at_us)
            .collect();
        assert_eq!(times, [1_000_000, 1_000_390, 1_000_490, 9_000_000]);
    }

    #[test]
    fn a_record_that_is_late_in_its_log_is_put_where_it_belongs() {
        let log = log(&[
            started("ARI", 0, 1_000),
            started("Go2", 30, 1_000),
            Record::stopped("ARI", 20),
            Record::stopped("Go2", 3_000_000),
        ]);
        let names: Vec<_> = times(vec![log]).into_iter().map(|(_, name)| name).collect();
        assert_eq!(names, ["ARI", "ARI", "Go2", "Go2"]);
    }

    #[test]
    fn a_line_that_is_no_record_is_named_and_a_last_one_was_cut_off() {
        let text = |tail: &str| {
            let mut text = Vec::new();
            write(&mut text, &started("ARI", 0, 0)).unwrap();
            text.extend(tail.as_bytes());
            Merged::new(vec![Log::new("a", std::io::Cursor::new(text))]).unwrap()
        };
        let mut cut_off = text("{\"atUs\":5,\"rob");
        assert!(cut_off.take().unwrap().is_some());
        assert!(cut_off.take().unwrap().is_none());
        let mut broken = text("nonsense\n");
        let error = broken.take().unwrap_err().to_string();
        assert!(error.starts_with("a, line 2: is not a record"), "{error}");
        assert_eq!(broken.take().unwrap().unwrap().record.robot, "ARI");
        assert!(broken.take().unwrap().is_none());
        let frames = br#"{"at_s": 0.0, "people": []}"#.as_slice();
        let frames = Merged::new(vec![Log::new("people.jsonl", frames)]).err();
        let error = frames.unwrap().to_string();
        assert!(error.contains("is a frame of a sensor"), "{error}");
        let empty = Merged::new(vec![log(&[])]).err().unwrap().to_string();
        assert_eq!(empty, "some.jsonl, line 1: there is nothing in this log");
    }
}
