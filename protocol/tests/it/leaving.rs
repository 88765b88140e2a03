//! Leaving and ending: always by name, always answered.

use crossguard_protocol::*;

use crate::script::*;

#[test]
fn a_follower_that_leaves_falls_back_and_names_the_session() {
    let mut street = Street::executing(TaskType::MOVE);
    let session = street.session_of(GO2);
    let maneuver = street.executes(GO2);
    street.tell(GO2, Event::LeaveRequested);
    let policy = FallbackPolicy::EscortToKerb;
    assert!(street.has_put_out(GO2, Output::FallBack(maneuver, policy)));
    assert!(street.was_told(
        GO2,
        Notice::Released(session, ReleaseReason::LeaveRequested)
    ));
    assert_eq!(street[GO2].farewell(), Some(left(session)));
    assert!(street.was_told(ARI, Notice::FollowerGone(GO2, GoneReason::Left)));
}

#[test]
fn a_helper_that_leaves_takes_its_offer_back() {
    let mut street = Street::new(&[ARI, GO2]);
    street.cut(ARI, GO2);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let need_help = street[ARI].ram();
    street.hears_ram(GO2, need_help);
    street.tell(GO2, Event::LeaveRequested);
    street.pass(1_000);
    assert_eq!(street[ARI].role(), Role::Requester);
    // To take back what is not there changes nothing.
    let left = street[GO2].ram();
    assert_eq!(left.farewell, None, "the farewell has had its time");
    let session = street.session_of(ARI);
    let left = farewell(GO2, Farewell::Left(session, FIRST_OFFER));
    assert_ignored(&street.hears_ram(ARI, left), Ignored::NothingNew);
}

#[test]
fn a_leader_or_requester_that_leaves_ends_its_session() {
    for established in [false, true] {
        let mut street = Street::asking(&[ARI, GO2], 1);
        if established {
            street.pass(400);
        }
        let session = street.session_of(ARI);
        street.tell(ARI, Event::LeaveRequested);
        assert!(street.was_told(
            ARI,
            Notice::SessionEnded(session, EndReason::LeaveRequested)
        ));
        assert_eq!(street.states([ARI, GO2]), [State::Idle, State::Idle]);
    }
}

#[test]
fn a_request_may_be_taken_back_as_completed() {
    let mut street = Street::asking(&[ARI], 1);
    let session = street.session_of(ARI);
    street.tell(ARI, Event::TaskCompleted);
    assert!(street.was_told(ARI, Notice::SessionEnded(session, EndReason::TaskCompleted)));
}

#[test]
fn who_has_no_part_has_nothing_to_leave_or_to_complete() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let completed = street.tell(GO2, Event::TaskCompleted);
    assert_ignored(&completed, Ignored::NotLeading);
    let mut street = Street::new(&[ARI]);
    assert_ignored(
        &street.tell(ARI, Event::LeaveRequested),
        Ignored::NotInSession,
    );
    assert_ignored(&street.tell(ARI, Event::TaskCompleted), Ignored::NotLeading);
}

#[test]
fn a_farewell_stands_for_t_farewell_and_is_repeated() {
    let mut street = Street::asking(&[ARI], 1);
    street.tell(ARI, Event::LeaveRequested);
    street.forget();
    street.pass(999);
    assert!(street[ARI].farewell().is_some());
    assert_eq!(street.count(ARI, sends_ram), 9);
    street.pass(1);
    assert_eq!(street[ARI].farewell(), None);
    street.forget();
    street.pass(1_000);
    assert_eq!(
        street.count(ARI, sends_ram),
        0,
        "the generation rules apply from here on"
    );
}

#[test]
fn the_farewell_to_one_session_goes_along_with_the_request_of_the_next() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let first = street.session_of(ARI);
    street.part(ARI, GO2);
    street.tell(ARI, Event::TaskCompleted);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let ram = street[ARI].ram();
    assert_eq!(
        ram.farewell,
        Some(Farewell::Ended(first.number, Ending::Completed))
    );
    // The one RAM ends the follower's part and wins it for the next session.
    street.hears_ram(GO2, ram);
    assert_eq!(street[GO2].role(), Role::Helper);
    assert_eq!(street.session_of(GO2), street.session_of(ARI));
}

#[test]
fn an_end_that_nobody_hears_frees_the_followers_all_the_same() {
    let mut street = Street::executing(TaskType::BLOCK);
    street.part(ARI, GO2);
    street.tell(ARI, Event::TaskCompleted);
    street.pass(7_000);
    assert_eq!(street[GO2].state(), State::Idle);
}

#[test]
fn what_somebody_else_leaves_is_not_this_robots_concern() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let left = |session| farewell(SPOT, Farewell::Left(session, FIRST_OFFER));
    let own = street.session_of(ARI);
    let foreign = SessionId { leader: NAO, ..own };
    let older = SessionId {
        number: SessionNumber(UniqueNumber { boot: 0, count: 0 }),
        ..own
    };
    let mut ignored = |session| street.hears_ram(ARI, left(session)).ignored();
    assert_eq!(ignored(foreign), Some(Ignored::NotAddressed));
    assert_eq!(ignored(older), Some(Ignored::OtherSession));
    assert_eq!(ignored(own), Some(Ignored::NotAFollower));
}
