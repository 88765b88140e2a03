//! Whole crossings: from the person who waits to the robots that are idle again.

use crossguard_crossing::*;
use crossguard_protocol::{Event, HelpRequest, List, Millis, Phase, StationId, TaskSet, TaskType};

use crate::scene::*;
use crate::team::*;

/// Where the blocker stands.
const POST: Point = Point::new(-200, 200);

fn leg(task: TaskType, to: Point) -> Leg {
    Leg {
        task,
        to,
        speed_cmps: 100,
        heading_ddeg: None,
    }
}

fn plan(stages: &[Leg]) -> Plan {
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
fn team(plan: Plan, follower_sees: bool) -> Team {
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

fn blocking() -> Team {
    let mut team = team(plan(&[leg(TaskType::BLOCK, POST)]), true);
    team.people = vec![person(1, 100, -100)];
    team
}

/// The person walks across.
fn walk_across(team: &mut Team) {
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
