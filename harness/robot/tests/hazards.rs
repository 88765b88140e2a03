//! The hazards of a crossing, each with real robots in virtual time and a person whose place is the ground truth.
//!
//! In every test, at every tick: while the person is between the kerbs, a follower executes a maneuver that guards, or
//! holds because of one. In the end the session is over and everybody is at rest. Hazard K, settings that switch guarding off,
//! is tested where settings are read.

#[path = "hazards/scene.rs"]
mod scene;

use crossguard_codec::Kind;
use crossguard_protocol::{EndReason, TaskType};
use crossguard_robot::perception::{SensorFrame, parse};
use crossguard_robot::site::Place;

use self::scene::{
    CAR_MPS, Car, GUARD, LEADER, Person, Pose, STOPPING_M, Scene, Sensors, escort, sees, shipped,
};

/// Both plans, with how fast the person walks in them.
fn both() -> [(Scene, f64); 2] {
    [(Scene::escorted(), 0.424), (Scene::blocked(), 1.2)]
}

/// Sensors that do something else for a while: from the beginning of that while, in ms, until its end.
fn sees_else(during_ms: [u32; 2], mut then: Sensors) -> Sensors {
    let mut usual = sees(7);
    let [from_ms, until_ms] = during_ms;
    Box::new(move |now_ms, person| {
        if (from_ms..until_ms).contains(&now_ms) {
            then(now_ms, person)
        } else {
            usual(now_ms, person)
        }
    })
}

fn sees_nobody() -> Sensors {
    Box::new(|_, _| vec![Some(SensorFrame::of(&[]))])
}

