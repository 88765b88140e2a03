//! A leader's plan and its corridor: when go is shown and ends, and who is commanded.

use std::iter::once;

use crossguard_crossing::*;
use crossguard_protocol::{Event, Millis, Phase, StationId, TaskType};

use crate::scene::*;
use crate::team::*;
use crate::whole::*;

/// The sign ends go by itself when its robot's process hangs.
#[test]
fn go_is_shown_for_no_longer_than_the_guards_are_known_to_be_there() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.pass(2_000);
    let left = |output: &Output| match output {
        Output::Go(left) => Some(*left),
        _ => None,
    };
    let longest = team.robots[0].log.iter().filter_map(left).max();
    assert!(longest <= Some(team.robots[0].setup.position.lease));
}

/// The leader knows it by a RAM before the guard says so.
#[test]
fn go_ends_at_once_when_a_guard_is_heard_elsewhere() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    let (at, error_cm) = (Point::new(-200, 500), 0);
    let pose = Some(Pose { at, error_cm });
    team.hear(0, Input::FollowerAt(StationId(2), pose, Millis(0)));
    assert!(!team.shows_go());
    let why = Output::Hindered(Hindrance::GuardElsewhere(StationId(2)));
    assert!(team.first(0, |it| *it == why).is_some());
}

/// Another application calls for people that the leader cannot see.
#[test]
fn a_leader_that_does_not_know_who_waits_shows_go() {
    for (sees, has_zone) in [(false, true), (true, false)] {
        let mut team = blocking();
        let leader = &mut team.robots[0];
        (leader.sees, leader.setup.watches, leader.setup.calls) = (sees, sees, false);
        if !has_zone {
            leader.setup.ground.waiting = None;
        }
        let request = leader.setup.request;
        team.people.clear();
        team.event(0, Event::PedestrianDetected(request));
        team.pass_until("go", Team::shows_go);
    }
}

#[test]
fn a_session_is_left_that_nobody_wants_any_more_unless_guards_are_on_their_way_to_the_road() {
    for (stage, left) in [(TaskType::INITIAL_POS, true), (TaskType::BLOCK, false)] {
        let stages = [
            leg(TaskType::INITIAL_POS, Point::new(-1_500, -150)),
            leg(TaskType::BLOCK, Point::new(-1_900, 200)),
        ];
        let mut team = team(plan(&stages), true);
        team.people = vec![person(1, 100, -100)];
        let orders = |output: &Output| matches!(output, Output::Order(_, leg) if leg.task == stage);
        team.pass_until("an order", |it| it.first(0, orders).is_some());
        team.people.clear();
        team.pass(5_000);
        let told = team.told(0, |it| *it == Event::LeaveRequested);
        assert_eq!(told > 0, left, "{stage:?}");
        team.pass_until("idle", Team::is_idle);
        assert_eq!(team.first(0, |it| matches!(it, Output::Go(_))), None);
    }
}

/// A plan without guards lets no person on the road.
#[test]
fn a_plan_that_lets_nobody_cross_is_over_when_it_is_done() {
    let stage = leg(TaskType::INITIAL_POS, Point::new(-200, -150));
    let mut team = team(plan(&[stage]), true);
    team.people = vec![person(1, 100, -100)];
    team.pass(6_000);
    assert!(team.told(0, |it| *it == Event::TaskCompleted) > 0);
    assert!(!team.shows_go());
}

/// The road runs from the north-west to the south-east.
#[test]
fn followers_with_the_same_part_stand_along_the_road_and_begin_at_the_nearer_kerb() {
    let kerbs = [Point::new(0, 0), Point::new(300, 400)];
    let plan = Plan {
        kerbs: Some(kerbs),
        ..plan(&[leg(TaskType::BLOCK, kerbs[0])])
    };
    for (seat, expected) in [
        (0, (0, 0)),
        (1, (120, -90)),
        (2, (-120, 90)),
        (3, (240, -180)),
    ] {
        let leg = plan.leg(0, seat, false).unwrap();
        assert_eq!(leg.to, Point::new(expected.0, expected.1), "seat {seat}");
    }
    for (people, expected) in [((150, 199), false), ((150, 200), false), ((150, 201), true)] {
        let people = Point::new(people.0, people.1);
        assert_eq!(plan.begins_over_there(people), expected, "{people:?}");
    }
}

/// A vehicle keeps go from beginning as the guard arrives, so it begins by the clock.
#[test]
fn go_is_shown_to_somebody_who_stands_on_the_road() {
    let mut team = blocking();
    team.people[0] = person(1, 100, 300);
    pass_beside(&mut team, 0, car(-1_900), 10_000);
    assert!(!team.shows_go());
    team.pass_until("go", Team::shows_go);
}

