//! Two requesters: requests are totally ordered, and the lesser one withdraws and helps.

use crossguard_protocol::*;

use crate::script::*;

/// Both have asked for help before either heard of the other.
fn both_ask(first: Urgency, second: Urgency) -> Street {
    let mut street = Street::new(&[ARI, GO2]);
    street.part(ARI, GO2);
    let request = |urgency| {
        Event::PedestrianDetected(HelpRequest {
            urgency,
            ..escort(1)
        })
    };
    street.tell(ARI, request(first));
    street.tell(GO2, request(second));
    street.heal();
    street
}

#[test]
fn the_lower_station_id_goes_before_among_equals() {
    let mut street = both_ask(Urgency::Medium, Urgency::Medium);
    let withdrawn = street.session_of(GO2);
    street.pass(100);
    assert_eq!(
        street[GO2].role(),
        Role::Requester,
        "it has heard the other once"
    );
    street.pass(100);
    assert_eq!(street.roles([ARI, GO2]), [Role::Requester, Role::Helper]);
    assert_eq!(street.session_of(GO2), street.session_of(ARI));
    let told = Notice::SessionEnded(withdrawn, EndReason::Withdrawn(ARI));
    assert!(
        street.has_put_out(GO2, Output::Notify(told)),
        "its application is told"
    );
    assert_eq!(street[GO2].farewell(), Some(aborted(withdrawn)));
    street.pass(400);
    assert_eq!(street.roles([ARI, GO2]), [Role::Leader, Role::Follower]);
}

#[test]
fn urgency_goes_before_station_id() {
    for (first, second) in [
        (Urgency::Low, Urgency::Medium),
        (Urgency::Medium, Urgency::High),
        (Urgency::High, Urgency::Emergency),
    ] {
        let mut street = both_ask(first, second);
        street.pass(600);
        assert_eq!(street.roles([ARI, GO2]), [Role::Follower, Role::Leader]);
    }
}

#[test]
fn the_request_that_goes_before_is_not_moved_by_the_other() {
    let mut street = both_ask(Urgency::Medium, Urgency::Medium);
    let lesser = street[GO2].ram();
    street.part(ARI, GO2);
    assert_ignored(&street.hears_ram(ARI, lesser), Ignored::LowerPrecedence);
}

#[test]
fn a_helper_of_the_withdrawn_request_becomes_free_for_the_other() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    street.part(ARI, GO2);
    street.part(ARI, SPOT);
    street.tell(GO2, Event::PedestrianDetected(escort(1)));
    street.tell(ARI, Event::PedestrianDetected(escort(2)));
    assert_eq!(street.session_of(SPOT), street.session_of(GO2));
    street.heal();
    street.pass(700);
    assert_eq!(street[ARI].role(), Role::Leader);
    assert_eq!(street.roles([GO2, SPOT]), [Role::Follower, Role::Follower]);
}

#[test]
fn a_leader_that_has_confirmed_somebody_does_not_withdraw() {
    let mut street = Street::with_roles(&[GO2, SPOT]);
    let urgent = HelpRequest {
        urgency: Urgency::Emergency,
        ..escort(1)
    };
    let preceding = need_help(ARI, 0, 0, urgent);
    assert_ignored(&street.hears_ram(GO2, preceding), Ignored::InSession);
    assert_eq!(street[GO2].role(), Role::Leader);
}

#[test]
fn a_requester_that_cannot_help_withdraws_all_the_same() {
    let capabilities = TaskSet::of(&[TaskType::BLOCK]);
    let settings = Settings {
        capabilities,
        ..Settings::default()
    };
    let mut street = Street::with_settings(&[GO2], settings);
    street.tell(GO2, Event::PedestrianDetected(escort(1)));
    for heartbeat in [0, 1] {
        let preceding = need_help(ARI, 0, heartbeat, escort(1));
        assert_eq!(street.hears_ram(GO2, preceding).ignored(), None);
    }
    assert_eq!(street[GO2].role(), Role::None);
}

#[test]
fn of_three_requesters_one_leads() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    for (a, b) in [(ARI, GO2), (ARI, SPOT), (GO2, SPOT)] {
        street.part(a, b);
    }
    for who in [SPOT, GO2, ARI] {
        street.tell(who, Event::PedestrianDetected(escort(2)));
    }
    street.heal();
    street.pass(700);
    assert_eq!(street[ARI].role(), Role::Leader);
    assert_eq!(street.roles([GO2, SPOT]), [Role::Follower, Role::Follower]);
}
