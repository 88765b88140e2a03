//! What one station, or one odd frame, takes away.

use crossguard_crossing::*;

use crate::scene::*;

fn car(id: Option<u32>, at: Point, speed: i32) -> Sighting {
    let car = Sighting {
        id,
        what: RoadUser::Vehicle,
        at,
        ..person(0, 0, 0)
    };
    walking(car, speed, 0)
}

#[test]
fn vehicles_of_one_frame_are_as_many_as_it_has() {
    let comes = |id| car(id, Point::new(-1_900, 200), 1_389);
    let stands = |id| car(id, Point::new(-2_700, 200), 0);
    for (name, vehicles) in [
        ("numbers", [comes(Some(1)), stands(Some(4_097))]),
        ("a number and none", [comes(Some(1)), stands(None)]),
        ("one number", [comes(Some(0)), stands(Some(0))]),
        (
            "a motorcycle",
            [
                Sighting {
                    what: RoadUser::Motorcyclist,
                    ..comes(Some(1))
                },
                stands(Some(2)),
            ],
        ),
        (
            "a fast bicycle",
            [
                Sighting {
                    what: RoadUser::Bicyclist,
                    ..car(Some(1), Point::new(-1_000, 200), 700)
                },
                stands(Some(2)),
            ],
        ),
    ] {
        let mut scene = Scene::new(street());
        scene.look(100, &vehicles);
        let hindered = scene.crossing.hindered(&scene.setup);
        assert!(
            matches!(hindered, Some(Hindrance::Vehicle(_))),
            "{name}: {hindered:?}"
        );
    }
}
