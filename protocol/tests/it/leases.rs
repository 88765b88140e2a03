//! Keep-alive: only newer heartbeats count, and a lease ends before its follower can fall back.

use crossguard_protocol::*;

use crate::script::*;

fn lease_left(street: &Street) -> Option<u32> {
    match street.leading(ARI).member(GO2).unwrap().lease {
        Lease::Stands(left) => left.left().map(|left| left.0),
        Lease::Expired(_) => None,
    }
}

fn safety_left(street: &Street) -> Option<u32> {
    match street.following(GO2).contact {
        Contact::Fresh(left) => left.left().map(|left| left.0),
        Contact::Lost(_) => None,
    }
}

fn leader_ram(street: &Street, newest: u16) -> Ram {
    let mut ram = street[ARI].ram();
    let Coordination::Leader { heartbeat, .. } = &mut ram.coordination else {
        panic!("no leader")
    };
    *heartbeat = Heartbeat(newest);
    ram
}

fn echo(street: &Street, heartbeat: u16) -> Ram {
    follower(GO2, street.session_of(ARI), heartbeat)
}

/// The newest heartbeat when the roles are established: the request has beaten three times.
const NEWEST: u16 = 4;

/// Roles, then silence between the two.
fn apart() -> Street {
    let mut street = Street::with_roles(&[ARI, GO2]);
    assert_eq!(street.leading(ARI).heartbeat, Heartbeat(NEWEST));
    street.part(ARI, GO2);
    street
}

#[test]
fn a_leader_bumps_its_heartbeat_once_per_ram_period() {
    let mut street = apart();
    street.pass(1_000);
    assert_eq!(street.leading(ARI).heartbeat, Heartbeat(NEWEST + 10));
    assert_eq!(street.count(ARI, sends_ram), 10);
}

#[test]
fn a_leader_that_is_told_late_counts_the_periods_it_missed() {
    let mut street = apart();
    street.step(ARI, Input::Elapsed(Millis(1_050)));
    assert_eq!(street.leading(ARI).heartbeat, Heartbeat(NEWEST + 10));
    assert_eq!(street[ARI].next_ram(), Some(Millis(50)));
    assert_eq!(
        street.count(ARI, sends_ram),
        1,
        "one RAM, not one per period"
    );
}

#[test]
fn a_newer_heartbeat_restarts_the_safety_timer_and_no_other() {
    let mut street = apart();
    street.pass(500);
    assert_eq!(safety_left(&street), Some(1_500));
    let same = street.following(GO2).heard.0;
    for heartbeat in [same, same.wrapping_sub(1), same.wrapping_sub(30_000)] {
        let ram = leader_ram(&street, heartbeat);
        assert_ignored(&street.hears_ram(GO2, ram), Ignored::OldHeartbeat);
        assert_eq!(safety_left(&street), Some(1_500));
    }
    let newer = leader_ram(&street, same + 1);
    assert_eq!(street.hears_ram(GO2, newer).ignored(), None);
    assert_eq!(safety_left(&street), Some(2_000));
    assert_eq!(street.following(GO2).heard, Heartbeat(same + 1));
}

#[test]
fn a_newer_command_restarts_the_safety_timer_and_a_repeated_one_does_not() {
    let mut street = apart();
    let session = street.session_of(ARI);
    let (request, task) = (RequestId(0), TaskType::MOVE);
    let command = Rmcm::Command(Command {
        session,
        to: GO2,
        request,
        task,
    });
    street.pass(500);
    street.hears_rmcm(GO2, command);
    assert_eq!(safety_left(&street), Some(2_000));
    street.pass(500);
    street.hears_rmcm(GO2, command);
    assert_eq!(safety_left(&street), Some(1_500));
}

#[test]
fn the_lease_counts_from_when_the_echoed_heartbeat_was_sent() {
    let mut street = apart();
    street.pass(400);
    // The fourth heartbeat has just been sent; its echo comes 70 ms later.
    street.pass(70);
    let ram = echo(&street, NEWEST + 4);
    street.hears_ram(ARI, ram);
    assert_eq!(lease_left(&street), Some(1_900 - 70));
    // An echo of it that comes when the seventh is the newest is 370 ms old; but it is not newer.
    street.pass(300);
    let ram = echo(&street, NEWEST + 4);
    assert_ignored(&street.hears_ram(ARI, ram), Ignored::OldHeartbeat);
    assert_eq!(lease_left(&street), Some(1_900 - 370));
    let ram = echo(&street, NEWEST + 6);
    street.hears_ram(ARI, ram);
    assert_eq!(lease_left(&street), Some(1_900 - 170));
}

#[test]
fn an_echo_that_is_older_than_a_lease_grants_none() {
    let mut street = apart();
    street.pass(2_000);
    assert_eq!(lease_left(&street), None);
    assert_eq!(street.leading(ARI).heartbeat, Heartbeat(NEWEST + 20));
    let ram = echo(&street, NEWEST + 1);
    street.hears_ram(ARI, ram);
    assert_eq!(lease_left(&street), None, "sent 1900 ms ago");
    let ram = echo(&street, NEWEST + 2);
    street.hears_ram(ARI, ram);
    assert_eq!(lease_left(&street), Some(100), "sent 1800 ms ago");
    assert!(street.was_told(ARI, Notice::LeaseGranted(GO2)));
}

#[test]
fn an_echo_of_a_heartbeat_that_was_never_sent_is_ignored() {
    let mut street = apart();
    let ram = echo(&street, NEWEST + 1);
    assert_ignored(&street.hears_ram(ARI, ram), Ignored::EchoFromFuture);
}

