//! Hazard: a requester waits for offers that cannot come, while the offers that it has grow old. It selects at
//! once when its application says that all have answered, and enough have.

use crossguard_protocol::*;

use crate::script::*;

#[test]
fn it_selects_at_once_when_nothing_better_can_come() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.pass(20);
    let outputs = street.tell(ARI, Event::AllAnswered);
    assert_eq!(outputs.ignored(), None);
    assert_eq!(street.roles([ARI, GO2]), [Role::Leader, Role::Follower]);
}

#[test]
fn it_goes_on_asking_while_too_few_have_offered() {
    let mut street = Street::new(&[ARI, GO2]);
    let nobody = street.tell(ARI, Event::AllAnswered);
    assert_ignored(&nobody, Ignored::NothingNew);
    street.tell(ARI, Event::PedestrianDetected(escort(2)));
    let too_few = street.tell(ARI, Event::AllAnswered);
    assert_ignored(&too_few, Ignored::NothingNew);
    assert_eq!(street[ARI].role(), Role::Requester);
}

#[test]
fn only_an_offer_that_stands_counts() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    street.part(ARI, SPOT);
    street.tell(ARI, Event::PedestrianDetected(escort(2)));
    street.part(ARI, GO2);
    street.pass(2_900);
    street.heal();
    street.part(ARI, GO2);
    // The offer of GO2 has lapsed by the time at which SPOT offers.
    street.pass(150);
    let outputs = street.tell(ARI, Event::AllAnswered);
    assert_ignored(&outputs, Ignored::NothingNew);
    assert_eq!(street.requesting(ARI).offers.len(), 1);
}
