//! The revocation list of a running robot. A thread of its own reads it: the robot does not wait for its disk.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crossguard_codec::security::HashedId8;
use crossguard_endpoint::cause::Cause;

use super::{Delivery, Loop, Orders, Running};
use crate::pki::{PkiError, RevokedList};

/// How often the file is looked at.
const PERIOD: Duration = Duration::from_secs(1);

/// How soon the thread ends with its robot.
const TICK: Duration = Duration::from_millis(50);

/// The certificates on the list, or why it cannot be read.
pub(super) type Read = Result<BTreeSet<HashedId8>, PkiError>;

impl Running {
    /// Has the robot keep to the revocation list in this file: a second after it changes, nothing is taken that is
    /// signed with a certificate on it. A list that cannot be read any more is counted, and the one before it stays.
    pub fn keep_revoked(&mut self, list: PathBuf) {
        let (list, stop) = (RevokedList::new(list), Arc::clone(&self.stop));
        let orders = self.orders();
        let watch = move || watch(list, &orders, &stop);
        self.threads.push(std::thread::spawn(watch));
    }
}

/// Delivers the list whenever its file has changed, until the robot has stopped.
fn watch(mut list: RevokedList, orders: &Orders, stop: &AtomicBool) {
    let mut due = Instant::now();
    while !stop.load(Ordering::Relaxed) {
        if Instant::now() >= due {
            due = Instant::now() + PERIOD;
            if let Some(read) = list.read_if_changed()
                && !orders.deliver(Delivery::Revoked(read))
            {
                return;
            }
        }
        std::thread::sleep(TICK);
    }
}

impl Loop {
    /// Takes over a revocation list that was read anew.
    pub(super) fn revoke(&mut self, list: Read) {
        match list {
            Ok(revoked) => {
                self.machine.endpoint.set_revoked(revoked);
            }
            Err(error) => {
                self.drop(Cause::RevokedUnread, error.to_string(), Vec::new());
            }
        }
    }
}
