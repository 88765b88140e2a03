//! What `crossguard run` writes, from threads of their own: nobody who does not read holds the robot up.

use std::io::{ErrorKind, Stdout, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError};
use std::sync::mpsc::{channel, sync_channel};
use std::time::Duration;

use crossguard_endpoint::cause::Cause;
use crossguard_robot::journal::{self, Journal, RECORDS, WhenFull};
use crossguard_robot::trace::{self, LogFile, LogLimits, Record};

use super::super::screen::Screen;
use super::super::{Failure, complain};

/// How many lines for people wait for their reader.
const LINES: usize = 1_024;

/// How long the end of the program waits for what is still to be written.
const PATIENCE: Duration = Duration::from_secs(2);

/// Where a robot's records go.
pub(super) struct Outputs {
    pub(super) journal: Journal,
    /// Those for the console, which need not have all.
    pub(super) records: Receiver<Arc<Record>>,
    /// Where the console says something to people; nowhere, when standard output is the log.
    pub(super) lines: Option<Lines>,
    pub(super) writings: Writings,
}

impl Outputs {
    /// Opens a log file, if there is to be one, and standard output; what people read there stands above
    /// the status line of `screen`.
    pub(super) fn open(log: Option<&Path>, is_json: bool, screen: Screen) -> Result<Self, Failure> {
        let mut journal = Journal::new();
        let records = journal.reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
        let mut of_log = || journal.reader(RECORDS, WhenFull::End, Cause::LogFull);
        let mut writings = Vec::new();
        if let Some(path) = log {
            writings.push(Writing::to_file(path, of_log())?);
        }
        let mut lines = None;
        if is_json {
            writings.push(Writing::to_stdout(of_log()));
        } else {
            let (for_people, writing) = Lines::start(screen);
            lines = Some(for_people);
            writings.push(writing);
        }
        Ok(Self {
            journal,
            records,
            lines,
            writings: Writings(writings),
        })
    }
}

/// The threads that write.
pub(super) struct Writings(Vec<Writing>);

impl Writings {
    /// Waits until all is written, but not for a reader who does not read. `missing` records did not
    /// get into a log, by the robot's account.
    pub(super) fn finish(self, missing: u64) -> Result<(), Failure> {
        let finished: Vec<_> = self.0.into_iter().map(Writing::finish).collect();
        if missing > 0 {
            complain(format_args!(
                "a log ends before the robot did: its reader was too slow for {missing} records"
            ));
            return Err(Failure::Incomplete);
        }
        finished.into_iter().collect()
    }
}

/// A thread that writes what comes out of a queue.
struct Writing {
    /// What it writes to.
    name: String,
    result: Receiver<std::io::Result<()>>,
}

impl Writing {
    /// Writes records to a file.
    fn to_file(path: &Path, records: Receiver<Arc<Record>>) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let file = LogFile::create(path, LogLimits::default());
        let file = file.map_err(|error| Failure::Input(format!("{name}: {error}")))?;
        let write = |to: &mut LogFile, record: &Arc<Record>| to.write(record);
        Ok(Self::start(name, records, file, write, LogFile::flush))
    }

    /// Writes records to standard output.
    fn to_stdout(records: Receiver<Arc<Record>>) -> Self {
        let name = "standard output".to_owned();
        let write = |to: &mut Stdout, record: &Arc<Record>| trace::write(to, record);
        Self::start(name, records, std::io::stdout(), write, Stdout::flush)
    }

    fn start<T: Send + 'static, W: Send + 'static>(
        name: String,
        queue: Receiver<T>,
        mut to: W,
        write: impl Fn(&mut W, &T) -> std::io::Result<()> + Send + 'static,
        flush: impl Fn(&mut W) -> std::io::Result<()> + Send + 'static,
    ) -> Self {
        let (tell, result) = channel();
        let of_thread = name.clone();
        std::thread::spawn(move || {
            let result = journal::write_out(&queue, &mut to, write, flush);
            if let Err(error) = &result
                && error.kind() != ErrorKind::BrokenPipe
            {
                complain(format_args!(
                    "{of_thread}: {error}; the robot goes on, and nothing more is written there"
                ));
            }
            // Nobody may be left who wants to know.
            let _ = tell.send(result);
        });
        Self { name, result }
    }

    /// Waits until all is written, but not for a reader who does not read.
    fn finish(self) -> Result<(), Failure> {
        match self.result.recv_timeout(PATIENCE) {
            Ok(Ok(())) => Ok(()),
            // Who stops reading has had enough.
            Ok(Err(error)) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            Ok(Err(_)) | Err(RecvTimeoutError::Disconnected) => Err(Failure::Incomplete),
            Err(RecvTimeoutError::Timeout) => {
                let name = &self.name;
                complain(format_args!(
                    "{name} is not read; what was left for it is lost"
                ));
                Err(Failure::Incomplete)
            }
        }
    }
}

/// Lines for people on standard output. Lines that do not get through are counted, and that is said
/// when lines get through again.
pub(super) struct Lines {
    queue: SyncSender<String>,
    left_out: usize,
}

impl Lines {
    /// The lines, and the thread that writes them, which ends after this has been dropped.
    fn start(screen: Screen) -> (Self, Writing) {
        let (queue, lines) = sync_channel(LINES);
        let name = "standard output".to_owned();
        let write = move |_: &mut Stdout, line: &String| screen.say(line);
        let writing = Writing::start(name, lines, std::io::stdout(), write, Stdout::flush);
        let lines = Self { queue, left_out: 0 };
        (lines, writing)
    }

    pub(super) fn say(&mut self, line: impl Into<String>) {
        if self.left_out > 0 {
            let remark = format!("({} lines were not read in time)", self.left_out);
            match self.queue.try_send(remark) {
                Ok(()) | Err(TrySendError::Disconnected(_)) => self.left_out = 0,
                Err(TrySendError::Full(_)) => {}
            }
        }
        if let Err(TrySendError::Full(_)) = self.queue.try_send(line.into()) {
            self.left_out += 1;
        }
    }
}
