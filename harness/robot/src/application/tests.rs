//! Behaviour of an application with its body and its plan.

use std::sync::{Arc, Mutex};

use crossguard_codec::security::Rejected;
use crossguard_codec::{
    ConfidenceEllipse, Identity, Kind, Position, RoadUser, RobotState, TaskParameters,
};
use crossguard_endpoint::Moment;
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_endpoint::station::LocalDynamicMap;
use crossguard_protocol::{Robot, StationId, StopReason, TaskType};

use super::*;
use crate::body::{Build, NotTaken, Report, Simulated};
use crate::perception::SensorFrame;
use crate::sight::Sight;
use crate::site::{Place, Site};
use crate::street::Street;
use crate::table::maneuver;
use crate::zone::Zone;

/// A body that starts, and takes nothing after that. It takes down what it is told, and is still falling back.
#[derive(Debug, Default)]
struct Broken(Arc<Mutex<Vec<String>>>);

impl Body for Broken {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        self.0.lock().unwrap().push(format!("{act:?}"));
        match act {
            BodyAct::Start(..) => Ok(()),
            _ => Err(NotTaken("the bus is down".to_owned())),
        }
    }

    fn advance(&mut self, _: f64) -> Vec<Report> {
        Vec::new()
    }

    fn state(&self) -> RobotState {
        RobotState::default()
    }

    fn place(&self) -> Place {
        Place::default()
    }

    fn fallback(&self) -> Option<Fallback> {
        Some(Fallback::UnderWay)
    }

    fn release(&mut self) {
        self.0.lock().unwrap().push("release".to_owned());
    }

    fn halt(&mut self) {}
}

#[test]
fn a_body_that_does_not_take_a_stop_is_a_fault_that_is_told_at_once() {
    let mut application = Application::new(Box::new(Broken::default()), None);
    let maneuver = maneuver(TaskType::MOVE);
    let act = |output| Effect::Act(output, TaskParameters::default());
    application.act(&act(protocol::Output::StartManeuver(maneuver)));
    assert_eq!(application.next_wish(), None);
    let stop = protocol::Output::StopManeuver(maneuver, StopReason::Superseded);
    application.act(&act(stop));
    let fault = Availability::Unavailable(Unavailability::LocalFault);
    let told = Stimulus::Event(Event::AvailabilityChanged(fault));
    assert_eq!(application.next_wish(), Some(told));
    let (cause, why, _) = application.next_trouble().unwrap();
    assert_eq!(cause, Cause::BodyFault);
    assert!(why.ends_with("the bus is down"), "{why}");
}

fn wishes(application: &mut Application) -> Vec<Stimulus<'static>> {
    std::iter::from_fn(|| application.next_wish()).collect()
}

/// Hazard: what a body says again and again fills a queue, or takes the place of the news that it is lost.
#[test]
fn what_a_body_repeats_is_counted_and_takes_one_place() {
    let mut application = Application::new(Box::new(Broken::default()), None);
    for _ in 0..1_000 {
        application.learn_of_body(Report::Fault("hot".to_owned()));
        let dropped = Report::Dropped(Cause::BodyGarbled, "no line".to_owned(), 7);
        application.learn_of_body(dropped);
    }
    application.learn_of_body(Report::Silent("the body fell over".to_owned()));
    let counted = std::iter::from_fn(|| application.next_trouble());
    let counted: Vec<_> = counted
        .map(|(cause, what, count)| (cause, what.into_owned(), count))
        .collect();
    let expected = [
        (Cause::BodyFault, "hot", 1_000),
        (Cause::BodyGarbled, "no line", 7_000),
        (Cause::BodySilent, "the body fell over: emergency stop", 1),
    ];
    assert_eq!(
        counted,
        expected.map(|(cause, what, count)| (cause, what.to_owned(), count))
    );
    assert_eq!(wishes(&mut application).len(), 1);
}

