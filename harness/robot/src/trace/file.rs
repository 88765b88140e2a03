//! A log in a file: never longer than it may be, and never written over an older one.
//!
//! ```text
//!   FILE      the newest run
//!   FILE.1    the run before it
//!   FILE.2    …
//! ```

use std::fs::File;
use std::io::{self, BufReader, BufWriter, ErrorKind, Write};
use std::os::unix::fs::FileTypeExt as _;
use std::path::{Path, PathBuf};

use super::{Log, Record};
use crate::files::Unfit;

/// How much of the disk logs of one name may take.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LogLimits {
    /// The longest file, in octets; 1 GiB by default, more than a quarter of an hour of a robot that is always busy. A
    /// record more may be in it.
    pub octets: u64,
    /// How many older files are kept beside the newest; 15 by default.
    pub older: u32,
}

impl Default for LogLimits {
    fn default() -> Self {
        Self {
            octets: 1 << 30,
            older: 15,
        }
    }
}

/// A log that is written.
#[derive(Debug)]
pub struct LogFile {
    file: BufWriter<File>,
    /// How many octets may still be written.
    left: u64,
    line: Vec<u8>,
}

impl LogFile {
    /// A new log at `path`. A file that is there already, and not empty, is kept under another name.
    ///
    /// # Errors
    /// When it is a FIFO, it cannot be created, or the older ones cannot be given other names.
    pub fn create(path: &Path, limits: LogLimits) -> io::Result<Self> {
        // A device is no file with an older log in it, and to open a FIFO could wait for its reader.
        let is_older = match std::fs::metadata(path) {
            Ok(there) if there.file_type().is_fifo() => return Err(Unfit::Kind("a FIFO").into()),
            Ok(there) => there.is_file() && there.len() > 0,
            Err(_) => false,
        };
        if is_older {
            make_place(path, limits.older)?;
        }
        Ok(Self {
            file: BufWriter::new(File::create(path)?),
            left: limits.octets,
            line: Vec::new(),
        })
    }

    /// Writes a record.
    ///
    /// # Errors
    /// When it cannot be written, or the file is as long as it may be.
    pub fn write(&mut self, record: &Record) -> io::Result<()> {
        if self.left == 0 {
            let full = "the log is as long as it may be";
            return Err(io::Error::new(ErrorKind::FileTooLarge, full));
        }
        self.line.clear();
        super::write(&mut self.line, record)?;
        self.file.write_all(&self.line)?;
        self.left = self.left.saturating_sub(self.line.len() as u64);
        Ok(())
    }

    /// Hands what was written to the operating system.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
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

/// Opens a log.
///
/// # Errors
/// When the file cannot be read.
pub fn open(path: &Path) -> io::Result<Log<'static>> {
    let lines = BufReader::new(File::open(path)?);
    Ok(Log::new(path.display().to_string(), lines))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::trace::{Records, Unreadable};

    fn write(path: &Path, limits: LogLimits, times: std::ops::Range<u64>) {
        let mut log = LogFile::create(path, limits).unwrap();
        for at_us in times {
            log.write(&Record::stopped("R1", at_us)).unwrap();
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
    fn a_log_in_a_fifo_is_refused_and_its_reader_not_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.jsonl");
        nix::unistd::mkfifo(&path, nix::sys::stat::Mode::S_IRWXU).unwrap();
        let (tell, refused) = std::sync::mpsc::channel();
        let create = move || LogFile::create(&path, LogLimits::default()).err();
        std::thread::spawn(move || tell.send(create()));
        let error = refused.recv_timeout(std::time::Duration::from_secs(30));
        assert_eq!(error.unwrap().unwrap().to_string(), "is a FIFO, not a file");
    }

    #[test]
    fn a_log_ends_before_it_takes_more_of_the_disk_than_it_may() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.jsonl");
        let limits = LogLimits {
            octets: 2_000,
            older: 3,
        };
        let mut log = LogFile::create(&path, limits).unwrap();
        let written =
            (0..1_000).take_while(|at_us| log.write(&Record::stopped("R1", *at_us)).is_ok());
        let written = written.count() as u64;
        assert_eq!(
            log.write(&Record::stopped("R1", written))
                .unwrap_err()
                .kind(),
            ErrorKind::FileTooLarge
        );
        drop(log);
        let length = fs::metadata(&path).unwrap().len();
        assert!((2_000..2_200).contains(&length), "{length}");
        // It is valid up to its end.
        assert!(times(&path).unwrap().into_iter().eq(0..written));
    }
}
