//! Hazard: a peer repeats messages until a robot has no numbers left. Numbers are spent by a robot's own
//! decisions, and a new epoch gives it new ones without a restart.

use crossguard_protocol::*;

use crate::script::*;

#[test]
fn requests_that_end_at_once_use_up_nothing() {
    let mut street = Street::new(&[GO2]);
    let before = street[GO2].next_number();
    for count in 0..=u16::MAX {
        street.hears_ram(GO2, need_help(ARI, count, 0, escort(1)));
        assert_eq!(street[GO2].role(), Role::Helper, "request {count}");
        let number = SessionNumber(UniqueNumber { boot: 1, count });
        street.hears_ram(GO2, farewell(ARI, Farewell::Ended(number, Ending::Aborted)));
        street.forget();
    }
    assert_eq!(street[GO2].next_number(), before);
    street.hears_ram(GO2, need_help(SPOT, 0, 0, escort(1)));
    assert_eq!(street[GO2].role(), Role::Helper);
}

#[test]
fn the_end_and_the_next_request_in_one_message_use_up_nothing() {
    let mut street = Street::new(&[GO2]);
    for count in 0..1_000 {
        let mut ram = need_help(ARI, count, 0, escort(1));
        let last = UniqueNumber {
            boot: 1,
            count: count.saturating_sub(1),
        };
        ram.farewell = Some(Farewell::Ended(SessionNumber(last), Ending::Aborted));
        street.hears_ram(GO2, ram);
        assert_eq!(street.offer_of(GO2), FIRST_OFFER);
    }
}

#[test]
fn a_number_that_was_confirmed_is_not_given_out_again() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let number = street[GO2].next_number();
    street.tell(ARI, Event::LeaveRequested);
    assert_eq!(street[GO2].next_number(), number);
    street.pass(1_000);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_ne!(street.offer_of(GO2), FIRST_OFFER);
}

fn spend(street: &mut Street, numbers: u16) {
    for _ in 0..numbers {
        street.tell(ARI, Event::PedestrianDetected(escort(1)));
        street.tell(ARI, Event::LeaveRequested);
    }
}

fn asks_for_an_epoch(street: &Street) -> bool {
    street.has_put_out(ARI, Output::RenewEpoch)
}

#[test]
fn half_of_the_numbers_ask_for_a_new_epoch_which_needs_no_restart() {
    let mut street = Street::new(&[ARI]);
    spend(&mut street, u16::MAX / 2);
    assert!(!asks_for_an_epoch(&street));
    spend(&mut street, 1);
    assert!(asks_for_an_epoch(&street));

    let same = street.tell(ARI, Event::EpochRenewed(1));
    assert_ignored(&same, Ignored::NothingNew);
    let outputs = street.tell(ARI, Event::EpochRenewed(2));
    assert_eq!(outputs.ignored(), None);
    assert_eq!(
        street[ARI].next_number(),
        UniqueNumber { boot: 2, count: 0 }
    );
    street.forget();
    spend(&mut street, 100);
    assert!(!asks_for_an_epoch(&street));
}

#[test]
fn an_epoch_may_be_renewed_within_a_session() {
    let mut street = Street::open(&[ARI, GO2], TaskType::MOVE);
    let sessions = [street.session_of(ARI), street.session_of(GO2)];
    for who in [ARI, GO2] {
        assert_eq!(street.tell(who, Event::EpochRenewed(2)).ignored(), None);
    }
    street.pass(10_000);
    assert_eq!([street.session_of(ARI), street.session_of(GO2)], sessions);
    assert!(street.shows_go(ARI));
    street.tell(ARI, Event::TaskCompleted);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert!(street.session_of(ARI).number > sessions[0].number);
    assert_eq!(street.offer_of(GO2).0, UniqueNumber { boot: 2, count: 0 });
}

#[test]
fn an_offer_of_an_earlier_epoch_that_ends_gives_back_nothing() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.tell(GO2, Event::EpochRenewed(2));
    street.tell(ARI, Event::LeaveRequested);
    assert_eq!(
        street[GO2].next_number(),
        UniqueNumber { boot: 2, count: 0 }
    );
}