/// Hazard: a CPM has as many vehicles as the queue has places, and each of them closes the corridor. Nobody is called for a person who
/// waits, or people on the road wait for the time limit of a guard whose body failed, or of a leader that gave up.
#[test]
fn a_wish_that_is_repeated_takes_one_place_and_one_that_nothing_repeats_always_has_one() {
    let mut application = Application::new(Box::new(Broken::default()), None);
    let told = [Event::CloseCorridor, Event::OpenCorridor].map(Stimulus::Event);
    (0..100).for_each(|_| application.wish(told[0]));
    application.wish(told[1]);
    assert_eq!(wishes(&mut application), told);
    assert_eq!(application.next_trouble(), None);
    // Half of the wishes without a place repeat the last one that has a place.
    (0..WISHES + 10).for_each(|number| application.wish(told[number % 2]));
    let once = [
        Event::PedestrianDetected(application.setup.request),
        Event::ManeuverFailed(maneuver(TaskType::BLOCK).id),
        Event::LeaveRequested,
        Event::TaskCompleted,
    ];
    let once = once.map(Stimulus::Event);
    for wish in once {
        application.wish(wish);
    }
    assert_eq!(wishes(&mut application)[WISHES..], once);
    let (cause, _, count) = application.next_trouble().unwrap();
    assert_eq!((cause, count), (Cause::WishesFull, 5));
}

/// Hazard: a body that is there and has a fault counts as available, since both are told in one turn.
#[test]
fn a_fault_outlasts_that_the_body_is_there() {
    for faulty_first in [false, true] {
        let mut application = Application::new(Box::new(Broken::default()), None);
        application.learn_of_body(Report::Absent);
        let fault = Report::Fault("hot".to_owned());
        let told = if faulty_first {
            [fault, Report::Here]
        } else {
            [Report::Here, fault]
        };
        for report in told {
            application.learn_of_body(report);
        }
        let fault = Availability::Unavailable(Unavailability::LocalFault);
        let wish = Stimulus::Event(Event::AvailabilityChanged(fault));
        assert_eq!(wishes(&mut application), [wish]);
    }
}

/// Hazard: a person presses the emergency stop while the body starts, and its first word lifts that.
#[test]
fn a_stop_that_was_told_before_the_body_came_stands() {
    for (told, lifted) in [
        (None, true),
        (Some(Unavailability::EmergencyStop), false),
        (Some(Unavailability::Teleoperated), false),
        (Some(Unavailability::LowBattery), false),
    ] {
        let mut application = Application::new(Box::new(Broken::default()), None);
        let mut robot = Robot::new(StationId(1), 1);
        let config = Config::default();
        application.learn_of_body(Report::Absent);
        let mut settle = |application: &mut Application, told: Option<Unavailability>| {
            application.watch_body();
            let told = told.map(|why| Event::AvailabilityChanged(Availability::Unavailable(why)));
            let wishes = wishes(application);
            let events = wishes.into_iter().filter_map(|it| match it {
                Stimulus::Event(event) => Some(event),
                _ => None,
            });
            for event in events.chain(told) {
                robot.step(&config, protocol::Input::Local(event));
            }
            application.learn(&robot, &config);
            robot.availability()
        };
        settle(&mut application, None);
        settle(&mut application, told);
        application.learn_of_body(Report::Here);
        let availability = settle(&mut application, None);
        assert_eq!(availability == Availability::Available, lifted, "{told:?}");
        assert_eq!(settle(&mut application, None), availability);
    }
}

/// Hazard: the crossing machine closes, and the sign goes on showing go; it holds a guard, and its body moves.
#[test]
fn what_the_crossing_machine_puts_out_reaches_sign_and_body() {
    let body = Broken::default();
    let told = Arc::clone(&body.0);
    let mut application = Application::new(Box::new(body), None);
    assert!(!application.is_body_free(), "its fallback is under way");
    let mut shows_go_after = |output| {
        application.carry_out(&[output].into_iter().collect());
        application.sign().shows_go(0)
    };
    let outputs = [
        Output::Go(Millis(100)),
        Output::Stop,
        Output::Wait,
        Output::GoOn,
        Output::Release,
    ];
    assert_eq!(
        outputs.map(&mut shows_go_after),
        [true, false, false, false, false]
    );
    assert_eq!(*told.lock().unwrap(), ["Wait", "GoOn", "release"]);
}

