//! Hazard: a crossing begins that cannot end, because the identity lock or an execution limit runs out in it.
//! The corridor opens only where both leave `t_cross`.

use crossguard_protocol::*;

use crate::script::*;

fn refusal(street: &mut Street) -> Option<Ignored> {
    street.tell(ARI, Event::OpenCorridor).ignored()
}

#[test]
fn an_execution_limit_leaves_time_to_cross_or_the_corridor_stays_closed() {
    // T_exec of `move` is 60 s, and a pedestrian needs 30 s.
    for (passed, expected) in [(30_000, None), (30_001, Some(Ignored::NotEnoughTime))] {
        let mut street = Street::executing(TaskType::MOVE);
        street.pass(passed);
        assert_eq!(refusal(&mut street), expected, "after {passed} ms");
    }
}

#[test]
fn every_follower_has_enough_time() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    street.pass(30_001);
    street.tell(ARI, order(SPOT, TaskType::MOVE));
    assert_eq!(refusal(&mut street), Some(Ignored::NotEnoughTime));
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(refusal(&mut street), None, "a new command has all its time");
}

#[test]
fn the_identity_lock_leaves_time_to_cross_or_the_corridor_stays_closed() {
    let settings = Settings {
        t_lock: Millis(80_000),
        ..Settings::default()
    };
    // The session ends 1 s before the lock; the roles are there after 400 ms.
    for (passed, expected) in [(48_600, None), (48_601, Some(Ignored::NotEnoughTime))] {
        let mut street = Street::with_roles_and_settings(&[ARI, GO2], settings.clone());
        street.pass(passed);
        street.tell(ARI, order(GO2, TaskType::MOVE));
        assert_eq!(refusal(&mut street), expected, "after {passed} ms");
    }
}
