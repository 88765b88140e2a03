//! A robot that knows one road helps there: it offers no help at another crossing, whose road is another one.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, Position, RobotState, Service, encode, ram_from};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Endpoint, Served, Stimulus};
use crossguard_protocol::{
    Availability, Coordination, Event, Heartbeat, HelpRequest, Place, Ram, Role, SessionNumber,
    StationId, TaskSet, TaskType, UniqueNumber, Urgency,
};

use crate::support::{detected, endpoint, handle, moment};

const TASK: TaskType = TaskType::BLOCK;
const LATITUDE: f64 = 49.0;

/// A place so many metres to the north of the crossing.
fn north(metres: f64) -> Position {
    Position::at(LATITUDE + metres / 111_200.0, 8.4)
}

/// A robot that serves this crossing hears a station that is here ask for help there, twice.
fn ask(served: Option<Place>, before: Option<Event>, place: Place, from: Position) -> Endpoint {
    let mut helper = endpoint(StationId(2));
    helper.serve(served.map(|place| Served {
        place,
        middle: north(0.0),
        within_m: 60.0,
    }));
    if let Some(event) = before {
        handle(&mut helper, 0, Stimulus::Event(event));
    }
    let ids = Identifiers::default();
    let mut stack = Stack::of_robot(ids, StationId(1));
    for beat in 0..2 {
        let ram = Ram {
            station: StationId(1),
            coordination: Coordination::NeedHelp {
                number: SessionNumber(UniqueNumber { boot: 1, count: 0 }),
                heartbeat: Heartbeat(beat),
                request: HelpRequest {
                    urgency: Urgency::High,
                    followers: 1,
                    tasks: TaskSet::of(&[TASK]),
                    place,
                },
            },
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
        let arrived_ms = 100 * u64::from(beat) + 100;
        let datagram = Stimulus::Datagram { packet, arrived_ms };
        let own = RobotState {
            position: north(-5.0),
            ..RobotState::default()
        };
        helper.handle(moment(arrived_ms), &own, datagram);
    }
    helper
}

/// Hazard: a robot is recruited for a crossing 200 m away, and goes by the kerbs, the people and the vehicles of its own road.
#[test]
fn a_robot_offers_no_help_at_another_crossing() {
    const OWN: Place = Place(7);
    const OTHER: Place = Place(8);
    const ANY: Place = Place::UNKNOWN;
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