#[test]
fn a_hindrance_is_told_once_until_go_is_shown_again() {
    let mut application = Application::new(Box::new(Broken::default()), None);
    let hindered = Output::Hindered(Hindrance::NoSight);
    let mut told = |output| {
        let outputs: Outputs = [output].into_iter().collect();
        application.carry_out(&outputs);
        application.untold_hindrance.take()
    };
    let go = Output::Go(Millis(100));
    let once = Some(Hindrance::NoSight);
    assert_eq!(
        [hindered, hindered, go, hindered].map(&mut told),
        [once, None, None, once]
    );
}

/// A log is judged by the sights in it.
/// Hazard: a frame that was held up tells of somebody as if they were there now.
#[test]
fn a_late_frame_is_no_sight_of_now() {
    let body = Simulated::new(Build::Humanoid, Site::default(), Place::default(), 1.0, 1);
    let road = Street::default().zone().road.unwrap();
    let application = Application::new(Box::new(body), None);
    let mut application = application.on(Road::Watched(Zone::of_road(road)));
    let person = SensorFrame::of(&[PerceivedVru::pedestrian(1, [1.0, 3.0])]);
    let nobody = SensorFrame::default();
    application.advance(10.0);
    application.look(&person, Millis(1_500));
    assert_eq!(application.next_sight(), None, "it is too old");
    let dropped = |application: &mut Application| application.next_trouble().map(|it| it.0);
    assert_eq!(
        dropped(&mut application),
        Some(Cause::FrameDropped("stale"))
    );
    application.look_in_vain("line 7 is no frame");
    let malformed = Cause::FrameDropped("malformed");
    assert_eq!(
        application.next_trouble(),
        Some((malformed, "line 7 is no frame".into(), 1))
    );
    assert_eq!(application.next_trouble(), None, "it is counted once");
    application.look(&nobody, Millis(40));
    application.look(&person, Millis(100));
    assert_eq!(application.next_sight(), None, "a newer one has nobody");
    let car = PerceivedVru {
        class: VruClass::Vehicle,
        velocity_mps: [-8.0, 0.0],
        ..PerceivedVru::pedestrian(2, [30.0, 3.0])
    };
    let person = SensorFrame::of(&[person.people[0].vru, car]);
    application.look(&person, Millis(40));
    let sight = application.next_sight().unwrap();
    assert_eq!(sight.people.len(), 1, "a vehicle is nobody on foot");
    assert_eq!(sight.vehicles[0].velocity, Some([-8.0, 0.0]));
    application.advance(11.5);
    assert_eq!(application.next_sight(), Some(Sight::default()));
    for id in 0..1_000 {
        application.perceive(StationId(1), &PerceivedVru::pedestrian(id, [1.0, 3.0]));
    }
    application.advance(12.0);
    assert_eq!(application.next_sight().unwrap().people.len(), 256);
    application.advance(13.0);
    hears_of(&mut application, vehicle(30.0, (8.0, 270.0)), 13_000);
    assert_eq!(application.next_sight().unwrap().vehicles.len(), 1);
}

/// Hazard: a guard without a zone announces the people of its own camera, and leaves them at its leader's word.
#[test]
fn road_users_in_frames_of_a_robot_without_a_zone_count_as_heard_ones() {
    let application = Application::new(Box::new(Broken::default()), None);
    let road = Street::default().zone().road.unwrap();
    let mut application = application.on(Road::Heard(road));
    let car = PerceivedVru {
        class: VruClass::Vehicle,
        velocity_mps: [8.0, 0.0],
        ..PerceivedVru::pedestrian(2, [-12.0, 2.0])
    };
    let frame = SensorFrame::of(&[PerceivedVru::pedestrian(1, [1.0, 3.0]), car]);
    application.look_at(10.0, &frame, 8_000);
    let on_road = |it: &Application| it.crossing.tracks().is_on_road();
    assert!(!on_road(&application), "it is too old");
    application.look_at(10.1, &frame, 10_000);
    assert!(on_road(&application));
    let hindered = application.crossing.hindered(&application.setup);
    assert!(
        matches!(hindered, Some(Hindrance::Vehicle(_))),
        "{hindered:?}"
    );
    assert_eq!(application.next_sight().unwrap().vehicles.len(), 1);
    let no_zone = Cause::FrameDropped("no zone");
    assert_eq!(application.next_trouble().unwrap().0, no_zone);
}

