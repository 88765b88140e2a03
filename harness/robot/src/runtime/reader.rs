//! The thread that takes datagrams off the link.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError};
use std::time::Duration;

use crossguard_endpoint::cause::Cause;

use super::{DATAGRAMS, Delivery};
use crate::transport::Receiver;

/// How long the reader leaves a link alone that has failed.
const LINK_REST: Duration = Duration::from_millis(200);

/// How long the reader waits for a datagram before it looks whether it should stop. A reader that looks less
/// often is known to have hung, and its datagrams to have waited, by that much later.
const READER_WAIT: Duration = Duration::from_millis(10);

/// What the reader and the loop know of the datagrams between them.
#[derive(Debug, Default)]
pub(super) struct Waiting {
    /// How many are in the inbox.
    pub(super) datagrams: AtomicUsize,
    /// How many were dropped and are not counted yet.
    pub(super) dropped: AtomicU64,
    pub(super) dropped_in_all: AtomicU64,
}

impl Waiting {
    /// There is no place for one more.
    fn drop_one(&self) {
        self.dropped.fetch_add(1, Ordering::Relaxed);
        let before = self.dropped_in_all.fetch_add(1, Ordering::Relaxed);
        let cause = Cause::InboxFull;
        tracing::warn!(layer = %cause.layer(), cause = %cause.reason(), before, "dropped");
    }
}

/// Takes datagrams off the link, so that it does not have to keep them.
pub(super) struct Reader {
    pub(super) receiver: Box<dyn Receiver>,
    pub(super) deliveries: SyncSender<Delivery>,
    pub(super) waiting: Arc<Waiting>,
    pub(super) stop: Arc<AtomicBool>,
}

impl Reader {
    pub(super) fn run(mut self) {
        while !self.stop.load(Ordering::Relaxed) {
            let delivery = match self.receiver.receive(READER_WAIT) {
                Ok(None) => continue,
                Ok(Some(arrival)) => Delivery::Arrived(arrival),
                Err(error) => Delivery::LinkFailed(error),
            };
            let has_failed = matches!(delivery, Delivery::LinkFailed(_));
            if !self.deliver(delivery) {
                return;
            }
            if has_failed {
                // An interface that is gone may come back; until then there is no hurry.
                std::thread::sleep(LINK_REST);
            }
        }
    }

    /// Puts something into the inbox, if it has a place for it. Whether there still is an inbox.
    fn deliver(&self, delivery: Delivery) -> bool {
        let datagrams = &self.waiting.datagrams;
        if datagrams.load(Ordering::Relaxed) >= DATAGRAMS {
            self.waiting.drop_one();
            return true;
        }
        datagrams.fetch_add(1, Ordering::Relaxed);
        match self.deliveries.try_send(delivery) {
            Ok(()) => true,
            Err(TrySendError::Full(_)) => {
                datagrams.fetch_sub(1, Ordering::Relaxed);
                self.waiting.drop_one();
                true
            }
            Err(TrySendError::Disconnected(_)) => false,
        }
    }
}
