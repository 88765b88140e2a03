//! Logs that grow: whole lines are taken as they come, and a file that is cut short or replaced is read anew.

use std::fs::{File, Metadata};
use std::io::{Read, Seek, SeekFrom};
use std::os::unix::fs::MetadataExt as _;
use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use crossguard_robot::trace::{Lines, Timed};

/// The most that is read of a log at once, in octets: a log of hours is read on while pages are served.
const READ_MAX: u64 = 4 << 20;

/// The longest line that is waited for, in octets.
const REST_MAX: usize = 1 << 20;

/// A log that may grow.
pub(super) struct Tail {
    path: PathBuf,
    place: usize,
    file: Option<File>,
    /// How far it has been read, and what of it is no whole line yet.
    read: u64,
    rest: Vec<u8>,
    lines: Lines,
    /// How it is with the log.
    pub(super) state: TailState,
    /// How often it began anew.
    pub(super) restarts: u32,
}

/// How it is with a log.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum TailState {
    /// It is not there yet, or not any more.
    Missing(String),
    /// It is read as it grows.
    Followed,
    /// A line of it cannot be read, and nothing after it is.
    Broken(String),
}

/// Records since the last look.
pub(super) struct Taken {
    pub(super) records: Vec<Timed>,
    /// How long ago it was written, as far as the file says.
    pub(super) age: Duration,
    /// Whether there is more to be read at once.
    pub(super) has_more: bool,
}

impl Tail {
    /// Of the log in this file, which is the one at this place of all.
    pub(super) fn new(path: PathBuf, place: usize) -> Self {
        Self {
            path,
            place,
            file: None,
            read: 0,
            rest: Vec::new(),
            lines: Lines::default(),
            state: TailState::Missing("nobody has looked yet".to_owned()),
            restarts: 0,
        }
    }

    /// Takes what has been written since the last time.
    pub(super) fn take(&mut self) -> Taken {
        match self.grow() {
            Ok((whole_lines, age, has_more)) => Taken {
                records: self.parse(&whole_lines),
                age,
                has_more,
            },
            Err(cause) => {
                self.file = None;
                self.state = TailState::Missing(cause.to_string());
                Taken {
                    records: Vec::new(),
                    age: Duration::ZERO,
                    has_more: false,
                }
            }
        }
    }

    /// Reads on. The whole lines that came, how long ago the file was written, and whether there is more.
    fn grow(&mut self) -> std::io::Result<(Vec<u8>, Duration, bool)> {
        let named = std::fs::metadata(&self.path)?;
        // To open a pipe would wait for somebody who writes.
        if !named.is_file() {
            return Err(std::io::Error::other("it is no regular file"));
        }
        let is_other = match &self.file {
            Some(file) => !is_same(&named, &file.metadata()?) || named.len() < self.read,
            None => self.read > 0,
        };
        if is_other {
            self.begin_anew();
        }
        if self.file.is_none() {
            self.file = Some(File::open(&self.path)?);
            self.state = TailState::Followed;
        }
        let Some(file) = &mut self.file else {
            return Ok((Vec::new(), Duration::ZERO, false));
        };
        file.seek(SeekFrom::Start(self.read))?;
        let before = self.rest.len();
        let read = file.take(READ_MAX).read_to_end(&mut self.rest)?;
        self.read += read as u64;
        let written = named.modified().unwrap_or_else(|_| SystemTime::now());
        let age = written.elapsed().unwrap_or_default();
        let end = self.rest[before..]
            .iter()
            .rposition(|octet| *octet == b'\n');
        let whole = end.map_or(0, |end| before + end + 1);
        let rest = self.rest.split_off(whole);
        let lines = std::mem::replace(&mut self.rest, rest);
        if self.rest.len() > REST_MAX {
            self.state = TailState::Broken("a line of it has no end".to_owned());
            self.rest.clear();
        }
        Ok((lines, age, read as u64 == READ_MAX))
    }

    fn begin_anew(&mut self) {
        self.restarts += 1;
        self.file = None;
        self.read = 0;
        self.rest.clear();
        self.lines = Lines::default();
        self.state = TailState::Followed;
    }

    fn parse(&mut self, whole_lines: &[u8]) -> Vec<Timed> {
        let mut taken = Vec::new();
        for line in whole_lines.split_inclusive(|octet| *octet == b'\n') {
            if matches!(self.state, TailState::Broken(_)) {
                break;
            }
            match self.lines.record(line) {
                Ok(record) => taken.extend(record.map(|record| Timed {
                    log: self.place,
                    at_us: self.lines.unix_us(&record),
                    record,
                })),
                Err(cause) => {
                    let line = self.lines.line();
                    self.state = TailState::Broken(format!("line {line}: {cause}"));
                }
            }
        }
        taken
    }
}

fn is_same(one: &Metadata, other: &Metadata) -> bool {
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

#[cfg(test)]
mod tests {
    use std::fs::OpenOptions;
    use std::io::Write as _;

    use super::*;

    /// A record as robots write it.
    fn line(at_us: u64) -> String {
        format!(
            "{{\"atUs\":{at_us},\"robot\":\"ARI\",\"entry\":\"dropped\",\"layer\":\"syntax\",\"cause\":\"malformed\",\"detail\":\"\",\"octets\":\"\"}}\n"
        )
    }

    #[test]
    fn whole_lines_are_taken_as_they_come_and_a_new_file_is_read_from_its_start() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log.jsonl");
        let mut tail = Tail::new(path.clone(), 0);
        assert!(tail.take().records.is_empty());
        assert!(matches!(tail.state, TailState::Missing(_)));
        let mut device = Tail::new("/dev/zero".into(), 0);
        assert!(device.take().records.is_empty() && device.read == 0);

        let mut file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(&path)
            .unwrap();
        let second = line(2);
        let (half, other_half) = second.split_at(30);
        file.write_all((line(1) + half).as_bytes()).unwrap();
        assert_eq!(tail.take().records.len(), 1);
        assert_eq!(tail.take().records.len(), 0);
        file.write_all((other_half.to_owned() + &line(3)).as_bytes())
            .unwrap();
        let taken = tail.take().records;
        assert_eq!(
            taken.iter().map(|it| it.record.at_us).collect::<Vec<_>>(),
            [2, 3]
        );
        assert_eq!(tail.state, TailState::Followed);

        std::fs::write(&path, line(7)).unwrap();
        assert_eq!(tail.take().records[0].record.at_us, 7);
        assert_eq!(tail.restarts, 1);

        std::fs::remove_file(&path).unwrap();
        assert!(tail.take().records.is_empty());
        assert!(matches!(tail.state, TailState::Missing(_)));
        std::fs::write(&path, line(8) + &line(9)).unwrap();
        assert_eq!(tail.take().records.len(), 2);
        assert_eq!(tail.restarts, 2);
    }

    #[test]
    fn a_line_that_is_no_record_ends_it_with_its_number() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log.jsonl");
        std::fs::write(&path, line(1) + "nonsense\n" + &line(3)).unwrap();
        let mut tail = Tail::new(path, 0);
        assert_eq!(tail.take().records.len(), 1);
        let TailState::Broken(cause) = &tail.state else {
            panic!("{:?}", tail.state);
        };
        assert!(cause.starts_with("line 2: "), "{cause}");
    }
}
