//! What an application does with its body and its plan.

use crossguard_codec::{PublicSignal, RobotState, SignalMeans, Target, TaskParameters};
use crossguard_protocol::{
    EndReason, Notice, Rejection, RequestId, SessionId, SessionNumber, StationId, StopReason,
    TaskType, UniqueNumber,
};

use super::*;
use crate::body::{Build, NotTaken, Simulated};
use crate::plan::{Leg, Stage};
use crate::plan_file::APART_M;
use crate::site::{Place, Site};

#[test]
fn an_escort_that_is_across_already_is_commanded_anew_at_the_opening_period_and_not_without_end() {
    let follower = StationId(2);
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let leader = StationId(1);
    let session = SessionId { leader, number };
    let across = Place::new(1.0, 8.0);
    let plan = Plan {
        stages: vec![Stage::everybody(Leg::new(TaskType::MOVE, across))],
        ..Plan::crossing(Site::default())
    };
    let body = Simulated::new(Build::Humanoid, Site::default(), across, 1.0, 1);
    let mut application = Application::new(Box::new(body), Some(plan));
    application.act(&Act::Notice(Notice::RolesEstablished(session)));
    application.act(&Act::Notice(Notice::FollowerJoined(follower)));
    let mut orders = 0;
    for step in 0..1_000 {
        application.advance(f64::from(step) / 100.0);
        while let Some(wish) = application.next_wish() {
            let Stimulus::Order { .. } = wish else {
                continue;
            };
            let request = RequestId(orders);
            let id = ManeuverId { session, request };
            orders += 1;
            application.act(&Act::Notice(Notice::ManeuverReported(follower, id)));
            application.act(&Act::Notice(Notice::ManeuverCompleted(follower, id)));
        }
    }
    // Ten seconds, an attempt each half second.
    assert!((15..=20).contains(&orders), "{orders} orders");
}

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

#[test]
fn a_follower_that_reports_from_elsewhere_is_commanded_again_and_in_the_end_given_up() {
    let follower = StationId(2);
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let leader = StationId(1);
    let session = SessionId { leader, number };
    let site = Site::default();
    let place = Place::new(6.0, 5.0);
    let plan = Plan {
        stages: vec![Stage::everybody(Leg::new(TaskType::BLOCK, place))],
        ..Plan::crossing(site)
    };
    let reports_from = |at: Place, times: u8| {
        let body = Simulated::new(Build::Humanoid, site, Place::default(), 1.0, 1);
        let mut application = Application::new(Box::new(body), Some(plan.clone()));
        application.act(&Act::Notice(Notice::RolesEstablished(session)));
        application.act(&Act::Notice(Notice::FollowerJoined(follower)));
        for request in (0..times).map(RequestId) {
            let id = ManeuverId { session, request };
            application.follower_is_at(follower, &site.position(at));
            application.act(&Act::Notice(Notice::ManeuverInPosition(follower, id)));
        }
        let mut wishes = Vec::new();
        while let Some(wish) = application.next_wish() {
            wishes.push(match wish {
                Stimulus::Order { .. } => "order",
                Stimulus::Event(Event::OpenCorridor) => "open",
                Stimulus::Event(Event::LeaveRequested) => "give up",
                _ => "other",
            });
        }
        wishes
    };
    assert_eq!(reports_from(place, 1), ["order", "open"]);
    assert_eq!(reports_from(Place::new(6.0, 6.5), 1), ["order", "open"]);
    let elsewhere = reports_from(Place::new(6.0, 8.2), 9);
    assert!(!elsewhere.contains(&"open"), "{elsewhere:?}");
    assert_eq!(elsewhere.last(), Some(&"give up"));
}

/// A leader at a kerb whose plan is the paper's crossing for this many followers, who have just joined; the session.
fn leading(followers: &[StationId]) -> (Application, SessionId) {
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let leader = StationId(1);
    let session = SessionId { leader, number };
    let plan = Plan {
        followers: u8::try_from(followers.len()).unwrap(),
        ..Plan::crossing(Site::default())
    };
    let place = Place::new(0.0, -1.5);
    let body = Simulated::new(Build::Humanoid, Site::default(), place, 1.0, 1);
    let mut application = Application::new(Box::new(body), Some(plan));
    application.act(&Act::Notice(Notice::RolesEstablished(session)));
    for follower in followers {
        application.act(&Act::Notice(Notice::FollowerJoined(*follower)));
    }
    (application, session)
}

/// Two dogs were sent to one point.
#[test]
fn followers_with_the_same_part_are_sent_to_places_apart() {
    let team = [2, 3, 4].map(StationId);
    let (mut application, _) = leading(&team);
    let mut places: Vec<Place> = Vec::new();
    while let Some(Stimulus::Order { parameters, .. }) = application.next_wish() {
        let Some(Target::Position {
            latitude,
            longitude,
            ..
        }) = parameters.target
        else {
            panic!("no place")
        };
        let place = Site::default().place(latitude, longitude);
        let is_apart = |other: &Place| other.distance(place) >= APART_M;
        assert!(places.iter().all(is_apart), "{place:?} of {places:?}");
        places.push(place);
    }
    assert_eq!(places.len(), team.len());
}

#[test]
fn a_rejected_command_is_repeated_half_a_second_later_and_never_to_who_is_unavailable() {
    let follower = StationId(2);
    let (mut application, session) = leading(&[follower]);
    let orders = |application: &mut Application| {
        let wishes: Vec<_> = std::iter::from_fn(|| application.next_wish()).collect();
        let orders = wishes
            .iter()
            .filter(|wish| matches!(wish, Stimulus::Order { .. }));
        (orders.count(), wishes.len())
    };
    assert_eq!(orders(&mut application), (1, 1));
    let request = RequestId(0);
    let id = ManeuverId { session, request };
    let rejected = |why| Act::Notice(Notice::CommandRejected(follower, id, why));
    application.act(&rejected(Rejection::UnsupportedTask));
    for step in 1..50 {
        application.advance(f64::from(step) / 100.0);
        assert_eq!(orders(&mut application).0, 0, "after {step} hundredths");
    }
    application.advance(0.51);
    assert_eq!(orders(&mut application).0, 1);
    let stop = Unavailability::EmergencyStop;
    application.act(&rejected(Rejection::Unavailable(stop)));
    assert_eq!(orders(&mut application), (0, 1), "it gives up at once");
    application.advance(2.0);
    assert_eq!(orders(&mut application), (0, 0));
}
