//! Hazard: timers of a team are assumed to be equal. A follower with a short `t_safety` falls back while its
//! leader's lease stands. An offer tells `t_safety`, and one that the lease does not fit is not taken.

use crossguard_protocol::*;

use crate::script::*;

fn hasty() -> Settings {
    Settings {
        t_safety: Millis(600),
        t_lease: Millis(500),
        ..Settings::default()
    }
}

#[test]
fn a_helper_that_would_fall_back_under_the_lease_is_not_taken() {
    let mut street = Street::new(&[ARI, GO2]);
    street.set(GO2, hasty());
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let offer = street[GO2].ram();
    assert_ignored(&street.hears_ram(ARI, offer), Ignored::TimersDoNotFit);
    street.pass(2_000);
    assert_eq!(street[ARI].role(), Role::Requester);
}

#[test]
fn another_helper_is_taken_in_its_place() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    street.set(GO2, hasty());
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    street.pass(400);
    assert_eq!(street.roles([SPOT, GO2]), [Role::Follower, Role::None]);
}

#[test]
fn a_patient_helper_fits_a_hasty_leader() {
    let mut street = Street::new(&[ARI, GO2]);
    street.set(ARI, hasty());
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    street.pass(400);
    assert_eq!(street[GO2].role(), Role::Follower);
}

#[test]
fn the_edge_is_that_of_the_inequality() {
    // (1900 + 50) * 1.001 < t_safety * 0.999 from 1954 on.
    for (t_safety, fits) in [(1_953, false), (1_954, true)] {
        assert_eq!(
            Config::default().lease_fits(Millis(t_safety)),
            fits,
            "{t_safety}"
        );
    }
}

#[test]
fn the_sign_of_an_unequal_team_ends_before_its_follower_falls_back() {
    let mut street = Street::new(&[ARI, GO2]);
    street.set(ARI, hasty());
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    street.pass(400);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
    street.hang(ARI);
    while street.count(GO2, falls_back) == 0 {
        assert!(street.following(GO2).executing().is_some());
        street.pass(1);
    }
    assert!(!street.shows_go(ARI));
}
