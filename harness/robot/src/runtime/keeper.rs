//! The thread that persists boot counters, and the time.

use std::sync::mpsc::{Receiver as Inbox, SyncSender, sync_channel};
use std::thread::JoinHandle;

use crossguard_codec::security::Time64;

use crate::boot::{AHEAD_US, Boot, BootError, Memory};

/// Value to persist.
enum Task {
    Counter,
    Time(Time64),
}

/// The boot counter and the time, in a thread of its own: the robot does not wait for its disk.
pub(super) struct Keeper {
    tasks: Option<SyncSender<Task>>,
    counters: Inbox<Result<u16, BootError>>,
    troubles: Inbox<BootError>,
    thread: Option<JoinHandle<()>>,
    /// Whether a counter is still to come.
    is_asked: bool,
    /// Up to when the time is kept, or about to be.
    kept: Time64,
}

impl Keeper {
    pub(super) fn start(mut boot: Boot, memory: Memory) -> Self {
        let (tasks, inbox) = sync_channel(4);
        let (counter, counters) = sync_channel(1);
        let (trouble, troubles) = sync_channel(1);
        let thread = std::thread::spawn(move || {
            while let Ok(task) = inbox.recv() {
                match task {
                    Task::Counter => {
                        if counter.send(boot.renew()).is_err() {
                            return;
                        }
                    }
                    Task::Time(time) => {
                        if let Err(error) = memory.keep(time) {
                            // One that is not taken is like the next.
                            let _ = trouble.try_send(error);
                        }
                    }
                }
            }
        });
        Self {
            tasks: Some(tasks),
            counters,
            troubles,
            thread: Some(thread),
            is_asked: false,
            kept: Time64::default(),
        }
    }

    fn put(&self, task: Task) -> bool {
        let tasks = self.tasks.as_ref();
        tasks.is_some_and(|tasks| tasks.try_send(task).is_ok())
    }

    /// Asks for the next counter, unless that has been asked already.
    pub(super) fn ask(&mut self) {
        if !self.is_asked {
            self.is_asked = self.put(Task::Counter);
        }
    }

    pub(super) fn answer(&mut self) -> Option<Result<u16, BootError>> {
        let answer = self.counters.try_recv().ok()?;
        self.is_asked = false;
        Some(answer)
    }

    /// It has been `now`: keeps a time ahead of it, once in so long. Why one was not kept.
    pub(super) fn keep(&mut self, now: Time64) -> Option<BootError> {
        if now >= self.kept {
            let ahead = Time64(now.0.saturating_add(AHEAD_US));
            if self.put(Task::Time(ahead)) {
                self.kept = ahead;
            }
        }
        self.troubles.try_recv().ok()
    }

    /// The robot stops at `now`, which the next boot may begin at.
    pub(super) fn keep_last(&self, now: Time64) {
        self.put(Task::Time(now));
    }
}

impl Drop for Keeper {
    /// Counter and time are kept, and free again, when the robot has ended.
    fn drop(&mut self) {
        self.tasks = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
