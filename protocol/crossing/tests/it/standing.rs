//! Acts of a robot about people, by its part in a session: it calls, goes home, tells what it sees.

use std::iter::once;

use crossguard_crossing::*;
use crossguard_protocol::{
    Availability, Event, List, Millis, Notice, Phase, TaskType, Unavailability,
};

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
    team.pass(TICK);
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

/// It has fallen back on the road, which is not known to be clear yet: soon after, and, without sensors, once it has left the session.
#[test]
fn a_guard_on_duty_calls_nobody_and_stays() {
    for (sees, ms) in [(true, 3_000), (false, 10_000)] {
        let mut team = left_alone(TaskType::BLOCK, sees);
        team.robots[1].setup.home = Some(Point::new(-100, -150));
        team.robots[1].setup.ground = street().ground;
        team.people = vec![person(1, 100, -100)];
        team.pass_until("a duty", |it| it.robots[1].robot.duty().is_some());
        let at = team.robots[1].body.at;
        assert!(is_on_road(&team.robots[1].body));
        for _ in 0..ms / TICK {
            team.hear(1, Input::Heard(WITNESS, team.people[0], Millis(0)));
            team.pass(TICK);
        }
        let guard = &team.robots[1];
        assert!(guard.robot.duty().is_some());
        assert_eq!(matches!(guard.robot.phase(), Phase::Idle), !sees);
        assert_eq!(guard.body.at, at);
        let called = team.told(1, |it| matches!(it, Event::PedestrianDetected(_)));
        assert_eq!(called, 0);
    }
}

/// A robot without sensors hears of somebody on the road, and then of nobody any more.
#[test]
fn a_robot_without_a_part_goes_home_once_it_hears_of_nobody_on_the_road() {
    let home = Point::new(0, -150);
    let setup = Setup {
        watches: false,
        home: Some(home),
        ..street()
    };
    let mut scene = Scene::new(setup);
    scene.is_at(0, -150, 0);
    // The next report may come 5 s later.
    for _ in 0..3 {
        scene.tell(Input::Heard(WITNESS, person(1, 100, 300), Millis(0)));
        for _ in 0..50 {
            scene.is_at(0, 100, 0);
            scene.pass(100);
            assert!(!scene.out.contains(&Output::WalkTo(home)));
        }
    }
    for (ms, goes) in [(499, false), (1, true)] {
        scene.is_at(0, 100, 0);
        scene.pass(ms);
        assert_eq!(scene.out.contains(&Output::WalkTo(home)), goes, "{ms} ms");
    }
}

/// When a robot on the lane sets out for its home, within a minute of its start, where people stand up to this speed. It has a frame in
/// each tenth of a second for which there is one: which parts it covers, and whether somebody is on the road.
fn leaves_ms(stands_cmps: u16, looks: impl Fn(u32) -> Option<(u32, bool)>) -> Option<u32> {
    let home = Point::new(0, -150);
    let mut setup = street();
    setup.home = Some(home);
    setup.waiting.speed_max_cmps = stands_cmps;
    let mut scene = Scene::new(setup);
    scene.pass(0);
    (100..=60_000).step_by(100).find(|ms| {
        scene.is_at(0, 100, 0);
        if let Some((covers, is_occupied)) = looks(ms - 100) {
            let people = [person(1, 100, 300)];
            let seen = if is_occupied { &people[..] } else { &[] };
            scene.frame(0, 0, covers, seen);
        }
        scene.pass(100);
        scene.out.contains(&Output::WalkTo(home))
    })
}