#[test]
fn the_lease_runs_out_before_the_follower_falls_back() {
    let mut street = apart();
    let expired = Output::Notify(Notice::LeaseExpired(GO2));
    while !street.has_put_out(ARI, expired) {
        assert!(!street.following(GO2).contact.is_lost());
        street.pass(1);
    }
    assert!(!street.following(GO2).contact.is_lost());
    // And the follower falls back on time.
    street.pass(100);
    assert!(street.following(GO2).contact.is_lost());
}

#[test]
fn a_follower_is_kept_without_a_lease_until_it_must_have_left() {
    let mut street = apart();
    let session = street.session_of(ARI);
    street.pass(1_900);
    assert!(street.was_told(ARI, Notice::LeaseExpired(GO2)));
    street.pass(6_999);
    assert!(street.leading(ARI).member(GO2).is_some());
    street.pass(1);
    assert!(street.was_told(ARI, Notice::FollowerGone(GO2, GoneReason::NoContact)));
    assert!(street.was_told(ARI, Notice::SessionEnded(session, EndReason::NoFollowers)));
    assert_eq!(street[GO2].role(), Role::None);
}

#[test]
fn a_follower_that_never_takes_its_role_is_dropped() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.remove(GO2);
    street.pass(300);
    assert_eq!(street[ARI].role(), Role::Leader);
    street.pass(6_999);
    assert_eq!(street[ARI].role(), Role::Leader);
    street.pass(1);
    assert_eq!(street[ARI].role(), Role::None);
}

#[test]
fn contact_that_comes_back_grants_a_new_lease() {
    let mut street = apart();
    street.pass(2_500);
    assert!(street.following(GO2).contact.is_lost());
    street.forget();
    street.heal();
    street.pass(200);
    assert!(!street.following(GO2).contact.is_lost());
    assert!(street.has_put_out(
        GO2,
        Output::Notify(Notice::ContactRegained(street.session_of(GO2)))
    ));
    assert!(street.was_told(ARI, Notice::LeaseGranted(GO2)));
}

#[test]
fn heartbeats_wrap_without_confusion() {
    let settings = Settings {
        first_heartbeat: Heartbeat(65_534),
        ..Settings::default()
    };
    let mut street = Street::with_roles_and_settings(&[ARI, GO2], settings);
    street.pass(1_000);
    assert_eq!(street.leading(ARI).heartbeat, Heartbeat(12));
    assert_eq!(street.following(GO2).heard, Heartbeat(12));
    assert!(lease_left(&street).is_some());
}

#[test]
fn an_echo_from_half_the_number_space_away_was_never_sent() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let newest = street.leading(ARI).heartbeat;
    let ram = echo(&street, newest.after(1 << 15).0);
    let ignored = street.hears_ram(ARI, ram).ignored();
    assert_eq!(ignored, Some(Ignored::EchoFromFuture));
}

#[test]
fn a_follower_whose_echo_is_half_the_number_space_old_is_dropped() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    street.part(ARI, GO2);
    street.forget();
    // Its other timers are held back; no endpoint does that.
    let echoed = street.leading(ARI).member(GO2).unwrap().echoed.unwrap();
    let lag = |street: &Street| street.leading(ARI).heartbeat.distance_from(echoed);
    while !street.has_put_out(ARI, gone(GO2)) {
        assert!(street.leading(ARI).member(GO2).is_some());
        assert!(u32::from(lag(&street)) < Heartbeat::HALF_SPACE);
        street.forget();
        street.step(ARI, Input::Expired(Timer::Ram));
        street.step(SPOT, Input::Expired(Timer::Ram));
    }
    assert_eq!(u32::from(lag(&street)), Heartbeat::HALF_SPACE);
    assert!(street.leading(ARI).member(SPOT).is_some());
}

fn gone(station: StationId) -> Output {
    Output::Notify(Notice::FollowerGone(station, GoneReason::NoContact))
}

#[test]
fn a_follower_that_the_leader_no_longer_lists_falls_back() {
    let mut street = Street::executing(TaskType::MOVE);
    let other = Confirmation {
        station: SPOT,
        offer: FIRST_OFFER,
    };
    let session = street.session_of(ARI);
    let maneuver = street.executes(GO2);
    let outputs = street.hears_ram(
        GO2,
        leader(session, NEWEST + 1, [other].into_iter().collect()),
    );
    let fall_back = Output::FallBack(maneuver, FallbackPolicy::EscortToKerb);
    assert!(outputs.iter().any(|o| *o == fall_back));
    let released = Notice::Released(session, ReleaseReason::NotListed);
    assert!(outputs.notices().any(|notice| notice == released));
    assert_eq!(street[GO2].role(), Role::None);
    assert_eq!(street[GO2].farewell(), None, "the leader knows already");
}

#[test]
fn being_listed_for_another_offer_is_not_being_listed() {
    let mut street = Street::executing(TaskType::MOVE);
    let session = street.session_of(GO2);
    let offer = OfferNumber(UniqueNumber { boot: 0, count: 7 });
    let station = GO2;
    let listed = [Confirmation { station, offer }].into_iter().collect();
    street.part(ARI, GO2);
    street.hears_ram(GO2, leader(session, NEWEST + 1, listed));
    assert_eq!(street[GO2].role(), Role::None);
    assert_eq!(
        street[GO2].farewell(),
        Some(Farewell::Left(session, offer)),
        "it names the offer that does not stand"
    );
}
