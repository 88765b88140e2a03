//! The transition function allocates nothing. Every step of every script is measured, see
//! `script/mod.rs`; here, that the measurement sees an allocation, and a run through all stages.

use crossguard_protocol::*;

use crate::script::*;

#[test]
fn the_count_sees_what_is_allocated() {
    let counted = allocation_counter::measure(|| drop(std::hint::black_box(Box::new(1))));
    assert_eq!(counted.count_total, 1);
}

#[test]
fn a_crossing_with_a_whole_team_and_its_loss_allocates_nothing() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT, NAO, PEPPER]);
    for follower in [GO2, SPOT, NAO, PEPPER] {
        let task = TaskType::MOVE;
        street.tell(ARI, order(follower, task));
    }
    street.tell(ARI, Event::OpenCorridor);
    let maneuver = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(maneuver));
    street.tell(ARI, Event::LeaveRequested);
    street.pass(10_000);
    assert_eq!(street[ARI].state(), State::Idle);
}
