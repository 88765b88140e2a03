//! Evidence that one station, or one odd frame, takes away.

use crossguard_crossing::*;
use crossguard_protocol::{Event, Millis, StationId, TaskType};

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

/// An escort of robot 1 at the kerb of its person.
fn escort(sees: bool) -> Team {
    let mut team = team(plan(&[leg(TaskType::MOVE, Point::new(100, 800))]), sees);
    team.robots[1].body.at = Point::new(0, -100);
    team
}

/// Has the person of an escort walk at *go* for so long, and stop on the road for 10 s. How far the escort is ahead of the person
/// then, in centimetres. `tell` tells the robots something before each 100 ms, and knows whether the person stopped.
fn ahead_cm(team: &mut Team, walks_ms: u32, mut tell: impl FnMut(&mut Team, bool)) -> i32 {
    let mut pass = |team: &mut Team, ms: u32, has_stopped: bool| {
        for _ in 0..ms / 100 {
            tell(team, has_stopped);
            team.pass(100);
        }
    };
    team.people = vec![person(1, 100, -100)];
    for _ in 0..200 {
        if !team.shows_go() {
            pass(team, 100, false);
        }
    }
    assert!(team.shows_go());
    team.people[0] = walking(team.people[0], 0, 40);
    pass(team, walks_ms, false);
    team.people[0] = walking(team.people[0], 0, 0);
    pass(team, 10_000, true);
    team.robots[1].body.at.north_cm() - team.people[0].at.north_cm()
}

#[test]
fn an_escort_stays_with_its_person_however_many_others_are_reported() {
    for crowd in [false, true] {
        let mut team = escort(true);
        let tell = |team: &mut Team, _: bool| {
            if crowd {
                crowd_elsewhere(team, 0);
                crowd_elsewhere(team, 1);
            }
        };
        for _ in 0..10 {
            tell(&mut team, false);
            team.pass(100);
        }
        let ahead = ahead_cm(&mut team, 5_000, tell);
        assert!((0..=250).contains(&ahead), "crowd {crowd}: {ahead} cm");
    }
}

/// A camera that covers no part of the road knows no more of it than none.
#[test]
fn a_source_that_covers_nothing_takes_nobody_off_the_road() {
    for looks in [false, true] {
        let ahead = ahead_cm(&mut escort(false), 6_000, |team, has_stopped| {
            if !has_stopped {
                let who = team.people[0];
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
        });
        assert!((0..=250).contains(&ahead), "looks: {looks}, {ahead} cm");
    }
}

#[test]
fn nobody_on_the_road_is_taken_off_it_by_another_station() {
    for liar in [false, true] {
        let ahead = ahead_cm(&mut escort(false), 6_000, |team, _| {
            let id = Some(77);
            let who = team.people[0];
            // The leader's RAM have the person, once a second.
            if team.now % 1_000 == 0 {
                team.hear(1, Input::Heard(WITNESS, Sighting { id, ..who }, Millis(0)));
            }
            if liar {
                for at in [who.at, Point::new(100, -100)] {
                    let lie = Sighting {
                        at,
                        error_cm: 4_000,
                        ..person(1_000 + team.now, 0, 0)
                    };
                    team.hear(1, Input::Heard(StationId(66), lie, Millis(0)));
                }
            }
        });
        assert!((0..=250).contains(&ahead), "liar {liar}: {ahead} cm");
    }
}

/// Hazard: a group of whom some are on the road is heard of every few seconds, and its escort is done in between.
#[test]
fn people_of_whom_a_robot_only_hears_are_on_the_road_until_the_next_report() {
    let mut scene = Scene::new(Setup {
        watches: false,
        ..street()
    });
    let escort = maneuver(TaskType::MOVE, 1);
    scene.tell(Input::Started(escort, Some(Point::new(100, 800))));
    scene.tell(Input::Body(BodyReport::Completed(escort.id)));
    let group = Sighting {
        error_cm: 500,
        ..person(1, 100, -100)
    };
    let is_done = |scene: &Scene| scene.told(|it| *it == Event::ManeuverCompleted(escort.id)) > 0;
    for _ in 0..3 {
        scene.tell(Input::Heard(WITNESS, group, Millis(0)));
        scene.pass(5_400);
        assert!(!is_done(&scene));
    }
    scene.pass(100);
    assert!(is_done(&scene));
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
