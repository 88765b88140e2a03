//! A robot that goes with a person waits for them, and is not done before they are off the road.

use crossguard_crossing::*;
use crossguard_protocol::{Event, FallbackPolicy, Millis, Robot, StationId, TaskType};

use crate::scene::*;
use crate::team::*;
use crate::whole::*;

/// The kerb to which it goes.
const OVER_THERE: Point = Point::new(100, 800);

/// A robot with sensors and the command to go with a person, from the kerb.
fn escort() -> Scene {
    let mut scene = Scene::new(street());
    scene.is_at(100, -100, 0);
    let maneuver = maneuver(TaskType::MOVE, 0);
    scene.tell(Input::Started(maneuver, Some(OVER_THERE)));
    scene
}

/// So many frames have these people, while the body is 3 m before the kerb over there.
fn look(scene: &mut Scene, frames: u32, people: &[Sighting]) {
    for _ in 0..frames {
        scene.is_at(100, 500, 0);
        scene.look(100, people);
    }
}

/// The body was told to wait, and not yet to go on.
fn waits(scene: &Scene) -> bool {
    let is_said = |it: &&Output| matches!(it, Output::Wait | Output::GoOn);
    scene.out.iter().rfind(is_said) == Some(&Output::Wait)
}

#[test]
fn an_escort_waits_for_people_behind_it_on_the_road_and_for_those_who_have_not_set_out_yet() {
    let [near, far, at_kerb] = [300, 299, -20].map(|north| vec![person(1, 100, north)]);
    // A road worker, 7 m from the crossing.
    let with_worker = vec![near[0], person(2, -1_000, 100)];
    for (name, seen, expected) in [
        ("near", vec![&near], false),
        ("far", vec![&far], true),
        ("comes nearer", vec![&far, &near], false),
        ("somebody else", vec![&with_worker], false),
        ("at the kerb", vec![&at_kerb], true),
        ("too late", vec![&near, &vec![], &at_kerb], false),
    ] {
        let mut scene = escort();
        for people in seen {
            look(&mut scene, 15, people);
        }
        assert_eq!(waits(&scene), expected, "{name}");
    }
}

/// Contact is lost, and the body stays beside its person up to the kerb.
#[test]
fn an_escort_that_falls_back_waits_for_people_it_sees_on_the_road_and_for_nobody_else() {
    use FallbackPolicy::{EscortToKerb, HoldUntilClear};
    for (name, policy, north, silence, expected) in [
        ("near", EscortToKerb, 300, 0, false),
        ("far", EscortToKerb, 299, 0, true),
        ("beside the road", EscortToKerb, -100, 0, false),
        ("lost", EscortToKerb, 299, 1_001, false),
        ("another fallback", HoldUntilClear, 299, 0, false),
    ] {
        let mut scene = escort();
        scene.tell(Input::FellBack(maneuver(TaskType::MOVE, 0), policy));
        look(&mut scene, 3, &[person(1, 100, north)]);
        scene.pass(silence);
        scene.is_at(100, 500, 0);
        scene.pass(0);
        assert_eq!(waits(&scene), expected, "{name}");
        // Its duty is over.
        let robot = Robot::new(StationId(2), 1);
        scene.crossing.learn(&scene.setup, &robot);
        scene.pass(0);
        assert!(!waits(&scene), "{name}");
    }
}

