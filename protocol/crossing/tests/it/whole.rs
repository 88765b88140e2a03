//! Whole crossings: from the person who waits to the robots that are idle again.

use crossguard_crossing::*;
use crossguard_protocol::{Event, HelpRequest, List, Millis, Phase, StationId, TaskSet, TaskType};

use crate::scene::*;
use crate::team::*;

/// Where the blocker stands.
pub(crate) const POST: Point = Point::new(-200, 200);

pub(crate) fn leg(task: TaskType, to: Point) -> Leg {
    Leg {
        task,
        to,
        speed_mmps: 1_000,
        heading_ddeg: None,
    }
}

pub(crate) fn plan(stages: &[Leg]) -> Plan {
    Plan {
        followers: 1,
        stages: stages.iter().copied().map(Stage::everybody).collect(),
        roles: List::EMPTY,
        own_place: None,
        patience: Millis(60_000),
        kerbs: None,
    }
}

/// A leader with this plan, and a follower with sensors or without.
pub(crate) fn team(plan: Plan, follower_sees: bool) -> Team {
    let setup = street();
    let request = HelpRequest {
        tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK]),
        ..setup.request
    };
    let leader = Setup {
        plan: Some(plan),
        request,
        ..setup.clone()
    };
    let follower = Setup {
        watches: follower_sees,
        ground: Ground {
            waiting: None,
            ..setup.ground
        },
        ..setup
    };
    Team::new(vec![leader, follower])
}

pub(crate) fn blocking() -> Team {
    let mut team = team(plan(&[leg(TaskType::BLOCK, POST)]), true);
    team.people = vec![person(1, 100, -100)];
    team
}

/// The person walks across.
pub(crate) fn walk_across(team: &mut Team) {
    team.people[0] = walking(team.people[0], 0, 140);
    team.pass(6_500);
    assert!(team.people[0].at.north_cm() > 720);
    team.people[0] = walking(team.people[0], 0, 0);
}

fn is_told(event: Event) -> impl Fn(&Output) -> bool {
    move |output| *output == Output::Tell(event)
}

#[test]
fn a_person_is_helped_across_and_everybody_is_idle_again() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    assert!(team.robots[1].body.at.distance_cm(POST) < 200);
    walk_across(&mut team);
    assert_eq!(
        team.told(0, |it| *it == Event::TaskCompleted),
        0,
        "seen not enough"
    );
    team.pass_until("idle", Team::is_idle);
    let steps = [
        team.first(0, |it| {
            matches!(it, Output::Tell(Event::PedestrianDetected(_)))
        }),
        team.first(0, |it| matches!(it, Output::Order(..))),
        team.first(0, is_told(Event::OpenCorridor)),
        team.first(0, |it| matches!(it, Output::Go(_))),
        team.first(0, |it| matches!(it, Output::Stop)),
        team.first(0, is_told(Event::RoadClear)),
        team.first(0, is_told(Event::TaskCompleted)),
    ];
    assert!(
        steps.iter().all(Option::is_some) && steps.is_sorted(),
        "{steps:?}"
    );
    assert_eq!(team.alone, 0);
    let calls = team.told(0, |it| matches!(it, Event::PedestrianDetected(_)));
    assert_eq!(calls, 1, "a person over there is no call");
}

/// Hazard A: the leader hangs just after go, and its piped frames of before are stale when it reads them.
#[test]
fn a_leader_that_hangs_under_go_frees_nobody() {
    for ms in [600, 1_200, 3_000, 9_000] {
        let mut team = blocking();
        team.pass_until("go", Team::shows_go);
        team.people[0] = walking(team.people[0], 0, 70);
        team.pass(300);
        team.robots[0].hangs_until = team.now + ms;
        team.pass_until("idle", Team::is_idle);
        assert_eq!(team.alone, 0, "hung for {ms} ms");
        assert!(team.people[0].at.north_cm() > 700, "hung for {ms} ms");
    }
}

