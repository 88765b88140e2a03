//! What no script can say: every moment of ten seconds, half of a number space, what an application reads.

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
fn a_set_without_another_has_no_task_of_it() {
    let of = |tasks: [TaskType; 2]| TaskSet::of(&tasks);
    let two = of([TaskType::MOVE, TaskType::BLOCK]);
    let left = two.without(of([TaskType::BLOCK, TaskType::INITIAL_POS]));
    assert_eq!(left, TaskSet::of(&[TaskType::MOVE]));
}

#[test]
fn the_newest_request_is_the_one_that_was_answered_last() {
    let street = Street::with_roles(&[ARI, GO2]);
    assert_eq!(street.following(GO2).newest_request(), None);
    let mut street = Street::executing(TaskType::INITIAL_POS);
    let running = street.executes(GO2).id;
    assert_eq!(
        street.following(GO2).newest_request(),
        Some(running.request)
    );
    let has_completed = |street: &Street| {
        let member = street.leading(ARI).member(GO2);
        member.is_some_and(Member::has_completed)
    };
    assert!(!has_completed(&street));
    street.tell(GO2, Event::ManeuverCompleted(running));
    assert_eq!(
        street.following(GO2).newest_request(),
        Some(running.request)
    );
    assert!(has_completed(&street));
}

/// Each step of each script is measured.
#[test]
fn an_allocation_is_counted() {
    let counted = allocation_counter::measure(|| drop(std::hint::black_box(Box::new(1))));
    assert_eq!(counted.count_total, 1);
}
