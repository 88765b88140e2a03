//! Hazard: after a safety timeout every reissue is rejected, also by the same leader for the same task, and the crossing never
//! ends. The leader for which a robot fell back may command the same task again: that is no new duty.

use crossguard_protocol::*;

use crate::script::*;

/// `GO2` guards for `ARI` with `task`, with people on the road, and has fallen back from it. Contact is back.
fn fallen_back(task: TaskType) -> Street {
    let mut street = Street::open(&[ARI, GO2], task);
    street.part(ARI, GO2);
    street.pass(2_500);
    street.heal();
    street.pass(200);
    assert_eq!(street.corridor(ARI), Corridor::Clearing);
    assert!(matches!(street[GO2].duty(), Some(Duty::FallingBack(_))));
    street.forget();
    street
}

#[test]
fn the_same_leader_resumes_the_same_task_while_people_are_on_the_road() {
    for task in [TaskType::BLOCK, TaskType::MOVE] {
        let mut street = fallen_back(task);
        let again = street.tell(ARI, order(GO2, task));
        assert_eq!(again.ignored(), None);
        let id = street.maneuver(ARI, 1);
        assert_eq!(street.executes(GO2), Maneuver { id, task });
        assert_eq!(
            (street[GO2].duty(), street[GO2].ram().on_duty),
            (None, false)
        );
        if task == TaskType::BLOCK {
            street.in_position(GO2);
        }
        assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
    }
}

#[test]
fn every_other_task_is_rejected_while_the_duty_stands() {
    let mut street = fallen_back(TaskType::BLOCK);
    let duty = street[GO2].duty();
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let rejected = Notice::CommandRejected(GO2, street.maneuver(ARI, 1), Rejection::OnDuty);
    assert!(street.was_told(ARI, rejected));
    assert_eq!((street[GO2].duty(), street.count(GO2, starts)), (duty, 0));
}

#[test]
fn no_other_session_takes_the_duty_over() {
    let mut street = fallen_back(TaskType::BLOCK);
    street.tell(ARI, Event::LeaveRequested);
    street.tell(ARI, Event::RoadClear);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    street.pass(1_000);
    assert_eq!(street[GO2].role(), Role::None, "it offers to nobody");
}

#[test]
fn a_resumed_task_that_falls_back_again_is_not_started_by_a_repeated_command() {
    let mut street = fallen_back(TaskType::BLOCK);
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    let maneuver = street.executes(GO2);
    street.part(ARI, GO2);
    street.pass(2_000);
    street.forget();
    let command = Command {
        session: maneuver.id.session,
        to: GO2,
        request: maneuver.id.request,
        task: maneuver.task,
    };
    street.hears_rmcm(GO2, Rmcm::Command(command));
    assert_eq!(street.count(GO2, starts), 0);
    assert_eq!(street[GO2].duty(), Some(Duty::FallingBack(maneuver)));
}

#[test]
fn a_fallback_that_follows_the_leaders_own_limit_can_be_resumed_as_well() {
    let settings = Settings {
        t_exec: [Millis(20_000); TaskType::COUNT],
        t_cross: Millis(10_000),
        ..Settings::default()
    };
    let mut street = Street::with_roles_and_settings(&[ARI, GO2], settings);
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    street.in_position(GO2);
    assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
    street.pass(20_000);
    let again = street.tell(ARI, order(GO2, TaskType::BLOCK));
    assert_ignored(&again, Ignored::RoadOccupied);
    let first = street.maneuver(ARI, 0);
    street.part(ARI, GO2);
    street.pass(2_500);
    street.heal();
    street.pass(200);
    assert!(street.was_told(ARI, Notice::FollowerSafeIdle(GO2, first)));
    assert_eq!(
        street.tell(ARI, order(GO2, TaskType::BLOCK)).ignored(),
        None
    );
    assert_eq!(street.executes(GO2).id, street.maneuver(ARI, 1));
}