#[test]
fn an_escort_is_done_once_it_sees_nobody_on_the_road_and_nobody_was_seen_or_reported_just_now() {
    type Case = (&'static str, fn(&mut Scene, Sighting), usize);
    let on_road = person(1, 100, 600);
    let cases: [Case; 5] = [
        ("empty", |it, _| look(it, 6, &[]), 1),
        (
            "silence",
            |it, who| {
                look(it, 1, &[who]);
                it.pass(2_000);
            },
            0,
        ),
        (
            "just left",
            |it, who| {
                look(it, 1, &[who]);
                look(it, 8, &[]);
            },
            0,
        ),
        (
            "left",
            |it, who| {
                look(it, 1, &[who]);
                look(it, 11, &[]);
            },
            1,
        ),
        (
            "others have them",
            |it, who| {
                look(it, 6, &[]);
                it.tell(Input::Heard(WITNESS, who, Millis(0)));
            },
            0,
        ),
    ];
    for (name, happens, expected) in cases {
        let mut scene = escort();
        scene.pass(2_001);
        happens(&mut scene, on_road);
        scene.out.clear();
        let id = maneuver(TaskType::MOVE, 0).id;
        scene.tell(Input::Body(BodyReport::Completed(id)));
        scene.pass(0);
        let told = scene.told(|it| *it == Event::ManeuverCompleted(id));
        assert_eq!(told, expected, "{name}");
    }
}

fn escorting(to: Point, sees: bool) -> Team {
    let mut team = team(plan(&[leg(TaskType::MOVE, to)]), sees);
    team.people = vec![person(1, 100, -100)];
    team
}

fn has_completed(robot: usize) -> impl Fn(&Team) -> bool {
    move |team| {
        let is_done = |it: &Event| matches!(it, Event::TaskCompleted | Event::ManeuverCompleted(_));
        team.told(robot, is_done) > 0
    }
}

/// The station that told of the person is silent now.
#[test]
fn an_escort_without_sensors_is_not_done_once_it_has_heard_of_somebody_on_the_road() {
    let mut team = escorting(OVER_THERE, false);
    team.pass_until("a maneuver", |it| it.robots[1].body.to.is_some());
    team.hear(1, Input::Heard(WITNESS, person(2, 100, 690), Millis(0)));
    team.pass(20_000);
    assert_eq!(team.robots[1].body.at, OVER_THERE);
    assert!(!has_completed(1)(&team));
}

#[test]
fn go_is_shown_for_as_long_as_an_escort_is_under_way() {
    let mut team = escorting(OVER_THERE, true);
    team.pass_until("go", Team::shows_go);
    for _ in 0..60 {
        team.pass(TICK);
        assert!(team.shows_go());
    }
}

/// An escort without sensors goes on there: nothing tells it that the road is clear.
#[test]
fn go_ends_when_an_escort_is_over_there_that_hears_of_somebody_on_the_road() {
    let mut team = escorting(Point::new(100, 500), false);
    team.robots[1].body.at = Point::new(100, 400);
    team.pass_until("go", Team::shows_go);
    team.hear(1, Input::Heard(WITNESS, person(2, 100, 450), Millis(0)));
    team.pass(3_000);
    // Nobody goes with the person who waits here yet.
    for _ in 0..200 {
        assert!(!team.shows_go() && !has_completed(1)(&team));
        team.pass(TICK);
    }
}

/// The escort may be lost itself.
#[test]
fn a_session_does_not_end_before_its_escort_is_heard() {
    let mut team = escorting(Point::new(100, 9_000), true);
    team.pass_until("go", Team::shows_go);
    team.robots[1].body.is_lost = true;
    walk_across(&mut team);
    team.pass(25_000);
    assert!(!has_completed(0)(&team));
    team.robots[1].body.is_lost = false;
    team.pass(6_000);
    assert!(has_completed(0)(&team));
}

/// The escort is over there within two seconds.
#[test]
fn a_session_with_an_escort_ends_early_only_when_somebody_has_crossed() {
    for crosses in [true, false] {
        let mut team = escorting(Point::new(100, 500), true);
        team.robots[1].body.at = Point::new(100, 400);
        team.pass_until("go", Team::shows_go);
        let go = team.now;
        if crosses {
            team.people[0] = walking(team.people[0], 0, 140);
            team.people.push(person(2, 100, -100));
        }
        team.pass_until("the end", has_completed(0));
        assert_eq!(team.now - go < 9_000, crosses, "{} ms", team.now - go);
    }
}

/// Go is over, and the escort on its way, when somebody else steps on the road and the sensor fails.
#[test]
fn nobody_who_steps_on_the_road_before_the_sensor_fails_is_across() {
    let mut team = escorting(Point::new(100, 3_000), true);
    team.pass_until("go", Team::shows_go);
    walk_across(&mut team);
    team.pass_until("a clear road", |it| {
        it.told(0, |it| *it == Event::RoadClear) > 0
    });
    team.people.push(person(2, 100, 300));
    team.pass(500);
    team.sensor = |_, _| None;
    team.pass(20_000);
    assert!(!has_completed(0)(&team));
    team.sensor = |_, people| Some(people.to_vec());
    team.people.pop();
    team.pass_until("the end", has_completed(0));
    assert_eq!(team.alone, 0);
}

/// An escort, and its person, who stops on the road.
fn stopping() -> Team {
    let mut team = escorting(OVER_THERE, true);
    team.robots[1].body.at = Point::new(0, -100);
    team.pass_until("go", Team::shows_go);
    team.people[0] = walking(team.people[0], 0, 40);
    team.pass(5_000);
    team.people[0] = walking(team.people[0], 0, 0);
    team
}

/// Hazard H: an escort waits for its person, and is not done before the person is off the road.
#[test]
fn an_escort_stays_with_its_person() {
    let mut team = stopping();
    team.pass(10_000);
    let ahead = team.robots[1].body.at.north_cm() - team.people[0].at.north_cm();
    assert!((0..=250).contains(&ahead), "{ahead} cm");
    assert_eq!(
        team.told(1, |it| matches!(it, Event::ManeuverCompleted(_))),
        0
    );
    team.people[0] = walking(team.people[0], 0, 60);
    team.pass_until("idle", Team::is_idle);
    assert!(team.people[0].at.north_cm() > 700);
    assert_eq!(team.alone, 0);
}

/// Hazard: its driver does not know any more where the body is; it walks on, and the person stands on the road alone.
#[test]
fn an_escort_that_does_not_know_where_it_is_stays_with_its_person() {
    let mut team = stopping();
    team.robots[1].body.is_lost = true;
    team.pass(10_000);
    let ahead = team.robots[1].body.at.north_cm() - team.people[0].at.north_cm();
    assert!((0..=250).contains(&ahead), "{ahead} cm");
}

/// The body of an escort has reached the other side, and somebody stands on the road close behind it.
#[test]
fn an_escort_is_not_done_under_the_eyes_of_people() {
    let completed = |team: &Team| team.told(1, |it| matches!(it, Event::ManeuverCompleted(_)));
    let mut team = escorting(OVER_THERE, true);
    team.robots[1].body.at = Point::new(0, -100);
    team.pass_until("go", Team::shows_go);
    team.people[0] = walking(team.people[0], 0, 100);
    team.pass_until("the last metre", |it| it.people[0].at.north_cm() > 620);
    team.people[0] = walking(team.people[0], 0, 0);
    team.pass(10_000);
    assert!(team.robots[1].body.at.distance_cm(Point::new(100, 800)) < 10);
    assert_eq!(completed(&team), 0);
    team.people[0] = walking(team.people[0], 0, 60);
    team.pass_until("idle", Team::is_idle);
    assert!(completed(&team) > 0);
    assert_eq!(team.alone, 0);
}

/// Go is over by then: an escort that waited for the next one would stand on the road until its leader gives up.
#[test]
fn an_escort_does_not_wait_on_the_road_for_people_who_come_late() {
    let mut team = escorting(OVER_THERE, true);
    team.robots[1].setup.ground.waiting = street().ground.waiting;
    team.robots[1].body.at = Point::new(0, -100);
    team.pass_until("go", Team::shows_go);
    // Faster than the escort.
    team.people[0] = walking(team.people[0], 0, 140);
    team.pass(5_000);
    assert!(team.robots[1].body.at.north_cm() < 600);
    team.people.push(person(2, 100, -100));
    team.pass_until("done", |it| {
        it.told(1, |event| matches!(event, Event::ManeuverCompleted(_))) > 0
    });
    assert_eq!(calls(&team), 1, "not on its second way");
    team.pass_until("a second call", |it| calls(it) == 2);
    assert_eq!(team.told(0, |it| *it == Event::LeaveRequested), 0);
    assert_eq!(team.alone, 0);
}

/// An escort that waits for everybody who guards, the leader too.
#[test]
fn a_stage_that_takes_people_on_the_road_waits_for_the_leader() {
    let mut plan = plan(&[leg(TaskType::MOVE, Point::new(100, 800))]);
    plan.own_place = Some(Point::new(0, -1_500));
    let mut team = team(plan, true);
    team.people = vec![person(1, 100, -100)];
    team.pass_until("a session", |it| it.told(0, |_| true) > 0 && !it.is_idle());
    team.pass(5_000);
    assert_eq!(team.first(0, |it| matches!(it, Output::Order(..))), None);
    team.pass_until("an order", |it| {
        it.first(0, |it| matches!(it, Output::Order(..))).is_some()
    });
    assert!(team.robots[0].body.at.distance_cm(Point::new(0, -1_500)) <= 200);
}

/// The protocol is told once.
#[test]
fn a_follower_says_once_that_it_has_completed() {
    let mut team = escorting(OVER_THERE, false);
    team.pass_until("done", |it| {
        it.told(1, |event| matches!(event, Event::ManeuverCompleted(_))) > 0
    });
    team.pass(400);
    let told = team.told(1, |event| matches!(event, Event::ManeuverCompleted(_)));
    let reported = team.told(1, |event| matches!(event, Event::InPosition(_)));
    assert_eq!((told, reported), (1, 1));
}

/// The person's phone falls silent on the road, as phones do in a cluster, and the sensors see its owner.
#[test]
fn an_escort_with_sensors_waits_for_no_report_that_is_lost() {
    let mut scene = escort();
    scene.tell(Input::Heard(WITNESS, person(1, 100, 100), Millis(0)));
    look(&mut scene, 15, &[person(1, 100, 300)]);
    assert!(!waits(&scene));
}
