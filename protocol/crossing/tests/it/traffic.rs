//! Which vehicles hinder (hazard I).

use std::collections::BTreeSet;

use crossguard_crossing::*;
use crossguard_protocol::{Millis, Notice, StationId, TaskType};

use crate::scene::*;
use crate::whole::plan;

fn vehicle(east: i32, north: i32, east_cms: i32, north_cms: i32) -> Vehicle {
    let velocity = Way {
        east_cm: east_cms,
        north_cm: north_cms,
    };
    Vehicle {
        key: 7,
        station: None,
        at: Point::new(east, north),
        front_cm: 0,
        length_cm: 1_200,
        error_cm: 0,
        velocity,
        goes_anywhere: false,
    }
}

/// Whether a vehicle hinders that was reported so long ago, and after so much silence.
fn hinders(vehicle: Vehicle, age: u32, silence: u32) -> bool {
    let mut setup = street();
    setup.watches = false;
    let mut scene = Scene::new(setup);
    scene.tell(Input::Vehicle(vehicle, Millis(age)));
    if silence > 0 {
        scene.pass(silence);
    }
    scene.crossing.hindered(&scene.setup) == Some(Hindrance::Vehicle(7))
}

#[test]
fn a_vehicle_hinders_that_can_no_longer_stop_comfortably() {
    // At 50 km/h: 2 s to react are 27.8 m, and 32.2 m to stop. The crossing ends at 3 m west.
    let fast = 1_389;
    for (name, vehicle, expected) in [
        ("50 km/h at 16 m", vehicle(-1_900, 200, fast, 0), true),
        ("50 km/h at 59 m", vehicle(-6_200, 200, fast, 0), true),
        ("the last that cannot", vehicle(-6_293, 200, fast, 0), true),
        ("the first that can", vehicle(-6_294, 200, fast, 0), false),
        ("50 km/h at 62 m", vehicle(-6_500, 200, fast, 0), false),
        ("from the east", vehicle(2_100, 500, -fast, 0), true),
        ("it stands", vehicle(-400, 200, 40, 0), false),
        ("it stands there", vehicle(-299, 200, 0, 0), true),
        ("its rear is there", vehicle(1_600, 200, fast, 0), true),
        ("it has passed", vehicle(1_800, 200, fast, 0), false),
        ("it is on the crossing", vehicle(450, 200, fast, 0), true),
        ("it is abreast", vehicle(100, -600, 100, 0), true),
        ("it passes near", vehicle(-1_900, 1_881, fast, 0), true),
        ("just aside", vehicle(-1_900, 1_882, fast, 0), false),
        ("it passes aside", vehicle(-1_900, 4_000, fast, 0), false),
        (
            "it comes from the north",
            vehicle(100, 4_000, 0, -fast),
            true,
        ),
    ] {
        assert_eq!(hinders(vehicle, 0, 0), expected, "{name}");
    }
}

/// Hazard: the rear of a bus with a joint, or of a train of carriages, is on the crossing yet.
#[test]
fn a_vehicle_that_is_longer_than_assumed_has_passed_when_its_rear_has() {
    for (length_cm, east, expected) in [
        (1_200, 1_750, false),
        (1_875, 1_750, true),
        (1_875, 2_375, true),
        (1_875, 2_400, false),
    ] {
        let vehicle = Vehicle {
            length_cm,
            ..vehicle(east, 200, 1_389, 0)
        };
        assert_eq!(hinders(vehicle, 0, 0), expected, "{length_cm} at {east}");
    }
    let setup = street();
    let lengths = [None, Some(450), Some(1_875)].map(|said| traffic::length_cm(&setup, said));
    assert_eq!(lengths, [1_200, 1_200, 1_875]);
}

