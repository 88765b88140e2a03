//! Fallback: a follower without contact stops by its task's policy, says so, and leaves in the end.

use crossguard_protocol::*;

use crate::script::*;

fn alone(task: TaskType) -> Street {
    let mut street = Street::executing(task);
    street.part(ARI, GO2);
    street
}

#[test]
fn the_follower_falls_back_after_t_safety_by_the_policy_of_its_task() {
    for (task, policy) in [
        (TaskType::INITIAL_POS, FallbackPolicy::StopInPlace),
        (TaskType::MOVE, FallbackPolicy::EscortToKerb),
        (TaskType::BLOCK, FallbackPolicy::HoldUntilClear),
    ] {
        let mut street = alone(task);
        let maneuver = street.executes(GO2);
        street.pass(1_999);
        assert_eq!(street[GO2].state(), State::ManeuverExecuting);
        street.pass(1);
        assert_eq!(street[GO2].state(), State::RoleEstablished);
        let outputs = street.outputs_of(GO2);
        assert!(outputs.contains(&Output::FallBack(maneuver, policy)));
        assert!(outputs.contains(&Output::SendRam));
        let progress = street.following(GO2).job.unwrap().progress;
        assert_eq!(progress, Progress::SafeIdle);
    }
}

#[test]
fn the_leader_learns_of_the_fallback_and_may_command_again_once_the_road_is_clear() {
    let mut street = alone(TaskType::MOVE);
    let id = street.maneuver(GO2, 0);
    street.pass(2_500);
    street.heal();
    street.pass(200);
    assert!(street.was_told(ARI, Notice::FollowerSafeIdle(GO2, id)));
    assert_eq!(street[ARI].state(), State::RoleEstablished);
    street.tell(ARI, order(GO2, TaskType::INITIAL_POS));
    assert!(street.was_told(
        ARI,
        Notice::CommandRejected(GO2, street.maneuver(ARI, 1), Rejection::OnDuty)
    ));
    assert_eq!(street.following(GO2).executing(), None);
    street.tell(GO2, Event::RoadClear);
    street.tell(ARI, order(GO2, TaskType::INITIAL_POS));
    assert_eq!(street.executes(GO2).id.request, RequestId(2));
}

#[test]
fn a_command_that_was_given_up_by_fallback_is_never_executed_again() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.cut(GO2, ARI);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let session = street.session_of(ARI);
    let (request, task) = (RequestId(0), TaskType::MOVE);
    let command = Rmcm::Command(Command {
        session,
        to: GO2,
        request,
        task,
    });
    street.part(ARI, GO2);
    street.pass(2_000);
    assert_eq!(
        street.following(GO2).job.unwrap().progress,
        Progress::SafeIdle
    );
    // The repeated command is acknowledged, and the RAM says what became of it.
    street.forget();
    street.hears_rmcm(GO2, command);
    assert_eq!(street.count(GO2, sends_rmcm), 1);
    assert_eq!(street.count(GO2, starts), 0);
    assert_eq!(street[GO2].state(), State::RoleEstablished);
    // The acknowledgement counts, the fallback is learnt from the RAM.
    street.heal();
    street.pass(100);
    let id = street.maneuver(ARI, 0);
    assert!(street.was_told(ARI, Notice::FollowerSafeIdle(GO2, id)));
}

#[test]
fn a_follower_without_a_maneuver_loses_contact_quietly() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.part(ARI, GO2);
    street.pass(2_000);
    assert!(street.was_told(GO2, Notice::ContactLost(street.session_of(GO2))));
    assert_eq!(street.count(GO2, |o| matches!(o, Output::FallBack(..))), 0);
    assert_eq!(street.following(GO2).job, None);
}

#[test]
fn what_was_finished_before_contact_was_lost_stays_finished() {
    let mut street = alone(TaskType::MOVE);
    let id = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(id));
    street.pass(2_500);
    street.heal();
    street.pass(200);
    assert!(street.was_told(ARI, Notice::ManeuverCompleted(GO2, id)));
}

#[test]
fn without_contact_the_follower_leaves_after_t_leave() {
    let mut street = alone(TaskType::MOVE);
    let session = street.session_of(GO2);
    street.pass(2_000 + 4_999);
    assert_eq!(street[GO2].role(), Role::Follower);
    street.pass(1);
    assert_eq!(street[GO2].role(), Role::None);
    assert_eq!(street[GO2].farewell(), Some(left(session)));
    assert!(street.was_told(GO2, Notice::Released(session, ReleaseReason::ContactLost)));
}

#[test]
fn when_the_leader_crashes_for_good_every_follower_stops_and_gets_idle_in_time() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    for follower in [GO2, SPOT] {
        street.tell(ARI, order(follower, TaskType::BLOCK));
    }
    street.remove(ARI);
    street.pass(2_000);
    for follower in [GO2, SPOT] {
        assert_eq!(street[follower].state(), State::RoleEstablished);
    }
    street.pass(5_000);
    for follower in [GO2, SPOT] {
        assert_eq!(street[follower].state(), State::Idle);
    }
}

#[test]
fn contact_that_comes_back_before_t_leave_keeps_the_follower() {
    let mut street = alone(TaskType::MOVE);
    street.pass(6_000);
    street.heal();
    street.pass(5_000);
    assert_eq!(street[GO2].role(), Role::Follower);
    assert_eq!(
        street[GO2].state(),
        State::RoleEstablished,
        "but nothing starts by itself"
    );
}
