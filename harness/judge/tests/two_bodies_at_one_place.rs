//! A leader that sends two bodies to one place is found in its log, although no rule of the protocol is broken.

use crossguard_judge::sim::{Swarm, run};
use crossguard_judge::validate::{self, Fault};
use crossguard_protocol::TaskType;
use crossguard_robot::plan::{Leg, Stage, Who};
use crossguard_robot::site::Place;
use crossguard_robot::trace::{self, Record};

/// A leader and two followers on an undisturbed network. Each stage has a place for either follower.
fn log(stages: &[(TaskType, [Place; 2])]) -> Vec<u8> {
    let mut swarm = Swarm::quiet(3);
    for robot in &mut swarm.robots {
        robot.plan.followers = 2;
        robot.plan.roles = vec![None, None];
        let stage = |(task, [first, second]): &(TaskType, [Place; 2])| Stage {
            parts: vec![
                (Who::Role(0), Leg::new(*task, *first)),
                (Who::Role(1), Leg::new(*task, *second)),
            ],
        };
        robot.plan.stages = stages.iter().map(stage).collect();
    }
    let mut log = Vec::new();
    let mut watch = |record: Record| trace::write(&mut log, &record).unwrap();
    let outcome = run(&swarm, Some(&mut watch));
    assert!(outcome.finding.is_none(), "{:?}", outcome.finding);
    log
}

fn refused(log: &[u8]) -> Option<Fault> {
    validate::one(log).err().map(|invalid| *invalid.fault)
}

const NEAR: [Place; 2] = [Place::new(0.0, -1.0), Place::new(2.0, -1.0)];
const FAR: [Place; 2] = [Place::new(0.0, 8.0), Place::new(2.0, 8.0)];

#[test]
fn places_a_metre_apart_are_valid() {
    let close = [FAR[0], Place::new(1.0, 8.0)];
    let log = log(&[(TaskType::INITIAL_POS, NEAR), (TaskType::MOVE, close)]);
    let validated = validate::one(&*log).unwrap();
    assert!(validated.sent > 20, "{validated:?}");
    let text = String::from_utf8(log).unwrap();
    let accepted = text.matches("\"accepted\"").count();
    assert!(
        accepted >= 4,
        "{accepted} answers: nobody was sent anywhere"
    );
}

#[test]
fn one_place_for_two_is_not() {
    for place in [FAR[0], Place::new(0.5, 8.0)] {
        let log = log(&[
            (TaskType::INITIAL_POS, NEAR),
            (TaskType::MOVE, [FAR[0], place]),
        ]);
        let fault = refused(&log);
        let Some(Fault::SamePlace { metres, .. }) = fault else {
            panic!("{fault:?}")
        };
        assert!((metres - place.distance(FAR[0])).abs() < 0.1, "{metres}");
    }
}
