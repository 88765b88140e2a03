//! The way of a body's acts from the robot to the node, which publishes them on `~/event`.
//!
//! It is a queue of its own, which drops nothing: an act that finds no place, or no node, was not taken, and
//! the robot says that its body has a fault.

use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};

use crossguard_codec::{RobotState, Target};
use crossguard_protocol::{FallbackPolicy, Output};
use crossguard_robot::body::{Body, BodyAct, Driver, Fallback, NotTaken, Pose, Report, Simulated};
use crossguard_robot::site::{Place, Site};

use crate::msgs::Event;
use crate::report::about;
use crate::standard::Point;

/// How many acts may wait for the node. A session has a handful at a time.
const ACTS: usize = 64;

/// The robot's end of the queue.
pub(crate) struct Acts {
    queue: SyncSender<BodyAct>,
    /// Has the node look into the queue. It looks by itself before long.
    wake: Box<dyn Fn() + Send>,
}

impl Acts {
    /// Both ends of a queue.
    pub(crate) fn new(wake: Box<dyn Fn() + Send>) -> (Self, Receiver<BodyAct>) {
        let (queue, acts) = sync_channel(ACTS);
        (Self { queue, wake }, acts)
    }

    fn hand_on(&self, act: BodyAct) -> Result<(), NotTaken> {
        self.queue.try_send(act).map_err(|error| {
            let why = match error {
                TrySendError::Full(_) => "the node takes no acts",
                TrySendError::Disconnected(_) => "the node has ended",
            };
            NotTaken(why.to_owned())
        })?;
        (self.wake)();
        Ok(())
    }

    /// What takes the acts of a body that others move.
    pub(crate) fn driver(self) -> Driver {
        Box::new(move |act| self.hand_on(act))
    }
}

/// A simulated body whose acts are published as well.
pub(crate) struct Announced {
    pub(crate) body: Simulated,
    pub(crate) acts: Acts,
}

impl std::fmt::Debug for Announced {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.body.fmt(f)
    }
}

impl Body for Announced {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        // The body takes it; who only looks on may miss it.
        let _ = self.acts.hand_on(act);
        self.body.act(act)
    }

    fn advance(&mut self, seconds: f64) -> Option<Report> {
        self.body.advance(seconds)
    }

    fn state(&self) -> RobotState {
        self.body.state()
    }

    fn place(&self) -> Place {
        self.body.place()
    }

    fn stands_at(&self, place: Place) -> bool {
        self.body.stands_at(place)
    }

    fn fallback(&self) -> Option<Fallback> {
        self.body.fallback()
    }

    fn release(&mut self) {
        self.body.release();
    }

    fn halt(&mut self) {
        self.body.halt();
    }

    fn finish_fallback(&mut self) {
        self.body.finish_fallback();
    }

    fn moved(&mut self, pose: Pose) {
        self.body.moved(pose);
    }

    fn walk_to(&mut self, place: Place) {
        self.body.walk_to(place);
    }

    fn walks_back(&self) -> bool {
        self.body.walks_back()
    }

    fn carry_to_safe_place(&mut self) {
        self.body.carry_to_safe_place();
    }

    fn time_scale(&self) -> f64 {
        self.body.time_scale()
    }
}

/// An act as a message. Places in it are on `site`.
pub(crate) fn event(act: BodyAct, site: &Site) -> Event {
    let (event, output) = match act {
        BodyAct::Start(maneuver, parameters) => {
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
                ..about(Event::START_MANEUVER, maneuver.id, maneuver.task)
            };
            (event, Output::StartManeuver(maneuver))
        }
        BodyAct::Stop(maneuver, why) => (
            about(Event::STOP_MANEUVER, maneuver.id, maneuver.task),
            Output::StopManeuver(maneuver, why),
        ),
        BodyAct::FallBack(maneuver, policy) => {
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
    };
    Event {
        text: output.to_string(),
        ..event
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::{
        Maneuver, ManeuverId, RequestId, SessionId, SessionNumber, StationId, StopReason, TaskType,
        Unavailability, UniqueNumber,
    };

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
    fn a_stop_that_nobody_takes_is_not_taken() {
        let (acts, queue) = Acts::new(Box::new(|| {}));
        let mut driver = acts.driver();
        for _ in 0..ACTS {
            assert_eq!(driver(stop()), Ok(()));
        }
        // The node hangs.
        assert!(driver(stop()).is_err());
        assert_eq!(queue.try_recv(), Ok(stop()));
        assert_eq!(driver(stop()), Ok(()));
        drop(queue);
        assert!(driver(stop()).is_err());
    }
}