/// Arcs of 90° at most that end on the crossing in any direction, with 3 m/s² to the side at most.
#[test]
fn a_vehicle_in_a_bend_hinders_from_where_it_can_no_longer_stop() {
    #[expect(clippy::cast_possible_truncation, reason = "a few hundred metres")]
    let cm = |metres: f64| (metres * 100.0).round() as i32;
    for case in 0..18 * 24 * 6 * 3 * 20_u32 {
        let speed = f64::from(3 + case % 18);
        let turned = f64::from(case / 18 % 24 * 15).to_radians();
        // To the left where it is positive.
        let wide = [1.0, 1.5, 3.0, -1.0, -1.5, -3.0][case as usize / (18 * 24) % 6];
        let radius = wide * f64::max(speed * speed / 3.0, 5.0);
        let [east, north] =
            [[-3.0, 0.0], [-3.0, 7.0], [5.0, 4.0]][case as usize / (18 * 24 * 6) % 3];
        let part = f64::from(case / (18 * 24 * 6 * 3)) / 20.0;
        let stops = 2.0 * speed + speed * speed / 6.0;
        let way = part * stops.min(radius.abs() * std::f64::consts::FRAC_PI_2);
        let (sin, cos) = turned.sin_cos();
        let (sin_before, cos_before) = (turned - way / radius).sin_cos();
        let comes = vehicle(
            cm(east - radius * (sin - sin_before)),
            cm(north - radius * (cos_before - cos)),
            cm(speed * cos_before),
            cm(speed * sin_before),
        );
        assert!(
            hinders(comes, 0, 0),
            "{speed} m/s, {radius} m, {way} m before it: {comes:?}"
        );
    }
}

#[test]
fn an_older_report_counts_as_if_the_vehicle_had_gone_on() {
    let far = vehicle(-6_500, 200, 1_389, 0);
    for (age, silence, expected) in [
        (0, 0, false),
        (300, 0, true),
        (0, 300, true),
        (0, 5_000, true),
        (0, 5_001, false),
        (5_000, 0, true),
        (5_001, 0, false),
    ] {
        assert_eq!(
            hinders(far, age, silence),
            expected,
            "{age} ms, {silence} ms"
        );
    }
    // So it does on a bend that it may have taken meanwhile.
    assert!(hinders(vehicle(-9_000, 9_000, 1_389, 0), 5_000, 0));
}

#[test]
fn the_error_of_its_place_counts_against_it() {
    let unsure = Vehicle {
        error_cm: 300,
        ..vehicle(-6_500, 200, 1_389, 0)
    };
    assert!(hinders(unsure, 0, 0));
    // Aside as well, and where it seems to have passed.
    for (exact, error_cm) in [
        (vehicle(-1_500, 2_500, 1_389, 0), 700),
        (vehicle(1_800, 200, 1_389, 0), 200),
    ] {
        assert!(!hinders(exact, 0, 0));
        assert!(hinders(Vehicle { error_cm, ..exact }, 0, 0));
    }
}

#[test]
fn a_late_report_says_nothing_new() {
    let mut setup = street();
    setup.watches = false;
    let mut scene = Scene::new(setup);
    scene.tell(Input::Vehicle(vehicle(-400, 200, 250, 0), Millis(100)));
    scene.tell(Input::Vehicle(vehicle(-9_900, 200, 0, 0), Millis(900)));
    assert!(scene.crossing.hindered(&scene.setup).is_some());
    scene.tell(Input::Vehicle(vehicle(-400, 200, 0, 0), Millis(0)));
    assert_eq!(scene.crossing.hindered(&scene.setup), None);
}