/// Hazard B: a person is out of sight for a second, under go and on the road.
#[test]
fn a_person_who_is_out_of_sight_for_a_moment_is_not_across() {
    for hidden_from in [0, 500, 1_000, 3_000] {
        let mut team = blocking();
        team.pass_until("go", Team::shows_go);
        team.pass(500);
        team.people[0] = walking(team.people[0], 0, 70);
        team.pass(hidden_from);
        // All but every fifth frame miss somebody.
        team.sensor = |now, people| {
            Some(if now % 500 == 0 {
                people.to_vec()
            } else {
                vec![]
            })
        };
        team.pass(4_000);
        team.sensor = |_, people| Some(people.to_vec());
        team.pass_until("idle", Team::is_idle);
        assert_eq!(team.alone, 0, "hidden from {hidden_from} ms on");
    }
}

/// Hazard C: a person leaves the crossing sideways, still on the carriageway.
#[test]
fn a_person_who_walks_off_along_the_road_is_on_it() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.people[0] = walking(team.people[0], 0, 140);
    team.pass(2_500);
    team.people[0] = walking(team.people[0], 140, 0);
    team.pass(10_000);
    assert!(!team.is_idle());
    team.people[0] = walking(team.people[0], 0, 140);
    team.pass_until("idle", Team::is_idle);
    assert_eq!(team.alone, 0);
}

/// Hazards D and E, on the road.
#[test]
fn nobody_is_freed_by_what_becomes_of_ids() {
    type Sensor = fn(u32, &[Sighting]) -> Option<Vec<Sighting>>;
    let sensors: [Sensor; 3] = [
        |now, people| {
            let id = Some(now / 800);
            Some(people.iter().map(|it| Sighting { id, ..*it }).collect())
        },
        // Two people whose ids are swapped all the time.
        |now, people| {
            let mut seen = people.to_vec();
            let passer_by = person(1, 400, -200);
            seen.push(passer_by);
            let swapped = now / 100 % 2 == 0;
            for (number, who) in seen.iter_mut().enumerate() {
                who.id = Some(u32::from((number == 0) == swapped));
            }
            Some(seen)
        },
        |_, people| {
            let id = None;
            Some(people.iter().map(|it| Sighting { id, ..*it }).collect())
        },
    ];
    for sensor in sensors {
        let mut team = blocking();
        team.sensor = sensor;
        team.pass_until("go", Team::shows_go);
        walk_across(&mut team);
        team.sensor = |_, people| Some(people.to_vec());
        team.pass_until("idle", Team::is_idle);
        assert_eq!(team.alone, 0);
    }
}

