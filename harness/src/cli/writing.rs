//! Output by threads of their own: a reader that does not read holds up nothing else, nor the hearing of signals.

use std::io::{ErrorKind, Write, stderr};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError};
use std::sync::mpsc::{channel, sync_channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crossguard_robot::journal;

use super::Failure;
use super::printable::Printable;

/// How many lines for people wait for their reader.
const LINES: usize = 1_024;

/// How long the end of the program waits for what is still to be written.
const PATIENCE: Duration = Duration::from_secs(2);

/// Queue and thread of standard error, from the start of the program to its end.
static TOLD: Mutex<Option<(Lines, Writing)>> = Mutex::new(None);

/// Complaints are told on standard error until this is dropped.
pub(super) struct Complaints(());

impl Complaints {
    /// Panics are complaints as well: where standard error is not read, the hook of the standard library keeps a thread
    /// that panics from halting its body.
    pub(super) fn begin() -> Self {
        let write = |line: &str| {
            let _ = stderr().write_all(line.as_bytes());
            Ok(())
        };
        *told() = Some(Lines::start("standard error", write));
        std::panic::set_hook(Box::new(|panic| complain(panic)));
        Self(())
    }
}

impl Drop for Complaints {
    /// Waits until standard error has what was told, but not for a reader who does not read.
    fn drop(&mut self) {
        let told = told().take();
        if let Some((lines, writing)) = told {
            drop(lines);
            let _ = writing.result.recv_timeout(PATIENCE);
        }
    }
}

fn told() -> MutexGuard<'static, Option<(Lines, Writing)>> {
    TOLD.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Tells on standard error. If that is gone as well, there is nobody to tell.
pub(super) fn complain(what: impl std::fmt::Display) {
    let line = format!("crossguard: {}\n", Printable(what));
    if let Some((lines, _)) = &mut *told() {
        lines.say(line);
    }
}

/// A thread that writes what comes out of a queue.
pub(super) struct Writing {
    /// Name of its destination.
    name: String,
    result: Receiver<std::io::Result<()>>,
}

impl Writing {
    /// Writes what comes out of `queue` to what is called `name`.
    pub(super) fn start<T: Send + 'static, W: Send + 'static>(
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
            // The receiver may be gone.
            let _ = tell.send(result);
        });
        Self { name, result }
    }

    /// Waits until all is written, but not for a reader who does not read.
    pub(super) fn finish(self) -> Result<(), Failure> {
        match self.result.recv_timeout(PATIENCE) {
            Ok(Ok(())) => Ok(()),
            // A reader that stops reading has had enough.
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

/// Lines for people. Lines that do not get through are counted, and that is said when lines get through again.
pub(super) struct Lines {
    queue: SyncSender<String>,
    left_out: usize,
}

impl Lines {
    /// The lines, and the thread that writes them, which ends after this has been dropped.
    pub(super) fn start(
        name: &str,
        write: impl Fn(&str) -> std::io::Result<()> + Send + 'static,
    ) -> (Self, Writing) {
        let (queue, lines) = sync_channel(LINES);
        let write = move |(): &mut (), line: &String| write(line);
        let writing = Writing::start(name.to_owned(), lines, (), write, |()| Ok(()));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Hazard: a person who looks away stops a guard, or makes it deaf.
    #[test]
    fn lines_that_nobody_reads_are_counted_and_wait_for_nobody() {
        let (reads, is_read) = channel::<()>();
        let (begins, has_begun) = channel();
        let (tell, read) = channel();
        let (mut lines, writing) = Lines::start("a screen", move |line| {
            let _ = begins.send(());
            // The reader is away until it says otherwise, or has gone.
            let _ = is_read.recv();
            let _ = tell.send(line.to_owned());
            Ok(())
        });
        let said = 3 * LINES;
        lines.say("0");
        // The first is on its way to the reader.
        has_begun.recv().unwrap();
        for number in 1..said {
            lines.say(number.to_string());
        }
        let (left_out, first) = (lines.left_out, said - lines.left_out);
        assert_eq!(first, LINES + 1);
        drop(reads);
        let read_first: Vec<_> = read.iter().take(first).collect();
        assert_eq!(read_first.last(), Some(&(first - 1).to_string()));
        lines.say("news");
        let remark = format!("({left_out} lines were not read in time)");
        assert_eq!(
            [read.recv().unwrap(), read.recv().unwrap()],
            [&remark, "news"]
        );
        drop(lines);
        assert!(writing.finish().is_ok());
    }
}
