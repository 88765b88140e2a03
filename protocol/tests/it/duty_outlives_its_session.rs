//! Hazard: a robot that still holds traffic back, or a leader whose people are still on the road, takes part
//! in something new. A duty lasts until the application says that the road is clear.

use crossguard_protocol::*;

use crate::script::*;

/// `GO2` has fallen back from a block for `ARI`, which is gone, and has no part in a session any more.
fn on_duty() -> Street {
    let mut street = Street::executing(TaskType::BLOCK);
    street.remove(ARI);
    street.pass(9_000);
    assert_eq!(street[GO2].role(), Role::None);
    street.forget();
    street
}

#[test]
fn a_robot_on_duty_offers_to_nobody_and_asks_for_nothing() {
    let mut street = on_duty();
    assert!(street[GO2].ram().on_duty, "its RAM says so");
    let asks = street.hears_ram(GO2, need_help(SPOT, 0, 0, escort(1)));
    assert_ignored(&asks, Ignored::OnDuty);
    let detected = street.tell(GO2, Event::PedestrianDetected(escort(1)));
    assert_ignored(&detected, Ignored::OnDuty);

    let clear = street.tell(GO2, Event::RoadClear);
    assert!(clear.iter().any(sends_ram), "its RAM says so at once");
    assert!(!street[GO2].ram().on_duty);
    street.hears_ram(GO2, need_help(SPOT, 0, 1, escort(1)));
    assert_eq!(street[GO2].role(), Role::Helper);
    let again = street.tell(GO2, Event::RoadClear);
    assert_ignored(&again, Ignored::NothingNew);
}

#[test]
fn time_does_not_end_a_duty() {
    let mut street = on_duty();
    let duty = street[GO2].duty();
    assert!(matches!(duty, Some(Duty::FallingBack(_))));
    street.step(GO2, Input::Elapsed(Millis(86_400_000)));
    assert_eq!(street[GO2].duty(), duty);
}

#[test]
fn a_follower_on_duty_rejects_the_next_command() {
    let mut street = Street::executing(TaskType::BLOCK);
    street.part(ARI, GO2);
    street.pass(2_500);
    street.heal();
    street.pass(200);
    assert_eq!(street[GO2].role(), Role::Follower);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert!(street.was_told(
        ARI,
        Notice::CommandRejected(GO2, street.maneuver(ARI, 1), Rejection::OnDuty)
    ));
    assert_eq!(street.count(GO2, starts), 0);
    street.tell(GO2, Event::RoadClear);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(street.count(GO2, starts), 1);
}

#[test]
fn a_leader_whose_session_ends_under_people_has_a_duty() {
    for close_first in [false, true] {
        let mut street = Street::open(&[ARI, GO2], TaskType::BLOCK);
        let session = street.session_of(ARI);
        if close_first {
            street.tell(ARI, Event::CloseCorridor);
        }
        street.tell(ARI, Event::LeaveRequested);
        assert_eq!(street[ARI].duty(), Some(Duty::Crossing(session)));
        let detected = street.tell(ARI, Event::PedestrianDetected(escort(1)));
        assert_ignored(&detected, Ignored::OnDuty);
        street.tell(ARI, Event::RoadClear);
        let detected = street.tell(ARI, Event::PedestrianDetected(escort(1)));
        assert_eq!(detected.ignored(), None);
    }
}

#[test]
fn a_leader_whose_road_is_clear_has_none() {
    let mut street = Street::open(&[ARI, GO2], TaskType::BLOCK);
    let open = street.tell(ARI, Event::RoadClear);
    assert_eq!(
        open.ignored(),
        Some(Ignored::CorridorOpen),
        "people may step on it"
    );
    street.tell(ARI, Event::CloseCorridor);
    assert_eq!(street.corridor(ARI), Corridor::Clearing);
    street.tell(ARI, Event::RoadClear);
    assert_eq!(street.corridor(ARI), Corridor::Clear);
    let again = street.tell(ARI, Event::RoadClear);
    assert_ignored(&again, Ignored::NothingNew);
    street.tell(ARI, Event::LeaveRequested);
    assert_eq!(street[ARI].duty(), None);
}