/// A vehicle so many metres to the east, with its speed in m/s and its heading in degrees, which knows its place to a metre.
fn vehicle(east: f64, (speed, heading): (f64, f64)) -> RoadUser {
    let metre = ConfidenceEllipse {
        semi_major: 1.0,
        semi_minor: 1.0,
        orientation: 0.0,
    };
    RoadUser {
        identity: Identity::Station(9),
        kind: Kind::Vehicle,
        station_type: None,
        position: Position {
            ellipse: Some(metre),
            ..Site::default().position(Place::new(east, 2.0))
        },
        speed: Some(speed),
        heading: Some(heading),
        length: None,
        cardinality: 1,
        signals: None,
        measured_its: BEGAN_ITS + 10_000,
    }
}

/// What the wall clock shows when the robot's shows 0.
const BEGAN_ITS: u64 = 694_694_400_000;

fn hears_of(application: &mut Application, user: RoadUser, now_ms: u64) {
    let mut map = LocalDynamicMap::default();
    map.observe(user, now_ms);
    let moment = Moment::after(BEGAN_ITS, now_ms);
    application.listen(&map, &Robot::new(StationId(1), 1), moment);
}

/// A robot that watches the simulated street, and has seen it empty once.
fn watching() -> Application {
    let body = Simulated::new(
        Build::Humanoid,
        Site::default(),
        Place::new(0.0, -1.5),
        1.0,
        1,
    );
    let application = Application::new(Box::new(body), None);
    let road = Street::default().zone().road.unwrap();
    let mut application = application.on(Road::Watched(Zone::of_road(road)));
    application.look_at(10.0, &SensorFrame::default(), 10_000);
    application
}

/// Hazard: a source says each frame twice, and half as many that all miss somebody clear the road.
#[test]
fn a_frame_that_is_told_twice_counts_once_whenever_it_is_read() {
    for ahead_ms in [0, 12] {
        let mut application = watching();
        let is_clear = |it: &Application| -> bool { it.crossing.is_clear(&it.setup) };
        for frame in 1..=5 {
            let at_s = 10.0 + 0.1 * f64::from(frame);
            // The loop has turned when it was made, and turns again 4 ms later.
            application.advance(at_s);
            assert!(!is_clear(&application), "{frame} frames");
            for read_s in [0.004, 0.004_5, 0.009] {
                let taken_ms = 10_000 + 100 * i64::from(frame) + ahead_ms;
                application.look_at(at_s + read_s, &SensorFrame::default(), taken_ms);
            }
        }
        assert!(is_clear(&application), "six have looked");
    }
}

/// Hazard: go is shown to somebody in front of a motorcycle, which is a vulnerable road user by ETSI.
#[test]
fn whoever_is_as_fast_as_a_vehicle_hinders_like_one() {
    for (kind, station_type, mps, expected) in [
        (Kind::Vehicle, Some(5), 13.9, true),
        (Kind::Vru, Some(4), 13.9, true),
        (Kind::Vru, Some(3), 3.0, true),
        (Kind::Vru, Some(2), 6.0, true),
        (Kind::Vru, None, 13.9, true),
        (Kind::Object, None, 13.9, true),
        (Kind::Robot, None, 7.0, true),
        (Kind::Robot, None, 1.6, false),
        (Kind::Vru, Some(1), 1.5, false),
        (Kind::Object, None, 0.0, false),
    ] {
        let mut application = watching();
        assert_eq!(application.crossing.hindered(&application.setup), None);
        let user = RoadUser {
            kind,
            station_type,
            ..vehicle(-12.0, (mps, 90.0))
        };
        let what = format!("{user:?}");
        hears_of(&mut application, user, 10_000);
        let hindered = application.crossing.hindered(&application.setup);
        assert_eq!(hindered.is_some(), expected, "{what}: {hindered:?}");
    }
}