#[test]
fn too_many_vehicles_hinder() {
    let mut setup = street();
    setup.watches = false;
    let mut scene = Scene::new(setup);
    let numbered = |key: u64, vehicle| Vehicle { key, ..vehicle };
    let far = vehicle(-60_000, 200, 1_389, 0);
    let count = u64::try_from(traffic::VEHICLES).unwrap();
    // Vehicles that stand take nobody's place, nor ones that no bend leads to the crossing while reports of them are kept.
    for (first, it) in [
        (0, vehicle(-900, 200, 0, 0)),
        (500, vehicle(-60_000, 20_000, 1_389, 0)),
    ] {
        (0..=count).for_each(|key| {
            scene.tell(Input::Vehicle(numbered(first + key, it), Millis(0)));
        });
    }
    for key in 0..=count {
        assert_eq!(
            scene.crossing.hindered(&scene.setup),
            None,
            "{key} vehicles"
        );
        scene.tell(Input::Vehicle(numbered(100 + key, far), Millis(0)));
    }
    let further = Some(Hindrance::Vehicle(100 + count));
    for (ms, expected) in [(0, further), (4_999, further), (1, None)] {
        scene.pass(ms);
        assert_eq!(scene.crossing.hindered(&scene.setup), expected, "{ms} ms");
    }
}

/// Two cameras number from 1. A vehicle that stands does not take the place of one that comes behind it, whichever camera has it, and
/// by whatever number.
#[test]
fn vehicles_of_two_sources_and_two_of_one_are_two() {
    let seen = |id, east, speed| Sighting {
        id,
        what: RoadUser::Vehicle,
        ..walking(person(0, east, 200), speed, 0)
    };
    let comes = |id| seen(id, -1_900, 1_389);
    let stands = |id| seen(id, -1_500, 0);
    let [one, two] = [Some(1), Some(2)];
    let cases = [
        [(0, vec![comes(one)]), (1, vec![stands(one)])],
        [(0, vec![comes(one), stands(two)]), (1, vec![])],
        [(0, vec![comes(one), stands(one)]), (1, vec![])],
        [(0, vec![comes(None), stands(None)]), (1, vec![])],
        [(0, vec![comes(one), stands(None)]), (1, vec![])],
    ];
    for frames in cases {
        let mut scene = Scene::new(street());
        for (source, vehicles) in &frames {
            scene.frame(*source, 0, 0b11, vehicles);
        }
        let hindered = scene.crossing.hindered(&scene.setup);
        assert!(
            matches!(hindered, Some(Hindrance::Vehicle(_))),
            "{hindered:?}, {frames:?}"
        );
    }
    // Nor that of one with its number that says itself where it is.
    let mut scene = Scene::new(street());
    let heard = vehicle(-1_900, 200, 1_389, 0);
    scene.tell(Input::Vehicle(heard, Millis(0)));
    scene.frame(0, 0, 0b11, &[stands(Some(7))]);
    let hindered = scene.crossing.hindered(&scene.setup);
    assert_eq!(hindered, Some(Hindrance::Vehicle(7)));
}

/// A sensor tells where the middle of a vehicle is, also in a frame that comes too late for people.
#[test]
fn a_vehicle_in_a_frame_is_half_a_car_nearer() {
    for (age, east, expected) in [
        (0, -1_301, false),
        (0, -1_300, true),
        (600, -1_301, true),
        (600, -1_481, false),
        (5_001, -1_300, false),
    ] {
        let mut scene = Scene::new(street());
        scene.setup.watches = false;
        let bus = Sighting {
            what: RoadUser::Vehicle,
            ..walking(person(1, east, 200), 300, 0)
        };
        scene.frame(0, age, 0b11, &[bus]);
        let hindered = scene.crossing.hindered(&scene.setup);
        assert_eq!(hindered.is_some(), expected, "{east}, {age} ms");
    }
}

