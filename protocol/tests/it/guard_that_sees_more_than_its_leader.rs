//! Hazard: a leader that has lost sight of somebody ends the session as completed, and a guard leaves that sees this person on
//! the road. A follower that sees somebody holds whatever its leader says, until it says itself that the road is clear.

use crossguard_protocol::*;

use crate::script::*;

/// `GO2` guards for `ARI` with `task`, and somebody is on the road.
fn crossing(task: TaskType) -> (Street, Maneuver) {
    let street = Street::open(&[ARI, GO2], task);
    let maneuver = street.executes(GO2);
    (street, maneuver)
}

#[test]
fn a_guard_that_sees_somebody_holds_after_a_completed_session() {
    for (task, policy) in [
        (TaskType::BLOCK, FallbackPolicy::HoldUntilClear),
        (TaskType::MOVE, FallbackPolicy::EscortToKerb),
    ] {
        let (mut street, maneuver) = crossing(task);
        assert_eq!(street.tell(GO2, Event::PersonOnRoad).ignored(), None);
        let again = street.tell(GO2, Event::PersonOnRoad);
        assert_ignored(&again, Ignored::NothingNew);
        street.tell(ARI, Event::TaskCompleted);
        assert!(street.has_put_out(GO2, Output::FallBack(maneuver, policy)));
        assert_eq!(street.count(GO2, stops), 0);
        assert_eq!(street[GO2].duty(), Some(Duty::FallingBack(maneuver)));
        assert!(street[GO2].ram().on_duty);
        street.tell(GO2, Event::RoadClear);
        assert_eq!(street[GO2].duty(), None);
    }
}

#[test]
fn a_guard_that_sees_nobody_any_more_is_free() {
    let (mut street, maneuver) = crossing(TaskType::BLOCK);
    street.tell(GO2, Event::PersonOnRoad);
    assert_eq!(street.tell(GO2, Event::RoadClear).ignored(), None);
    let again = street.tell(GO2, Event::RoadClear);
    assert_ignored(&again, Ignored::NothingNew);
    street.tell(ARI, Event::TaskCompleted);
    let stop = StopReason::Released(ReleaseReason::TaskCompleted);
    assert!(street.has_put_out(GO2, Output::StopManeuver(maneuver, stop)));
    assert_eq!(street[GO2].duty(), None);
}

#[test]
fn what_it_sees_outlasts_a_task_that_is_resumed() {
    let (mut street, _) = crossing(TaskType::BLOCK);
    street.tell(GO2, Event::PersonOnRoad);
    street.part(ARI, GO2);
    street.pass(2_500);
    street.heal();
    street.pass(200);
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    let maneuver = street.executes(GO2);
    street.tell(ARI, Event::TaskCompleted);
    assert_eq!(street[GO2].duty(), Some(Duty::FallingBack(maneuver)));
}

#[test]
fn only_a_follower_sees_for_itself() {
    let (mut street, _) = crossing(TaskType::BLOCK);
    let leader = street.tell(ARI, Event::PersonOnRoad);
    assert_ignored(&leader, Ignored::NotExecuting);
}
