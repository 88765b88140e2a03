//! In position is a lease that fresh positions renew (hazard G).

use crossguard_crossing::*;
use crossguard_protocol::*;

use crate::scene::*;

/// A guard that was told to block at a place, or where it stands.
fn guard(place: Option<Point>) -> (Scene, ManeuverId) {
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let leader = StationId(1);
    let session = SessionId { leader, number };
    let request = RequestId(0);
    let id = ManeuverId::of(session, request);
    let task = TaskType::BLOCK;
    let mut setup = street();
    setup.watches = false;
    let mut scene = Scene::new(setup);
    scene.tell(crossguard_crossing::Input::Started(
        Maneuver { id, task },
        place,
    ));
    scene.tell(crossguard_crossing::Input::Body(BodyReport::InPosition(id)));
    (scene, id)
}

fn is_at(scene: &mut Scene, east: i32, error_cm: u16, age: u32) {
    let at = Point::new(east, 0);
    let pose = Some(Pose { at, error_cm });
    scene.tell(crossguard_crossing::Input::Pose(pose, Millis(age)));
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
    scene.tell(crossguard_crossing::Input::Pose(None, Millis(0)));
    assert!(!says(&mut scene, 0));
}

/// A position of before the command is as old as it is.
#[test]
fn a_command_makes_no_position_younger() {
    let (mut scene, id) = guard(None);
    let task = TaskType::BLOCK;
    is_at(&mut scene, 0, 0, 0);
    scene.pass(900);
    let place = Some(Point::default());
    scene.tell(crossguard_crossing::Input::Started(
        Maneuver { id, task },
        place,
    ));
    scene.tell(crossguard_crossing::Input::Body(BodyReport::InPosition(id)));
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