/// Hazard G: a guard drifts, jumps, or does not know any more where it is.
#[test]
fn go_ends_when_a_guard_is_not_at_its_place_any_more() {
    type Case = (&'static str, fn(&mut Body));
    let cases: [Case; 3] = [
        ("drifts", |body| {
            body.at = body.at.plus(Way {
                east_cm: 300,
                north_cm: 0,
            });
        }),
        ("jumps", |body| {
            body.at = body.at.plus(Way {
                east_cm: 3_000,
                north_cm: 0,
            });
        }),
        ("is lost", |body| body.is_lost = true),
    ];
    for (name, disturb) in cases {
        let mut team = blocking();
        team.pass_until("go", Team::shows_go);
        team.pass(1_000);
        assert!(team.shows_go());
        team.robots[1].body.to = None;
        disturb(&mut team.robots[1].body);
        team.pass(100);
        assert!(!team.shows_go(), "it {name}");
        team.pass(1_000);
        assert!(!team.shows_go());
        assert_eq!(
            team.told(1, |it| matches!(it, Event::OutOfPosition(_))),
            1,
            "it {name}"
        );
        team.robots[1].body.is_lost = false;
        team.pass_until("go again", Team::shows_go);
        assert!(team.robots[1].body.at.distance_cm(POST) <= 200);
    }
}

/// A car at 50 km/h.
pub(crate) fn car(east: i32) -> Vehicle {
    Vehicle {
        key: 7,
        station: Some(StationId(7)),
        at: Point::new(east, 200),
        front_cm: 0,
        length_cm: 1_200,
        error_cm: 0,
        velocity: Way {
            east_cm: 1_389,
            north_cm: 0,
        },
        goes_anywhere: false,
    }
}

/// While this robot hears of a car that cannot stop.
fn pass_beside_a_car(team: &mut Team, robot: usize, ms: u32) {
    pass_beside(team, robot, car(-1_900), ms);
}

pub(crate) fn pass_beside(team: &mut Team, robot: usize, vehicle: Vehicle, ms: u32) {
    for _ in 0..ms / 50 {
        team.hear(robot, Input::Vehicle(vehicle, Millis(0)));
        team.pass(50);
    }
}

pub(crate) fn is_on_road(body: &Body) -> bool {
    (0..700).contains(&body.at.north_cm())
}

#[test]
fn a_guard_steps_on_the_lane_when_no_vehicle_comes_that_cannot_stop() {
    let mut team = blocking();
    pass_beside_a_car(&mut team, 1, 10_000);
    let body = &team.robots[1].body;
    assert!(body.waits && !is_on_road(body) && !team.shows_go());
    assert!(body.at.north_cm() >= -200, "it stands at the kerb");
    team.pass_until("go", Team::shows_go);
    assert!(is_on_road(&team.robots[1].body));
    // One on the lane does not stand there on its way because of a vehicle, nor at its place.
    for north in [150, POST.north_cm()] {
        team.robots[1].body.at = Point::new(-200, north);
        pass_beside_a_car(&mut team, 1, 3_000);
        let body = &team.robots[1].body;
        assert!(!body.waits && body.at.distance_cm(POST) <= 200);
    }
}

/// Hazard: the driver could stop when it set out, and does not. Somebody on the road needs it at once.
#[test]
fn a_guard_does_not_step_on_the_other_lane_before_a_car_unless_somebody_is_on_the_road() {
    for is_somebody_there in [false, true] {
        let mut team = team(plan(&[leg(TaskType::BLOCK, Point::new(-200, 600))]), true);
        team.people = vec![person(1, 100, -100)];
        team.pass_until("a maneuver", |it| it.robots[1].body.to.is_some());
        team.robots[1].body.at = Point::new(-200, 100);
        team.pass(TICK);
        if is_somebody_there {
            team.people.push(person(2, 300, 300));
        }
        let vehicle = Vehicle {
            at: Point::new(-3_500, 500),
            ..car(0)
        };
        pass_beside(&mut team, 1, vehicle, 4_000);
        let body = &team.robots[1].body;
        assert_eq!(body.waits, !is_somebody_there);
        assert_eq!(body.at.north_cm() > 320, is_somebody_there, "{:?}", body.at);
    }
}

/// Hazard: the pose of a body fails while it lets a car pass, or while it waits for its person.
#[test]
fn a_body_that_does_not_know_where_it_is_any_more_stays_where_it_was_to_wait() {
    let mut team = blocking();
    pass_beside_a_car(&mut team, 1, 3_000);
    team.robots[1].body.is_lost = true;
    pass_beside_a_car(&mut team, 1, 3_000);
    let body = &team.robots[1].body;
    assert!(body.waits && !is_on_road(body), "{:?}", body.at);
    // It knows it again, over the kerb.
    team.robots[1].body.is_lost = false;
    team.robots[1].body.at = Point::new(-200, 10);
    pass_beside_a_car(&mut team, 1, 1_000);
    assert!(team.robots[1].body.waits);
    team.pass_until("go", Team::shows_go);
}

/// A vehicle hits it whose driver cannot stop even by hard braking, and that helps nobody.
#[test]
fn a_guard_goes_to_somebody_on_the_road_before_a_driver_who_can_stop_by_hard_braking() {
    for (east, is_going) in [(-1_900, false), (-3_800, true)] {
        let mut team = blocking();
        pass_beside(&mut team, 1, car(east), 5_000);
        assert!(team.robots[1].body.waits);
        team.people.push(person(2, 300, 300));
        pass_beside(&mut team, 1, car(east), 4_000);
        assert_eq!(is_on_road(&team.robots[1].body), is_going, "{east}");
    }
}

/// The flank of a vehicle whose front has passed, and a vehicle that stands.
#[test]
fn a_guard_steps_behind_a_vehicle_and_before_one_that_stands() {
    for (east, speed, is_going) in [
        (300, 150, false),
        (300, 0, true),
        (1_200, 150, true),
        (-900, 0, true),
    ] {
        let vehicle = Vehicle {
            velocity: Way {
                east_cm: speed,
                north_cm: 0,
            },
            ..car(east)
        };
        let mut team = blocking();
        pass_beside(&mut team, 1, vehicle, 8_000);
        let body = &team.robots[1].body;
        assert_eq!(is_on_road(body), is_going, "{east} at {speed} cm/s");
    }
}

/// Hazard: a car that backs, or does not say its direction, is between the crossing and the place of a guard, and comes to that.
#[test]
fn a_guard_waits_for_a_vehicle_that_may_go_anywhere() {
    for (goes_anywhere, east, waits) in [
        (false, -1_500, false),
        (true, -1_500, true),
        (true, 300, false),
    ] {
        let mut team = team(plan(&[leg(TaskType::BLOCK, Point::new(-2_900, 200))]), true);
        team.robots[1].body.at = Point::new(-2_900, -200);
        team.people = vec![person(1, 100, -100)];
        let vehicle = Vehicle {
            goes_anywhere,
            velocity: Way {
                east_cm: 800,
                north_cm: 0,
            },
            ..car(east)
        };
        pass_beside(&mut team, 1, vehicle, 6_000);
        let body = &team.robots[1].body;
        assert_eq!(body.waits, waits, "{:?}", body.at);
        assert_eq!(is_on_road(body), !waits, "{:?}", body.at);
    }
}

#[test]
fn a_leader_waits_at_the_kerb_on_its_way_to_the_place_of_its_plan() {
    let own_place = Some(Point::new(200, 200));
    let plan = plan(&[leg(TaskType::BLOCK, POST)]);
    let mut team = team(Plan { own_place, ..plan }, true);
    team.robots[0].setup.home = Some(team.robots[0].body.at);
    team.people = vec![person(1, 100, -100)];
    pass_beside_a_car(&mut team, 0, 6_000);
    let body = &team.robots[0].body;
    assert!(body.waits && !is_on_road(body));
    team.pass_until("go", Team::shows_go);
    assert!(is_on_road(&team.robots[0].body));
    walk_across(&mut team);
    team.pass_until("idle", Team::is_idle);
    team.pass(5_000);
    assert!(!is_on_road(&team.robots[0].body));
}

#[test]
fn a_robot_without_a_part_leaves_the_road_unless_somebody_is_on_it() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    walk_across(&mut team);
    let is_released = |team: &Team| team.is_idle() && is_on_road(&team.robots[1].body);
    team.pass_until("idle", is_released);
    team.robots[0].setup.calls = false;
    team.people.push(person(2, 300, 300));
    team.pass(500);
    let home = Point::new(-100, -150);
    team.robots[1].setup.home = Some(home);
    team.pass(5_000);
    assert_eq!(team.robots[1].body.at, POST, "somebody is on the road");
    team.people.clear();
    // On its way it does not step on the other lane before a car, and does not stand on its own lane before one.
    for (lane, is_held) in [(0, true), (200, false)] {
        let vehicle = Vehicle {
            at: Point::new(-1_900, lane),
            ..car(0)
        };
        pass_beside(&mut team, 1, vehicle, 6_000);
        let body = &team.robots[1].body;
        let is_on_lane = body.at.north_cm() > 150;
        assert_eq!((body.waits, is_on_lane), (is_held, is_held), "{lane}");
    }
    team.pass(12_000);
    assert_eq!(team.robots[1].body.at, home);
}

