//! Two machines: what is ordered, shown and selected.

mod support;

use crossguard_codec::{
    Identity, MapPlace, PublicSignal, SignalMeans, SignalsShown, TaskParameters,
};
use crossguard_endpoint::station::Security;
use crossguard_endpoint::{Effect, Stimulus};
use crossguard_protocol::{Config, Event, Output, Phase, StationId, TaskType};
use crossguard_robot::body::Build;
use crossguard_robot::machine::Machine;
use crossguard_robot::plan::{Leg, Plan, Stage};
use crossguard_robot::runtime::Order;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::Road;

use self::support::{TICK_MS, effects};

const FOLLOWER: StationId = StationId(2);

/// Maneuvers that the follower was to start, in order.
type Started = Vec<(TaskType, TaskParameters)>;
type Street = support::Street<Started>;

fn machine(station: u32) -> Machine {
    let place = Place::new(f64::from(station), 0.0);
    let body = (Build::Quadruped, place, 30.0);
    support::machine(station, body, None, Road::Unknown, Security::default())
}

fn street() -> Street {
    let robots = vec![Some(machine(1)), Some(machine(FOLLOWER.0))];
    Street::new(robots, |started, _, effect| {
        if let Effect::Act(Output::StartManeuver(maneuver), parameters) = effect {
            started.push((maneuver.task, parameters));
        }
    })
}

#[test]
fn the_other_robot_has_on_its_map_what_is_shown_to_people() {
    let mut street = street();
    let on_the_map = |street: &mut Street| {
        let map = street.robot(1).endpoint.map();
        map.get(Identity::Station(1)).unwrap().user.signals
    };
    street.pass(2_000);
    assert_eq!(on_the_map(&mut street), None);
    let shown = |to_vehicles, to_pedestrians| SignalsShown {
        to_vehicles,
        to_pedestrians,
        means: SignalMeans::LIGHTS,
    };
    let (stop, caution) = (PublicSignal::Stop, PublicSignal::Caution);
    let application = &mut street.robot(0).application;
    application.obey(Order::Show(shown(stop, caution)));
    street.pass(2_000);
    assert_eq!(on_the_map(&mut street), Some(shown(stop, caution)));
    // A robot that asks for help or leads has a sign. Its RAM say what the sign shows, the first one, too.
    let request = Plan::crossing(Site::default()).request();
    street.pass(200);
    street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
    assert_eq!(on_the_map(&mut street), Some(shown(stop, stop)));
    street.pass(2_000);
    assert_eq!(on_the_map(&mut street), Some(shown(stop, stop)));
    // Without means, they are those of before.
    let quiet = SignalsShown {
        means: SignalMeans::default(),
        ..shown(PublicSignal::None, PublicSignal::None)
    };
    street.robot(0).application.obey(Order::Show(quiet));
    street.pass(1_000);
    assert_eq!(
        on_the_map(&mut street),
        Some(shown(PublicSignal::None, stop))
    );
}

/// Hazard: a robot stands on a lane with people behind it, and shows vehicles nothing.
#[test]
fn who_holds_vehicles_back_shows_them_stop_until_the_road_is_clear() {
    let site = Site::default();
    let block = Leg::new(TaskType::BLOCK, Place::new(2.0, 4.0));
    let plan = Plan {
        shows: Some(PublicSignal::Stop),
        stages: vec![Stage::everybody(block)],
        ..Plan::crossing(site)
    };
    for (gone, stays) in [(1, 0), (0, 1)] {
        let machine = |station, plan| {
            let body = (Build::Humanoid, Place::new(f64::from(station), 0.0), 30.0);
            support::machine(station, body, plan, Road::Unknown, Security::default())
        };
        let robots = vec![Some(machine(1, Some(plan.clone()))), Some(machine(2, None))];
        let mut street: Street = Street::new(robots, |_, _, _| {});
        for robot in 0..2 {
            let shown = SignalsShown {
                to_vehicles: PublicSignal::None,
                to_pedestrians: PublicSignal::None,
                means: SignalMeans::GESTURE,
            };
            street.robot(robot).application.obey(Order::Show(shown));
        }
        let to_vehicles = |street: &mut Street| {
            let state = street.robot(stays).application.state();
            state.slow.unwrap().signals.unwrap().to_vehicles
        };
        street.pass(1_000);
        assert_eq!(to_vehicles(&mut street), PublicSignal::None);
        let detected = Event::PedestrianDetected(plan.request());
        street.tell(0, Stimulus::Event(detected));
        street.pass(2_000);
        assert_eq!(to_vehicles(&mut street), PublicSignal::Stop);
        // The other robot is gone, and nobody knows whether somebody is on the road.
        street.robots[gone] = None;
        street.pass(70_000);
        let robot = street.robot(stays).endpoint.robot();
        assert!(robot.duty().is_some(), "{:?}", robot.phase());
        assert_eq!(to_vehicles(&mut street), PublicSignal::Stop);
        street.robot(stays).application.say_clear();
        street.pass(1_000);
        assert_eq!(to_vehicles(&mut street), PublicSignal::None);
    }
}

/// How long a robot that asks for help takes to lead, with a follower nearby, in ms.
fn selects_after(street: &mut Street) -> u32 {
    let request = Plan::crossing(Site::default()).request();
    let asked_ms = street.now_ms;
    street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
    let leads = |it: &Machine| matches!(it.endpoint.robot().phase(), Phase::Leading(_));
    while !leads(street.robot(0)) {
        street.pass(TICK_MS);
        assert!(street.now_ms < asked_ms + 2_000, "it never leads");
    }
    street.now_ms - asked_ms
}

#[test]
fn a_request_that_all_robots_nearby_have_answered_waits_for_no_other() {
    let t_select_ms = Config::default().settings().t_select.0;
    let mut alone = street();
    alone.pass(2_000);
    assert!(selects_after(&mut alone) < t_select_ms);
    // A third robot was heard a moment ago, and may answer still.
    let mut street = street();
    street.pass(2_000);
    let said = effects(&mut machine(3), street.now_ms, Stimulus::Time);
    let packet = said.into_iter().find_map(|effect| match effect {
        Effect::Transmit { packet, .. } => Some(packet),
        _ => None,
    });
    let heard = Stimulus::Datagram {
        packet: &packet.expect("a RAM"),
        arrived_ms: street.now_ms.into(),
    };
    street.tell(0, heard);
    assert!(selects_after(&mut street) >= t_select_ms);
}

#[test]
fn a_command_without_parameters_has_none_though_the_one_before_had() {
    let mut street = street();
    let request = Plan::crossing(Site::default()).request();
    street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
    street.pass(1_000);
    let slowly = TaskParameters {
        maximum_speed: Some(0.5),
        map_place: Some(MapPlace::RoadSegment {
            region: Some(276),
            id: 12,
        }),
        ..TaskParameters::default()
    };
    street.tell(
        0,
        Stimulus::Command {
            follower: FOLLOWER,
            task: TaskType::INITIAL_POS,
            parameters: slowly,
        },
    );
    street.pass(3_000);
    let again = Event::CommandManeuver {
        follower: FOLLOWER,
        task: TaskType::MOVE,
    };
    street.tell(0, Stimulus::Event(again));
    street.pass(1_000);
    let expected = [
        (TaskType::INITIAL_POS, slowly),
        (TaskType::MOVE, TaskParameters::default()),
    ];
    assert_eq!(street.notes, expected);
}