/// Hazard: a detector tells of road users one by one, and go is shown in front of a vehicle that it has.
#[test]
fn a_vehicle_that_comes_alone_in_a_line_hinders_like_one_in_a_frame() {
    for (class, mps, expected) in [
        (VruClass::Vehicle, 8.0, true),
        (VruClass::Motorcyclist, 8.0, true),
        (VruClass::Bicyclist, 8.0, true),
        (VruClass::Vehicle, 0.0, false),
        (VruClass::Pedestrian, 1.5, false),
    ] {
        let mut application = watching();
        let vru = PerceivedVru {
            class,
            velocity_mps: [mps, 0.0],
            ..PerceivedVru::pedestrian(7, [-12.0, 2.0])
        };
        application.perceive(StationId(1), &vru);
        let hindered = application.crossing.hindered(&application.setup);
        assert_eq!(hindered.is_some(), expected, "{vru:?}: {hindered:?}");
    }
}

/// A body that says NaN is not at the origin of the site.
#[test]
fn a_position_that_is_no_number_is_no_place() {
    let application = watching();
    assert!(application.pose(&Position::at(49.0, 8.4)).is_some());
    for (latitude, longitude) in [(f64::NAN, 8.4), (49.0, f64::INFINITY)] {
        assert_eq!(application.pose(&Position::at(latitude, longitude)), None);
    }
}

/// A robot that leads where nobody has to look, and drops a packet.
fn leader_that_drops(cause: Cause, shows_go: bool) -> Application {
    let mut application = watching();
    application.setup.watches = false;
    if shows_go {
        application.step(Input::CorridorOpen(Millis(1_900)));
    }
    application.act(&Effect::Dropped {
        cause,
        detail: String::new(),
        octets: Vec::new(),
    });
    application
}

/// Hazard: a car comes during a flood of packets, nobody hears it, and go begins in front of it.
#[test]
fn packets_that_are_dropped_for_their_number_may_be_those_of_a_vehicle() {
    let too_many_new = Cause::Rejected(Rejected::TooManyNew.cause());
    for (cause, hindered_ms) in [
        (Cause::SocketFull, Some(5_000)),
        (Cause::InboxFull, Some(5_000)),
        (too_many_new, Some(5_000)),
        (Cause::WaitedTooLong, Some(1_000)),
        (Cause::Rejected(Rejected::Signature.cause()), None),
        (Cause::NotCanonical, None),
    ] {
        for ms in [0, 999, 1_000, 4_999, 5_000] {
            let mut application = leader_that_drops(cause, false);
            application.advance(10.0 + f64::from(ms) / 1e3);
            let hindered = application.crossing.hindered(&application.setup);
            let expected = hindered_ms.is_some_and(|until_ms| ms < until_ms);
            assert_eq!(hindered.is_some(), expected, "{cause} {ms} ms");
        }
    }
    let mut application = leader_that_drops(Cause::InboxFull, false);
    application.step(Input::CorridorOpen(Millis(1_900)));
    let why = application.next_hindrance().unwrap();
    assert!(why.starts_with("packets were dropped"), "{why}");
}

/// Go ends in a flood as it does where the channel is jammed. A robot that was held up for a moment keeps the go that it has.
#[test]
fn go_ends_in_a_flood_and_not_because_packets_have_waited() {
    let too_many_new = Cause::Rejected(Rejected::TooManyNew.cause());
    for (cause, goes_on) in [
        (Cause::SocketFull, false),
        (Cause::InboxFull, false),
        (too_many_new, false),
        (Cause::WaitedTooLong, true),
    ] {
        let application = leader_that_drops(cause, true);
        let shows_go = application.sign().shows_go(10_000_000);
        assert_eq!(shows_go, goes_on, "{cause}");
    }
}

