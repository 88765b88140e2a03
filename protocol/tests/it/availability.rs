//! Availability: an unavailable robot withdraws, fails or leaves; it is never silent.

use crossguard_protocol::*;

use crate::script::*;

const EVERY_REASON: [Unavailability; 5] = [
    Unavailability::LowBattery,
    Unavailability::Teleoperated,
    Unavailability::EmergencyStop,
    Unavailability::LocalFault,
    Unavailability::NotSafe,
];

fn unavailable(reason: Unavailability) -> Event {
    Event::AvailabilityChanged(Availability::Unavailable(reason))
}

#[test]
fn an_unavailable_robot_neither_asks_nor_offers() {
    let mut street = Street::new(&[ARI, GO2]);
    let low = Unavailability::LowBattery;
    street.tell(GO2, unavailable(low));
    assert!(street.has_put_out(GO2, Output::SendRam), "its RAM says so");
    let detected = street.tell(GO2, Event::PedestrianDetected(escort(1)));
    assert_ignored(&detected, Ignored::Unavailable(low));
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_eq!(street[GO2].role(), Role::None);
    let again = street[ARI].ram();
    assert_ignored(&street.hears_ram(GO2, again), Ignored::Unavailable(low));
    assert_ignored(&street.tell(GO2, unavailable(low)), Ignored::NothingNew);

    street.tell(GO2, Event::AvailabilityChanged(Availability::Available));
    street.pass(100);
    assert_eq!(street[GO2].role(), Role::Helper);
}

#[test]
fn an_offer_is_withdrawn_by_name() {
    for reason in EVERY_REASON {
        let mut street = Street::asking(&[ARI, GO2], 1);
        let session = street.session_of(ARI);
        street.tell(GO2, unavailable(reason));
        assert_eq!(street[GO2].farewell(), Some(left(session)));
        street.pass(1_000);
        assert_eq!(street[ARI].role(), Role::Requester, "the offer is gone");
    }
}

#[test]
fn a_follower_that_executes_fails_and_ends_it_as_its_body_can() {
    for reason in EVERY_REASON {
        let mut street = Street::executing(TaskType::MOVE);
        let maneuver = street.executes(GO2);
        street.tell(GO2, unavailable(reason));
        let end = if reason.can_fall_back() {
            Output::FallBack(maneuver, FallbackPolicy::EscortToKerb)
        } else {
            Output::StopManeuver(maneuver, StopReason::Unavailable(reason))
        };
        assert!(street.has_put_out(GO2, end), "{reason}");
        assert_eq!(street[GO2].duty().is_some(), reason.can_fall_back());
        assert!(street.was_told(
            ARI,
            Notice::ManeuverFailed(GO2, maneuver.id, Failure::Unavailable(reason))
        ));
        assert_eq!(
            street[GO2].state(),
            State::RoleEstablished,
            "it stays, and answers"
        );

        street.tell(ARI, order(GO2, TaskType::MOVE));
        let id = street.maneuver(ARI, 1);
        assert!(street.was_told(
            ARI,
            Notice::CommandRejected(GO2, id, Rejection::Unavailable(reason))
        ));
    }
}

#[test]
fn a_follower_that_executes_nothing_leaves() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let session = street.session_of(GO2);
    let reason = Unavailability::Teleoperated;
    street.tell(GO2, unavailable(reason));
    assert!(street.was_told(
        GO2,
        Notice::Released(session, ReleaseReason::Unavailable(reason))
    ));
    assert!(street.was_told(ARI, Notice::FollowerGone(GO2, GoneReason::Left)));
}

#[test]
fn a_requester_or_leader_ends_its_session() {
    let reason = Unavailability::EmergencyStop;
    for established in [false, true] {
        let mut street = Street::asking(&[ARI, GO2], 1);
        if established {
            street.pass(400);
        }
        let session = street.session_of(ARI);
        street.tell(ARI, unavailable(reason));
        assert!(street.was_told(
            ARI,
            Notice::SessionEnded(session, EndReason::Unavailable(reason))
        ));
        assert_eq!(street.states([ARI, GO2]), [State::Idle, State::Idle]);
    }
}