/// The guard's position is at its place, and the guard says that it does not guard.
#[test]
fn a_guard_that_says_it_has_left_its_place_is_commanded_back() {
    let mut team = blocking();
    team.robots[0].setup.traffic.asks = Millis(20_000);
    let orders = |team: &Team| {
        let log = team.robots[0].log.iter();
        log.filter(|it| matches!(it, Output::Order(..))).count()
    };
    pass_beside(&mut team, 0, car(-9_000), 15_000);
    let hindered = |team: &Team| team.robots[0].crossing.hindered(&team.robots[0].setup);
    assert_eq!(hindered(&team), Some(Hindrance::NoPromise(StationId(7))));
    assert_eq!(orders(&team), 1);
    let Phase::Following(following) = team.robots[1].robot.phase() else {
        panic!("no follower");
    };
    let id = following.executing().unwrap().id;
    team.event(1, Event::OutOfPosition(id));
    assert_eq!(
        hindered(&team),
        Some(Hindrance::GuardElsewhere(StationId(2)))
    );
    team.tick();
    assert_eq!(orders(&team), 2);
}

/// One follower blocks from the first stage on, the other one escorts in the second.
#[test]
fn a_guard_without_a_part_in_a_stage_goes_on_with_its_last_one() {
    let stage = |role, leg| Stage {
        parts: once((Who::Role(role), leg)).collect(),
    };
    let stages = [
        stage(0, leg(TaskType::BLOCK, POST)),
        stage(1, leg(TaskType::MOVE, Point::new(100, 800))),
    ];
    let plan = Plan {
        followers: 2,
        stages: stages.into_iter().collect(),
        roles: [None, None].into_iter().collect(),
        ..plan(&[])
    };
    let team = team(plan, true);
    let setups = [0, 1, 1].map(|robot| team.robots[robot].setup.clone());
    let mut team = Team::new(setups.to_vec());
    team.robots[0].setup.request.followers = 2;
    team.people = vec![person(1, 100, -100)];
    team.pass_until("go", Team::shows_go);
    walk_across(&mut team);
    team.pass_until("idle", Team::is_idle);
    assert_eq!(team.alone, 0);
}

/// An operator asked for one follower, and the plan has two.
#[test]
fn go_is_not_shown_with_fewer_guards_than_the_plan_has() {
    let mut team = blocking();
    let plan = team.robots[0].setup.plan.as_mut().unwrap();
    plan.followers = 2;
    team.pass(20_000);
    assert_eq!(team.first(0, |it| matches!(it, Output::Go(_))), None);
    let leader = &team.robots[0];
    let why = leader.crossing.hindered(&leader.setup);
    assert_eq!(why, Some(Hindrance::GuardMissing));
}

/// The limit of its maneuver is a minute.
#[test]
fn a_guard_whose_time_ran_out_beside_people_is_commanded_back_once_the_road_is_clear() {
    let mut team = blocking();
    team.robots[0].setup.plan.as_mut().unwrap().patience = Millis(200_000);
    team.pass_until("go", Team::shows_go);
    team.people[0] = walking(team.people[0], 0, 100);
    team.pass(3_000);
    team.people[0] = walking(team.people[0], 0, 0);
    team.pass(60_000);
    assert!(!team.is_idle());
    let orders = team.robots[0].log.len();
    team.people[0] = walking(team.people[0], 0, 100);
    team.pass_until("idle", Team::is_idle);
    let later = &team.robots[0].log[orders..];
    assert!(later.iter().any(|it| matches!(it, Output::Order(..))));
    assert_eq!(team.told(0, |it| *it == Event::LeaveRequested), 0);
    assert_eq!(team.alone, 0);
}

/// A session that is left has guards without sensors stand on the lane until somebody says that the road is clear.
#[test]
fn a_leader_that_gives_up_before_an_empty_road_completes_the_task() {
    for sees in [true, false] {
        let mut team = blocking();
        team.robots[0].setup.plan.as_mut().unwrap().patience = Millis(9_000);
        team.pass(4_000);
        if !sees {
            team.sensor = |_, _| None;
        }
        pass_beside(&mut team, 0, car(-1_900), 10_000);
        let told = |event| team.told(0, |it| *it == event) > 0;
        assert_eq!(told(Event::TaskCompleted), sees);
        assert_eq!(told(Event::LeaveRequested), !sees);
    }
}
