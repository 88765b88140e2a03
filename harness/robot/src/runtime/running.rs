//! A robot that runs, as its owner sees it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::SyncSender;
use std::thread::JoinHandle;
use std::time::Instant;

use crossguard_codec::{Battery, JobRole, MapPlace, SignalsShown};
use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::clustering::PerceivedVru;

use super::Delivery;
use super::reader::Waiting;
use crate::perception::SensorFrame;

/// Order to a running robot from outside.
#[derive(Clone, PartialEq, Debug)]
pub enum Order {
    /// Tell its endpoint this.
    Tell(Stimulus<'static>),
    /// The body holds the place from which the maneuver that runs guards.
    InPosition,
    /// It does not hold that place any more.
    OutOfPosition,
    /// A person says that the road is clear.
    Clear,
    /// The maneuver that runs is finished, well or not; or the fallback that runs.
    Finish {
        /// Whether it was completed.
        well: bool,
    },
    /// The sensors have this person now, at this place on the site.
    Perceived(PerceivedVru),
    /// A sensor source looked at this moment.
    Looked(Arc<SensorFrame>, Instant),
    /// A sensor source delivered something that is no frame, and why.
    LookedInVain(String),
    /// The battery is like this now.
    Battery(Battery),
    /// Show this to people, which RAM tell; without means, by those of the robot's configuration.
    Show(SignalsShown),
    /// Be there for this job.
    Job(JobRole),
    /// Serve this road segment or intersection, or none of a map.
    Serve(Option<MapPlace>),
    /// Count this, which happened outside of it, and log it with a detail.
    Count(Cause, &'static str),
    /// Carry the body back to where it began.
    Reset,
    /// Leave whatever session it is in, say farewell, and stop.
    Stop,
    /// Lose power: end at once and say nothing.
    Die,
}

/// Where a robot takes orders.
#[derive(Clone)]
pub struct Orders {
    pub(super) deliveries: SyncSender<Delivery>,
    /// An order takes one of these before it takes a place among the datagrams, so that it never takes one of theirs.
    pub(super) places: SyncSender<()>,
}

impl Orders {
    /// Tells the robot something, as soon as there is a place for it. It has no effect on a robot that has stopped.
    pub fn give(&self, order: Order) {
        self.deliver(Delivery::Order(order));
    }

    /// Delivers something that takes the place of an order. Whether the robot still runs.
    pub(super) fn deliver(&self, delivery: Delivery) -> bool {
        self.places.send(()).is_ok() && self.deliveries.send(delivery).is_ok()
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

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;
    use std::sync::mpsc::sync_channel;

    use super::super::{DATAGRAMS, OF_PARTNERS, ORDERS};
    use super::*;

    /// Hazard: a program at the operator port repeats itself, and the heartbeats of the session find no place.
    #[test]
    fn a_flood_of_orders_takes_no_place_of_a_datagram() {
        let (deliveries, inbox) = sync_channel(DATAGRAMS + OF_PARTNERS + ORDERS);
        let (places, places_taken) = sync_channel(ORDERS);
        let orders = Orders { deliveries, places };
        let given = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&given);
        let flood = std::thread::spawn(move || {
            for _ in 0..1_000 {
                orders.give(Order::Reset);
                counted.fetch_add(1, Ordering::Relaxed);
            }
        });
        while given.load(Ordering::Relaxed) < ORDERS {
            std::thread::yield_now();
        }
        assert_eq!(inbox.try_iter().count(), ORDERS);
        drop((inbox, places_taken));
        flood.join().unwrap();
    }
}