/// Hazard A. The old application read the lines of before as fresh, forgot who waited, and told that the task was completed.
#[test]
fn a_leader_hangs_just_after_go_and_reads_old_frames_when_it_wakes() {
    for (mut scene, speed) in both() {
        scene.comes_to_go();
        scene.person.way_mps = [0.0, speed];
        scene.pass(200);
        scene.robots[LEADER].hangs = true;
        scene.pass(1_200);
        scene.robots[LEADER].hangs = false;
        scene.walks_across(speed);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard A. The old application took frames for as young as it read them: by those, nobody came back.
#[test]
fn frames_that_wait_in_a_pipe_show_the_kerb_of_before() {
    for (mut scene, _) in both() {
        scene.comes_to_go();
        let usual_ms = std::mem::replace(&mut scene.latency_ms, 2_000);
        scene.person.way_mps = [0.0, -2.0];
        scene.pass(1_000);
        // They step on the road before those frames have even shown that they left.
        scene.person.way_mps = [0.0, 2.0];
        scene.pass(1_500);
        scene.person.way_mps = [0.0, 1.2];
        scene.pass(3_500);
        scene.latency_ms = usual_ms;
        scene.walks_across(1.2);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard B. The old application took one occlusion of a person who waits under go for a crossing, and released the guards.
#[test]
fn a_person_who_waits_under_go_is_out_of_sight_for_a_second_or_two() {
    for (guard_watches, hidden_ms) in [(false, 1_000), (true, 1_000), (false, 2_000), (true, 2_000)]
    {
        for (mut scene, speed) in both() {
            scene.comes_to_go();
            let now_ms = scene.now_ms;
            scene.sensors = sees_else([now_ms, now_ms + hidden_ms], sees_nobody());
            if guard_watches {
                scene.watchers.push(GUARD);
            }
            scene.pass(hidden_ms - 100);
            scene.walks_across(speed);
            scene.comes_to_rest(60_000);
        }
    }
}

/// Hazard C. The old application counted a person as beside the road who left the polygon of the zone sideways.
#[test]
fn a_person_walks_off_sideways_on_the_carriageway() {
    for (mut scene, speed) in both() {
        scene.comes_to_go();
        scene.walks_to(3.0, speed);
        scene.person.way_mps = [speed, 0.0];
        scene.pass_until(60_000, |it| it.person.at[0] >= 12.0);
        scene.person.way_mps = [0.0; 2];
        scene.pass(5_000);
        assert_eq!(scene.ends, [], "{}", scene.told());
        scene.person.way_mps = [0.0, -speed];
        scene.pass_until(60_000, |it| it.person.at[1] <= -1.0);
        scene.person.way_mps = [0.0; 2];
        scene.comes_to_rest(60_000);
    }
}

/// Somebody who stands on the pavement over there, beside the crossing.
const BYSTANDER: Person = Person {
    at: [9.0, 8.5],
    way_mps: [0.0; 2],
};

/// Hazard D. The old application took the number of a track for a person: the person on the road *was* on the pavement.
#[test]
fn a_tracker_that_restarts_gives_the_persons_number_to_a_bystander() {
    for (mut scene, speed) in both() {
        scene.sensors = Box::new(|_, person| {
            let people = [person.seen_as(1), BYSTANDER.seen_as(2)];
            vec![Some(SensorFrame::of(&people))]
        });
        scene.comes_to_go();
        scene.walks_to(2.0, speed);
        let restarts_ms = scene.now_ms;
        scene.sensors = Box::new(move |now_ms, person| {
            let mut people = vec![BYSTANDER.seen_as(1)];
            // It takes four frames to have both again, fewer than the assumption allows.
            if now_ms > restarts_ms + 400 {
                people.push(person.seen_as(2));
            }
            vec![Some(SensorFrame::of(&people))]
        });
        scene.pass(3_000);
        assert_eq!(scene.ends, [], "{}", scene.told());
        scene.walks_across(speed);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard D. The old application had one table of numbers for all sources.
#[test]
fn two_sources_number_from_one() {
    for (mut scene, speed) in both() {
        scene.sensors = Box::new(|_, person| {
            let has = |source, people: &[_]| SensorFrame {
                source,
                ..SensorFrame::of(people)
            };
            // The second camera stands behind a tree, and has the bystander alone, who comes along then.
            let bystander = person.is_on_road().then(|| BYSTANDER.seen_as(1));
            let second = has(1, bystander.as_slice());
            vec![Some(has(0, &[person.seen_as(1)])), Some(second)]
        });
        scene.comes_to_go();
        scene.walks_to(4.0, speed);
        scene.pass(5_000);
        assert_eq!(scene.ends, [], "{}", scene.told());
        scene.walks_across(speed);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard E. The old application began the dwell anew with every id, and never called.
#[test]
fn ids_change_all_the_time_and_the_person_is_detected_within_15_frames() {
    for (mut scene, speed) in both() {
        scene.sensors = Box::new(|now_ms, person| {
            let id = 1 + now_ms / 800;
            vec![Some(SensorFrame::of(&[person.seen_as(id)]))]
        });
        let took_ms = scene.pass_until(1_500, |it| it.calls > 0);
        assert!(took_ms >= 1_000, "the dwell is over after {took_ms} ms");
        scene.comes_to_go();
        scene.walks_across(speed);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard F. The old application ended the process of the robot at a malformed line, also that of a guard on the road.
#[test]
fn malformed_frames_end_nothing_and_close_go() {
    let lines = [
        r#"{"at_s": 1, "people": [{"id": 1, "position_m": [NaN, 2]}]}"#,
        r#"{"at_s": 1, "people": [{"id": -1, "position_m": [1, 2]}]}"#,
        r#"{"at_s": 1, "people": [{"id": 1, "position_m": [1, 2], "confidence": 1.01}]}"#,
        r#"{"at_s": 1, "people": [{"id": 1, "position_m": [1, 1e300]}]}"#,
        r#"{"at_s": null, "people": null}"#,
        "null",
        "",
    ];
    for (mut scene, speed) in both() {
        scene.watchers.push(GUARD);
        scene.comes_to_go();
        scene.walks_to(2.0, speed);
        assert!(scene.is_go(), "{}", scene.told());
        let now_ms = scene.now_ms;
        let mut next = lines.into_iter().cycle();
        let garbage: Sensors = Box::new(move |_, _| {
            let line = next.next().unwrap();
            assert!(parse(line).is_err(), "{line}");
            vec![None]
        });
        scene.sensors = sees_else([now_ms, now_ms + 5_000], garbage);
        let took_ms = scene.pass_until(1_000, |it| !it.is_go());
        assert!(took_ms <= 650, "go for {took_ms} ms without a frame");
        scene.walks_across(speed);
        scene.pass(5_000);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard G. The old application believed *in position* for ever, and go stayed.
#[test]
fn a_guard_that_is_off_its_place_turns_the_sign_to_stop() {
    for pose in [Pose::Off([3.0, 0.0]), Pose::Off([30.0, 0.0]), Pose::Unknown] {
        let mut scene = Scene::blocked();
        scene.comes_to_go();
        *scene.robots[GUARD].pose.lock().unwrap() = pose;
        let took_ms = scene.pass_until(1_000, |it| !it.is_go());
        // A RAM comes every 100 ms.
        assert!(took_ms <= 150, "{pose:?}: go for {took_ms} ms");
        scene.pass(3_000);
        assert_eq!(scene.goes_ms.len(), 1, "{pose:?}: {}", scene.told());
        *scene.robots[GUARD].pose.lock().unwrap() = Pose::Off([0.0; 2]);
        scene.comes_to_go();
        scene.walks_across(1.2);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard G. The old application of a guard that drifts off left the person with a sign at go.
#[test]
fn a_guard_drifts_off_while_the_person_is_on_the_road() {
    let mut scene = Scene::blocked();
    scene.comes_to_go();
    scene.walks_to(2.0, 1.2);
    for centimetres in 0..300 {
        let off = f64::from(centimetres) / 100.0;
        *scene.robots[GUARD].pose.lock().unwrap() = Pose::Off([off, 0.0]);
        scene.pass(10);
        // The body reports its place to 0.2 m; 2 m are tolerated.
        assert!(!scene.is_go() || off < 2.1, "{off} m: {}", scene.told());
    }
    scene.walks_across(1.2);
    *scene.robots[GUARD].pose.lock().unwrap() = Pose::Off([0.0; 2]);
    scene.comes_to_rest(60_000);
}

/// Hazard H. The old application completed `move` and left, while its person stood on the road.
#[test]
fn an_escort_waits_for_a_person_who_stops_on_the_road() {
    let mut scene = Scene::escorted();
    scene.watchers.push(GUARD);
    scene.comes_to_go();
    // The escort sets out with the person.
    scene.walks_to(3.0, 0.424);
    for _ in 0..150 {
        scene.pass(100);
        let ahead_m = scene.robots[GUARD].place().north - scene.person.at[1];
        // 2 m, the error of a place, and the way in which a body brakes.
        assert!(ahead_m <= 2.4, "{ahead_m} m: {}", scene.told());
        assert!(scene.is_executed(TaskType::MOVE), "{}", scene.told());
    }
    assert_eq!(scene.ends, [], "{}", scene.told());
    scene.walks_across(0.4);
    scene.comes_to_rest(60_000);
}

/// Hazard H. The old application began the escort before its leader was at the place from which it guards.
#[test]
fn an_escort_begins_when_the_leader_is_at_its_place() {
    let (plan, place) = (shipped("trio", 2), Place::new(-4.0, 2.0));
    // The others are there long before it.
    let mut scene = Scene::new(plan, Place::new(-14.0, -0.8));
    assert_eq!(scene.robots.len(), 3);
    scene.pass_until(60_000, |it| it.is_executed(TaskType::MOVE));
    let off_m = scene.robots[LEADER].place().distance(place);
    assert!(off_m < 2.0, "{off_m} m: {}", scene.told());
    assert!(scene.now_ms > 8_000, "{}", scene.told());
    scene.comes_to_go();
    scene.walks_across(0.424);
    scene.comes_to_rest(60_000);
}

/// How far the nearest car that comes is from the crossing.
fn nearest_car_m(scene: &Scene) -> f64 {
    let ahead = scene.cars.iter().map(|car| -3.0 - car.east);
    ahead
        .filter(|metres| *metres >= 0.0)
        .fold(f64::INFINITY, f64::min)
}

/// Hazard I. The old application opened the corridor in front of cars whose CAM it received.
#[test]
fn go_does_not_begin_before_cars_that_can_no_longer_stop() {
    for (mut scene, speed) in both() {
        // One after the other, so that always one is too near, for 15 s.
        scene.cars = (0..5)
            .map(|number| Car {
                station: 100 + number,
                east: -19.0 - 40.0 * f64::from(number),
            })
            .collect();
        while scene.goes_ms.is_empty() {
            scene.pass(10);
            let nearest_m = nearest_car_m(&scene);
            // Between two CAM a car goes on for 100 ms.
            let is_safe = nearest_m > STOPPING_M - CAR_MPS * 0.1;
            assert!(!scene.is_go() || is_safe, "{nearest_m} m");
            assert!(scene.now_ms < 40_000, "{}", scene.told());
        }
        assert!(scene.now_ms > 10_000, "{}", scene.told());
        scene.walks_across(speed);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard I. The old application went on to show go to those who wait.
#[test]
fn go_ends_for_a_car_that_can_no_longer_stop() {
    for (mut scene, speed) in both() {
        scene.comes_to_go();
        let (station, east) = (100, -19.0);
        scene.cars.push(Car { station, east });
        let took_ms = scene.pass_until(1_000, |it| !it.is_go());
        assert!(took_ms <= 110, "go for {took_ms} ms");
        let leader = scene.robots[LEADER].machine.application_mut();
        let sight = leader.next_sight().unwrap();
        assert_eq!(sight.vehicles.len(), 1, "its log has cars that it hears");
        scene.pass_until(60_000, |it| it.goes_ms.len() == 2);
        assert!(scene.cars[0].east > 5.0, "it has passed");
        scene.cars.clear();
        scene.walks_across(speed);
        scene.comes_to_rest(60_000);
    }
}

/// Hazard I. The old application received VAM, and called nobody.
#[test]
fn a_person_who_tells_of_themselves_by_vam_is_called_for() {
    let mut scene = Scene::new(escort(), Place::new(-4.0, -0.8));
    scene.sensors = sees_nobody();
    let mut until_called_ms = 0;
    while scene.calls == 0 {
        scene.hear(Kind::Vru, 200, [1.0, -0.8], Some(0.0));
        scene.pass(500);
        until_called_ms += 500;
        assert!(until_called_ms <= 3_000, "{}", scene.told());
    }
    // They have left before anybody came.
    scene.pass_until(60_000, Scene::all_rest);
    scene.pass(5_000);
    assert!(scene.all_rest() && scene.calls == 1, "{}", scene.told());
}

/// Hazard J. The old application could never be commanded again after a fallback: every reissue was rejected.
#[test]
fn a_follower_that_lost_contact_takes_the_reissue_of_the_same_leader() {
    for (mut scene, speed) in both() {
        scene.comes_to_go();
        scene.walks_to(1.0, speed);
        scene.is_cut = true;
        let mut has_fallen_back = false;
        for _ in 0..300 {
            scene.pass(10);
            has_fallen_back |= scene.robots[GUARD].falls_back().is_some();
        }
        assert!(has_fallen_back, "{}", scene.told());
        scene.is_cut = false;
        scene.pass_until(10_000, |it| {
            let resumed = it.robots[GUARD].executes();
            resumed.is_some() && it.robots[GUARD].falls_back().is_none()
        });
        scene.walks_across(speed);
        scene.comes_to_rest(90_000);
        assert_eq!(scene.ends, [EndReason::TaskCompleted]);
    }
}