/// Ids are hints: a tracker that starts anew, or an object of a CPM without a number, gives a parked car the number of one that comes.
#[test]
fn a_vehicle_that_jumps_is_another_one() {
    let inexact = |error_cm, vehicle| Vehicle {
        error_cm,
        ..vehicle
    };
    let first = inexact(200, vehicle(-4_000, 200, 1_389, 0));
    // It goes 2.77 m until the later report, its places are 5 m inexact together, and the next in a queue is 5 m from it. A later report
    // that goes away does not hinder itself.
    for (name, later, hinders_then) in [
        ("parked, 60 m off", vehicle(2_000, 900, 0, 0), true),
        // 10 m/s² for 0.2 s, and 2 m/s that its speed is inexact.
        ("as hard as that", vehicle(-3_600, 200, -989, 0), false),
        ("harder", vehicle(-3_600, 200, -988, 0), true),
        ("the bus beside it", vehicle(-3_600, 500, 0, 0), true),
        ("behind, 50 m off", vehicle(-9_000, 200, 0, 0), true),
        (
            "the farthest",
            inexact(300, vehicle(-2_723, 200, -1_389, 0)),
            false,
        ),
        (
            "1 cm more",
            inexact(300, vehicle(-2_722, 200, -1_389, 0)),
            true,
        ),
    ] {
        let mut scene = Scene::new(street());
        scene.setup.watches = false;
        scene.tell(Input::Vehicle(first, Millis::ZERO));
        scene.pass(200);
        scene.tell(Input::Vehicle(later, Millis::ZERO));
        // Nor does one without a number take its place.
        let zero = Vehicle {
            key: 0,
            ..vehicle(-4_000, 200, 0, 0)
        };
        scene.tell(Input::Vehicle(zero, Millis::ZERO));
        let is_hindered = |scene: &Scene| scene.crossing.hindered(&scene.setup).is_some();
        assert_eq!(is_hindered(&scene), hinders_then, "{name}");
        // It is forgotten as one that falls silent is.
        let keep = scene.setup.traffic.keep.0;
        scene.pass(keep - 200);
        assert_eq!(is_hindered(&scene), hinders_then, "{name}");
        scene.pass(50);
        assert!(!is_hindered(&scene), "{name}");
    }
}

/// Absence of a field makes nothing safer: it comes at 50 km/h.
#[test]
fn a_vehicle_in_a_frame_that_tells_no_velocity_hinders_like_one_that_comes() {
    for (name, what, east, north, expected) in [
        ("near", RoadUser::Vehicle, -1_900, 200, true),
        (
            "from the east, at 59 m",
            RoadUser::Vehicle,
            6_400,
            200,
            true,
        ),
        ("beside the road", RoadUser::Vehicle, -1_900, 4_000, true),
        (
            "in the middle of the crossing",
            RoadUser::Vehicle,
            100,
            350,
            true,
        ),
        ("it can stop", RoadUser::Vehicle, -9_000, 200, false),
        ("a motorcycle", RoadUser::Motorcyclist, -1_900, 200, true),
        ("a bicycle", RoadUser::Bicyclist, -1_900, 200, false),
        ("a person", RoadUser::Pedestrian, -400, 200, false),
    ] {
        let mut scene = Scene::new(street());
        let silent = Sighting {
            what,
            velocity: None,
            ..person(1, east, north)
        };
        scene.frame(0, 0, 0b11, &[silent]);
        let hindered = scene.crossing.hindered(&scene.setup).is_some();
        assert_eq!(hindered, expected, "{name}");
    }
}

/// The sign shows go, though its robot does not know of an open corridor yet.
#[test]
fn a_sign_that_shows_go_is_turned_before_a_vehicle_that_cannot_stop() {
    let mut setup = street();
    setup.watches = false;
    let comes = Input::Vehicle(vehicle(-1_900, 200, 1_389, 0), Millis(0));
    for told in [comes, Input::Missed(Millis(1))] {
        for (shows, expected) in [(1_900, true), (0, false)] {
            let mut scene = Scene::new(setup.clone());
            scene.tell(Input::CorridorOpen(Millis(shows)));
            let out = scene.tell(told);
            assert_eq!(out.contains(&Output::Stop), expected, "{shows} ms");
        }
    }
}

