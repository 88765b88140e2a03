//! What an application does with its body and its plan.

use crossguard_codec::{PublicSignal, RobotState, SignalMeans, TaskParameters};
use crossguard_protocol::{
    EndReason, Maneuver, ManeuverId, Notice, RequestId, SessionId, SessionNumber, StationId,
    StopReason, TaskType, UniqueNumber,
};

use super::*;
use crate::body::{Build, NotTaken, Report, Simulated};
use crate::site::{Place, Site};

/// A body that starts, and takes nothing after that.
#[derive(Debug)]
struct Broken;

impl Body for Broken {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        match act {
            BodyAct::Start(..) => Ok(()),
            _ => Err(NotTaken("the bus is down".to_owned())),
        }
    }

    fn advance(&mut self, _: f64) -> Option<Report> {
        None
    }

    fn state(&self) -> RobotState {
        RobotState::default()
    }

    fn place(&self) -> Place {
        Place::default()
    }

    fn stands_at(&self, _: Place) -> bool {
        false
    }

    fn fallback(&self) -> Option<Fallback> {
        None
    }

    fn release(&mut self) {}

    fn halt(&mut self) {}
}

#[test]
fn a_body_that_does_not_take_a_stop_is_a_fault_that_is_told_at_once() {
    let mut application = Application::new(Box::new(Broken), None);
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let leader = StationId(1);
    let session = SessionId { leader, number };
    let request = RequestId(0);
    let id = ManeuverId { session, request };
    let (task, why) = (TaskType::MOVE, StopReason::Superseded);
    let maneuver = Maneuver { id, task };
    application.act(&Act::Start(maneuver, TaskParameters::default()));
    assert_eq!(application.next_wish(), None);
    application.act(&Act::Stop(maneuver, why));
    let fault = Availability::Unavailable(Unavailability::LocalFault);
    let told = Stimulus::Event(Event::AvailabilityChanged(fault));
    assert_eq!(application.next_wish(), Some(told));
}

/// A guard that reports from beside the road must not let anybody cross.
/// Hazard: the pedestrian is told to go, and vehicles are told nothing.
#[test]
fn a_leader_shows_vehicles_what_its_plan_says_and_nothing_after_its_session() {
    let leader = StationId(1);
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let session = SessionId { leader, number };
    let site = Site::default();
    let plan = Plan {
        shows: Some(PublicSignal::Stop),
        ..Plan::crossing(site)
    };
    for means in [Some(SignalMeans::GESTURE), None] {
        let body = Simulated::new(Build::Humanoid, site, Place::default(), 1.0, 1);
        let mut application =
            Application::new(Box::new(body), Some(plan.clone())).showing_by(means);
        let shown = |application: &Application| {
            let signals = application.state().slow?.signals?;
            Some(signals.to_vehicles)
        };
        let mut seen = vec![shown(&application)];
        application.act(&Act::Notice(Notice::RolesEstablished(session)));
        seen.push(shown(&application));
        let ended = Notice::SessionEnded(session, EndReason::NoFollowers);
        application.act(&Act::Notice(ended));
        seen.push(shown(&application));
        let expected = [PublicSignal::None, PublicSignal::Stop, PublicSignal::None];
        let expected = expected.map(|signal| means.map(|_| signal));
        assert_eq!(seen, expected, "{means:?}");
    }
}