/// Hazard: a guard loses power in the middle of a crossing, and boots on the lane. For as long as its `t_safety` (2 s) a sign may count on
/// it; for 2 s after that people step off the kerb; and they need 14 s for 7 m at 0.5 m/s.
#[test]
fn a_robot_that_boots_on_the_road_goes_home_once_it_has_looked_or_people_had_their_time() {
    type Looks = fn(u32) -> Option<(u32, bool)>;
    let at_last = Some(18_000);
    let cases: [(&str, Looks, Option<u32>); 8] = [
        ("nobody", |_| Some((0b11, false)), Some(4_700)),
        (
            "somebody goes",
            |ms| Some((0b11, ms < 10_000)),
            Some(11_100),
        ),
        ("somebody stays", |_| Some((0b11, true)), None),
        (
            "somebody comes soon",
            |ms| Some((0b11, (3_900..9_000).contains(&ms))),
            Some(10_100),
        ),
        (
            "it looks late",
            |ms| (ms >= 8_000).then_some((0b11, false)),
            Some(8_600),
        ),
        ("it sees half of the road", |_| Some((0b01, false)), at_last),
        (
            "it stops to look",
            |ms| (ms < 4_400).then_some((0b11, false)),
            at_last,
        ),
        ("no sensors", |_| None, at_last),
    ];
    for (name, looks, expected) in cases {
        assert_eq!(leaves_ms(50, looks), expected, "{name}");
    }
}

/// Hazard: where people are said to stand up to 2 m/s, a robot that boots on the lane walks off beside a slow walker, who needs 7.8 s.
#[test]
fn a_robot_that_boots_on_the_road_waits_for_a_slow_walker_whatever_counts_as_standing() {
    for (stands_cmps, expected) in [(50, 18_000), (90, 11_800), (200, 11_800)] {
        let left_ms = leaves_ms(stands_cmps, |_| None);
        assert_eq!(left_ms, Some(expected), "{stands_cmps} cm/s");
    }
}

/// A sign may count on it for as long as it has stood there for less than its `t_safety`.
#[test]
fn an_empty_road_is_old_news_to_a_robot_that_did_not_know_where_it_stands() {
    let home = Point::new(0, -150);
    let mut setup = street();
    (setup.home, setup.sensors.gap_max) = (Some(home), Millis(10_000));
    let mut scene = Scene::new(setup);
    (0..40).for_each(|_| drop(scene.look(100, &[])));
    assert!(scene.is_clear());
    for _ in 0..30 {
        scene.is_at(0, 100, 0);
        scene.pass(100);
    }
    assert!(!scene.out.contains(&Output::WalkTo(home)));
}

#[test]
fn a_robot_that_may_have_booted_on_the_road_by_its_first_position_stays_there_first() {
    let home = Point::new(0, -150);
    for (error_cm, goes) in [(9, true), (10, false)] {
        let mut scene = Scene::new(Setup {
            home: Some(home),
            ..street()
        });
        for north in [-10, 10] {
            let at = Point::new(0, north);
            scene.tell(Input::Pose(Some(Pose { at, error_cm }), Millis(0)));
        }
        scene.pass(100);
        assert_eq!(
            scene.out.contains(&Output::WalkTo(home)),
            goes,
            "{error_cm}"
        );
    }
}

/// Hazard: a guard loses power in the middle of a crossing, boots on the lane, and is commanded to another place, or leads, at once.
#[test]
fn a_robot_that_boots_on_the_road_looks_before_it_has_a_part_elsewhere() {
    let goes_ms = |starts: Input<'_>, sees: Option<&[Sighting]>| {
        let mut plan = plan(&[leg(TaskType::BLOCK, POST)]);
        plan.own_place = Some(POST);
        let mut scene = Scene::new(Setup {
            plan: Some(plan),
            ..street()
        });
        scene.is_at(0, 100, 0);
        scene.tell(starts);
        (100..=60_000).step_by(100).find(|_| {
            scene.is_at(0, 100, 0);
            if let Some(people) = sees {
                scene.frame(0, 0, 0b11, people);
            }
            scene.pass(100);
            let mut last = scene.out.iter().rev();
            let last = last.find(|it| matches!(it, Output::Wait | Output::GoOn));
            last != Some(&Output::Wait)
        })
    };
    let maneuver = maneuver(TaskType::BLOCK, 1);
    let leads = Notice::RolesEstablished(maneuver.id.session);
    for starts in [Input::Started(maneuver, Some(POST)), Input::Notice(leads)] {
        let stays = [person(1, 100, 300)];
        for (sees, expected) in [
            (None, Some(18_000)),
            (Some(&[][..]), Some(4_700)),
            (Some(&stays[..]), None),
        ] {
            assert_eq!(goes_ms(starts, sees), expected, "{starts:?} {sees:?}");
        }
    }
    // It is in its place already.
    let here = Input::Started(maneuver, Some(Point::new(0, 250)));
    assert_eq!(goes_ms(here, None), Some(100));
}

