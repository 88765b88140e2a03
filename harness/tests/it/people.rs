//! People without a radio: a robot sees them, its RAM announces them, and a device understands it.

use std::collections::BTreeMap;

use crossguard_codec::core::ram::RAM;
use crossguard_codec::{Identifiers, Position, RobotState, Service, decode};
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_endpoint::ras::containers::{self, Announced};
use crossguard_endpoint::ras::generation::Trigger;
use crossguard_endpoint::ras::motion::Plane;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Availability, Config, Event, Robot, Settings, StationId, Unavailability,
};
use crossguard_testkit::command::*;

fn person(id: u32, east_m: f64, north_m: f64) -> PerceivedVru {
    PerceivedVru {
        id,
        position_m: [east_m, north_m],
        velocity_mps: [0.0, 0.0],
        class: VruClass::Pedestrian,
        confidence: 0.9,
    }
}

struct Street {
    endpoint: Endpoint,
    state: RobotState,
    now_ms: u64,
}

impl Street {
    fn new() -> Self {
        let config = Config::new(Settings::default()).unwrap();
        let robot = Robot::new(StationId(7), 1);
        Self {
            endpoint: Endpoint::new(robot, config, Identifiers::default(), 0),
            state: RobotState {
                position: Position::at(49.01, 8.41),
                ..RobotState::default()
            },
            now_ms: 0,
        }
    }

    /// The RAM that are sent when this happens `after_ms`: why, and what cluster they announce.
    fn hears(
        &mut self,
        after_ms: u64,
        stimulus: Stimulus<'_>,
    ) -> Vec<(Trigger, Option<Announced>)> {
        self.now_ms += after_ms;
        let moment = Moment {
            now_ms: self.now_ms,
            timestamp_its: self.now_ms,
        };
        let plane = Plane::around(&self.state.position).unwrap();
        let announced = |octets: &[u8]| {
            let ram = decode::<RAM>(&Identifiers::default(), octets)
                .unwrap()
                .message;
            containers::read(&ram, &plane)
        };
        let effects = self.endpoint.handle(moment, &self.state, stimulus);
        let sent = effects.iter().filter_map(|effect| match effect {
            Effect::Transmit {
                kind: Service::Ram,
                trigger,
                octets,
                ..
            } => Some((*trigger, announced(octets))),
            _ => None,
        });
        sent.collect()
    }
}

#[test]
fn people_around_a_robot_are_in_its_ram() {
    let mut street = Street::new();
    assert_eq!(street.hears(0, Stimulus::Time), [(Trigger::First, None)]);
    let people = [
        person(1, 3.0, 0.0),
        person(2, 2.0, -2.0),
        person(3, 40.0, 0.0),
    ];
    assert_eq!(street.hears(500, Stimulus::Perceived(&people)), []);
    let sent = street.hears(500, Stimulus::Perceived(&people));
    let [(Trigger::Interval, Some(cluster))] = &sent[..] else {
        panic!("{sent:?}")
    };
    assert_eq!(cluster.cardinality, 2);
    assert!(cluster.area.contains([3.0, 0.0]) && cluster.area.contains([2.0, -2.0]));
    assert!(!cluster.area.contains([40.0, 0.0]));
}

#[test]
fn a_crowd_is_announced_in_parts_each_within_a_second() {
    let mut street = Street::new();
    let crowd: Vec<PerceivedVru> = (0_u8..50)
        .map(|i| person(i.into(), f64::from(i % 10) - 5.0, f64::from(i / 10) - 2.0))
        .collect();
    street.hears(0, Stimulus::Perceived(&crowd));
    let mut last_ms = BTreeMap::new();
    for _ in 0..50 {
        for (trigger, cluster) in street.hears(100, Stimulus::Perceived(&crowd)) {
            assert_eq!(trigger, Trigger::Interval);
            let cluster = cluster.unwrap();
            assert!(cluster.cardinality <= 20);
            if let Some(last_ms) = last_ms.insert(cluster.id.unwrap(), street.now_ms) {
                assert!(street.now_ms - last_ms <= 1_600);
            }
        }
    }
    assert!((4..=10).contains(&last_ms.len()), "{}", last_ms.len());
}

#[test]
fn every_ram_says_why_it_was_sent() {
    let mut street = Street::new();
    street.hears(0, Stimulus::Time);
    let why = |sent: Vec<(Trigger, _)>| sent.first().map(|(trigger, _)| *trigger);
    let unavailable = Availability::Unavailable(Unavailability::LowBattery);
    let event = Event::AvailabilityChanged(unavailable);
    let sent = street.hears(200, Stimulus::Event(event));
    assert_eq!(why(sent), Some(Trigger::Availability));
    let event = Event::AvailabilityChanged(Availability::Available);
    let sent = street.hears(200, Stimulus::Event(event));
    assert_eq!(why(sent), Some(Trigger::Availability));

    street.endpoint.hold_back(500);
    street.state.speed = Some(1.0.into());
    assert_eq!(
        why(street.hears(1_000, Stimulus::Time)),
        Some(Trigger::Interval)
    );
    street.state.speed = Some(2.0.into());
    assert_eq!(why(street.hears(400, Stimulus::Time)), None);
    assert_eq!(why(street.hears(100, Stimulus::Time)), Some(Trigger::Speed));
}

#[test]
fn people_who_are_typed_are_announced_and_forgotten() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let robot = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let script = "wait 0.3\n{\"id\": 1, \"position_m\": [3, 1]}\n\
                  {\"id\": 2, \"position_m\": [300, 1]}\nwait 3.0\nquit\n";
    let output = run_with(&["run", "--config", &robot], script.as_bytes());
    let text = stdout(&output);
    assert_code(&output, 0);
    text.must_have(&["announces 1 person, cluster ", "announces nobody any more"]);
}