/// Hazard: the sensor of the leader stalls while somebody is on the road. A guard without sensors stands on the lane for ever, and
/// an escort waits in the middle of each later crossing.
#[test]
fn a_robot_without_sensors_leaves_the_road_when_nobody_reports_the_person_any_more() {
    let mut team = blocking();
    team.robots[1].sees = false;
    team.pass_until("go", Team::shows_go);
    team.hear(1, Input::Heard(WITNESS, person(2, 300, 300), Millis(0)));
    walk_across(&mut team);
    let is_released = |team: &Team| team.is_idle() && is_on_road(&team.robots[1].body);
    team.pass_until("idle", is_released);
    team.robots[0].setup.calls = false;
    let home = Point::new(-100, -150);
    team.robots[1].setup.home = Some(home);
    team.pass(10_000);
    assert_eq!(team.robots[1].body.at, home);
}

/// Hazard I: a car at 50 km/h, 16 m away.
#[test]
fn go_does_not_begin_in_front_of_a_car_and_ends_before_one() {
    let mut team = blocking();
    for _ in 0..200 {
        team.hear(0, Input::Vehicle(car(-1_900), Millis(0)));
        team.pass(50);
        assert!(!team.shows_go());
    }
    team.pass_until("go", Team::shows_go);
    team.hear(0, Input::Vehicle(car(-1_900), Millis(0)));
    assert!(!team.shows_go());
    team.pass(50);
    assert_eq!(team.told(0, |it| *it == Event::CloseCorridor), 1, "once");
}

