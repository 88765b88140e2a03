//! A robot that runs, as its owner sees it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::SyncSender;
use std::thread::JoinHandle;

use super::reader::Waiting;
use super::{Delivery, Order};

/// Where a robot takes orders.
#[derive(Clone)]
pub struct Orders(pub(super) SyncSender<Delivery>);

impl Orders {
    /// Tells the robot something. It has no effect on a robot that has stopped.
    pub fn give(&self, order: Order) {
        let _ = self.0.send(Delivery::Order(order));
    }
}

/// A robot that runs.
pub struct Running {
    pub(super) orders: Orders,
    pub(super) waiting: Arc<Waiting>,
    pub(super) threads: Vec<JoinHandle<()>>,
    pub(super) stop: Arc<AtomicBool>,
}

impl Running {
    /// Tells the robot something. It has no effect on a robot that has stopped.
    pub fn order(&self, order: Order) {
        self.orders.give(order);
    }

    /// Where it takes orders, for others than its owner.
    #[must_use]
    pub fn orders(&self) -> Orders {
        self.orders.clone()
    }

    /// Whether the robot has stopped, of its own accord or because it was told to.
    #[must_use]
    pub fn has_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// How many datagrams have been dropped so far because the inbox was full.
    #[must_use]
    pub fn inbox_full(&self) -> u64 {
        self.waiting.dropped_in_all.load(Ordering::Relaxed)
    }

    /// Tells the robot to stop and waits until it has said farewell.
    ///
    /// # Errors
    /// When one of its threads has panicked.
    pub fn stop(self) -> Result<(), Panicked> {
        self.order(Order::Stop);
        self.wait()
    }

    /// Waits until the robot has stopped.
    ///
    /// # Errors
    /// When one of its threads has panicked.
    pub fn wait(self) -> Result<(), Panicked> {
        drop(self.orders);
        // All of them are waited for.
        let ended: Vec<_> = self.threads.into_iter().map(JoinHandle::join).collect();
        if ended.iter().any(Result::is_err) {
            return Err(Panicked);
        }
        Ok(())
    }
}

/// A robot that ended in the middle of what it did, because of a mistake in the kit or in a body. It has said no
/// farewell; its body was halted, if it could be, and its leases run out.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "a thread of the robot panicked: it ended without a farewell, and its body was halted. Report this with the log"
)]
pub struct Panicked;
