//! Evidence that one station, or one odd frame, takes away.

use crossguard_crossing::*;
use crossguard_protocol::{Millis, StationId, TaskType};

use crate::scene::*;
use crate::team::Team;
use crate::whole::{leg, plan, team};

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

/// A CPM with many people elsewhere.
fn crowd_elsewhere(team: &mut Team, robot: usize) {
    for number in 0..64 {
        let far = person(
            1_000 + number,
            100_000 + 2_000 * i32::try_from(number).unwrap(),
            0,
        );
        team.hear(robot, Input::Heard(WITNESS, far, Millis(0)));
    }
}

#[test]
fn an_escort_stays_with_its_person_however_many_others_are_reported() {
    for crowd in [false, true] {
        let mut team = team(plan(&[leg(TaskType::MOVE, Point::new(100, 800))]), true);
        team.robots[1].body.at = Point::new(0, -100);
        let pass = |team: &mut Team, ms: u32| {
            for _ in 0..ms / 100 {
                if crowd {
                    crowd_elsewhere(team, 0);
                    crowd_elsewhere(team, 1);
                }
                team.pass(100);
            }
        };
        pass(&mut team, 1_000);
        team.people = vec![person(1, 100, -100)];
        for _ in 0..200 {
            if !team.shows_go() {
                pass(&mut team, 100);
            }
        }
        assert!(team.shows_go());
        team.people[0] = walking(team.people[0], 0, 40);
        pass(&mut team, 5_000);
        team.people[0] = walking(team.people[0], 0, 0);
        pass(&mut team, 10_000);
        let ahead = team.robots[1].body.at.north_cm() - team.people[0].at.north_cm();
        assert!((0..=250).contains(&ahead), "crowd {crowd}: {ahead} cm");
    }
}

/// A camera that covers no part of the road knows no more of it than none.
#[test]
fn a_source_that_covers_nothing_takes_nobody_off_the_road() {
    for looks in [false, true] {
        let mut team = team(plan(&[leg(TaskType::MOVE, Point::new(100, 800))]), false);
        team.people = vec![person(1, 100, -100)];
        team.robots[1].body.at = Point::new(0, -100);
        let pass = |team: &mut Team, ms: u32, is_reported: bool| {
            for _ in 0..ms / 100 {
                let who = team.people[0];
                if is_reported {
                    team.hear(1, Input::Heard(WITNESS, who, Millis(0)));
                }
                if looks {
                    let frame = Frame {
                        source: 0,
                        age: Millis(0),
                        covers: Coverage::NONE,
                        sightings: &[],
                    };
                    team.hear(1, Input::Frame(frame));
                }
                team.pass(100);
            }
        };
        while !team.shows_go() {
            assert!(team.now < 30_000);
            pass(&mut team, 100, true);
        }
        team.people[0] = walking(team.people[0], 0, 40);
        pass(&mut team, 6_000, true);
        team.people[0] = walking(team.people[0], 0, 0);
        pass(&mut team, 10_000, false);
        let ahead = team.robots[1].body.at.north_cm() - team.people[0].at.north_cm();
        assert!((0..=250).contains(&ahead), "looks: {looks}, {ahead} cm");
    }
}

#[test]
fn nobody_on_the_road_is_taken_off_it_by_another_station() {
    for liar in [false, true] {
        let mut team = team(plan(&[leg(TaskType::MOVE, Point::new(100, 800))]), false);
        team.people = vec![person(1, 100, -100)];
        team.robots[1].body.at = Point::new(0, -100);
        let pass = |team: &mut Team, ms: u32| {
            for step in 0..ms / 100 {
                // The leader's RAM have the person, once a second.
                if step % 10 == 0 {
                    let mut who = team.people[0];
                    who.id = Some(77);
                    team.hear(1, Input::Heard(WITNESS, who, Millis(0)));
                }
                if liar {
                    for at in [team.people[0].at, Point::new(100, -100)] {
                        let number = 1_000 + team.now;
                        let lie = Sighting {
                            at,
                            error_cm: 4_000,
                            ..person(number, 0, 0)
                        };
                        team.hear(1, Input::Heard(StationId(66), lie, Millis(0)));
                    }
                }
                team.pass(100);
            }
        };
        for _ in 0..200 {
            if !team.shows_go() {
                pass(&mut team, 100);
            }
        }
        assert!(team.shows_go());
        team.people[0] = walking(team.people[0], 0, 40);
        pass(&mut team, 6_000);
        team.people[0] = walking(team.people[0], 0, 0);
        pass(&mut team, 10_000);
        let ahead = team.robots[1].body.at.north_cm() - team.people[0].at.north_cm();
        assert!((0..=250).contains(&ahead), "liar {liar}: {ahead} cm");
    }
}

/// Hazard: there are five cameras, and the fifth alone has somebody on the road.
#[test]
fn somebody_in_a_frame_that_does_not_count_is_on_the_road_all_the_same() {
    for (name, source, age) in [("no such source", 9, 0), ("stale", 0, 600), ("late", 0, 50)] {
        let mut scene = Scene::new(street());
        scene.pass(5_000);
        for _ in 0..10 {
            scene.look(100, &[]);
        }
        assert!(scene.is_clear(), "{name}");
        scene.pass(10);
        scene.frame(source, age, 0b11, &[person(1, 100, 300)]);
        assert!(!scene.is_clear(), "{name}");
    }
}