/// A vehicle that could stop is asked for as long as it does not answer, and go begins once it has.
#[test]
fn go_begins_once_a_car_has_said_that_it_will_stop() {
    let mut team = blocking();
    team.robots[0].setup.traffic.asks = Millis(10_000);
    let asked = |team: &Team| {
        let out = team.robots[0].log.iter();
        out.filter(|it| matches!(it, Output::Ask(StationId(7), _)))
            .count()
    };
    pass_beside(&mut team, 0, car(-9_000), 10_000);
    assert!(!team.shows_go());
    let why = Output::Hindered(Hindrance::NoPromise(StationId(7)));
    assert!(
        team.first(0, |it| *it == why).is_some(),
        "nobody is told why"
    );
    let count = asked(&team);
    assert!((5..=20).contains(&count), "{count}");
    team.hear(0, Input::Answered(StationId(7), true));
    pass_beside(&mut team, 0, car(-9_000), 1_000);
    assert!(team.shows_go());
    assert!(asked(&team) <= count + 1);
    // Another one does not end go for people who have set out, as long as it can stop.
    let other = Vehicle {
        key: 8,
        station: Some(StationId(8)),
        ..car(-9_000)
    };
    team.hear(0, Input::Vehicle(other, Millis(0)));
    team.pass(50);
    assert!(team.shows_go());
}

/// Hazard J: the follower falls back for lack of contact, and is commanded again.
#[test]
fn a_guard_that_fell_back_is_resumed() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.robots[0].hangs_until = team.now + 2_500;
    team.pass(2_400);
    assert!(team.robots[1].body.holds);
    team.pass_until("go again", Team::shows_go);
    let Phase::Following(following) = team.robots[1].robot.phase() else {
        panic!("no follower");
    };
    assert!(following.executing().is_some());
    assert_eq!(team.robots[1].robot.duty(), None);
    assert_eq!(
        team.first(1, |it| *it == Output::Release),
        None,
        "it holds on"
    );
    walk_across(&mut team);
    team.pass_until("idle", Team::is_idle);
    assert_eq!(team.alone, 0);
}

/// A guard with sensors stays, though the leader has lost sight of everybody and says that the task is done.
#[test]
fn a_guard_that_sees_somebody_holds_whatever_its_leader_says() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.people[0] = walking(team.people[0], 0, 140);
    team.pass(2_000);
    team.people[0] = walking(team.people[0], 0, 0);
    team.event(0, Event::TaskCompleted);
    team.pass(20_000);
    assert!(team.robots[1].body.holds);
    team.people[0] = walking(team.people[0], 0, 140);
    team.pass_until("idle", Team::is_idle);
    assert!(team.people[0].at.north_cm() > 700);
    assert_eq!(team.alone, 0);
}

/// Hazard: the sensors miss a person on the crossing. A road-side unit reports that person as an object without a class, and the guards
/// leave. An operator frees them if the object is a box.
#[test]
fn something_without_a_class_on_the_crossing_keeps_guards_until_it_is_gone_or_a_person_has_looked()
{
    for is_box in [false, true] {
        let mut team = blocking();
        let report = |team: &mut Team, ms: u32| {
            for _ in 0..ms / 1_000 {
                team.pass(1_000);
                for robot in 0..2 {
                    team.hear(robot, Input::Object(Point::new(100, 300)));
                }
            }
        };
        team.pass_until("go", Team::shows_go);
        walk_across(&mut team);
        team.robots[0].setup.calls = false;
        report(&mut team, 30_000);
        assert!(is_on_road(&team.robots[1].body) && !team.is_idle());
        let why = Output::Hindered(Hindrance::Object);
        assert!(team.first(0, |it| *it == why).is_some());
        for _ in 0..4 {
            if is_box {
                team.hear(0, Input::SaidClear);
                team.hear(1, Input::SaidClear);
                report(&mut team, 20_000);
            }
        }
        if !is_box {
            team.pass(10_000);
        }
        assert!(team.is_idle(), "is box: {is_box}");
    }
}

