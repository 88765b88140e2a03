//! Where a robot's records go: to every reader by a queue of its own, which the robot never waits for.
//!
//! ```text
//!             ┌─► queue ─► log file       full: the log ends there, valid up to its end
//!   loop ─────┼─► queue ─► somebody       full: the newest record is skipped
//!             └─► …
//! ```
//!
//! A log with a gap could not be validated from there on, so the reader of a log that is too slow is
//! cut off. Either way every record that does not get through is counted under the queue's cause. The end of a log is told to
//! the other readers.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, TrySendError, sync_channel};
use std::time::{Duration, Instant};

use crossguard_endpoint::cause::Cause;

use crate::trace::Record;

/// How many records wait for a reader that writes them: about ten seconds of a busy robot.
pub const RECORDS: usize = 4_096;

/// How often a record is tried again that is worth waiting for.
const PATIENCE_STEP: Duration = Duration::from_millis(5);

/// Fate of a queue that is full.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum WhenFull {
    /// It ends; its reader gets what is in it and no more.
    End,
    /// It goes on without the record.
    Skip,
}

/// The queues of a robot's records. Clones put records into the same queues.
#[derive(Clone, Debug, Default)]
pub struct Journal {
    queues: Vec<Queue>,
}

#[derive(Clone, Debug)]
struct Queue {
    to: SyncSender<Arc<Record>>,
    when_full: WhenFull,
    /// Whether it has ended because it was full.
    has_ended: Arc<AtomicBool>,
    /// Whether its reader has gone.
    is_left: Arc<AtomicBool>,
    lost: Cause,
}

impl Journal {
    /// A journal that nobody reads.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A queue of at most `length` records for one more reader. Records that it does not get are counted
    /// under `lost`.
    pub fn reader(
        &mut self,
        length: usize,
        when_full: WhenFull,
        lost: Cause,
    ) -> Receiver<Arc<Record>> {
        let (to, reader) = sync_channel(length);
        self.queues.push(Queue {
            to,
            when_full,
            has_ended: Arc::default(),
            is_left: Arc::default(),
            lost,
        });
        reader
    }

    /// Puts a record into every queue that has room. The causes of the others.
    pub fn put(&self, record: Record) -> impl Iterator<Item = Cause> {
        let record = Arc::new(record);
        let put = move |queue: &Queue| queue.put(&record).err();
        self.queues.iter().filter_map(put)
    }

    /// How many logs have ended, because their readers were too slow, could not write, or have gone.
    #[must_use]
    pub fn ended_logs(&self) -> usize {
        let is_log = |queue: &&Queue| queue.when_full == WhenFull::End;
        let logs = self.queues.iter().filter(is_log);
        logs.filter(|queue| queue.has_ended() || queue.is_left.load(Ordering::Relaxed))
            .count()
    }

    /// Puts a record into every queue, and waits for room for so long at most. For the last record of
    /// a robot that has stopped.
    pub fn put_last(&self, record: Record, at_most: Duration) {
        let (record, deadline) = (Arc::new(record), Instant::now() + at_most);
        for queue in &self.queues {
            while queue.is_full_with(&record) && Instant::now() < deadline {
                std::thread::sleep(PATIENCE_STEP);
            }
        }
    }
}

/// Writes the items of a queue until no more can come. `to` does not keep back written items: it
/// is flushed while nothing comes.
///
/// # Errors
/// Errors of the writer.
pub fn write_out<T, W>(
    queue: &Receiver<T>,
    to: &mut W,
    write: impl Fn(&mut W, &T) -> std::io::Result<()>,
    flush: impl Fn(&mut W) -> std::io::Result<()>,
) -> std::io::Result<()> {
    loop {
        let next = match queue.try_recv() {
            Ok(next) => next,
            Err(TryRecvError::Disconnected) => return flush(to),
            Err(TryRecvError::Empty) => {
                flush(to)?;
                match queue.recv() {
                    Ok(next) => next,
                    Err(_) => return Ok(()),
                }
            }
        };
        write(to, &next)?;
    }
}

impl Queue {
    /// Puts a record in, if there is room and somebody who reads.
    fn put(&self, record: &Arc<Record>) -> Result<(), Cause> {
        if self.has_ended() {
            return Err(self.lost);
        }
        match self.to.try_send(Arc::clone(record)) {
            Ok(()) => Ok(()),
            Err(TrySendError::Disconnected(_)) => {
                // A reader that has gone misses nothing.
                self.is_left.store(true, Ordering::Relaxed);
                Ok(())
            }
            Err(TrySendError::Full(_)) => {
                let ends = self.when_full == WhenFull::End;
                self.has_ended.store(ends, Ordering::Relaxed);
                Err(self.lost)
            }
        }
    }

    fn has_ended(&self) -> bool {
        self.has_ended.load(Ordering::Relaxed)
    }

    /// Whether a record does not get in, although it may later.
    fn is_full_with(&self, record: &Arc<Record>) -> bool {
        !self.has_ended()
            && matches!(
                self.to.try_send(Arc::clone(record)),
                Err(TrySendError::Full(_))
            )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(reader: &Receiver<Arc<Record>>) -> Vec<u64> {
        reader.try_iter().map(|record| record.at_us).collect()
    }

    #[test]
    fn a_log_ends_where_its_reader_is_too_slow_and_another_reader_has_a_gap() {
        let mut journal = Journal::new();
        let log = journal.reader(2, WhenFull::End, Cause::LogFull);
        let other = journal.reader(2, WhenFull::Skip, Cause::OutputFull);
        let put = |at_us| {
            journal
                .put(Record::stopped("R1", at_us))
                .collect::<Vec<_>>()
        };
        assert_eq!([put(1), put(2)].concat(), []);
        assert_eq!(put(3), [Cause::LogFull, Cause::OutputFull]);
        assert_eq!((times(&log), times(&other)), (vec![1, 2], vec![1, 2]));
        assert_eq!(put(4), [Cause::LogFull]);
        assert_eq!(journal.ended_logs(), 1);
        assert_eq!((times(&log), times(&other)), (vec![], vec![4]));
    }

    #[test]
    fn who_does_not_read_any_more_misses_nothing() {
        let mut journal = Journal::new();
        drop(journal.reader(1, WhenFull::End, Cause::LogFull));
        drop(journal.reader(1, WhenFull::Skip, Cause::OutputFull));
        assert_eq!(journal.ended_logs(), 0);
        assert_eq!(journal.put(Record::stopped("R1", 1)).count(), 0);
        assert_eq!(journal.ended_logs(), 1);
    }

    #[test]
    fn the_last_record_waits_for_room_but_not_for_ever() {
        let mut journal = Journal::new();
        let reader = journal.reader(1, WhenFull::Skip, Cause::OutputFull);
        assert_eq!(journal.put(Record::stopped("R1", 1)).count(), 0);
        journal.put_last(Record::stopped("R1", 2), Duration::from_millis(20));
        assert_eq!(times(&reader), [1]);
        let waits = std::thread::spawn(move || {
            journal.put_last(Record::stopped("R1", 3), Duration::from_mins(1));
        });
        assert_eq!(reader.recv().unwrap().at_us, 3);
        waits.join().unwrap();
    }
}
