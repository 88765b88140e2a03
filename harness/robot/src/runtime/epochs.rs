//! The thread that persists boot counters.

use std::sync::mpsc::{Receiver as Inbox, SyncSender, sync_channel};
use std::thread::JoinHandle;

use crate::boot::{Boot, BootError};

/// The boot counter, in a thread of its own: the robot does not wait for its disk.
pub(super) struct Epochs {
    ask: Option<SyncSender<()>>,
    answers: Inbox<Result<u16, BootError>>,
    thread: Option<JoinHandle<()>>,
    /// Whether an answer is still to come.
    is_asked: bool,
}

impl Epochs {
    pub(super) fn start(mut boot: Boot) -> Self {
        let (ask, asked) = sync_channel(1);
        let (answer, answers) = sync_channel(1);
        let thread = std::thread::spawn(move || {
            while asked.recv().is_ok() {
                if answer.send(boot.renew()).is_err() {
                    return;
                }
            }
        });
        Self {
            ask: Some(ask),
            answers,
            thread: Some(thread),
            is_asked: false,
        }
    }

    /// Asks for the next counter, unless that has been asked already.
    pub(super) fn ask(&mut self) {
        if let (Some(ask), false) = (&self.ask, self.is_asked) {
            self.is_asked = ask.try_send(()).is_ok();
        }
    }

    pub(super) fn answer(&mut self) -> Option<Result<u16, BootError>> {
        let answer = self.answers.try_recv().ok()?;
        self.is_asked = false;
        Some(answer)
    }
}

impl Drop for Epochs {
    /// The counter is free again when the robot has ended.
    fn drop(&mut self) {
        self.ask = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
