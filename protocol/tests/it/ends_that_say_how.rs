//! Hazard: a leader that reboots, leaves, renews or gives up takes a guard off the road. Every end but a
//! completed crossing makes a follower fall back by the policy of its task.

use crossguard_protocol::*;

use crate::script::*;

/// `GO2` blocks for `ARI`, and people are on the road.
fn crossing() -> Street {
    Street::open(&[ARI, GO2], TaskType::BLOCK)
}

fn assert_holds(street: &Street, maneuver: Maneuver) {
    let hold = Output::FallBack(maneuver, FallbackPolicy::HoldUntilClear);
    assert!(street.has_put_out(GO2, hold));
    assert_eq!(street.count(GO2, stops), 0);
    assert_eq!(street[GO2].duty(), Some(Duty::FallingBack(maneuver)));
}

#[test]
fn a_completed_crossing_frees_the_follower() {
    let mut street = crossing();
    let maneuver = street.executes(GO2);
    street.tell(ARI, Event::TaskCompleted);
    let stop = StopReason::Released(ReleaseReason::TaskCompleted);
    assert!(street.has_put_out(GO2, Output::StopManeuver(maneuver, stop)));
    assert_eq!(street.count(GO2, falls_back), 0);
    assert_eq!((street[ARI].duty(), street[GO2].duty()), (None, None));
    assert!(!street.shows_go(ARI));
}

#[test]
fn every_other_end_of_a_session_is_an_abort() {
    let low = Availability::Unavailable(Unavailability::LowBattery);
    let stop = Availability::Unavailable(Unavailability::EmergencyStop);
    for event in [
        Event::LeaveRequested,
        Event::AvailabilityChanged(low),
        Event::AvailabilityChanged(stop),
    ] {
        let mut street = crossing();
        let maneuver = street.executes(GO2);
        let session = street.session_of(ARI);
        street.tell(ARI, event);
        assert_eq!(street[ARI].farewell(), Some(aborted(session)));
        assert_holds(&street, maneuver);
        assert!(street.was_told(GO2, Notice::Released(session, ReleaseReason::SessionEnded)));
        assert_eq!(street[ARI].duty(), Some(Duty::Crossing(session)), "{event}");
    }
}

#[test]
fn a_leader_that_reboots_does_not_stop_its_follower() {
    let mut street = crossing();
    let maneuver = street.executes(GO2);
    street.reboot(ARI);
    street.pass(100);
    assert_eq!(
        street[GO2].role(),
        Role::None,
        "it is told that the session is over"
    );
    assert_holds(&street, maneuver);
}

#[test]
fn a_leader_that_gives_its_follower_up_does_not_stop_it() {
    let mut street = crossing();
    let maneuver = street.executes(GO2);
    street.cut(GO2, ARI);
    street.pass(1_900 + 7_000);
    assert_eq!(street[ARI].role(), Role::None);
    assert_holds(&street, maneuver);
}

#[test]
fn a_session_that_is_renewed_does_not_stop_its_follower() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for _ in 0..RequestId::MAX_PER_SESSION {
        street.tell(ARI, order(GO2, TaskType::BLOCK));
    }
    let maneuver = street.executes(GO2);
    street.forget();
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    assert_eq!(street[ARI].role(), Role::Requester);
    assert_holds(&street, maneuver);
}

#[test]
fn the_limit_of_the_identity_lock_does_not_stop_a_follower() {
    let settings = Settings {
        t_lock: Millis(80_000),
        ..Settings::default()
    };
    let mut street = Street::with_roles_and_settings(&[ARI, GO2], settings);
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    let maneuver = street.executes(GO2);
    street.pass(79_000);
    assert_eq!(street.roles([ARI, GO2]), [Role::None, Role::None]);
    assert_holds(&street, maneuver);
}

#[test]
fn contact_that_is_lost_does_not_stop_a_follower() {
    let mut street = crossing();
    let maneuver = street.executes(GO2);
    street.remove(ARI);
    street.pass(7_000);
    assert_holds(&street, maneuver);
}

#[test]
fn a_follower_that_leaves_falls_back_as_well() {
    let mut street = crossing();
    let maneuver = street.executes(GO2);
    street.tell(GO2, Event::LeaveRequested);
    assert_holds(&street, maneuver);
}

#[test]
fn an_end_that_is_asked_for_later_counts_as_aborted() {
    // The follower is deaf while its leader says that the crossing is completed.
    let mut street = crossing();
    let maneuver = street.executes(GO2);
    street.cut(ARI, GO2);
    street.tell(ARI, Event::TaskCompleted);
    street.pass(1_500);
    street.heal();
    street.pass(100);
    assert_eq!(street[GO2].role(), Role::None);
    assert_holds(&street, maneuver);
}

#[test]
fn a_body_that_is_not_its_own_stops() {
    for reason in [
        Unavailability::EmergencyStop,
        Unavailability::LocalFault,
        Unavailability::Teleoperated,
    ] {
        let mut street = crossing();
        let unavailable = Availability::Unavailable(reason);
        street.tell(GO2, Event::AvailabilityChanged(unavailable));
        assert_eq!(
            (street.count(GO2, stops), street.count(GO2, falls_back)),
            (1, 0)
        );
        assert_eq!(street[GO2].duty(), None);
        assert!(!street.shows_go(ARI), "the leader learns at once");
    }
}
