//! The way of a robot's acts to the node, which publishes them on `~/event`.
//!
//! It is one queue, so that they are published in the order in which the robot put them out. Its last places
//! are for what the body is to do: news that finds no other place is lost and counted, an act of the body that
//! finds none, or no node, was not taken, and the robot says that its body has a fault.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};

use crossguard_codec::Target;
use crossguard_endpoint::Act;
use crossguard_protocol::{FallbackPolicy, Output};
use crossguard_robot::application::Listener;
use crossguard_robot::body::{Driver, NotTaken};
use crossguard_robot::site::Site;

use crate::msgs::Event;
use crate::report::{about, news, of};
use crate::standard::Point;

/// How many acts may wait for the node.
const ACTS: usize = 1_024;

/// How many of these places are for the body alone. A session has a handful of such acts at a time.
const OF_BODY: usize = 64;

/// The robot's end of the queue.
#[derive(Clone)]
pub(crate) struct Acts {
    queue: SyncSender<Act>,
    waiting: Arc<AtomicUsize>,
    lost: Arc<AtomicU64>,
    /// Has the node look into the queue. It looks by itself before long.
    wake: Arc<dyn Fn() + Send + Sync>,
}

/// The node's end of the queue.
pub(crate) struct Taken {
    queue: Receiver<Act>,
    waiting: Arc<AtomicUsize>,
    lost: Arc<AtomicU64>,
}

impl Acts {
    /// Both ends of a queue.
    pub(crate) fn new(wake: Arc<dyn Fn() + Send + Sync>) -> (Self, Taken) {
        let (sender, queue) = sync_channel(ACTS);
        let (waiting, lost) = (Arc::default(), Arc::default());
        let taken = Taken {
            queue,
            waiting: Arc::clone(&waiting),
            lost: Arc::clone(&lost),
        };
        let acts = Self {
            queue: sender,
            waiting,
            lost,
            wake,
        };
        (acts, taken)
    }

    fn hand_on(&self, act: Act) -> Result<(), NotTaken> {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        self.queue.try_send(act).map_err(|error| {
            self.waiting.fetch_sub(1, Ordering::Relaxed);
            let why = match error {
                TrySendError::Full(_) => "the node takes no acts",
                TrySendError::Disconnected(_) => "the node has ended",
            };
            NotTaken(why.to_owned())
        })?;
        (self.wake)();
        Ok(())
    }

    fn tell(&self, act: &Act) {
        let has_place = self.waiting.load(Ordering::Relaxed) < ACTS - OF_BODY;
        if !has_place || self.hand_on(act.clone()).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// What takes the acts of a body that others move.
    pub(crate) fn driver(&self) -> Driver {
        let acts = self.clone();
        Box::new(move |act| acts.hand_on(act.into()))
    }

    /// What hears all other acts, and those of the body too where no other node moves it (`of_body_too`).
    pub(crate) fn listener(&self, of_body_too: bool) -> Listener {
        let acts = self.clone();
        Listener(Box::new(move |act| {
            if of_body_too || !is_of_body(act) {
                acts.tell(act);
            }
        }))
    }
}

impl Taken {
    /// The next act, if there is one.
    pub(crate) fn next(&self) -> Option<Act> {
        let act = self.queue.try_recv().ok()?;
        self.waiting.fetch_sub(1, Ordering::Relaxed);
        Some(act)
    }

