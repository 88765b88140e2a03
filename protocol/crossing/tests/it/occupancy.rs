//! When the carriageway is clear (hazards A, B, C): only by fresh, consecutive, empty frames that cover it.

use std::collections::BTreeSet;

use crossguard_crossing::*;

use crate::scene::*;

/// How many empty frames are needed.
const NEEDED: usize = 6;

fn watch() -> Scene {
    let mut scene = Scene::new(street());
    // Before the robot began, a sign may have shown go.
    scene.look(2_001, &[person(1, 100, 300)]);
    scene
}

#[test]
fn the_road_is_clear_after_more_than_miss_max_empty_frames() {
    let mut scene = watch();
    for frame in 1..=NEEDED {
        assert!(!scene.is_clear());
        scene.look(100, &[]);
        assert_eq!(scene.is_clear(), frame == NEEDED, "frame {frame}");
    }
    // People beside it, and vehicles on it, change nothing.
    let car = Sighting {
        what: RoadUser::Vehicle,
        ..person(3, 200, 300)
    };
    scene.look(100, &[person(2, 100, -100), car]);
    assert!(scene.is_clear());
    scene.pass(501);
    assert!(!scene.is_clear(), "silence");
}

#[test]
fn each_of_these_starts_the_count_anew() {
    type Case = (&'static str, fn(&mut Scene));
    let cases: [Case; 10] = [
        ("somebody on the road", |it| {
            it.look(100, &[person(9, 0, 100)]);
        }),
        ("somebody beside the crossing, on the carriageway", |it| {
            it.look(100, &[person(9, 2_500, 100)]);
        }),
        ("somebody whose place may be on the road", |it| {
            let unsure = Sighting {
                error_cm: 150,
                ..person(9, 0, -140)
            };
            it.look(100, &[unsure]);
        }),
        ("something that is no vehicle", |it| {
            let what = RoadUser::Animal;
            it.look(
                100,
                &[Sighting {
                    what,
                    ..person(9, 0, 100)
                }],
            );
        }),
        ("a stale frame", |it| {
            it.pass(100);
            let out = it.frame(0, 501, 0b11, &[]);
            assert_eq!(out, [Output::Dropped(FrameDrop::Stale)]);
        }),
        ("a malformed frame", |it| {
            let out = it.tell(Input::BadFrame);
            assert_eq!(out, [Output::Dropped(FrameDrop::Malformed)]);
        }),
        ("a frame that was overtaken", |it| {
            it.pass(100);
            it.frame(0, 0, 0b11, &[]);
            it.frame(0, 50, 0b11, &[]);
        }),
        ("a gap", |it| it.pass(501)),
        ("a gap between frames that came late", |it| {
            it.pass(400);
            it.frame(0, 390, 0b11, &[]);
            it.pass(120);
            it.frame(0, 0, 0b11, &[]);
        }),
        ("a frame that does not cover everything", |it| {
            it.look(100, &[]);
            it.pass(100);
            it.frame(0, 0, 0b01, &[]);
        }),
    ];
    for (name, disturb) in cases {
        for at in 1..NEEDED {
            let mut scene = watch();
            (0..at).for_each(|_| drop(scene.look(100, &[])));
            disturb(&mut scene);
            let already = usize::from(name.starts_with("a gap between"));
            for _ in 0..NEEDED - 1 - already {
                scene.look(100, &[]);
                assert!(!scene.is_clear(), "{name}, after {at}");
            }
        }
    }
}

#[test]
fn a_frame_that_is_not_newer_is_dropped() {
    let mut scene = watch();
    scene.look(100, &[]);
    scene.pass(50);
    for age in [50, 60, 500] {
        let out = scene.frame(0, age, 0b11, &[]);
        assert_eq!(out, [Output::Dropped(FrameDrop::OutOfOrder)]);
    }
    assert_eq!(
        scene.frame(9, 0, 0b11, &[]),
        [Output::Dropped(FrameDrop::NoSuchSource)]
    );
}

/// A sign may have shown go before the robot began, and people step on the road for two seconds after it.
#[test]
fn a_frame_counts_once_nobody_steps_off_the_kerb_any_more() {
    for (from, is_clear) in [(2_000, false), (2_001, true)] {
        let mut scene = Scene::new(street());
        scene.look(from, &[]);
        (1..NEEDED).for_each(|_| drop(scene.look(100, &[])));
        assert_eq!(scene.is_clear(), is_clear, "from {from} ms on");
    }
}

#[test]
fn each_reason_to_drop_a_frame_has_a_name_of_its_own() {
    use FrameDrop::{Malformed, NoSuchSource, OutOfOrder, Stale};
    let names = [Stale, OutOfOrder, NoSuchSource, Malformed].map(FrameDrop::name);
    assert_eq!(BTreeSet::from(names).len(), names.len());
}

/// A repeated frame is no further observation.
#[test]
fn a_frame_counts_once() {
    let mut scene = watch();
    for _ in 0..NEEDED - 1 {
        scene.look(100, &[]);
        (0..3).for_each(|_| drop(scene.frame(0, 0, 0b11, &[])));
    }
    assert!(!scene.is_clear());
    scene.look(100, &[]);
    assert!(scene.is_clear());
}

#[test]
fn two_sources_cover_the_road_together_and_each_must_have_counted_enough() {
    let mut scene = watch();
    for frame in 0..10 {
        scene.pass(100);
        scene.frame(1, 0, 0b01, &[]);
        if frame >= 4 {
            scene.frame(2, 0, 0b10, &[]);
        }
        assert_eq!(scene.is_clear(), frame == 9, "frame {frame}");
    }
    // One of them is covered up.
    scene.pass(100);
    scene.frame(1, 0, 0, &[]);
    scene.frame(2, 0, 0b10, &[]);
    assert!(!scene.is_clear());
}

#[test]
fn a_road_that_nobody_has_measured_is_never_clear() {
    for change in [
        (|it: &mut Ground| it.road = None) as fn(&mut Ground),
        |it| it.parts = Coverage::NONE,
    ] {
        let mut setup = street();
        change(&mut setup.ground);
        let mut scene = Scene::new(setup);
        (0..20).for_each(|_| drop(scene.look(100, &[])));
        assert!(!scene.is_clear());
    }
    assert!(!Scene::new(street()).is_clear(), "nothing is known");
}

/// Another station can add people, and take none away.
#[test]
fn what_others_report_counts_against_a_clear_road_and_never_for_it() {
    let mut scene = watch();
    (0..NEEDED).for_each(|_| drop(scene.look(100, &[])));
    assert!(scene.is_clear());
    scene.tell(Input::Heard(
        WITNESS,
        person(5, 0, -100),
        crossguard_protocol::Millis(100),
    ));
    assert!(scene.is_clear());
    for (age, is_clear) in [(1_001, true), (1_000, false)] {
        scene.tell(Input::Heard(
            WITNESS,
            person(5, 0, 100),
            crossguard_protocol::Millis(age),
        ));
        assert_eq!(scene.is_clear(), is_clear, "{age} ms old");
    }
    scene.tell(Input::Heard(
        WITNESS,
        person(5, 0, -100),
        crossguard_protocol::Millis(0),
    ));
    assert!(!scene.is_clear());
}

/// Hazard: the sensors miss a person on the road. A road-side unit reports that person once a second, and the guards leave between two
/// reports.
#[test]
fn somebody_whom_others_report_is_on_the_road_until_they_do_not_any_more() {
    let mut scene = watch();
    for report in 0..3 {
        let (at, age) = (person(5, 0, 100), crossguard_protocol::Millis(0));
        scene.tell(Input::Heard(WITNESS, at, age));
        for _ in 0..10 {
            scene.look(100, &[]);
            assert!(!scene.is_clear(), "{report}");
        }
    }
    (0..10).for_each(|_| drop(scene.look(100, &[])));
    assert!(scene.is_clear());
}

/// Hazard: something on the crossing has no class, as a camera with little light reports it, and counts as nobody.
#[test]
fn something_without_a_class_on_the_crossing_keeps_the_road_from_being_clear_and_calls_nobody() {
    for (name, at, expected) in [
        ("on the crossing", Point::new(100, 300), false),
        ("beside it, as near as a rider", Point::new(650, 300), false),
        ("parked along the road", Point::new(2_500, 100), true),
        ("on the pavement", Point::new(0, -20), true),
    ] {
        let mut scene = watch();
        (0..NEEDED).for_each(|_| drop(scene.look(100, &[])));
        // A CPM has it once a second.
        for tick in 0..30 {
            if tick % 10 == 0 {
                let out = scene.tell(Input::Object(at));
                assert!(out.is_empty(), "{name}: nobody waits for a clear road");
            }
            assert_eq!(scene.is_clear(), expected, "{name}, {tick}");
            scene.look(100, &[]);
        }
        let occupancy = scene.crossing.occupancy();
        assert!(!occupancy.was_seen() && !scene.crossing.tracks().is_on_road());
        (0..20).for_each(|_| drop(scene.look(100, &[])));
        assert!(scene.is_clear(), "{name}, and gone");
    }
}

/// A person waits at the kerb until the road is clear, and says so by a device that knows its place to a metre.
#[test]
fn who_waits_at_the_kerb_by_an_inexact_report_does_not_keep_the_road_of_who_sees_occupied() {
    let at_kerb = Sighting {
        error_cm: 100,
        ..person(5, 0, -50)
    };
    let mut scene = watch();
    for _ in 0..NEEDED {
        scene.look(100, &[]);
        scene.tell(Input::Heard(
            WITNESS,
            at_kerb,
            crossguard_protocol::Millis(0),
        ));
    }
    assert!(scene.is_clear());
    scene.look(100, &[at_kerb]);
    assert!(!scene.is_clear(), "its own sensor has somebody there");
}

/// A frame that comes after newer ones still shows who was there, and at once again as a repetition changes nothing.
#[test]
fn a_person_in_a_frame_that_was_overtaken_is_on_the_road() {
    for age in [0, 50] {
        let mut scene = watch();
        (0..NEEDED).for_each(|_| drop(scene.look(100, &[])));
        assert!(scene.is_clear());
        if age == 0 {
            let what = RoadUser::Vehicle;
            let car = Sighting {
                what,
                ..person(1, 100, 300)
            };
            scene.frame(0, age, 0b11, &[car, person(2, 100, -100)]);
            assert!(scene.is_clear(), "a vehicle, and somebody beside the road");
        }
        scene.frame(0, age, 0b11, &[person(1, 100, 300)]);
        assert!(!scene.is_clear(), "{age} ms old");
    }
}

/// A guard with sensors of its own that look away does not know that the person whom it saw has gone.
#[test]
fn a_source_that_looks_away_sees_nobody_leave() {
    let mut scene = watch();
    for _ in 0..20 {
        scene.pass(100);
        scene.frame(0, 0, 0b01, &[]);
        assert!(!scene.crossing.occupancy().sees_nobody(&scene.setup));
    }
    (0..NEEDED).for_each(|_| drop(scene.look(100, &[])));
    assert!(scene.crossing.occupancy().sees_nobody(&scene.setup));
    // Now it owes nothing, and what it covers is enough.
    (0..NEEDED).for_each(|_| drop(scene.look(100, &[])));
    for _ in 0..NEEDED {
        scene.pass(100);
        scene.frame(0, 0, 0b01, &[]);
    }
    assert!(scene.crossing.occupancy().sees_nobody(&scene.setup));
}

/// The source covers a part alone, or does not say what it covers, as it sees a person.
#[test]
fn a_source_sees_nobody_once_what_it_covered_is_empty() {
    for (before, after, expected) in [
        (0b01, 0b01, true),
        (0b01, 0b10, false),
        (0b11, 0b01, false),
        (0b00, 0b00, false),
        (0b00, 0b11, true),
    ] {
        let mut scene = watch();
        (0..NEEDED).for_each(|_| drop(scene.look(100, &[])));
        scene.pass(100);
        scene.frame(0, 0, before, &[person(1, 100, 300)]);
        for _ in 0..NEEDED {
            scene.pass(100);
            scene.frame(0, 0, after, &[]);
        }
        let sees_nobody = scene.crossing.occupancy().sees_nobody(&scene.setup);
        assert_eq!(sees_nobody, expected, "{before:b}, {after:b}");
    }
}

/// A lorry hides a part for one frame: that part is counted anew, and not lost for ever.
#[test]
fn parts_are_counted_each_for_itself() {
    let mut scene = watch();
    (0..NEEDED).for_each(|_| drop(scene.look(100, &[])));
    scene.pass(100);
    scene.frame(0, 0, 0b01, &[]);
    for frame in 1..=NEEDED {
        scene.look(100, &[]);
        assert_eq!(scene.is_clear(), frame == NEEDED, "frame {frame}");
    }
}

/// Hazard: the sensors of a robot die, or were dead from the start, whose setup says nothing of them.
#[test]
fn a_setup_that_says_nothing_of_sensors_counts_on_them() {
    let ground = street().ground;
    let mut scene = Scene::new(Setup {
        ground,
        ..Setup::default()
    });
    let blind = Some(Hindrance::NoSight);
    assert_eq!(scene.crossing.hindered(&scene.setup), blind);
    scene.look(100, &[]);
    assert_eq!(scene.crossing.hindered(&scene.setup), None);
    scene.pass(501);
    assert_eq!(scene.crossing.hindered(&scene.setup), blind);
}

/// Hazard: one of two sources sees vehicles come, and fails.
#[test]
fn a_source_that_fails_hinders_though_another_covers_the_road() {
    let mut scene = watch();
    scene.frame(1, 0, 0, &[]);
    for (ms, is_blind) in [(500, false), (1, true)] {
        scene.look(ms, &[]);
        let blind = scene.crossing.hindered(&scene.setup) == Some(Hindrance::NoSight);
        assert_eq!(blind, is_blind, "{ms} ms");
    }
}
