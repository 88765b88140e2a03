//! A robot that knows one road helps there: it offers no help at another crossing, whose road is another one.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, Position, RobotState, Service, encode, ram_from};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Endpoint, Served, Stimulus};
use crossguard_protocol::{
    Availability, Confirmation, Coordination, Event, Heartbeat, HelpRequest, Millis, OfferNumber,
    Place, Ram, Role, SessionNumber, StationId, TaskSet, TaskType, UniqueNumber, Urgency,
};

use crate::support::{detected, endpoint, handle, hear, moment, ram};

const TASK: TaskType = TaskType::BLOCK;
const LATITUDE: f64 = 49.0;

const OWN: Place = Place(7);
const OTHER: Place = Place(8);
const ANY: Place = Place::UNKNOWN;

/// A place so many metres to the north of the crossing.
fn north(metres: f64) -> Position {
    Position::at(LATITUDE + metres / 111_200.0, 8.4)
}

/// A robot that serves this crossing, at which something was told it before.
fn serves(served: Option<Place>, before: Option<Event>) -> Endpoint {
    let mut robot = endpoint(StationId(2));
    robot.serve(served.map(|place| Served {
        place,
        middle: north(0.0),
        within_m: 60.0,
    }));
    if let Some(event) = before {
        handle(&mut robot, 0, Stimulus::Event(event));
    }
    robot
}

/// It hears station 1, which is here, say this by two heartbeats, from then on.
fn hears(robot: &mut Endpoint, says: impl Fn(u16) -> Coordination, from: Position, from_ms: u64) {
    let ids = Identifiers::default();
    let mut stack = Stack::of_robot(ids, StationId(1));
    for beat in 0..2 {
        let ram = Ram {
            station: StationId(1),
            coordination: says(beat),
            farewell: None,
            on_duty: false,
        };
        let state = RobotState {
            position: from,
            ..RobotState::default()
        };
        let ram = ram_from(&ids, &state, &ram, Availability::Available, 0, false);
        let message = encode(&ids, &ram.unwrap()).unwrap();
        let packet = stack.packet(&EgoPosition::default(), Service::Ram, &message);
        let packet = &packet.unwrap();
        let arrived_ms = from_ms + 100 * u64::from(beat) + 100;
        let datagram = Stimulus::Datagram { packet, arrived_ms };
        let own = RobotState {
            position: north(-5.0),
            ..RobotState::default()
        };
        robot.handle(moment(arrived_ms), &own, datagram);
    }
}

const NUMBER: SessionNumber = SessionNumber(UniqueNumber { boot: 1, count: 0 });

/// A robot that serves this crossing hears a station that is here ask for help there, twice.
fn ask(served: Option<Place>, before: Option<Event>, place: Place, from: Position) -> Endpoint {
    let mut helper = serves(served, before);
    let asks = |beat| Coordination::NeedHelp {
        number: NUMBER,
        heartbeat: Heartbeat(beat),
        request: HelpRequest {
            urgency: Urgency::High,
            followers: 1,
            tasks: TaskSet::of(&[TASK]),
            place,
        },
    };
    hears(&mut helper, asks, from, 0);
    helper
}

/// What a leader says at this place, whose follower is this one.
fn leads(place: Place, follower: u32) -> impl Fn(u16) -> Coordination {
    move |beat| {
        let follower = Confirmation {
            station: StationId(follower),
            offer: OfferNumber(UniqueNumber { boot: 1, count: 0 }),
        };
        Coordination::Leader {
            number: NUMBER,
            heartbeat: Heartbeat(beat),
            followers: std::iter::once(follower).collect(),
            urgency: Urgency::High,
            place,
            yields: false,
        }
    }
}

/// Hazard: a robot is recruited for a crossing 200 m away, and goes by the kerbs, the people and the vehicles of its own road.
#[test]
fn a_robot_offers_no_help_at_another_crossing() {
    let unknown = Position::default();
    for (served, place, from, helps) in [
        (None, ANY, north(200.0), true),
        (None, OTHER, unknown, true),
        (Some(ANY), ANY, north(20.0), true),
        (Some(ANY), ANY, north(200.0), false),
        (Some(ANY), ANY, unknown, false),
        (Some(ANY), OTHER, north(60.0), true),
        // As far away as it may be, with the 1 m by which its place may be wrong.
        (Some(OWN), ANY, north(60.8), true),
        (Some(OWN), ANY, north(61.2), false),
        (Some(OWN), OTHER, north(5.0), false),
        (Some(OWN), OWN, north(200.0), true),
        (Some(OWN), OWN, unknown, true),
    ] {
        let what = format!("{served:?} {place:?} {from:?}");
        let helper = ask(served, None, place, from);
        assert_eq!(helper.robot().role() == Role::Helper, helps, "{what}");
        let dropped = helper.counters().of(Cause::OtherCrossing);
        assert_eq!(dropped, if helps { 0 } else { 2 }, "{what}");
        // It is around all the same.
        assert_eq!(helper.map().iter().count(), 1, "{what}");
    }
}

