//! Hazard: a message of the current session arrives late and counts as news. Offers are ordered, a farewell
//! names the offer that is left, and a request counts against another one only while it beats.

use crossguard_protocol::*;

use crate::script::*;

const SECOND_OFFER: OfferNumber = OfferNumber(UniqueNumber { boot: 1, count: 1 });

/// `GO2` has offered, left, and offered anew.
fn offers_twice() -> (Street, Ram, Ram) {
    let mut street = Street::asking(&[ARI, GO2], 1);
    let offer = street[GO2].ram();
    street.tell(GO2, Event::LeaveRequested);
    let left = street[GO2].ram();
    street.pass(100);
    assert_eq!(street.offer_of(GO2), SECOND_OFFER);
    (street, offer, left)
}

fn known_offer(street: &Street) -> Option<OfferNumber> {
    street
        .requesting(ARI)
        .offers
        .iter()
        .next()
        .map(|offer| offer.number)
}

#[test]
fn an_older_offer_does_not_displace_a_newer_one() {
    let (mut street, older, _) = offers_twice();
    assert_eq!(known_offer(&street), Some(SECOND_OFFER));
    assert_ignored(&street.hears_ram(ARI, older), Ignored::OldOffer);
    assert_eq!(known_offer(&street), Some(SECOND_OFFER));
    street.pass(400);
    assert_eq!(street[GO2].role(), Role::Follower);
}

/// Kani found it: such a RAM renewed the offer that it took back.
#[test]
fn an_offer_that_its_own_ram_takes_back_is_none() {
    let (mut street, _, _) = offers_twice();
    let session = street[ARI].session().expect("it asks for help");
    let offer = street[GO2].ram();
    let contradiction = Ram {
        farewell: Some(Farewell::Left(session, SECOND_OFFER)),
        ..offer
    };
    assert_eq!(street.hears_ram(ARI, contradiction).ignored(), None);
    assert_eq!(known_offer(&street), None);
    // Said once more, it brings about nothing.
    assert!(street.hears_ram(ARI, contradiction).ignored().is_some());
    assert_eq!(known_offer(&street), None);
    // One that takes an earlier offer back is no contradiction.
    let earlier = street.offer_of(GO2);
    let left = OfferNumber(UniqueNumber {
        count: earlier.0.count - 1,
        ..earlier.0
    });
    let renewed = Ram {
        farewell: Some(Farewell::Left(session, left)),
        ..offer
    };
    assert_eq!(street.hears_ram(ARI, renewed).ignored(), None);
    assert_eq!(known_offer(&street), Some(SECOND_OFFER));
}

#[test]
fn a_late_farewell_to_an_earlier_offer_ends_neither_offer_nor_part() {
    let (mut street, _, left) = offers_twice();
    assert_ignored(&street.hears_ram(ARI, left), Ignored::NothingNew);
    assert_eq!(known_offer(&street), Some(SECOND_OFFER));
    street.pass(400);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
    assert_ignored(&street.hears_ram(ARI, left), Ignored::OtherOffer);
    assert_eq!(street.corridor(ARI), Corridor::Open);
    assert!(street.leading(ARI).member(GO2).is_some());
}

#[test]
fn a_farewell_to_the_offer_that_was_confirmed_ends_the_part() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    let session = street.session_of(ARI);
    street.hears_ram(ARI, farewell(GO2, Farewell::Left(session, FIRST_OFFER)));
    assert!(street.leading(ARI).member(GO2).is_none());
}

#[test]
fn a_request_of_a_session_that_is_over_makes_nobody_withdraw() {
    let mut street = Street::new(&[ARI, GO2]);
    street.cut(GO2, ARI);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let stale = street[ARI].ram();
    street.tell(ARI, Event::LeaveRequested);
    street.pass(60_000);
    street.tell(GO2, Event::PedestrianDetected(escort(1)));
    let session = street.session_of(GO2);
    // ARI goes before GO2, but its request does not beat any more.
    assert_eq!(street.hears_ram(GO2, stale).ignored(), None);
    for _ in 0..5 {
        let again = street.hears_ram(GO2, stale);
        assert_ignored(&again, Ignored::FirstHeard);
    }
    assert_eq!(street[GO2].session(), Some(session));
    assert_eq!(street[GO2].role(), Role::Requester);
}

#[test]
fn a_late_confirmation_is_no_leader_to_withdraw_for() {
    let mut street = Street::with_roles(&[ARI, SPOT]);
    let stale = street[ARI].ram();
    street.tell(ARI, Event::TaskCompleted);
    street.pass(60_000);
    let mut alone = Street::new(&[GO2]);
    alone.tell(GO2, Event::PedestrianDetected(escort(1)));
    for _ in 0..5 {
        alone.hears_ram(GO2, stale);
    }
    assert_eq!(alone[GO2].role(), Role::Requester);
}

#[test]
fn a_late_request_does_not_keep_a_helper_reserved() {
    let mut street = Street::asking(&[ARI, GO2], 2);
    street.pass(1_000);
    let stale = street[ARI].ram();
    street.remove(ARI);
    for _ in 0..29 {
        street.pass(100);
        assert_ignored(&street.hears_ram(GO2, stale), Ignored::OldHeartbeat);
    }
    assert_eq!(street[GO2].role(), Role::Helper);
    street.pass(100);
    assert_eq!(street[GO2].role(), Role::None);
}

#[test]
fn a_leader_does_not_list_an_offer_that_was_never_made() {
    let mut street = Street::new(&[GO2]);
    let session = SessionId {
        leader: ARI,
        number: SessionNumber(UniqueNumber { boot: 1, count: 0 }),
    };
    let (station, offer) = (GO2, SECOND_OFFER);
    let listed = [Confirmation { station, offer }].into_iter().collect();
    let outputs = street.hears_ram(GO2, leader(session, 0, listed));
    assert_ignored(&outputs, Ignored::NeverOffered);
    assert_eq!(street[GO2].farewell(), None);
}
