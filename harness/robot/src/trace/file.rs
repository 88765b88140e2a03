//! A log in files: linked line by line, never longer than it may be, and never written over an older one.
//!
//! ```text
//!   FILE      the newest part of the newest run
//!   FILE.1    the part before it, of the same run or of the run before
//!   FILE.2    …
//! ```

use std::fs::File;
use std::io::{self, BufReader, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use super::chain::{Chain, part_of};
use super::{Log, Record};
use crate::lines::{LineError, read_line};

/// How much of the disk logs of one name may take.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LogLimits {
    /// The longest file, in octets; 256 MiB by default, some minutes of a robot that is always busy. A record more may
    /// be in it.
    pub part_octets: u64,
    /// How many older files are kept beside the newest; 15 by default.
    pub older: u32,
}

impl Default for LogLimits {
    fn default() -> Self {
        Self {
            part_octets: 256 << 20,
            older: 15,
        }
    }
}

/// A log that is written.
#[derive(Debug)]
pub struct LogFile {
    path: PathBuf,
    limits: LogLimits,
    file: BufWriter<File>,
    chain: Chain,
    part: u32,
    /// Octets in this part.
    length: u64,
    line: Vec<u8>,
}

impl LogFile {
    /// A new log at `path`. A file that is there already, and not empty, is kept under another name.
    ///
    /// # Errors
    /// When it cannot be created, or the older ones cannot be given other names.
    pub fn create(path: &Path, limits: LogLimits) -> io::Result<Self> {
        // A pipe or device is no file with an older log in it.
        let is_older = match std::fs::metadata(path) {
            Ok(there) => there.is_file() && there.len() > 0,
            Err(_) => false,
        };
        if is_older {
            make_place(path, limits.older)?;
        }
        Ok(Self {
            path: path.to_owned(),
            limits,
            file: BufWriter::new(File::create(path)?),
            chain: Chain::default(),
            part: 1,
            length: 0,
            line: Vec::new(),
        })
    }

    /// Writes a record.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&mut self, record: &Record) -> io::Result<()> {
        if self.length >= self.limits.part_octets {
            self.begin_part()?;
        }
        self.line.clear();
        serde_json::to_writer(&mut self.line, record)?;
        let part = (self.length == 0).then_some(self.part);
        self.chain.link(&mut self.line, part);
        self.file.write_all(&self.line)?;
        self.length += self.line.len() as u64;
        Ok(())
    }

    /// Hands what was written to the operating system.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }

    fn begin_part(&mut self) -> io::Result<()> {
        self.file.flush()?;
        make_place(&self.path, self.limits.older)?;
        self.file = BufWriter::new(File::create_new(&self.path)?);
        self.part += 1;
        self.length = 0;
        Ok(())
    }
}

/// The name of an older file, 1 being the newest of them.
fn older(path: &Path, number: u32) -> PathBuf {
    path.with_added_extension(number.to_string())
}

/// Gives the file at `path` the next name, and the files that have it already theirs; the oldest goes.
fn make_place(path: &Path, kept: u32) -> io::Result<()> {
    let last = (1..=kept).find(|number| !older(path, *number).exists());
    for number in (1..=last.unwrap_or(kept)).rev() {
        let from = if number == 1 {
            path.to_owned()
        } else {
            older(path, number - 1)
        };
        std::fs::rename(from, older(path, number))?;
    }
    if kept == 0 {
        std::fs::remove_file(path)?;
    }
    Ok(())
}

/// Opens a log with all parts of its run.
///
/// # Errors
/// When a file cannot be read, or a part of the run is gone: which.
pub fn open(path: &Path) -> io::Result<Log<'static>> {
    let mut newest = BufReader::new(File::open(path)?);
    let first = read_line(&mut newest).map_err(|error| match error {
        LineError::Io(error) => error,
        error @ LineError::TooLong => io::Error::new(ErrorKind::InvalidData, error.to_string()),
    })?;
    let parts = part_of(&first).unwrap_or(1);
    let mut lines: Box<dyn Read> = Box::new(io::Cursor::new(first).chain(newest));
    for number in 1..parts {
        let part = older(path, number);
        let file = File::open(&part).map_err(|error| {
            let (name, of) = (part.display(), parts - number);
            io::Error::new(
                error.kind(),
                format!("{name}, with part {of} of the same run, cannot be read: {error}"),
            )
        })?;
        lines = Box::new(file.chain(lines));
    }
    Ok(Log {
        name: path.display().to_string(),
        lines: Box::new(BufReader::new(lines)),
    })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use crossguard_endpoint::counters::Counts;

    use super::*;
    use crate::trace::{Entry, Records, Unchained, Unreadable};

    fn record(at_us: u64) -> Record {
        let counters = Counts::default();
        Record {
            at_us,
            robot: "R1".to_owned(),
            entry: Entry::Stopped { counters },
        }
    }

    fn write(path: &Path, limits: LogLimits, times: std::ops::Range<u64>) {
        let mut log = LogFile::create(path, limits).unwrap();
        for at_us in times {
            log.write(&record(at_us)).unwrap();
        }
        log.flush().unwrap();
    }

    fn times(path: &Path) -> Result<Vec<u64>, Unreadable> {
        let mut records = Records::new(open(path).unwrap());
        let mut times = Vec::new();
        while let Some(record) = records.take()? {
            times.push(record.at_us);
        }
        Ok(times)
    }

    #[test]
    fn a_log_is_never_written_over_an_older_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.jsonl");
        let limits = LogLimits {
            older: 2,
            ..LogLimits::default()
        };
        for run in 0..5 {
            write(&path, limits, run..run + 1);
        }
        assert_eq!(times(&path).unwrap(), [4]);
        assert_eq!(times(&older(&path, 1)).unwrap(), [3]);
        assert_eq!(times(&older(&path, 2)).unwrap(), [2]);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
    }

    #[test]
    fn a_log_takes_no_more_of_the_disk_than_it_may() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.jsonl");
        let limits = LogLimits {
            part_octets: 2_000,
            older: 3,
        };
        write(&path, limits, 0..1_000);
        let files = fs::read_dir(folder.path()).unwrap();
        let lengths: Vec<_> = files
            .map(|it| it.unwrap().metadata().unwrap().len())
            .collect();
        assert_eq!(lengths.len(), 4);
        assert!(lengths.iter().all(|length| *length < 2_200), "{lengths:?}");
        let gone = open(&path).err().unwrap().to_string();
        assert!(gone.contains("r.jsonl.4, with part"), "{gone}");
    }

    #[test]
    fn the_parts_of_a_run_are_read_as_one_log_and_a_missing_piece_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.jsonl");
        let limits = LogLimits {
            part_octets: 2_000,
            older: 20,
        };
        // Of the run before, which is not read along.
        write(&path, limits, 7_000..7_001);
        write(&path, limits, 0..60);
        assert!(older(&path, 3).exists());
        assert!(times(&path).unwrap().into_iter().eq(0..60));
        let second = fs::read_to_string(older(&path, 1)).unwrap();
        let without: Vec<_> = second
            .lines()
            .skip(1)
            .map(|line| format!("{line}\n"))
            .collect();
        fs::write(older(&path, 1), without.concat()).unwrap();
        let found = times(&path);
        assert!(
            matches!(found, Err(Unreadable::Unchained(Unchained::Gap))),
            "{found:?}"
        );
        fs::remove_file(older(&path, 1)).unwrap();
        let gone = open(&path).err().unwrap();
        assert_eq!(gone.kind(), ErrorKind::NotFound);
    }
}