/// Hazard: a vehicle that does not say how fast it is, or that was measured a while ago, counts as none, or as where it was.
#[test]
fn what_a_vehicle_does_not_say_makes_nothing_safer() {
    let (itself, seen) = (Identity::Station(9), Identity::Object { by: 9, number: 1 });
    for (identity, east, mps, heading, ago_ms, expected) in [
        (itself, -60.0, Some(13.9), Some(90.0), 0, true),
        (itself, -60.0, None, Some(90.0), 0, true),
        (itself, -60.0, None, None, 0, true),
        (itself, -60.0, Some(0.0), None, 0, false),
        (itself, -60.0, None, Some(270.0), 0, false),
        (itself, -100.0, None, None, 0, false),
        // It needs 60 m, and has 71 m when it is measured.
        (itself, -80.0, Some(13.9), Some(90.0), 0, false),
        (itself, -80.0, Some(13.9), Some(90.0), 1_000, true),
        // Its clock is ahead of the robot's, or a minute behind.
        (itself, -80.0, Some(13.9), Some(90.0), -1_000, false),
        (itself, -80.0, Some(13.9), Some(90.0), 60_000, true),
        (itself, -120.0, Some(13.9), Some(90.0), 60_000, false),
        // The front of a bus is 6 m ahead of its middle.
        (itself, -72.0, Some(13.9), Some(90.0), 0, false),
        (seen, -72.0, Some(13.9), Some(90.0), 0, true),
        (seen, -84.0, Some(13.9), Some(90.0), 0, false),
    ] {
        let mut application = watching();
        let known = vehicle(east, (0.0, 0.0));
        let user = RoadUser {
            identity,
            speed: mps,
            heading,
            measured_its: known.measured_its.strict_sub_signed(ago_ms),
            ..known
        };
        let what = format!("{user:?}");
        hears_of(&mut application, user, 10_000);
        application.advance(10.0);
        let hindered = application.crossing.hindered(&application.setup);
        assert_eq!(hindered.is_some(), expected, "{what}: {hindered:?}");
    }
}

/// Hazard: a car backs to the crossing with its rear, which is its length before the place that it says, and is taken to go away.
#[test]
fn the_rear_of_a_vehicle_that_may_back_comes_first_in_any_direction() {
    let [comes, goes] = [90.0, 270.0].map(|heading| vehicle(-25.0, (3.0, heading)));
    let backs = |user| RoadUser {
        heading: None,
        ..user
    };
    let long = |user| RoadUser {
        length: Some(18.0),
        ..user
    };
    let object = RoadUser {
        identity: Identity::Object { by: 9, number: 1 },
        ..comes
    };
    let person = RoadUser {
        kind: Kind::Vru,
        ..comes
    };
    // It needs 7.5 m. The crossing begins 17 m before it, less 1 m that its place is inexact.
    for (user, expected) in [
        (comes, false),
        (goes, false),
        (backs(goes), true),
        (backs(person), false),
        (long(comes), false),
        (long(goes), true),
        (object, false),
        (long(object), true),
    ] {
        let mut application = watching();
        let what = format!("{user:?}");
        hears_of(&mut application, user, 10_000);
        let hindered = application.crossing.hindered(&application.setup);
        assert_eq!(hindered.is_some(), expected, "{what}: {hindered:?}");
    }
}

/// A car at 50 km/h, 67 m before the crossing.
#[test]
fn a_vehicle_that_does_not_say_how_exact_its_place_is_may_be_nearer() {
    let exact = vehicle(-76.0, (13.9, 90.0));
    for (ellipse, expected) in [(exact.position.ellipse, false), (None, true)] {
        let mut application = watching();
        let position = Position {
            ellipse,
            ..exact.position
        };
        hears_of(&mut application, RoadUser { position, ..exact }, 10_000);
        let hindered = application.crossing.hindered(&application.setup);
        assert_eq!(hindered.is_some(), expected);
    }
}

/// A cyclist, by VAM, in the queue before a guard.
#[test]
fn a_rider_who_is_heard_beside_the_crossing_is_not_on_the_road() {
    for (station_type, expected) in [(1, true), (2, false), (4, false)] {
        let mut application = watching();
        let corners = [(-300, 0), (500, 0), (500, 700), (-300, 700)];
        let corners = corners.map(|(east, north)| crossguard_crossing::Point::new(east, north));
        application.setup.ground.crossing = crossguard_crossing::Shape::new(&corners);
        let user = RoadUser {
            kind: Kind::Vru,
            station_type: Some(station_type),
            ..vehicle(-8.0, (0.0, 90.0))
        };
        hears_of(&mut application, user, 10_000);
        let tracks = application.crossing.tracks();
        assert_eq!(tracks.is_on_road(), expected, "{station_type}");
    }
}

