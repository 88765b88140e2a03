//! Hazard: a session whose request numbers are used up is renewed under an open corridor, which frees its
//! guards. Nothing is renewed, and no guard commanded, while people may be on the road.

use crossguard_protocol::*;

use crate::script::*;

/// All request numbers of the session but those of one block are used, and the corridor is open.
fn used_up() -> Street {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for _ in 0..RequestId::MAX_PER_SESSION {
        street.tell(ARI, order(GO2, TaskType::BLOCK));
        street.forget();
    }
    street.in_position(GO2);
    assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
    street
}

#[test]
fn a_session_is_renewed_once_the_road_is_clear_and_not_before() {
    let mut street = used_up();
    let session = street.session_of(ARI);
    let maneuver = street.following(GO2).executing();
    for event in [Event::CloseCorridor, Event::RoadClear] {
        for task in [TaskType::BLOCK, TaskType::MOVE, TaskType::INITIAL_POS] {
            let outputs = street.tell(ARI, order(GO2, task));
            assert_ignored(&outputs, Ignored::RoadOccupied);
        }
        assert_eq!(street.session_of(ARI), session);
        assert_eq!(street.following(GO2).executing(), maneuver);
        street.tell(ARI, event);
    }
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    assert!(street.was_told(ARI, Notice::SessionEnded(session, EndReason::Renewed)));
    assert_eq!(street[ARI].role(), Role::Requester);
}

#[test]
fn a_follower_that_guards_nobody_may_be_commanded() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    for guard in [GO2, SPOT] {
        street.tell(ARI, order(guard, TaskType::MOVE));
    }
    assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
    let done = street.executes(SPOT).id;
    street.tell(SPOT, Event::ManeuverFailed(done));
    assert_eq!(street.corridor(ARI), Corridor::Clearing);
    // Its place may be taken again while people are on the road; that of the other is kept.
    assert_eq!(
        street.tell(ARI, order(SPOT, TaskType::MOVE)).ignored(),
        None
    );
    let outputs = street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_ignored(&outputs, Ignored::RoadOccupied);
}
