//! What an application reads off a robot.

use crossguard_protocol::*;

use crate::script::*;

fn following(street: &Street, station: StationId) -> &Following {
    match street[station].phase() {
        Phase::Following(following) => following,
        other => panic!("{other:?}"),
    }
}

fn member(street: &Street, station: StationId) -> &Member {
    match street[ARI].phase() {
        Phase::Leading(leading) => leading.member(station).unwrap(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_boot_counter_is_that_of_its_numbers() {
    let robot = Robot::new(ARI, 7);
    assert_eq!(robot.boot(), 7);
    assert_eq!(robot.next_number(), UniqueNumber { boot: 7, count: 0 });
}

#[test]
fn the_newest_request_is_the_one_that_was_answered_last() {
    let street = Street::with_roles(&[ARI, GO2]);
    assert_eq!(following(&street, GO2).newest_request(), None);
    let mut street = Street::executing(TaskType::INITIAL_POS);
    let job = following(&street, GO2).job.unwrap();
    assert_eq!(following(&street, GO2).newest_request(), Some(job.request));
    street.tell(
        GO2,
        Event::ManeuverCompleted(following(&street, GO2).executing().unwrap().id),
    );
    assert_eq!(following(&street, GO2).newest_request(), Some(job.request));
}

#[test]
fn a_follower_has_completed_its_command_once_it_says_so() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    assert!(!member(&street, GO2).has_completed());
    street = Street::executing(TaskType::INITIAL_POS);
    assert!(!member(&street, GO2).has_completed());
    street.tell(
        GO2,
        Event::ManeuverCompleted(following(&street, GO2).executing().unwrap().id),
    );
    street.pass(street.config.settings().ram_period.0);
    assert!(member(&street, GO2).has_completed());
}

#[test]
fn a_task_is_its_number() {
    assert_eq!(
        [TaskType::INITIAL_POS, TaskType::MOVE].map(u8::from),
        [0, 1]
    );
    assert_eq!(TaskType::try_from(1), Ok(TaskType::MOVE));
    let none = TaskType::try_from(16).unwrap_err();
    assert_eq!(
        none.to_string(),
        "task type 16 does not exist, the largest is 15"
    );
}