/// A body waits for vehicles within 2 m of the road, and the error of its place, that its way leads on or over, and nowhere else beside it; and not for vehicles
/// that would have to bend.
#[test]
fn a_body_waits_at_the_kerb_and_not_before_it_or_along_it() {
    let mut setup = street();
    setup.watches = false;
    for (north, error_cm, to, expected) in [
        (-200, 0, (0, 200), true),
        (-201, 0, (0, 200), false),
        (-450, 250, (0, 200), true),
        (-100, 0, (0, 800), true),
        (-100, 0, (500, -100), false),
    ] {
        let mut scene = Scene::new(setup.clone());
        scene.tell(Input::Vehicle(vehicle(-1_900, 200, 1_389, 0), Millis(0)));
        let at = Point::new(0, north);
        scene.tell(Input::Pose(Some(Pose { at, error_cm }), Millis(0)));
        let to = Some(Point::new(to.0, to.1));
        let out = scene.tell(Input::Started(maneuver(TaskType::BLOCK, 0), to));
        assert_eq!(out.contains(&Output::Wait), expected, "{north}, {to:?}");
    }
    let mut scene = Scene::new(setup);
    scene.tell(Input::Vehicle(vehicle(-5_000, 2_000, 1_389, 0), Millis(0)));
    assert!(scene.crossing.hindered(&scene.setup).is_some());
    scene.is_at(0, -100, 0);
    let to = Some(Point::new(0, 200));
    let out = scene.tell(Input::Started(maneuver(TaskType::BLOCK, 0), to));
    assert!(!out.contains(&Output::Wait));
}

/// Hazard: nobody knows where a body is, which is at the kerb, and it steps in front of a vehicle.
#[test]
fn a_body_sets_out_for_the_road_once_it_is_known_where_it_is() {
    let (blocks, to) = (maneuver(TaskType::BLOCK, 0), Point::new(0, 200));
    let mut plan = plan(&[]);
    plan.own_place = Some(to);
    let setup = Setup {
        watches: false,
        plan: Some(plan),
        ..street()
    };
    let follows = Input::Started(blocks, Some(to));
    let leads = Input::Notice(Notice::RolesEstablished(blocks.id.session));
    for starts in [follows, leads] {
        let mut scene = Scene::new(setup.clone());
        let out = scene.tell(starts);
        assert!(out.contains(&Output::Wait), "{starts:?}");
        scene.pass(3_000);
        scene.tell(Input::Vehicle(vehicle(-1_900, 200, 1_389, 0), Millis(0)));
        for (ms, expected) in [(1, false), (5_000, true)] {
            scene.is_at(0, -100, 0);
            scene.pass(ms);
            scene.is_at(0, -100, 0);
            scene.pass(0);
            let goes_on = scene.out.contains(&Output::GoOn);
            assert_eq!(goes_on, expected, "{starts:?}");
        }
    }
}

/// Hazard: a guard steps on the lane in a flood of packets, before a car that it does not hear. One that is on a lane does not stay
/// there for it, nor does one at the kerb that somebody on the road needs.
#[test]
fn packets_that_are_dropped_hold_a_body_at_the_kerb_of_an_empty_road() {
    let mut setup = street();
    setup.watches = false;
    for (name, north, people, expected) in [
        ("at the kerb", -100, &[][..], true),
        ("on the lane", 100, &[], false),
        ("for somebody", -100, &[person(1, 100, 300)], false),
    ] {
        let mut scene = Scene::new(setup.clone());
        scene.frame(0, 0, 0b11, people);
        scene.is_at(0, north, 0);
        // A shorter time takes nothing from a longer one.
        for ms in [5_000, 1_000] {
            scene.tell(Input::Missed(Millis(ms)));
        }
        let to = Some(Point::new(0, 200));
        let out = scene.tell(Input::Started(maneuver(TaskType::BLOCK, 0), to));
        assert_eq!(out.contains(&Output::Wait), expected, "{name}");
        for half in 1..=10 {
            let hindered = scene.crossing.hindered(&scene.setup);
            assert_eq!(hindered, Some(Hindrance::Missed), "{name}");
            scene.is_at(0, north, 0);
            scene.pass(500);
            let goes_on = scene.out.contains(&Output::GoOn);
            assert_eq!(goes_on, expected && half == 10, "{name}, {half}");
        }
        assert_eq!(scene.crossing.hindered(&scene.setup), None, "{name}");
    }
    // Somebody could keep a robot without a part on the lane.
    let home = Point::new(0, -150);
    setup.home = Some(home);
    let mut scene = Scene::new(setup);
    for north in [-150, 100] {
        scene.is_at(0, north, 0);
    }
    scene.tell(Input::Missed(Millis(5_000)));
    scene.pass(100);
    let goes = [Output::WalkTo(home), Output::Wait].map(|it| scene.out.contains(&it));
    assert_eq!(goes, [true, false]);
}

