//! Hazard: a requester confirms an offer that its helper holds no more. Requests beat, and an offer lapses at
//! the requester before the helper's reservation ends; so a team that is confirmed is complete.

use crossguard_protocol::*;

use crate::script::*;

/// Two followers are wanted. `GO2` is there from the beginning, `SPOT` hears nothing before `arrival`.
fn second_helper_at(arrival: u32) -> Street {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    street.part(ARI, SPOT);
    street.tell(ARI, Event::PedestrianDetected(escort(2)));
    street.pass(arrival);
    street.heal();
    street
}

fn is_complete(street: &Street) -> bool {
    street.leading(ARI).members.len() == 2
        && [GO2, SPOT]
            .into_iter()
            .all(|who| street[who].session() == street[ARI].session())
}

#[test]
fn whenever_the_second_helper_arrives_the_team_is_complete() {
    let mut teams = 0;
    for arrival in (1..=10_000).step_by(11) {
        let mut street = second_helper_at(arrival);
        // What counts is the moment after the confirmation was heard.
        while street[ARI].role() == Role::Requester {
            street.pass(100);
        }
        if street[ARI].role() != Role::Leader {
            assert!(arrival > 9_000, "no help at {arrival} ms");
            continue;
        }
        teams += 1;
        street.pass(100);
        assert!(is_complete(&street), "incomplete at {arrival} ms");
        street.pass(1_000);
        assert!(is_complete(&street), "incomplete later, at {arrival} ms");
        let gone = |o: &Output| matches!(o, Output::Notify(Notice::FollowerGone(..)));
        assert_eq!(street.count(ARI, gone), 0, "at {arrival} ms");
    }
    assert!(teams > 800, "{teams}");
}

#[test]
fn a_request_that_beats_keeps_its_helper() {
    let street = second_helper_at(9_000);
    assert_eq!(street[GO2].role(), Role::Helper);
    assert_eq!(
        street.count(GO2, |o| matches!(o, Output::Notify(Notice::Released(..)))),
        0
    );
    assert_eq!(
        street.offer_of(GO2),
        FIRST_OFFER,
        "it is the offer that it made at first"
    );
}

#[test]
fn an_offer_that_is_not_repeated_lapses_before_the_reservation_does() {
    let mut street = Street::asking(&[ARI, GO2], 2);
    street.pass(1_000);
    street.part(ARI, GO2);
    let lapsed = Output::Notify(Notice::OfferLapsed(GO2));
    while !street.has_put_out(ARI, lapsed) {
        assert_eq!(street[GO2].role(), Role::Helper, "still reserved");
        street.pass(1);
    }
    assert!(street.requesting(ARI).offers.is_empty());
    assert_eq!(street[GO2].role(), Role::Helper, "still reserved");
    street.pass(200);
    assert_eq!(street[GO2].role(), Role::None);
}

#[test]
fn an_offer_is_as_old_as_the_heartbeat_that_it_echoes() {
    let mut street = Street::asking(&[ARI], 1);
    let session = street.session_of(ARI);
    let late = offer(GO2, session, FIRST_OFFER, &[TaskType::MOVE], 0);
    // Sent when the request was, and heard when the reservation may be over.
    street.pass(street.config.t_offer_lease().0);
    assert_ignored(&street.hears_ram(ARI, late), Ignored::OldHeartbeat);
    let future = offer(GO2, session, FIRST_OFFER, &[TaskType::MOVE], 500);
    assert_ignored(&street.hears_ram(ARI, future), Ignored::EchoFromFuture);
}
