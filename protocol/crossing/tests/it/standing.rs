//! What a robot does about people by the part that it has in a session: calls, goes home, tells what it sees.

use crossguard_crossing::*;
use crossguard_protocol::{Availability, Event, TaskType, Unavailability};

use crate::scene::*;
use crate::team::*;
use crate::whole::*;

/// The protocol was not free when it was told.
#[test]
fn a_call_that_had_no_effect_is_repeated_after_a_pause() {
    let mut scene = Scene::new(street());
    let mut who = person(1, 100, -100);
    let calls = |scene: &Scene| scene.told(|it| matches!(it, Event::PedestrianDetected(_)));
    scene.sees(&mut who, 1_500);
    assert_eq!(calls(&scene), 1);
    scene.tell(Input::CallIgnored);
    scene.sees(&mut who, 1_900);
    assert_eq!(calls(&scene), 1);
    scene.sees(&mut who, 200);
    assert_eq!(calls(&scene), 2);
}

#[test]
fn a_robot_that_is_unavailable_calls_nobody_and_stays() {
    let mut team = alone(0);
    team.robots[0].body.at = Point::new(0, 100);
    team.robots[0].setup.home = Some(Point::new(0, -150));
    let why = Availability::Unavailable(Unavailability::EmergencyStop);
    team.event(0, Event::AvailabilityChanged(why));
    team.people = vec![person(1, 100, -100)];
    team.pass(3_000);
    assert_eq!(calls(&team), 0);
    assert_eq!(team.robots[0].body.at, Point::new(0, 100));
    team.event(0, Event::AvailabilityChanged(Availability::Available));
    team.pass(3_000);
    assert!(calls(&team) > 0 && team.robots[0].body.at != Point::new(0, 100));
}

/// It has fallen back on the road, which is not known to be clear yet.
#[test]
fn a_guard_on_duty_calls_nobody_and_stays() {
    let mut team = left_alone(TaskType::BLOCK, true);
    team.robots[1].setup.home = Some(Point::new(-100, -150));
    team.robots[1].setup.ground = street().ground;
    team.people = vec![person(1, 100, -100)];
    team.pass_until("a duty", |it| it.robots[1].robot.duty().is_some());
    let at = team.robots[1].body.at;
    assert!(is_on_road(&team.robots[1].body));
    team.pass(3_000);
    assert!(team.robots[1].robot.duty().is_some());
    assert_eq!(team.robots[1].body.at, at);
    let called = team.told(1, |it| matches!(it, Event::PedestrianDetected(_)));
    assert_eq!(called, 0);
}

#[test]
fn a_follower_says_once_that_it_sees_somebody_on_the_road_and_that_it_does_not_any_more() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    walk_across(&mut team);
    team.pass_until("idle", Team::is_idle);
    for event in [Event::PersonOnRoad, Event::RoadClear] {
        assert_eq!(team.told(1, |it| *it == event), 1, "{event:?}");
    }
}