/// Hazard: a camera reports people and vehicles without numbers, and one stands for all of them, or hides one with a number.
#[test]
fn road_users_without_numbers_are_as_many_as_are_reported() {
    let by = 9;
    let comes = Identity::Unnumbered { by, place: 0 };
    let others = [
        Identity::Unnumbered { by, place: 1 },
        Identity::Object { by, number: 0 },
        Identity::Station(by),
    ];
    let mut application = watching();
    let car = RoadUser {
        identity: comes,
        ..vehicle(-30.0, (13.9, 90.0))
    };
    hears_of(&mut application, car, 10_000);
    for identity in others {
        let stands = RoadUser {
            identity,
            ..vehicle(-40.0, (0.0, 90.0))
        };
        hears_of(&mut application, stands, 10_000);
    }
    let hindered = application.crossing.hindered(&application.setup);
    assert!(hindered.is_some());
    let mut application = watching();
    for (place, north) in [(0, 2.0), (1, 5.0)] {
        let person = RoadUser {
            identity: Identity::Unnumbered { by, place },
            kind: Kind::Vru,
            position: Site::default().position(Place::new(0.0, north)),
            ..vehicle(0.0, (0.0, 0.0))
        };
        hears_of(&mut application, person, 10_000);
    }
    let on_road = application.crossing.tracks().iter();
    assert_eq!(on_road.filter(|it| it.is_on_road()).count(), 2);
}

/// Something without a class on the road, known to 20 cm: so many metres to the north of the kerb.
fn object(identity: Identity, north: f64) -> RoadUser {
    RoadUser {
        identity,
        kind: Kind::Object,
        position: Site::default().position(Place::new(0.0, north)),
        ..vehicle(0.0, (0.0, 0.0))
    }
}

/// A robot whose sensors have nobody on the road, once it has heard of these.
fn hearing(map: &LocalDynamicMap) -> Application {
    let mut application = watching();
    for frame in 1..=6 {
        let taken_ms = 10_000 + 100 * i64::from(frame);
        application.look_at(
            10.0 + 0.1 * f64::from(frame),
            &SensorFrame::default(),
            taken_ms,
        );
    }
    assert!(application.crossing.is_clear(&application.setup));
    let moment = Moment::after(BEGAN_ITS, 10_600);
    application.listen(map, &Robot::new(StationId(1), 1), moment);
    application
}

/// Whether it knows the road to be clear, after the last of these reports. Each came so many milliseconds before.
fn is_clear_after(reports: &[(RoadUser, u64)]) -> bool {
    let mut map = LocalDynamicMap::default();
    for (user, before_ms) in reports {
        map.observe(*user, 10_600 - before_ms);
    }
    let application = hearing(&map);
    application.crossing.is_clear(&application.setup)
}

/// Hazard: a camera takes a person for a vehicle by a hair, and guards leave; or a vehicle for a person, and go begins in front of it.
#[test]
fn somebody_who_may_be_a_person_or_a_vehicle_counts_as_both() {
    for (kind, is_either, is_clear, hinders) in [
        (Kind::Vehicle, false, true, true),
        (Kind::Vehicle, true, false, true),
        (Kind::Vru, false, false, false),
        (Kind::Vru, true, false, true),
        (Kind::Object, true, false, true),
    ] {
        let mut map = LocalDynamicMap::default();
        let walks = RoadUser {
            kind,
            speed: Some(1.5),
            ..object(Identity::Object { by: 9, number: 1 }, 3.0)
        };
        map.observe_unsure(walks, is_either, 10_600);
        let application = hearing(&map);
        let is = application.crossing.is_clear(&application.setup);
        let hindered = application.crossing.hindered(&application.setup);
        assert_eq!(
            (is, hindered.is_some()),
            (is_clear, hinders),
            "{kind:?} {is_either}"
        );
    }
}