/// Hazard: an escort goes to the person who waits, whose place nobody knows, and says that it is there. Go is shown, and they step on
/// the road without it.
#[test]
fn go_is_not_shown_because_an_escort_says_that_it_is_there() {
    for is_lost in [false, true] {
        let to = [Point::new(100, -100), Point::new(100, 800)];
        let [begins, ends] = to;
        let legs = [
            leg(TaskType::INITIAL_POS, begins),
            leg(TaskType::MOVE, ends),
        ];
        let mut team = team(plan(&legs), true);
        team.people = vec![person(1, 100, -100)];
        team.robots[1].body.is_lost = is_lost;
        let mut has_shown_go = false;
        for _ in 0..400 {
            team.pass(TICK);
            has_shown_go |= team.shows_go();
        }
        assert_eq!(has_shown_go, !is_lost);
    }
}

/// A sensor that fails: no go, and the guards stay.
#[test]
fn a_blind_leader_closes_the_sign_and_keeps_its_guards() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.people[0] = walking(team.people[0], 0, 70);
    team.pass(500);
    team.sensor = |_, _| None;
    team.pass(600);
    assert!(!team.shows_go());
    team.pass(20_000);
    assert!(!team.is_idle());
    team.sensor = |_, people| Some(people.to_vec());
    team.pass_until("idle", Team::is_idle);
    assert_eq!(team.alone, 0);
}

/// The last person goes out of sight while go is shown, and it ends. A person who saw it steps on the road two seconds later.
#[test]
fn somebody_who_saw_go_and_steps_off_the_kerb_late_has_guards() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.people.clear();
    team.pass_until("stop", |it| !it.shows_go());
    team.pass(1_900);
    team.people = vec![person(1, 100, 50)];
    team.pass(20_000);
    assert!(!team.is_idle());
    team.people.clear();
    team.pass_until("idle", Team::is_idle);
    assert_eq!(team.alone, 0);
}

/// A leader that waits for a person, and no helper, or one.
pub(crate) fn alone(helpers: usize) -> Team {
    let mut it = team(plan(&[leg(TaskType::BLOCK, POST)]), true);
    it.robots.truncate(1 + helpers);
    it
}

pub(crate) fn calls(team: &Team) -> usize {
    team.told(0, |it| matches!(it, Event::PedestrianDetected(_)))
}

/// A follower whose leader fell silent while it did this: its session is over.
pub(crate) fn left_alone(task: TaskType, sees: bool) -> Team {
    let mut team = team(plan(&[leg(task, Point::new(100, 800))]), sees);
    team.people = vec![person(1, 100, -100)];
    team.pass_until("a maneuver", |it| it.robots[1].body.to.is_some());
    team.people.clear();
    team.robots[0].hangs_until = u32::MAX;
    if !sees {
        team.sensor = |_, _| None;
    }
    team
}

/// Until the follower has a duty, and no sign shows go any more that counts on it.
fn begin_duty(team: &mut Team) {
    team.pass_until("a duty", |it| it.robots[1].robot.duty().is_some());
    team.pass(team.robots[1].setup.t_safety.0);
}

/// Hazard: a guard is taken out of its session, and a person says at once that the road is clear, which it is. Its leader has not heard
/// that and shows go, and somebody steps on the road.
#[test]
fn a_word_frees_no_guard_while_another_robots_sign_may_show_go() {
    let mut team = team(plan(&[leg(TaskType::BLOCK, POST)]), false);
    team.people = vec![person(1, 100, -100)];
    team.pass_until("go", Team::shows_go);
    team.robots[0].hangs_until = u32::MAX;
    team.event(1, Event::LeaveRequested);
    for _ in 0..3 {
        team.hear(1, Input::SaidClear);
        team.pass(TICK);
    }
    assert!(team.shows_go());
    team.people[0] = walking(person(1, 100, 0), 0, 140);
    team.pass(6_000);
    assert_eq!(team.alone, 0);
    assert!(team.people[0].at.north_cm() > 700);
    assert!(team.first(1, |it| *it == Output::SaidTooEarly).is_some());
    team.hear(1, Input::SaidClear);
    team.pass(TICK);
    assert_eq!(team.robots[1].robot.duty(), None);
}