#[test]
fn each_hindrance_has_a_text_of_its_own() {
    let hindrances = [
        Hindrance::GuardElsewhere(StationId(2)),
        Hindrance::GuardElsewhere(StationId(3)),
        Hindrance::LeaderElsewhere,
        Hindrance::NoSight,
        Hindrance::Vehicle(7),
        Hindrance::Missed,
        Hindrance::NoPromise(StationId(7)),
    ];
    let texts = hindrances.map(|it| it.to_string());
    assert_eq!(BTreeSet::from(texts).len(), hindrances.len());
}

#[test]
fn a_robot_that_comes_elsewhere_knows_nothing_of_that_place() {
    let mut scene = Scene::new(street());
    let car = vehicle(-1_900, 200, 1_389, 0);
    scene.frame(0, 0, 0b11, &[person(1, 100, 300)]);
    scene.tell(Input::Vehicle(car, Millis(0)));
    scene.crossing.come_elsewhere();
    assert_eq!(scene.crossing, Crossing::default());
}

/// Paper, section VI names coordination with vehicles as further work.
#[test]
fn a_vehicle_that_can_stop_hinders_until_it_has_said_that_it_will() {
    let station = Some(StationId(7));
    let asked = Vehicle {
        station,
        ..vehicle(-9_000, 200, 1_389, 0)
    };
    let bends = Vehicle {
        station,
        ..vehicle(-9_000, 4_000, 1_389, 0)
    };
    let hinders = |asks: u32, vehicle: Vehicle, answers: &[bool], later: u32| {
        let mut setup = street();
        (setup.watches, setup.traffic.asks) = (false, Millis(asks));
        let mut scene = Scene::new(setup);
        scene.tell(Input::Vehicle(vehicle, Millis(0)));
        for promises in answers {
            scene.tell(Input::Answered(StationId(7), *promises));
        }
        scene.pass(later);
        scene.tell(Input::Vehicle(vehicle, Millis(0)));
        scene.crossing.hindered(&scene.setup) == Some(Hindrance::NoPromise(StationId(7)))
    };
    // It is at the crossing in 6.3 s.
    for (name, asks, vehicle, answers, later, expected) in [
        ("silent", 10_000, asked, &[][..], 0, true),
        ("no vehicle is asked", 0, asked, &[], 0, false),
        ("far", 6_000, asked, &[], 0, false),
        ("it would have to bend", 10_000, bends, &[], 0, false),
        ("it promises", 10_000, asked, &[true], 0, false),
        (
            "it promised 4.9 s ago",
            10_000,
            asked,
            &[true],
            4_900,
            false,
        ),
        ("it promised 5 s ago", 10_000, asked, &[true], 5_000, true),
        ("it refuses", 10_000, asked, &[false], 0, true),
        (
            "it thinks better of it",
            10_000,
            asked,
            &[true, false],
            0,
            true,
        ),
        (
            "it is seen, and tells nothing",
            10_000,
            Vehicle {
                station: None,
                ..asked
            },
            &[],
            0,
            false,
        ),
        (
            "it stands",
            10_000,
            Vehicle {
                velocity: Way::default(),
                ..asked
            },
            &[],
            0,
            false,
        ),
        (
            "it cannot stop, whatever it says",
            10_000,
            Vehicle {
                at: Point::new(-4_000, 200),
                ..asked
            },
            &[true],
            0,
            false,
        ),
    ] {
        assert_eq!(hinders(asks, vehicle, answers, later), expected, "{name}");
    }
}