/// Hazard: a camera does not know what is on the crossing, and a person is nobody. Or it has a guard, and the team is never free.
#[test]
fn an_object_without_a_class_may_be_a_person_unless_it_is_one_robot() {
    type Case<'a> = (&'a str, &'a [(RoadUser, u64)], bool);
    let [a, b] = [1, 2].map(|number| Identity::Object { by: 9, number });
    let by_other = Identity::Object { by: 8, number: 1 };
    let unnumbered = Identity::Unnumbered { by: 9, place: 0 };
    let robot = RoadUser {
        kind: Kind::Robot,
        ..object(Identity::Station(5), 3.0)
    };
    let fast = |speed| RoadUser {
        speed,
        ..object(a, 3.0)
    };
    let inexact = |user: RoadUser| RoadUser {
        position: Site::default().position_within(Place::new(0.0, 3.0), Some(2.1)),
        ..user
    };
    let cases: [Case<'_>; 16] = [
        ("nothing", &[], true),
        ("something", &[(object(a, 3.0), 0)], false),
        ("something long ago", &[(object(a, 3.0), 100)], true),
        ("of unknown speed", &[(fast(None), 0)], false),
        ("a vehicle", &[(fast(Some(5.0)), 0)], true),
        ("on the pavement", &[(object(a, 9.0), 0)], true),
        ("this robot's body", &[(object(a, 0.2), 0)], true),
        ("a robot", &[(robot, 90), (object(a, 4.0), 0)], true),
        ("beside a robot", &[(robot, 90), (object(a, 5.1), 0)], false),
        (
            "a robot that fell silent",
            &[(robot, 1_000), (object(a, 3.0), 0)],
            false,
        ),
        (
            "a robot anywhere",
            &[(inexact(robot), 90), (object(a, 3.0), 0)],
            false,
        ),
        (
            "something anywhere",
            &[(robot, 90), (inexact(object(a, 3.0)), 0)],
            false,
        ),
        (
            "without a number",
            &[(robot, 90), (object(unnumbered, 3.0), 0)],
            false,
        ),
        (
            "a robot and a person beside it",
            &[(robot, 90), (object(a, 3.1), 0), (object(b, 4.0), 0)],
            false,
        ),
        // A station tells of each of them about once a second.
        (
            "a person beside a robot that was in the report before",
            &[(robot, 90), (object(a, 3.1), 900), (object(b, 4.0), 0)],
            false,
        ),
        (
            "a robot by two stations",
            &[(robot, 90), (object(a, 3.1), 0), (object(by_other, 4.0), 0)],
            true,
        ),
    ];
    let wrong = cases.into_iter().filter_map(|(name, reports, expected)| {
        let is_wrong = is_clear_after(reports) != expected;
        is_wrong.then_some(name)
    });
    assert_eq!(wrong.collect::<Vec<_>>(), [""; 0]);
}

#[test]
fn a_word_that_came_too_early_is_counted() {
    let mut application = watching();
    application.carry_out(&[Output::SaidTooEarly].into_iter().collect());
    let (cause, what, _) = application.next_trouble().unwrap();
    assert_eq!((cause, &*what), (Cause::SaidTooEarly, "clear"));
}

/// Hazard: an operator says that everybody is across while people step on the road at go, or while sensors have one there.
#[test]
fn a_person_completes_no_task_while_go_is_shown_or_somebody_is_seen_on_the_road() {
    let mut application = watching();
    assert!(application.say_completed());
    application.sign.go(micros(10.0), Millis(100));
    assert!(!application.say_completed());
    let (cause, what, _) = application.next_trouble().unwrap();
    assert_eq!((cause, &*what), (Cause::SaidTooEarly, "task-completed"));
    application.advance(10.2);
    assert!(application.say_completed());
    let person = SensorFrame::of(&[PerceivedVru::pedestrian(1, [1.0, 3.0])]);
    application.look(&person, Millis::ZERO);
    assert!(!application.say_completed());
}

/// Hazard: a guard whose position is not known passes for one that is at its place.
#[test]
fn a_position_that_is_not_known_is_no_pose() {
    let application = Application::new(Box::new(Broken::default()), None);
    assert_eq!(application.pose(&Position::default()), None);
    let known = Site::default().position(Place::new(4.0, 2.0));
    let pose = application.pose(&Position {
        ellipse: None,
        ..known
    });
    assert_eq!(pose.map(|it| it.error_cm), Some(100));
}
