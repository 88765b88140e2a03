//! What no script can say: every moment of ten seconds, half of a number space, a timer that is told alone, capacities.

use crossguard_protocol::*;

use crate::script::*;

#[test]
fn a_farewell_does_not_outlast_the_lock() {
    let settings = Settings {
        t_lock: Millis(80_000),
        ..Settings::default()
    };
    let mut street = Street::with_settings(&[ARI], settings);
    let stale = |count| {
        follower(
            GO2,
            SessionId {
                leader: ARI,
                number: SessionNumber(UniqueNumber { boot: 0, count }),
            },
            0,
        )
    };
    // Somebody keeps naming sessions that are over, so there is always one to say farewell to.
    for count in 0..158 {
        street.hears_ram(ARI, stale(count));
        street.pass(500);
    }
    assert!(street.has_put_out(ARI, Output::UnlockIdentity));
    assert_eq!(street[ARI].identity(), Identity::Unlocked);
}

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
fn a_follower_whose_echo_is_half_the_number_space_old_is_dropped() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    street.part(ARI, GO2);
    street.forget();
    // Its other timers are held back; no endpoint does that.
    let echoed = street.leading(ARI).member(GO2).unwrap().echoed.unwrap();
    let lag = |street: &Street| street.leading(ARI).heartbeat.distance_from(echoed);
    let gone = Output::Notify(Notice::FollowerGone(GO2, GoneReason::NoContact));
    while !street.has_put_out(ARI, gone) {
        assert!(street.leading(ARI).member(GO2).is_some());
        assert!(u32::from(lag(&street)) < Heartbeat::HALF_SPACE);
        street.forget();
        street.step(ARI, Input::Expired(Timer::Ram));
        street.step(SPOT, Input::Expired(Timer::Ram));
    }
    assert_eq!(u32::from(lag(&street)), Heartbeat::HALF_SPACE);
    assert!(street.leading(ARI).member(SPOT).is_some());
}

#[test]
fn a_timer_that_is_not_armed_does_not_expire() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for (who, timer) in [
        (ARI, Timer::Help),
        (ARI, Timer::Acknowledgement(GO2)),
        (ARI, Timer::Lost(GO2)),
        (GO2, Timer::Leave),
        (GO2, Timer::Farewell),
    ] {
        let outputs = street.step(who, Input::Expired(timer));
        assert_eq!(outputs.ignored(), Some(Ignored::TimerNotArmed), "{timer}");
    }
}

#[test]
fn one_step_of_a_full_team_stays_within_the_capacity_for_outputs() {
    let everybody = [ARI, GO2, SPOT, NAO, PEPPER];
    // The leader sleeps until everything is due at once: under an open corridor, and with commands that
    // nobody acknowledges.
    let open = Street::open(&everybody, TaskType::BLOCK);
    let mut commanded = Street::with_roles(&everybody);
    for follower in [GO2, SPOT, NAO, PEPPER] {
        commanded.tell(ARI, order(follower, TaskType::BLOCK));
    }
    for follower in [GO2, SPOT, NAO, PEPPER] {
        commanded.part(ARI, follower);
        commanded.tell(ARI, order(follower, TaskType::MOVE));
    }
    for mut street in [open, commanded] {
        let outputs = street.step(ARI, Input::Elapsed(Millis(400_000)));
        assert!(outputs.len() <= MAX_OUTPUTS);
        assert_eq!(street[ARI].state(), State::Idle);
    }
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