/// Hazard: somebody waits here, and the robot that asks for help withdraws in favour of a crossing 200 m away.
#[test]
fn a_request_at_another_crossing_goes_before_none() {
    let detected = detected(TASK, Place::UNKNOWN);
    for (metres, role) in [(20.0, Role::Helper), (200.0, Role::Requester)] {
        let served = Some(Place::UNKNOWN);
        let helper = ask(served, Some(detected), Place::UNKNOWN, north(metres));
        assert_eq!(helper.robot().role(), role, "{metres}");
    }
}

/// Who leads at which place, from where; and whether that may be at the crossing of a robot that serves one of this name.
const LEADERS: [(Place, Place, Option<f64>, bool); 8] = [
    (ANY, ANY, Some(20.0), true),
    (ANY, ANY, Some(200.0), false),
    (ANY, OTHER, Some(200.0), false),
    (OWN, ANY, Some(200.0), false),
    // By its name it is this one, wherever the leader stands.
    (OWN, OWN, Some(200.0), true),
    // It does not say where it is: nobody knows that two signs are not at one crossing.
    (ANY, ANY, None, true),
    (OWN, ANY, None, true),
    (OWN, OTHER, Some(5.0), false),
];

/// Hazard: somebody waits here, and the robot that asks for help withdraws, again and again, for a leader 200 m away that does not say
/// for which crossing.
#[test]
fn a_leader_at_another_crossing_takes_no_call_away() {
    for (served, place, metres, withdraws) in LEADERS {
        let mut robot = serves(Some(served), Some(detected(TASK, served)));
        let from = metres.map_or_else(Position::default, north);
        hears(&mut robot, leads(place, 9), from, 0);
        let is_withdrawn = robot.robot().role() == Role::None;
        assert_eq!(is_withdrawn, withdraws, "{served} {place} {metres:?}");
        let dropped = robot.counters().of(Cause::OtherCrossing);
        let is_named = !served.may_be(place);
        assert_eq!(dropped == 0, withdraws || is_named, "{dropped}");
        assert_eq!(robot.map().iter().count(), 1, "it is around all the same");
    }
}

/// Hazard: the corridor closes with somebody on the road, because of a leader 200 m away.
#[test]
fn a_leader_yields_to_none_at_another_crossing() {
    for (served, place, metres, yields) in LEADERS {
        let mut robot = serves(Some(served), Some(detected(TASK, served)));
        let offer = Coordination::OfferHelp {
            session: robot.robot().session().unwrap(),
            offer: OfferNumber(UniqueNumber { boot: 1, count: 0 }),
            capabilities: TaskSet::of(&[TASK]),
            echo: Heartbeat(0),
            t_safety: Millis(2_000),
        };
        let helper = StationId(3);
        let mut stack = Stack::of_robot(Identifiers::default(), helper);
        let mut now_ms = 0;
        while robot.robot().role() != Role::Leader {
            now_ms += 100;
            assert!(now_ms < 5_000, "nobody leads");
            handle(&mut robot, now_ms, Stimulus::Time);
            hear(&mut robot, now_ms, &ram(&mut stack, helper, offer));
        }
        let from = metres.map_or_else(Position::default, north);
        hears(&mut robot, leads(place, 9), from, now_ms);
        // Nobody is on the road yet, so one that yields ends at once.
        let has_yielded = robot.robot().role() != Role::Leader;
        assert_eq!(has_yielded, yields, "{served} {place} {metres:?}");
    }
}

/// A leader that counts on an offer of this robot is told that it does not stand, from wherever it leads.
#[test]
fn a_leader_elsewhere_that_lists_this_robot_is_heard() {
    let mut robot = serves(Some(ANY), Some(detected(TASK, ANY)));
    hears(&mut robot, leads(ANY, 2), north(200.0), 0);
    assert_eq!(robot.counters().of(Cause::OtherCrossing), 0);
}