    /// How much news has found no place so far.
    pub(crate) fn lost(&self) -> u64 {
        self.lost.load(Ordering::Relaxed)
    }
}

/// Whether an act is for the body.
pub(crate) const fn is_of_body(act: &Act) -> bool {
    matches!(act, Act::Start(..) | Act::Stop(..) | Act::FallBack(..))
}

/// An act as a message; `None` for what the node tells elsewhere or does by itself. Places in it are on
/// `site`.
pub(crate) fn event(act: &Act, site: &Site) -> Option<Event> {
    let (event, output) = match *act {
        Act::Start(maneuver, parameters) => {
            let target = match parameters.target {
                Some(Target::Position {
                    latitude,
                    longitude,
                    ..
                }) => Some(site.place(latitude, longitude)),
                _ => None,
            };
            let event = Event {
                has_target: target.is_some(),
                target: target.map_or_else(Point::default, |place| Point {
                    x: place.east,
                    y: place.north,
                    z: 0.0,
                }),
                maximum_speed: parameters.maximum_speed.unwrap_or_default(),
                map_place: parameters
                    .map_place
                    .map_or_else(String::new, |it| it.to_string()),
                ..about(Event::START_MANEUVER, maneuver.id, maneuver.task)
            };
            (event, Output::StartManeuver(maneuver))
        }
        Act::Stop(maneuver, why) => (
            about(Event::STOP_MANEUVER, maneuver.id, maneuver.task),
            Output::StopManeuver(maneuver, why),
        ),
        Act::FallBack(maneuver, policy) => {
            let event = Event {
                policy: match policy {
                    FallbackPolicy::StopInPlace => Event::POLICY_STOP_IN_PLACE,
                    FallbackPolicy::GoToSafePosition => Event::POLICY_GO_TO_SAFE_POSITION,
                    FallbackPolicy::EscortToKerb => Event::POLICY_ESCORT_TO_KERB,
                    FallbackPolicy::HoldUntilClear => Event::POLICY_HOLD_UNTIL_CLEAR,
                },
                ..about(Event::FALL_BACK, maneuver.id, maneuver.task)
            };
            (event, Output::FallBack(maneuver, policy))
        }
        Act::LockIdentity(true) => (of(Event::LOCK_IDENTITY), Output::LockIdentity),
        Act::LockIdentity(false) => (of(Event::UNLOCK_IDENTITY), Output::UnlockIdentity),
        Act::Notice(notice) => (news(notice), Output::Notify(notice)),
        Act::Ignored(told, why) => {
            return Some(Event {
                text: format!("{told}: {why}"),
                ..of(Event::COMMAND_IGNORED)
            });
        }
        // The corridor has a topic of its own; the node renews the boot counter by itself.
        Act::OpenCorridor(_) | Act::ExtendCorridor(_) | Act::CloseCorridor(_) | Act::RenewEpoch => {
            return None;
        }
    };
    Some(Event {
        text: output.to_string(),
        ..event
    })
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::{
        Maneuver, ManeuverId, RequestId, SessionId, SessionNumber, StationId, StopReason, TaskType,
        Unavailability, UniqueNumber,
    };
    use crossguard_robot::body::BodyAct;

    use super::*;

    fn stop() -> BodyAct {
        let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
        let leader = StationId(1);
        let session = SessionId { leader, number };
        let request = RequestId(0);
        let id = ManeuverId { session, request };
        let task = TaskType::MOVE;
        let why = StopReason::Unavailable(Unavailability::LowBattery);
        BodyAct::Stop(Maneuver { id, task }, why)
    }

    #[test]
    fn a_stop_has_a_place_behind_any_news_and_is_not_taken_where_there_is_none() {
        let (acts, taken) = Acts::new(Arc::new(|| {}));
        let (mut driver, Listener(mut hear)) = (acts.driver(), acts.listener(false));
        // The node hangs while there is much news.
        for _ in 0..2 * ACTS {
            hear(&Act::LockIdentity(true));
            // That comes by the driver.
            hear(&stop().into());
        }
        assert_eq!(taken.lost(), (ACTS + OF_BODY) as u64);
        for _ in 0..OF_BODY {
            assert_eq!(driver(stop()), Ok(()));
        }
        assert!(driver(stop()).is_err());
        let order: Vec<_> = std::iter::from_fn(|| taken.next()).collect();
        assert_eq!(order.len(), ACTS);
        assert!(order[ACTS - OF_BODY..].iter().all(is_of_body));
        assert_eq!(driver(stop()), Ok(()));
        drop(taken);
        assert!(driver(stop()).is_err());
    }
}
