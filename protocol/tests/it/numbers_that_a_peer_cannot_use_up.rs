//! Hazard: a peer repeats messages until a robot has no numbers left. These tests spend thousands of numbers; the scripts of the
//! same name have the others.

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
fn a_session_is_not_ended_for_one_that_cannot_be_opened() {
    let mut street = Street::new(&[ARI, GO2]);
    // All but one of the numbers of this boot.
    for _ in 0..u16::MAX - 1 {
        street.step(ARI, Input::Local(Event::PedestrianDetected(escort(1))));
        street.step(ARI, Input::Local(Event::TaskCompleted));
        street.forget();
    }
    street.pass(1_000);
    street.establish_roles(ARI, 1);
    for _ in 0..RequestId::MAX_PER_SESSION {
        street.tell(ARI, order(GO2, TaskType::BLOCK));
        street.forget();
    }
    let ignored = street.tell(ARI, order(GO2, TaskType::BLOCK)).ignored();
    assert_eq!(ignored, Some(Ignored::NumbersExhausted));
    assert_eq!(street[ARI].role(), Role::Leader);
}

#[test]
fn a_boot_whose_numbers_are_used_up_opens_no_session_and_makes_no_offer() {
    let mut street = Street::new(&[ARI]);
    let need_help = |count| need_help(SPOT, count, 0, escort(1));
    for count in 0..u16::MAX {
        assert_eq!(street.hears_ram(ARI, need_help(count)).ignored(), None);
        street.tell(ARI, Event::LeaveRequested);
        street.forget();
    }
    let exhausted = Some(Ignored::NumbersExhausted);
    assert_eq!(street.hears_ram(ARI, need_help(0)).ignored(), exhausted);
    let detected = street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_eq!(detected.ignored(), exhausted);
}
