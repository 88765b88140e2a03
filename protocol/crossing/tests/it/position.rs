//! In position is a lease that fresh positions renew (hazard G).

use crossguard_crossing::*;
use crossguard_protocol::{Event, ManeuverId, Millis, TaskType};

use crate::scene::*;

/// A guard that was told to block at a place, or where it stands.
fn guard(place: Option<Point>) -> (Scene, ManeuverId) {
    let mut setup = street();
    setup.watches = false;
    let (mut scene, maneuver) = (Scene::new(setup), maneuver(TaskType::BLOCK, 0));
    scene.tell(Input::Started(maneuver, place));
    scene.tell(Input::Body(BodyReport::InPosition(maneuver.id)));
    (scene, maneuver.id)
}

fn is_at(scene: &mut Scene, east: i32, error_cm: u16, age: u32) {
    let at = Point::new(east, 0);
    let pose = Some(Pose { at, error_cm });
    scene.tell(Input::Pose(pose, Millis(age)));
}

/// Whether it would say now that it is in position.
fn says(scene: &mut Scene, ms: u32) -> bool {
    scene.out.clear();
    scene.pass(ms);
    scene.told(|event| matches!(event, Event::InPosition(_))) > 0
}

#[test]
fn in_position_is_within_tolerance_by_a_fresh_position() {
    for (east, error_cm, age, expected) in [
        (0, 0, 0, true),
        (200, 0, 0, true),
        (201, 0, 0, false),
        (150, 50, 0, true),
        (150, 51, 0, false),
        (0, 0, 899, true),
        (0, 0, 900, false),
        (0, 0, 1_000, false),
    ] {
        let (mut scene, _) = guard(Some(Point::default()));
        assert!(!says(&mut scene, 0), "without a position");
        is_at(&mut scene, east, error_cm, age);
        assert_eq!(
            says(&mut scene, 100),
            expected,
            "{east} cm, {error_cm} cm, {age} ms"
        );
    }
}

#[test]
fn the_lease_ends_by_itself_and_by_a_position_elsewhere_or_none() {
    for (name, after, expected) in [
        ("silence", None, [true, false]),
        ("fresh", Some((0, 0)), [true, true]),
        ("elsewhere", Some((300, 0)), [false, false]),
        ("older than the newest", Some((300, 900)), [true, false]),
    ] {
        let (mut scene, _) = guard(Some(Point::default()));
        is_at(&mut scene, 0, 0, 0);
        scene.pass(500);
        if let Some((east, age)) = after {
            is_at(&mut scene, east, 0, age);
        }
        let said = [says(&mut scene, 400), says(&mut scene, 100)];
        assert_eq!(said, expected, "{name}");
    }
    let (mut scene, _) = guard(Some(Point::default()));
    is_at(&mut scene, 0, 0, 0);
    scene.tell(Input::Pose(None, Millis(0)));
    assert!(!says(&mut scene, 0));
}

/// A position of before the command is as old as it is.
#[test]
fn a_command_makes_no_position_younger() {
    let (mut scene, id) = guard(None);
    is_at(&mut scene, 0, 0, 0);
    scene.pass(900);
    let place = Some(Point::default());
    scene.tell(Input::Started(maneuver(TaskType::BLOCK, 0), place));
    scene.tell(Input::Body(BodyReport::InPosition(id)));
    assert!(says(&mut scene, 0));
    assert!(!says(&mut scene, 100));
}

#[test]
fn a_guard_that_is_told_no_place_guards_where_it_stands() {
    let (mut scene, _) = guard(None);
    assert!(!says(&mut scene, 100), "nobody knows where");
    is_at(&mut scene, 900, 0, 0);
    assert!(says(&mut scene, 0));
    is_at(&mut scene, 1_200, 0, 0);
    assert!(!says(&mut scene, 0));
}

#[test]
fn a_guard_that_is_told_no_place_stands_where_its_newest_position_is() {
    for (before, ms, stood) in [
        (&[(900, 999)][..], 0, true),
        (&[(900, 1_000)], 0, false),
        (&[(900, 0)], 999, true),
        (&[(900, 0)], 1_000, false),
        (&[(900, 0), (1_200, 500)], 0, true),
        (&[(900, 500), (1_200, 0)], 0, false),
        (&[(900, 100), (1_200, 100)], 0, false),
    ] {
        let (mut scene, id) = guard(Some(Point::default()));
        for (east, age) in before {
            is_at(&mut scene, *east, 0, *age);
        }
        if ms > 0 {
            scene.pass(ms);
        }
        scene.tell(Input::Started(maneuver(TaskType::BLOCK, 0), None));
        scene.tell(Input::Body(BodyReport::InPosition(id)));
        for (east, expected) in [(1_200, !stood), (900, stood)] {
            is_at(&mut scene, east, 0, 0);
            assert_eq!(
                says(&mut scene, 0),
                expected,
                "{before:?}, {ms} ms, at {east}"
            );
        }
    }
}

/// Only the newest word of the body counts, and only of the maneuver that it carries out.
#[test]
fn a_body_speaks_of_its_maneuver_until_it_is_gone() {
    use BodyReport::{Completed, Gone, InPosition};
    let [id, before] = [1, 0].map(|request| maneuver(TaskType::BLOCK, request).id);
    for (reports, expected) in [
        (&[][..], [0, 0]),
        (&[InPosition(id)], [1, 0]),
        (&[InPosition(before)], [0, 0]),
        (&[Completed(id)], [0, 1]),
        (&[Completed(before)], [0, 0]),
        (&[InPosition(id), Completed(id), Gone], [0, 0]),
    ] {
        let (mut scene, _) = guard(None);
        let place = Some(Point::default());
        scene.tell(Input::Started(maneuver(TaskType::BLOCK, 1), place));
        for report in reports {
            scene.tell(Input::Body(*report));
        }
        is_at(&mut scene, 0, 0, 0);
        scene.pass(0);
        let told = [Event::InPosition(id), Event::ManeuverCompleted(id)];
        let told = told.map(|event| scene.told(|it| *it == event));
        assert_eq!(told, expected, "{reports:?}");
    }
}
