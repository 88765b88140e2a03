//! Hazard: a leader hangs and its sign shows *go* on, after its follower has fallen back. *Go* is a lease:
//! the sign ends by itself, before the follower can fall back.

use crossguard_protocol::*;

use crate::script::*;

const LONG: u32 = 8_000;

fn open() -> Street {
    Street::open(&[ARI, GO2], TaskType::BLOCK)
}

#[test]
fn the_sign_ends_before_the_follower_falls_back() {
    let mut street = open();
    street.pass(1_000);
    assert!(street.shows_go(ARI));
    street.hang(ARI);
    let mut ended = None;
    for passed in 1..=LONG {
        street.pass(1);
        if !street.shows_go(ARI) && ended.is_none() {
            ended = Some(passed);
            assert_eq!(street.count(GO2, falls_back), 0, "the guard is still there");
        }
        if street.count(GO2, falls_back) == 1 {
            assert!(ended.is_some_and(|ended| ended < passed), "{ended:?}");
            return;
        }
    }
    panic!("the follower never fell back");
}

#[test]
fn time_that_is_told_late_closes_the_corridor() {
    let mut street = open();
    street.pass(1_000);
    street.hang(ARI);
    street.pass(LONG);
    assert_eq!(street.corridor(ARI), Corridor::Open, "it knows of nothing");
    assert!(!street.shows_go(ARI), "but its sign has ended");
    street.forget();
    street.go_on(ARI);
    let closed = CorridorClosure::NotEngaged(GO2, Disengagement::NoLease);
    assert!(street.has_put_out(ARI, Output::CorridorClosed(closed)));
    assert_eq!(street.count(ARI, opens), 0);
    // Its follower has left meanwhile; people may be on the road all the same.
    assert_eq!(street[ARI].role(), Role::None);
    assert!(matches!(street[ARI].duty(), Some(Duty::Crossing(_))));
}

#[test]
fn a_hang_that_is_shorter_than_the_lease_interrupts_nothing() {
    let mut street = open();
    street.pass(1_000);
    street.hang(ARI);
    street.pass(1_000);
    street.go_on(ARI);
    street.pass(1_000);
    assert_eq!(street.corridor(ARI), Corridor::Open);
    assert!(street.shows_go(ARI));
    assert_eq!(street.count(GO2, falls_back), 0);
}

#[test]
fn go_lasts_as_long_as_the_shortest_lease() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    for guard in [GO2, SPOT] {
        street.tell(ARI, order(guard, TaskType::MOVE));
    }
    street.part(ARI, SPOT);
    street.pass(700);
    // The lease on SPOT was renewed last when it reported.
    let left = |street: &Street, guard| match street.leading(ARI).member(guard).unwrap().lease {
        Lease::Stands(left) => left.left().unwrap(),
        Lease::Expired(_) => Millis::ZERO,
    };
    let shortest = left(&street, SPOT);
    assert!(shortest < left(&street, GO2));
    let outputs = street.tell(ARI, Event::OpenCorridor);
    assert!(
        outputs
            .iter()
            .any(|o| *o == Output::CorridorOpened(shortest))
    );
    // What GO2 renews prolongs nothing, so the sign ends with the lease on SPOT.
    street.forget();
    street.pass(shortest.0 - 1);
    assert!(street.shows_go(ARI));
    street.pass(1);
    assert!(!street.shows_go(ARI));
    let closed = CorridorClosure::NotEngaged(SPOT, Disengagement::NoLease);
    assert!(street.has_put_out(ARI, Output::CorridorClosed(closed)));
}

#[test]
fn while_all_is_well_go_is_prolonged_in_time() {
    let mut street = open();
    for _ in 0..200 {
        street.pass(100);
        assert!(street.shows_go(ARI));
    }
    assert!(street.count(ARI, |o| matches!(o, Output::CorridorExtended(_))) >= 190);
    assert_eq!(street.count(ARI, opens) + street.count(ARI, closes), 0);
}
