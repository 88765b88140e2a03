//! Two machines: what is ordered, shown and selected.

#![allow(clippy::large_stack_arrays, reason = "a pair of machines, in a test")]

use crossguard_codec::{
    Identifiers, Identity, MapPlace, PublicSignal, SignalMeans, SignalsShown, TaskParameters,
};
use crossguard_endpoint::{Act, Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Event, Phase, Robot, StationId, TaskType};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::machine::Machine;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};

const FOLLOWER: StationId = StationId(2);
const TICK_MS: u32 = 10;

fn machine(station: StationId) -> Machine {
    let endpoint = Endpoint::new(
        Robot::new(station, 1),
        Config::default(),
        Identifiers::default(),
        0,
    );
    let place = Place::new(f64::from(station.0), 0.0);
    let body = Simulated::new(Build::Quadruped, Site::default(), place, 30.0, 1);
    Machine::new(endpoint, Application::new(Box::new(body), None))
}

struct Street {
    robots: [Machine; 2],
    now_ms: u32,
    /// What the follower was to start, in order.
    started: Vec<(TaskType, TaskParameters)>,
}

impl Street {
    /// Tells a robot something, and both what comes of it.
    fn tell(&mut self, robot: usize, stimulus: Stimulus<'_>) {
        let moment = Moment {
            now_ms: self.now_ms.into(),
            timestamp_its: 694_694_401_000 + u64::from(self.now_ms),
        };
        let now_s = f64::from(self.now_ms) / 1e3;
        for effect in self.robots[robot].handle(moment, now_s, stimulus) {
            match effect {
                Effect::Transmit { packet, .. } => {
                    let datagram = Stimulus::Datagram {
                        packet: &packet,
                        arrived_ms: self.now_ms.into(),
                    };
                    self.tell(1 - robot, datagram);
                }
                Effect::Act(Act::Start(maneuver, parameters)) => {
                    self.started.push((maneuver.task, parameters));
                }
                _ => {}
            }
        }
    }

    fn step(&mut self) {
        self.now_ms += TICK_MS;
        for robot in 0..2 {
            self.tell(robot, Stimulus::Time);
        }
    }

    fn pass(&mut self, seconds: u32) {
        for _ in 0..seconds * 1_000 / TICK_MS {
            self.step();
        }
    }
}

#[test]
fn the_other_robot_has_on_its_map_what_is_shown_to_people() {
    let mut street = Street {
        robots: [machine(StationId(1)), machine(FOLLOWER)],
        now_ms: 0,
        started: Vec::new(),
    };
    let on_the_map = |street: &Street| {
        let map = street.robots[1].endpoint().map();
        map.get(Identity::Station(1)).unwrap().user.signals
    };
    street.pass(2);
    assert_eq!(on_the_map(&street), None);
    let shown = |to_vehicles, to_pedestrians| SignalsShown {
        to_vehicles,
        to_pedestrians,
        means: SignalMeans::LIGHTS,
    };
    let (stop, caution) = (PublicSignal::Stop, PublicSignal::Caution);
    let application = street.robots[0].application_mut();
    application.show(shown(stop, caution));
    street.pass(2);
    assert_eq!(on_the_map(&street), Some(shown(stop, caution)));
    // A leader has a sign, and what that shows is what its RAM say.
    let request = Plan::crossing(Site::default()).request();
    street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
    street.pass(2);
    assert_eq!(on_the_map(&street), Some(shown(stop, stop)));
    // Without means, they are those of before.
    let quiet = SignalsShown {
        means: SignalMeans::default(),
        ..shown(PublicSignal::None, PublicSignal::None)
    };
    street.robots[0].application_mut().show(quiet);
    street.pass(1);
    assert_eq!(on_the_map(&street), Some(shown(PublicSignal::None, stop)));
}

/// How long a robot that asks for help takes to lead, with a follower nearby, in ms.
fn selects_after(street: &mut Street) -> u32 {
    let request = Plan::crossing(Site::default()).request();
    let asked_ms = street.now_ms;
    street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
    while !matches!(
        street.robots[0].endpoint().robot().phase(),
        Phase::Leading(_)
    ) {
        street.step();
        assert!(street.now_ms < asked_ms + 2_000, "it never leads");
    }
    street.now_ms - asked_ms
}

#[test]
fn a_request_that_all_robots_nearby_have_answered_waits_for_no_other() {
    let pair = || Street {
        robots: [machine(StationId(1)), machine(FOLLOWER)],
        now_ms: 0,
        started: Vec::new(),
    };
    let t_select_ms = Config::default().settings().t_select.0;
    let mut alone = pair();
    alone.pass(2);
    assert!(selects_after(&mut alone) < t_select_ms);
    // A third robot was heard a moment ago, and may answer still.
    let mut street = pair();
    street.pass(2);
    let moment = Moment {
        now_ms: street.now_ms.into(),
        timestamp_its: 694_694_401_000 + u64::from(street.now_ms),
    };
    let mut third = machine(StationId(3));
    let effects = third.handle(moment, f64::from(street.now_ms) / 1e3, Stimulus::Time);
    let packet = effects.into_iter().find_map(|effect| match effect {
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
    let mut street = Street {
        robots: [machine(StationId(1)), machine(FOLLOWER)],
        now_ms: 0,
        started: Vec::new(),
    };
    let request = Plan::crossing(Site::default()).request();
    street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
    street.pass(1);
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
        Stimulus::Order {
            follower: FOLLOWER,
            task: TaskType::INITIAL_POS,
            parameters: slowly,
        },
    );
    street.pass(3);
    let again = Event::CommandManeuver {
        follower: FOLLOWER,
        task: TaskType::MOVE,
    };
    street.tell(0, Stimulus::Event(again));
    street.pass(1);
    let expected = [
        (TaskType::INITIAL_POS, slowly),
        (TaskType::MOVE, TaskParameters::default()),
    ];
    assert_eq!(street.started, expected);
}
