//! When a robot that fell back says that the road is clear: never by itself where it knows nothing of the
//! road, and otherwise once everybody that its sensors had on the road was seen beside it.

use crossguard_codec::{Identifiers, TaskParameters};
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Config, Event, HelpRequest, Millis, Robot, StationId, TaskSet, TaskType,
};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::machine::Machine;
use crossguard_robot::perception::SensorFrame;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::{Road, Street};
use crossguard_robot::zone::Zone;

const TICK_MS: u32 = 10;

/// A leader that falls silent while its follower does something, and the follower.
struct Pair {
    leader: Option<Machine>,
    follower: Machine,
    now_ms: u32,
}

fn machine(station: u32, road: Road) -> Machine {
    let robot = Robot::new(StationId(station), 1);
    let endpoint = Endpoint::new(robot, Config::default(), Identifiers::default(), 0);
    let place = Place::new(f64::from(station), 2.0);
    let body = Simulated::new(Build::Quadruped, Site::default(), place, 1.0, 1);
    Machine::new(endpoint, Application::new(Box::new(body), None).on(road))
}

/// A request for a robot that blocks.
fn blocking() -> HelpRequest {
    HelpRequest {
        tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::BLOCK]),
        ..Plan::crossing(Site::default()).request()
    }
}

impl Pair {
    /// 12 s after the leader fell silent: the follower's session is over.
    fn left_alone(task: TaskType, road: Road) -> Self {
        let mut pair = Self {
            leader: Some(machine(1, Road::Unknown)),
            follower: machine(2, road),
            now_ms: 0,
        };
        let request = blocking();
        pair.tell_leader(Stimulus::Event(Event::PedestrianDetected(request)));
        pair.pass(1_000);
        pair.tell_leader(Stimulus::Order {
            follower: StationId(2),
            task,
            parameters: TaskParameters {
                target: Some(Site::default().target(Place::new(30.0, 2.0))),
                ..TaskParameters::default()
            },
        });
        pair.pass(1_000);
        pair.leader = None;
        pair.pass(12_000);
        assert!(pair.follower.endpoint().robot().session().is_none());
        pair
    }

    fn tell_leader(&mut self, stimulus: Stimulus<'_>) {
        let packets = self
            .leader
            .as_mut()
            .map(|it| sent(it, self.now_ms, stimulus));
        for packet in packets.into_iter().flatten() {
            self.tell_follower(Stimulus::Datagram {
                packet: &packet,
                arrived_ms: self.now_ms.into(),
            });
        }
    }

    fn tell_follower(&mut self, stimulus: Stimulus<'_>) {
        for packet in sent(&mut self.follower, self.now_ms, stimulus) {
            self.tell_leader(Stimulus::Datagram {
                packet: &packet,
                arrived_ms: self.now_ms.into(),
            });
        }
    }

    fn pass(&mut self, ms: u32) {
        let until_ms = self.now_ms + ms;
        while self.now_ms < until_ms {
            self.now_ms += TICK_MS;
            self.tell_leader(Stimulus::Time);
            self.tell_follower(Stimulus::Time);
        }
    }

    fn sees(&mut self, id: u32, east: f64, north: f64) {
        let vru = PerceivedVru {
            id,
            position_m: [east, north],
            velocity_mps: [0.0; 2],
            class: VruClass::Pedestrian,
            confidence: 1.0,
        };
        let frame = SensorFrame::of(&[vru]);
        self.follower.application_mut().look(&frame, Millis(0));
        self.pass(100);
    }

    fn is_on_duty(&self) -> bool {
        self.follower.endpoint().robot().duty().is_some()
    }
}

fn sent(machine: &mut Machine, now_ms: u32, stimulus: Stimulus<'_>) -> Vec<Vec<u8>> {
    let moment = Moment {
        now_ms: now_ms.into(),
        timestamp_its: 694_694_401_000 + u64::from(now_ms),
    };
    let effects = machine.handle(moment, f64::from(now_ms) / 1e3, stimulus);
    let packets = effects.into_iter().filter_map(|effect| match effect {
        Effect::Transmit { packet, .. } => Some(packet),
        _ => None,
    });
    packets.collect()
}

#[test]
fn a_guard_that_knows_nothing_of_the_road_waits_for_a_person() {
    // Its own simulated crossing says nothing of the people that another robot let across.
    for road in [Road::Unknown, Road::Own(Street::default())] {
        let mut pair = Pair::left_alone(TaskType::BLOCK, road);
        pair.pass(60_000);
        assert!(pair.is_on_duty());
        assert!(pair.follower.application_mut().say_clear());
        pair.pass(100);
        assert!(!pair.is_on_duty());
        assert!(
            !pair.follower.application_mut().say_clear(),
            "nothing waits"
        );
    }
}

#[test]
fn the_word_of_a_person_waits_for_the_body() {
    let mut pair = Pair::left_alone(TaskType::MOVE, Road::Unknown);
    // It escorts to the nearer kerb; a word that is said on the way counts when it is there.
    assert!(pair.is_on_duty());
    pair.follower.application_mut().say_clear();
    pair.pass(60_000);
    assert!(!pair.is_on_duty());
}

#[test]
fn a_robot_that_guarded_nobody_is_free_when_its_body_is() {
    let pair = Pair::left_alone(TaskType::INITIAL_POS, Road::Unknown);
    assert!(!pair.is_on_duty());
}

#[test]
fn a_guard_with_sensors_waits_until_everybody_was_seen_beside_the_road() {
    let road = [[-3.0, 0.0], [5.0, 0.0], [5.0, 7.0], [-3.0, 7.0]];
    let zone = Zone::of_road(Area::Polygon(road.to_vec()));
    let mut pair = Pair::left_alone(TaskType::BLOCK, Road::Watched(zone));
    assert!(pair.is_on_duty(), "nothing was seen, so nothing is known");
    pair.sees(7, 1.0, 3.0);
    pair.sees(8, 9.0, 3.0);
    pair.pass(5_000);
    assert!(pair.is_on_duty(), "7 was seen last on the road");
    pair.sees(7, 1.0, 8.0);
    assert!(pair.is_on_duty(), "one frame may miss somebody");
    for _ in 0..6 {
        pair.sees(7, 1.0, 8.0);
    }
    assert!(!pair.is_on_duty());
}
