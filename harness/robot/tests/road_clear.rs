//! When a robot that fell back says that the road is clear: never by itself where it knows nothing of the
//! road, and otherwise once everybody that its sensors had on the road was seen beside it.

mod support;

use crossguard_codec::TaskParameters;
use crossguard_endpoint::Stimulus;
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::station::Security;
use crossguard_protocol::{Event, HelpRequest, Millis, StationId, TaskSet, TaskType};
use crossguard_robot::body::Build;
use crossguard_robot::machine::Machine;
use crossguard_robot::perception::SensorFrame;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::{Road, Street};
use crossguard_robot::zone::Zone;

/// A leader that falls silent while its follower does something, and the follower.
struct Pair(support::Street<()>);

const LEADER: usize = 0;

fn machine(station: u32, road: Road) -> Machine {
    let place = Place::new(f64::from(station), 2.0);
    let body = (Build::Quadruped, place, 1.0);
    support::machine(station, body, None, road, Security::default())
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
        let robots = vec![Some(machine(1, Road::Unknown)), Some(machine(2, road))];
        let mut street = support::Street::new(robots, |(), _, _| {});
        let detected = Event::PedestrianDetected(blocking());
        street.tell(LEADER, Stimulus::Event(detected));
        street.pass(1_000);
        let parameters = TaskParameters {
            target: Some(Site::default().target(Place::new(30.0, 2.0))),
            ..TaskParameters::default()
        };
        let follower = StationId(2);
        let order = Stimulus::Order {
            follower,
            task,
            parameters,
        };
        street.tell(LEADER, order);
        street.pass(1_000);
        street.robots[LEADER] = None;
        street.pass(12_000);
        let mut pair = Self(street);
        assert!(pair.follower().endpoint().robot().session().is_none());
        pair
    }

    fn follower(&mut self) -> &mut Machine {
        self.0.robot(1)
    }

    fn says_clear(&mut self) -> bool {
        self.follower().application_mut().say_clear()
    }

    fn sees(&mut self, id: u32, east: f64, north: f64) {
        let frame = SensorFrame::of(&[PerceivedVru::pedestrian(id, [east, north])]);
        self.follower().application_mut().look(&frame, Millis(0));
        self.0.pass(100);
    }

    fn is_on_duty(&mut self) -> bool {
        self.follower().endpoint().robot().duty().is_some()
    }
}

#[test]
fn a_guard_that_knows_nothing_of_the_road_waits_for_a_person() {
    // Its own simulated crossing says nothing of the people that another robot let across.
    for road in [Road::Unknown, Road::Own(Street::default())] {
        let mut pair = Pair::left_alone(TaskType::BLOCK, road);
        pair.0.pass(60_000);
        assert!(pair.is_on_duty());
        assert!(pair.says_clear());
        pair.0.pass(100);
        assert!(!pair.is_on_duty());
        assert!(!pair.says_clear(), "nothing waits");
    }
}

#[test]
fn the_word_of_a_person_waits_for_the_body() {
    let mut pair = Pair::left_alone(TaskType::MOVE, Road::Unknown);
    // It escorts to the nearer kerb; a word that is said on the way counts when it is there.
    assert!(pair.is_on_duty());
    pair.says_clear();
    pair.0.pass(60_000);
    assert!(!pair.is_on_duty());
}

#[test]
fn a_robot_that_guarded_nobody_is_free_when_its_body_is() {
    let mut pair = Pair::left_alone(TaskType::INITIAL_POS, Road::Unknown);
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
    pair.0.pass(5_000);
    assert!(pair.is_on_duty(), "7 was seen last on the road");
    pair.sees(7, 1.0, 8.0);
    assert!(pair.is_on_duty(), "one frame may miss somebody");
    for _ in 0..6 {
        pair.sees(7, 1.0, 8.0);
    }
    assert!(!pair.is_on_duty());
}