#[test]
fn a_guard_that_knows_nothing_of_the_road_waits_for_a_person() {
    for task in [TaskType::BLOCK, TaskType::MOVE] {
        let mut team = left_alone(task, false);
        team.pass(60_000);
        assert!(team.robots[1].robot.duty().is_some());
        assert!(team.robots[1].crossing.waits_for_clear());
        // The word waits for the body.
        team.hear(1, Input::BodyIsFree(false));
        team.hear(1, Input::SaidClear);
        team.pass(1_000);
        assert!(team.robots[1].robot.duty().is_some());
        team.hear(1, Input::BodyIsFree(true));
        team.pass(100);
        assert_eq!(team.robots[1].robot.duty(), None);
        assert!(!team.robots[1].crossing.waits_for_clear());
    }
}

/// A person says that the road is clear, and the guard sees somebody step on it, or hears of that, before its body is free.
#[test]
fn a_word_that_somebody_is_seen_after_frees_no_guard() {
    for (sees, has_class) in [(true, true), (false, true), (false, false)] {
        let mut team = left_alone(TaskType::BLOCK, sees);
        begin_duty(&mut team);
        team.hear(1, Input::BodyIsFree(false));
        team.hear(1, Input::SaidClear);
        let who = person(1, 100, 300);
        team.people = vec![who];
        team.hear(
            1,
            if has_class {
                Input::Heard(WITNESS, who, Millis(0))
            } else {
                Input::Object(who.at)
            },
        );
        team.pass(1_000);
        team.hear(1, Input::BodyIsFree(true));
        team.pass(30_000);
        let duty = team.robots[1].robot.duty();
        assert!(duty.is_some(), "sees: {sees}, {has_class}");
    }
}

/// Hazard: the body takes longer to fall back than the road stays as a person saw it. Somebody has come since, and the guard leaves.
#[test]
fn a_word_that_the_road_is_clear_is_about_the_road_as_it_was() {
    for (ms, is_free) in [(9_000, true), (11_000, false)] {
        let mut team = left_alone(TaskType::BLOCK, false);
        begin_duty(&mut team);
        team.hear(1, Input::BodyIsFree(false));
        team.hear(1, Input::SaidClear);
        team.pass(ms);
        team.hear(1, Input::BodyIsFree(true));
        team.pass(500);
        assert_eq!(team.robots[1].robot.duty().is_none(), is_free, "{ms}");
        team.hear(1, Input::SaidClear);
        team.pass(500);
        assert_eq!(team.robots[1].robot.duty(), None, "{ms}");
    }
}

#[test]
fn a_robot_that_guarded_nobody_is_free_when_its_body_is() {
    let mut team = left_alone(TaskType::INITIAL_POS, false);
    team.pass(12_000);
    assert_eq!(team.robots[1].robot.duty(), None);
}

/// The sign of its leader may show go for `t_safety` yet, and people step off the kerb after it: what it sees before counts for
/// nothing.
#[test]
fn a_guard_with_sensors_is_free_once_they_have_had_nobody_on_the_road() {
    let mut team = left_alone(TaskType::BLOCK, true);
    team.pass_until("a duty", |it| it.robots[1].robot.duty().is_some());
    let setup = &team.robots[1].setup;
    let not_before = setup.t_safety.0 + setup.waiting.step_off.0;
    team.pass(not_before + 300);
    assert!(team.robots[1].robot.duty().is_some());
    team.pass(600);
    assert_eq!(team.robots[1].robot.duty(), None);
    let mut team = left_alone(TaskType::BLOCK, true);
    team.people = vec![person(1, 100, 300)];
    team.pass(30_000);
    assert!(team.robots[1].robot.duty().is_some());
    team.people[0] = walking(team.people[0], 0, 200);
    team.pass(4_000);
    assert_eq!(team.robots[1].robot.duty(), None);
}
