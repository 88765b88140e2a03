//! The identity is locked from joining a session until its farewell is over, and not for ever.

use crossguard_protocol::*;

use crate::script::*;

const ALIAS: StationId = StationId(77);

/// The robot takes another pseudonym; why it may not.
fn change(street: &mut Street, who: StationId) -> Option<Ignored> {
    let changed = Event::IdentityChanged(ALIAS, None);
    street.tell(who, changed).ignored()
}

#[test]
fn an_idle_robot_may_change_its_pseudonym() {
    let mut street = Street::new(&[ARI]);
    let same = street.tell(ARI, Event::IdentityChanged(ARI, None));
    assert_ignored(&same, Ignored::NothingNew);
    assert_eq!(change(&mut street, ARI), None);
    assert_eq!(street[ARI].station(), ALIAS);
}

/// Hazard: sessions that are numbered on tell that two pseudonyms are one robot.
#[test]
fn numbers_begin_anew_with_a_pseudonym_where_the_event_says_so() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.pass(400);
    street.tell(ARI, Event::TaskCompleted);
    street.pass(1_000);
    let next = UniqueNumber {
        boot: 40_213,
        count: 0,
    };
    let changed = street.tell(ARI, Event::IdentityChanged(ALIAS, Some(next)));
    assert_eq!(changed.ignored(), None);
    assert_eq!(street[ARI].next_number(), next);
    // Locked, nothing changes.
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let first = SessionId {
        leader: ALIAS,
        number: SessionNumber(next),
    };
    assert_eq!(street[ARI].session(), Some(first));
    let again = street.tell(ARI, Event::IdentityChanged(ARI, Some(next)));
    assert_ignored(&again, Ignored::IdentityLocked);
    assert_eq!(street[ARI].next_number().count, 1);
}

#[test]
fn the_lock_holds_from_the_request_or_offer_until_the_farewell_is_over() {
    let mut street = Street::new(&[ARI, GO2]);
    let locked = Some(Ignored::IdentityLocked);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    for who in [ARI, GO2] {
        assert!(street.has_put_out(who, Output::LockIdentity));
        assert_eq!(change(&mut street, who), locked);
    }
    street.pass(400);
    street.tell(ARI, Event::TaskCompleted);
    // The follower is free at once; the leader still says farewell.
    assert!(street.has_put_out(GO2, Output::UnlockIdentity));
    assert_eq!(change(&mut street, ARI), locked);
    street.pass(999);
    assert_eq!(change(&mut street, ARI), locked);
    street.pass(1);
    assert!(street.has_put_out(ARI, Output::UnlockIdentity));
    assert_eq!(change(&mut street, ARI), None);
    // Once each: a lock is not locked again.
    assert_eq!(street.count(GO2, |o| *o == Output::LockIdentity), 1);
}

fn short_lock() -> Settings {
    Settings {
        t_lock: Millis(80_000),
        ..Settings::default()
    }
}

#[test]
fn a_leader_ends_its_session_in_order_when_the_lock_has_lasted_too_long() {
    let mut street = Street::with_settings(&[ARI, GO2], short_lock());
    street.establish_roles(ARI, 1);
    let session = street.session_of(ARI);
    street.pass(80_000 - 1_000 - 400 - 1);
    assert_eq!(street[ARI].role(), Role::Leader);
    street.pass(1);
    assert!(street.was_told(
        ARI,
        Notice::SessionEnded(session, EndReason::IdentityLockLimit)
    ));
    assert_eq!(street.states([ARI, GO2]), [State::Idle, State::Idle]);

    // Until the identity is unlocked it takes part in nothing new.
    assert_eq!(street[ARI].identity(), Identity::Expiring);
    let detected = street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_ignored(&detected, Ignored::IdentityLockLimit);
    street.pass(1_000);
    assert_eq!(street[ARI].identity(), Identity::Unlocked);
    assert_eq!(
        street
            .tell(ARI, Event::PedestrianDetected(escort(1)))
            .ignored(),
        None
    );
}

#[test]
fn a_follower_leaves_in_order_when_its_own_lock_has_lasted_too_long() {
    let mut street = Street::with_settings(&[ARI, GO2], short_lock());
    // GO2 has been bound for a while before: it led a session that has just ended.
    street.cut(GO2, ARI);
    street.tell(GO2, Event::PedestrianDetected(escort(1)));
    street.pass(900);
    street.tell(GO2, Event::LeaveRequested);
    street.heal();
    street.establish_roles(ARI, 1);
    let session = street.session_of(GO2);
    street.pass(80_000 - 1_000 - 900 - 400);
    assert!(street.was_told(
        GO2,
        Notice::Released(session, ReleaseReason::IdentityLockLimit)
    ));
    let second = OfferNumber(UniqueNumber { boot: 1, count: 1 });
    assert_eq!(
        street[GO2].farewell(),
        Some(Farewell::Left(session, second))
    );
    assert_eq!(street[GO2].identity(), Identity::Expiring);
    assert_eq!(
        street[ARI].state(),
        State::Idle,
        "its only follower is gone"
    );
}

#[test]
fn a_farewell_does_not_outlast_the_lock() {
    let mut street = Street::with_settings(&[ARI], short_lock());
    let stale = |count| {
        follower(
            GO2,
            SessionId {
                leader: ARI,
                number: SessionNumber(UniqueNumber { boot: 0, count }),
            },
            0,
        )
    };
    // Somebody keeps naming sessions that are over, so there is always one to say farewell to.
    for count in 0..158 {
        street.hears_ram(ARI, stale(count));
        street.pass(500);
    }
    assert!(street.has_put_out(ARI, Output::UnlockIdentity));
    assert_eq!(street[ARI].identity(), Identity::Unlocked);
}

#[test]
fn while_the_lock_runs_out_no_further_farewell_prolongs_it() {
    let mut street = Street::with_settings(&[ARI], short_lock());
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    for _ in 0..8 {
        street.pass(9_500);
        street.tell(ARI, Event::LeaveRequested);
        street.tell(ARI, Event::PedestrianDetected(escort(1)));
    }
    street.pass(79_000 - 8 * 9_500 - 1);
    street.tell(ARI, Event::LeaveRequested);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    street.pass(1);
    assert_eq!(street[ARI].identity(), Identity::Expiring);
    let farewell = street[ARI].farewell();
    let stale = follower(
        GO2,
        SessionId {
            leader: ARI,
            number: SessionNumber(UniqueNumber { boot: 0, count: 0 }),
        },
        0,
    );
    assert_ignored(&street.hears_ram(ARI, stale), Ignored::AnsweringAnother);
    assert_eq!(street[ARI].farewell(), farewell);
    street.pass(1_000);
    assert_eq!(street[ARI].identity(), Identity::Unlocked);
}
