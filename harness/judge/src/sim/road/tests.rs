use crossguard_protocol::{Config, SessionNumber, StationId, UniqueNumber};

use super::*;

const MS: u64 = 1_000;

fn session(leader: u32) -> SessionId {
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    SessionId::of(StationId(leader), number)
}

/// Places 0 and 1 lead at one corner, each with one guard: 2 and 3. A message takes 100 ms at most.
fn road() -> Road {
    let config = Config::default();
    let limits = Limits::new(&config, Millis(100));
    let post = |_| Post::new(0, 1, 40.0, config.settings(), &limits);
    Road::new((0..4).map(post), Millis(100), true)
}

fn leader(place: u32, go_ends_us: Option<u64>) -> Sight {
    Sight {
        go_ends_us,
        leads: Some(session(place)),
        guards: None,
        is_awake: true,
    }
}

fn guard(of: u32) -> Sight {
    Sight {
        go_ends_us: None,
        leads: None,
        guards: Some(session(of)),
        is_awake: true,
    }
}

const GONE: Sight = Sight {
    go_ends_us: None,
    leads: None,
    guards: None,
    is_awake: true,
};

const HUNG: Sight = Sight {
    is_awake: false,
    ..GONE
};

/// The sign of 0 shows go from 1 s on, for this many milliseconds, with its guard in place.
fn open(ms: u64) -> Road {
    let mut road = road();
    road.see(900 * MS, 2, guard(0)).unwrap();
    let ends_us = Some((1_000 + ms) * MS);
    road.see(1_000 * MS, 0, leader(0, ends_us)).unwrap();
    road
}

// 1900 ms and 50 ms of lateness, on a clock that is 0.1 % slow.
const LEASE_MS: u64 = 1_952;

#[test]
fn who_steps_on_the_road_finds_the_guard_in_place_or_gone_for_less_than_the_lease() {
    let mut road = open(60_000);
    assert!(road.step_on_road(2_000 * MS, 0, 0).unwrap().is_some());
    road.see(2_000 * MS, 2, GONE).unwrap();
    let found = road.step_on_road((2_000 + LEASE_MS) * MS, 0, 0).unwrap();
    assert_eq!(found, Some((session(0), 1, vec![2])));
    let late = road.step_on_road((2_000 + LEASE_MS) * MS + 1, 0, 0);
    assert_eq!(late, Err((Measure::GuardGone, 0)));
}

#[test]
fn a_guard_that_was_never_there_is_missed_at_once() {
    let mut road = road();
    road.see(0, 0, leader(0, Some(60_000 * MS))).unwrap();
    let broken = road.step_on_road(1, 0, 0);
    assert_eq!(broken, Err((Measure::GuardGone, 0)));
}

#[test]
fn a_sign_that_goes_on_after_its_guard_has_failed_is_found() {
    for failure in [GONE, HUNG] {
        let mut road = open(60_000);
        road.see(2_000 * MS, 2, failure).unwrap();
        // The knowledge of the leader's application is another matter.
        road.tell_gone(2_000 * MS, 0, Some(2)).unwrap();
        road.pass((2_000 + LEASE_MS) * MS).unwrap();
        let late = road.pass((2_000 + LEASE_MS) * MS + 1);
        assert_eq!(late, Err((Measure::SignAfterGuard, 0)));
    }
}

#[test]
fn a_sign_that_goes_on_while_its_leader_hangs_is_found_and_one_that_ends_is_measured() {
    let hung = |ms: u64| Sight {
        go_ends_us: Some((1_000 + ms) * MS),
        ..HUNG
    };
    let mut road = open(60_000);
    road.see(2_000 * MS, 0, hung(60_000)).unwrap();
    let late = road.pass((2_000 + LEASE_MS) * MS + 1);
    assert_eq!(late, Err((Measure::SignAfterLeader, 0)));
    let mut road = open(1_900);
    road.see(1_000 * MS, 0, hung(1_900)).unwrap();
    road.pass(9_000 * MS).unwrap();
    let longest = road.worst().of(Measure::SignAfterLeader).unwrap();
    assert_eq!((longest.ms, u64::from(longest.bound_ms)), (1_900, LEASE_MS));
}

#[test]
fn a_follower_that_falls_back_while_the_sign_shows_go_is_found() {
    let mut road = open(1_900);
    road.lose_contact(2_900 * MS, session(0)).unwrap();
    let late = road.lose_contact(2_899 * MS, session(0));
    assert_eq!(late, Err((Measure::Unguarded, 0)));
}

#[test]
fn two_leaders_that_hear_each_other_show_go_no_longer_than_a_period_and_the_way_of_a_message() {
    // 100 ms and 50 ms of lateness on a slow clock, 100 ms under way.
    let y_us = (151 + 100) * MS;
    let met = || {
        let mut road = open(60_000);
        road.see(1_400 * MS, 1, leader(1, None)).unwrap();
        road.see(1_500 * MS, 1, leader(1, Some(60_000 * MS)))
            .unwrap();
        road.hear(2_000 * MS, 0, 1, 1_900 * MS);
        road.pass(9_000 * MS).unwrap();
        road.hear(9_000 * MS, 1, 0, 8_900 * MS);
        road
    };
    let mut road = met();
    road.pass(9_000 * MS + y_us).unwrap();
    let late = road.pass(9_000 * MS + y_us + 1);
    assert_eq!(late, Err((Measure::TwoSigns, 1)));
    let mut road = met();
    road.see(9_100 * MS, 1, leader(1, None)).unwrap();
    road.pass(20_000 * MS).unwrap();
    assert_eq!(road.worst().of(Measure::TwoSigns).unwrap().ms, 100);
    // A message that was lost leaves open when they hear each other again.
    let mut road = met();
    road.lose(0, 1);
    road.pass(20_000 * MS).unwrap();
}

#[test]
fn an_application_that_is_not_told_of_a_lost_guard_or_of_an_end_is_found() {
    let mut road = open(60_000);
    road.see(2_000 * MS, 2, GONE).unwrap();
    road.see(2_100 * MS, 0, leader(0, None)).unwrap();
    let late = road.pass((2_000 + LEASE_MS) * MS + 1);
    assert_eq!(late, Err((Measure::Untold, 0)));
    let mut road = self::road();
    road.see(0, 0, leader(0, None)).unwrap();
    road.notice(0, 0);
    let late = road.pass(51_000 * MS);
    assert_eq!(late, Err((Measure::Served, 0)));
    let mut road = self::road();
    road.see(0, 0, leader(0, None)).unwrap();
    road.notice(0, 0);
    road.tell_end(10_000 * MS, 0).unwrap();
    road.pass(99_000 * MS).unwrap();
}

#[test]
fn a_guard_that_is_back_before_the_bound_is_no_failure_any_more() {
    let mut road = open(60_000);
    road.see(2_000 * MS, 2, HUNG).unwrap();
    road.see(2_500 * MS, 2, guard(0)).unwrap();
    road.pass(30_000 * MS).unwrap();
}
