//! A body that others move: it says to a function what is to be done, and is told where it is.

use std::fmt;

use crossguard_codec::RobotState;
use crossguard_protocol::FallbackPolicy;

use super::{AT_PLACE_M, Body, BodyAct, Build, Fallback, NotTaken, Pose, Report, state_of};
use crate::site::{Place, Site};

/// For how long a body is where it was said to be, in seconds.
const POSE_LASTS_S: f64 = 1.0;

/// What takes the acts of a body. It returns at once.
pub type Driver = Box<dyn FnMut(BodyAct) -> Result<(), NotTaken> + Send>;

/// A body that others move. It finishes nothing by itself: its driver says when a maneuver or a fallback is
/// done, by an event or [`Body::finish_fallback`].
pub struct External {
    build: Build,
    site: Site,
    driver: Driver,
    pose: Pose,
    /// For how many seconds it is known yet where it is.
    known_s: f64,
    fallback: Option<Fallback>,
}

impl External {
    /// A body of this build on a site. Where it is, nobody knows before it was told.
    #[must_use]
    pub fn new(build: Build, site: Site, place: Place, driver: Driver) -> Self {
        let pose = Pose {
            place,
            heading_deg: 0.0,
            speed_mps: 0.0,
        };
        Self {
            build,
            site,
            driver,
            pose,
            known_s: 0.0,
            fallback: None,
        }
    }

    fn known(&self) -> Option<Pose> {
        (self.known_s > 0.0).then_some(self.pose)
    }
}

impl fmt::Debug for External {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("External")
            .field("pose", &self.known())
            .field("fallback", &self.fallback)
            .finish_non_exhaustive()
    }
}

impl Body for External {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        self.fallback = match act {
            BodyAct::Start(..) | BodyAct::Stop(..) => None,
            BodyAct::FallBack(_, FallbackPolicy::HoldUntilClear) => Some(Fallback::Holding),
            BodyAct::FallBack(..) => Some(Fallback::UnderWay),
        };
        (self.driver)(act)
    }

    fn advance(&mut self, seconds: f64) -> Option<Report> {
        self.known_s = (self.known_s - seconds).max(0.0);
        None
    }

    fn state(&self) -> RobotState {
        state_of(self.build, &self.site, self.known(), 0.0)
    }

    fn place(&self) -> Place {
        self.pose.place
    }

    fn stands_at(&self, place: Place) -> bool {
        let known = self.known();
        known.is_some_and(|pose| pose.place.distance(place) < AT_PLACE_M)
    }

    fn fallback(&self) -> Option<Fallback> {
        self.fallback
    }

    fn release(&mut self) {
        self.fallback = None;
    }

    fn halt(&mut self) {
        self.fallback = None;
    }

    fn finish_fallback(&mut self) {
        if self.fallback == Some(Fallback::UnderWay) {
            self.fallback = Some(Fallback::Finished);
        }
    }

    fn moved(&mut self, pose: Pose) {
        (self.pose, self.known_s) = (pose, POSE_LASTS_S);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use crossguard_codec::TaskParameters;
    use crossguard_protocol::{
        Maneuver, ManeuverId, RequestId, SessionId, SessionNumber, StationId, StopReason, TaskType,
        UniqueNumber,
    };

    use super::*;

    fn maneuver() -> Maneuver {
        let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
        let leader = StationId(1);
        let session = SessionId { leader, number };
        let request = RequestId(0);
        let id = ManeuverId { session, request };
        let task = TaskType::MOVE;
        Maneuver { id, task }
    }

    fn body(driver: Driver) -> External {
        External::new(Build::Quadruped, Site::default(), Place::default(), driver)
    }

    #[test]
    fn a_body_that_others_move_is_where_they_say_and_finishes_nothing() {
        let mut body = body(Box::new(|_| Ok(())));
        let start = BodyAct::Start(maneuver(), TaskParameters::default());
        assert_eq!(body.act(start), Ok(()));
        assert_eq!(body.state().position.latitude, None, "nobody has said it");
        let pose = Pose {
            place: Place::new(1.0, 2.0),
            heading_deg: 90.0,
            speed_mps: 0.5,
        };
        body.moved(pose);
        let stop = BodyAct::Stop(maneuver(), StopReason::Superseded);
        assert_eq!(body.act(stop), Ok(()));
        let state = body.state();
        assert_eq!(state.position, Site::default().position(pose.place));
        assert_eq!(state.speed.map(|speed| speed.value), Some(0.5));
        assert_eq!(body.advance(0.9), None);
        assert!(body.state().position.latitude.is_some());
        assert_eq!(body.advance(0.2), None);
        assert_eq!(body.state().position.latitude, None, "that was long ago");
    }

    #[test]
    fn every_act_reaches_the_driver_at_once_and_in_order() {
        let (acts, taken) = channel();
        let mut body = body(Box::new(move |act| {
            acts.send(act)
                .map_err(|_| NotTaken("nobody is there".to_owned()))
        }));
        let start = BodyAct::Start(maneuver(), TaskParameters::default());
        let fall_back = BodyAct::FallBack(maneuver(), FallbackPolicy::EscortToKerb);
        for act in [start, fall_back] {
            assert_eq!(body.act(act), Ok(()));
            assert_eq!(taken.try_recv(), Ok(act));
        }
        assert_eq!(body.fallback(), Some(Fallback::UnderWay));
        body.finish_fallback();
        assert_eq!(body.fallback(), Some(Fallback::Finished));
        drop(taken);
        assert!(body.act(start).is_err());
    }
}