/// A guard at its post, beside a slow walker who has been on the road for four seconds.
fn beside_a_walker(sees: bool) -> Team {
    let mut team = team(plan(&[leg(TaskType::BLOCK, POST)]), sees);
    team.robots[1].setup.home = Some(Point::new(-100, -150));
    team.robots[1].setup.calls = false;
    team.people = vec![person(1, 100, -100)];
    team.pass_until("go", Team::shows_go);
    team.people[0] = walking(team.people[0], 0, 60);
    team.pass(4_000);
    team
}

#[test]
fn a_guard_that_boots_on_the_road_stays_with_the_person_there() {
    for sees in [true, false] {
        let mut team = beside_a_walker(sees);
        team.boot(1);
        team.pass_until("across", |it| {
            let guard = &it.robots[1].body;
            assert_eq!(guard.at, POST, "{sees}");
            it.people[0].at.north_cm() > 700
        });
        team.pass(20_000);
        assert!(!is_on_road(&team.robots[1].body), "{sees}");
    }
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

/// Go ends before a car when the first of two people is across.
#[test]
fn guards_stay_for_somebody_who_waits_yet_when_go_has_ended_early() {
    let mut team = blocking();
    team.people.push(person(2, 200, -100));
    team.pass_until("go", Team::shows_go);
    walk_across(&mut team);
    team.hear(0, Input::Vehicle(car(-1_900), Millis(0)));
    assert!(!team.shows_go());
    team.pass_until("go again", Team::shows_go);
    assert_eq!(calls(&team), 1, "it is one session");
}

#[test]
fn an_escort_begins_at_the_kerb_where_people_wait() {
    let [near, far] = [Point::new(100, -50), Point::new(100, 750)];
    let parts = [
        (Who::Everybody, List::EMPTY),
        (Who::Role(0), once(None).collect()),
    ];
    let cases = [(-100, [near, far]), (800, [far, near])];
    for ((who, roles), (north, expected)) in parts
        .into_iter()
        .flat_map(|it| cases.map(|case| (it, case)))
    {
        let stage = |leg| Stage {
            parts: once((who, leg)).collect(),
        };
        let legs = [leg(TaskType::INITIAL_POS, near), leg(TaskType::MOVE, far)];
        let plan = Plan {
            kerbs: Some([near, far]),
            stages: legs.map(stage).into_iter().collect(),
            roles,
            ..plan(&[])
        };
        let mut team = team(plan, true);
        team.people = vec![person(1, 100, north)];
        let orders = |team: &Team| -> Vec<Point> {
            let of = |it: &Output| match it {
                Output::Order(_, leg) => Some(leg.to),
                _ => None,
            };
            let mut places: Vec<_> = team.robots[0].log.iter().filter_map(of).collect();
            places.dedup();
            places
        };
        team.pass_until("two orders", |it| orders(it).len() == 2);
        assert_eq!(orders(&team), expected, "{who:?}, people at {north}");
    }
}

#[test]
fn a_call_ends_when_the_person_leaves() {
    for helpers in [0, 1] {
        let mut team = alone(helpers);
        team.people = vec![person(1, 460, -100)];
        team.pass(1_300);
        assert_eq!(calls(&team), 1);
        // Somebody else called a second time.
        team.hear(0, Input::CallIgnored);
        team.people[0] = walking(team.people[0], 140, 0);
        // People who are lost from sight for three seconds may come again.
        team.pass(3_000);
        assert_eq!(team.told(0, |it| *it == Event::LeaveRequested), 0);
        team.pass_until("idle", Team::is_idle);
        // A guard that is on its way to the road goes there first.
        let left = team.told(0, |it| *it == Event::LeaveRequested);
        assert_eq!(left > 0, helpers == 0);
        assert!(!team.shows_go());
        assert_eq!(team.first(0, |it| matches!(it, Output::Go(_))), None);
        team.pass(5_000);
        assert_eq!(calls(&team), 1);
    }
}

#[test]
fn a_call_is_repeated_while_the_person_waits_and_nobody_helps() {
    let mut team = alone(0);
    team.people = vec![person(1, 100, -100)];
    team.pass(30_000);
    assert!((2..=4).contains(&calls(&team)), "{} calls", calls(&team));
}

#[test]
fn nobody_is_called_for_people_who_pass_vehicles_and_stale_sensors() {
    let passer_by = walking(person(1, -800, -80), 140, 0);
    let car = Sighting {
        what: RoadUser::Vehicle,
        ..person(1, 100, -80)
    };
    let rider = Sighting {
        what: RoadUser::Bicyclist,
        ..walking(person(1, -2_000, -80), 400, 0)
    };
    for who in [passer_by, car, rider] {
        let mut team = alone(1);
        team.people = vec![who];
        team.pass(10_000);
        assert_eq!(calls(&team), 0, "{who:?}");
    }
    let mut team = alone(1);
    team.people = vec![person(1, 100, -100)];
    team.sensor = |now, people| (now < 200).then(|| people.to_vec());
    team.pass(10_000);
    assert_eq!(calls(&team), 0, "a frame, and silence");
}

/// Its process hung, or somebody stopped it, and an operator says that it is available again.
#[test]
fn a_guard_that_was_stopped_beside_people_looks_before_it_leaves_the_road() {
    let mut team = beside_a_walker(false);
    let stop = Availability::Unavailable(Unavailability::EmergencyStop);
    team.event(1, Event::AvailabilityChanged(stop));
    team.pass(1_000);
    team.event(1, Event::AvailabilityChanged(Availability::Available));
    team.pass_until("across", |it| {
        assert_eq!(it.robots[1].body.at, POST);
        it.people[0].at.north_cm() > 700
    });
    team.pass(20_000);
    assert!(!is_on_road(&team.robots[1].body));
}

#[test]
fn a_body_that_is_there_again_on_its_way_home_is_sent_there_again() {
    let home = Point::new(0, -150);
    let mut scene = Scene::new(Setup {
        home: Some(home),
        ..street()
    });
    scene.is_at(0, -20, 0);
    for expected in [1, 2] {
        for _ in 0..3 {
            scene.is_at(0, 100, 0);
            scene.pass(100);
        }
        let goes = scene.out.iter().filter(|it| **it == Output::WalkTo(home));
        assert_eq!(goes.count(), expected);
        scene.tell(Input::Body(BodyReport::Gone));
    }
}

/// A car at 50 km/h is heard when a guard is 0.2 m before the kerb.
#[test]
fn a_body_that_rolls_over_the_kerb_while_it_is_to_wait_stays_there() {
    let mut scene = Scene::new(street());
    let blocks = maneuver(TaskType::BLOCK, 0);
    scene.is_at(-800, -20, 0);
    scene.tell(Input::Started(blocks, Some(Point::new(-800, 175))));
    scene.tell(Input::Vehicle(car(-3_300), Millis(0)));
    for (north, ms, expected) in [
        (-20, 100, vec![Output::Wait]),
        (5, 400, vec![]),
        (5, 5_000, vec![Output::GoOn]),
    ] {
        scene.out.clear();
        scene.is_at(-800, north, 0);
        scene.pass(ms);
        scene.is_at(-800, north, 0);
        scene.pass(0);
        assert_eq!(scene.out, expected, "{north} cm, {ms} ms");
    }
}
