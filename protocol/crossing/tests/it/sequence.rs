//! What a robot keeps of one session in the next, and a person's word against what sensors see.

use crossguard_crossing::*;
use crossguard_protocol::{Availability, Event, Millis, Phase, TaskType, Unavailability};

use crate::scene::*;
use crate::team::*;
use crate::whole::*;

/// Hazard: a person sees somebody on the road whom the guard's own sensors miss, and says so. The sensors take that back at
/// once, and the guard leaves.
#[test]
fn a_persons_word_that_somebody_is_on_the_road_stands_until_a_person_takes_it_back() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.people.clear();
    team.event(1, Event::PersonOnRoad);
    team.pass(30_000);
    assert!(team.robots[1].body.holds, "its leader has seen nobody");
    team.hear(1, Input::SaidClear);
    team.pass_until("idle", Team::is_idle);
    assert!(!team.robots[1].body.holds);
    // The word is for one duty.
    team.people = vec![person(2, 100, -100)];
    team.pass_until("go", Team::shows_go);
    walk_across(&mut team);
    team.pass_until("idle", Team::is_idle);
    assert!(!team.robots[1].body.holds);
}

/// Hazard: the sensors have an adult on the road and miss a child. An operator reports the child, the protocol knows of somebody
/// already and ignores the report, and guard and leader go once the adult is across.
#[test]
fn the_word_stands_also_where_sensors_have_somebody_else() {
    for robot in [0, 1] {
        let mut team = blocking();
        team.pass_until("go", Team::shows_go);
        team.people[0].at = Point::new(100, 200);
        team.pass(1_000);
        team.event(robot, Event::PersonOnRoad);
        team.people.clear();
        team.pass(30_000);
        assert!(!team.is_idle(), "the word of robot {robot}");
        team.hear(robot, Input::SaidClear);
        team.pass_until("idle", Team::is_idle);
    }
}

/// Hazard: an operator closes the corridor before an ambulance that no message tells of, and the leader opens it after 3 s for people
/// who wait.
#[test]
fn a_corridor_that_a_person_has_closed_stays_closed_until_a_person_opens_it() {
    let mut team = blocking();
    team.pass_until("go", Team::shows_go);
    team.event(0, Event::CloseCorridor);
    for _ in 0..200 {
        team.pass(100);
        assert!(!team.shows_go());
    }
    let why = Output::Hindered(Hindrance::KeptClosed);
    assert!(team.robots[0].log.contains(&why));
    team.event(0, Event::OpenCorridor);
    team.pass_until("go", Team::shows_go);
    // The word is for one session.
    team.event(0, Event::CloseCorridor);
    team.event(0, Event::LeaveRequested);
    team.pass_until("go in the next one", Team::shows_go);
}

/// Hazard: the escort walks from the other kerb, because people once came from there.
#[test]
fn a_plan_begins_where_people_are_and_not_where_they_were_in_the_session_before() {
    let kerbs @ [near, far] = [Point::new(100, -100), Point::new(100, 800)];
    let stages = [leg(TaskType::INITIAL_POS, near), leg(TaskType::MOVE, far)];
    let plan = Plan {
        kerbs: Some(kerbs),
        ..plan(&stages)
    };
    let mut team = team(plan, true);
    let request = team.robots[0].setup.request;
    let begins = |team: &Team| {
        let mut legs = team.robots[0].log.iter().rev().filter_map(|it| match it {
            Output::Order(_, leg) if leg.task == TaskType::INITIAL_POS => Some(leg.to),
            _ => None,
        });
        legs.next()
    };
    team.people = vec![person(1, 100, 800)];
    team.pass_until("an order", |it| begins(it).is_some());
    assert_eq!(begins(&team), Some(far));
    team.event(0, Event::LeaveRequested);
    team.people.clear();
    team.pass_until("idle", Team::is_idle);
    team.robots[0].log.clear();
    // An operator calls.
    team.event(0, Event::PedestrianDetected(request));
    team.pass_until("an order", |it| begins(it).is_some());
    assert_eq!(begins(&team), Some(near));
}

/// Hazard: `clear_s = 0`, and each call is taken back at once.
#[test]
fn a_person_who_waits_is_helped_however_soon_the_zone_is_deserted() {
    let mut team = blocking();
    team.robots[0].setup.waiting.clear = Millis::ZERO;
    team.pass_until("go", Team::shows_go);
}

/// Hazard: everybody leaves while a guard without sensors stands on the lane already and the escort is still to be sent. The session
/// is left, and the guard stands there until a person says clear: the next person waits in vain.
#[test]
fn a_guard_on_the_lane_is_free_again_when_nobody_wants_to_cross_any_more() {
    let stage = |role, task, to| Stage {
        parts: core::iter::once((Who::Role(role), leg(task, to))).collect(),
    };
    let kerb = Point::new(100, -100);
    let stages = [
        stage(0, TaskType::BLOCK, POST),
        stage(1, TaskType::INITIAL_POS, kerb),
        stage(1, TaskType::MOVE, Point::new(100, 800)),
    ];
    let plan = Plan {
        followers: 2,
        roles: [None, None].into_iter().collect(),
        stages: stages.into_iter().collect(),
        ..plan(&[])
    };
    for leaves_in in [TaskType::BLOCK, TaskType::INITIAL_POS] {
        let mut one = team(plan.clone(), false);
        let mut setups: Vec<_> = one.robots.drain(..).map(|it| it.setup).collect();
        setups[0].request.followers = 2;
        setups.push(setups[1].clone());
        let mut team = Team::new(setups);
        team.people = vec![person(1, 100, -100)];
        let is_ordered = |it: &Output| matches!(it, Output::Order(_, leg) if leg.task == leaves_in);
        team.pass_until("an order", |it| it.first(0, is_ordered).is_some());
        team.pass(200);
        team.people.clear();
        team.pass_until("idle", Team::is_idle);
        team.people = vec![person(2, 100, -100)];
        team.pass_until("go", Team::shows_go);
    }
}

/// Hazard: a guard whose battery is low has no part any more, and stands on the lane.
#[test]
fn a_robot_that_can_still_walk_leaves_the_road_although_it_helps_nobody() {
    for (why, leaves) in [
        (Unavailability::LowBattery, true),
        (Unavailability::NotSafe, true),
        (Unavailability::Teleoperated, false),
        (Unavailability::EmergencyStop, false),
        (Unavailability::LocalFault, false),
    ] {
        let mut team = blocking();
        team.pass_until("go", Team::shows_go);
        walk_across(&mut team);
        team.pass_until("idle", Team::is_idle);
        team.robots[0].setup.calls = false;
        let unavailable = Availability::Unavailable(why);
        team.event(1, Event::AvailabilityChanged(unavailable));
        let home = Point::new(-100, -150);
        team.robots[1].setup.home = Some(home);
        team.pass(20_000);
        assert!(matches!(team.robots[1].robot.phase(), Phase::Idle));
        assert_eq!(team.robots[1].body.at == home, leaves, "{why:?}");
    }
}
