//! Hazard: a guard in position drifts away or loses its pose, and *in position* stands at its leader, which shows go. The
//! corridor closes in the step in which the leader hears of it, and no late RAM brings the position back.

use crossguard_protocol::*;

use crate::script::*;

/// `GO2` blocks for `ARI` from its place, and the corridor is open.
fn guarded() -> (Street, ManeuverId) {
    let mut street = Street::open(&[ARI, GO2], TaskType::BLOCK);
    let id = street.maneuver(ARI, 0);
    street.pass(150);
    street.forget();
    (street, id)
}

const CLOSED: CorridorClosure = CorridorClosure::NotEngaged(GO2, Disengagement::NotInPosition);

#[test]
fn the_corridor_closes_at_once() {
    let (mut street, id) = guarded();
    let left = street.tell(GO2, Event::OutOfPosition(id));
    assert!(left.iter().any(sends_ram), "its RAM says so at once");
    assert!(street.has_put_out(ARI, Output::CorridorClosed(CLOSED)));
    assert!(street.was_told(ARI, Notice::ManeuverReported(GO2, id)));
    let again = street.tell(GO2, Event::OutOfPosition(id));
    assert_ignored(&again, Ignored::NothingNew);
    assert_eq!(street.executes(GO2).id, id, "the maneuver runs on");
}

#[test]
fn a_position_that_is_taken_again_counts_from_the_next_heartbeat_on() {
    let (mut street, id) = guarded();
    street.tell(GO2, Event::OutOfPosition(id));
    street.tell(GO2, Event::InPosition(id));
    let refused = street.tell(ARI, Event::OpenCorridor);
    assert!(matches!(refused.ignored(), Some(Ignored::NotEngaged(..))));
    street.pass(200);
    assert!(street.was_told(ARI, Notice::ManeuverInPosition(GO2, id)));
    assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
}

#[test]
fn late_ram_do_not_bring_a_position_back() {
    let (mut street, id) = guarded();
    let in_position = street[GO2].ram();
    street.tell(GO2, Event::OutOfPosition(id));
    for _ in 0..3 {
        let late = street.hears_ram(ARI, in_position);
        assert_ignored(&late, Ignored::NothingNew);
        street.pass(100);
    }
    assert_eq!(street.corridor(ARI), Corridor::Clearing);
}

#[test]
fn a_loss_counts_also_where_another_ram_of_its_heartbeat_came_first() {
    let (mut street, id) = guarded();
    street.cut(GO2, ARI);
    let before = street[GO2].ram();
    street.tell(GO2, Event::OutOfPosition(id));
    let lost = street[GO2].ram();
    street.heal();
    street.hears_ram(ARI, before);
    assert_eq!(street.corridor(ARI), Corridor::Open);
    street.hears_ram(ARI, lost);
    assert_eq!(street.corridor(ARI), Corridor::Clearing);
}

#[test]
fn only_the_maneuver_that_runs_leaves_its_position() {
    let (mut street, id) = guarded();
    street.tell(GO2, Event::ManeuverFailed(id));
    let over = street.tell(GO2, Event::OutOfPosition(id));
    assert_ignored(&over, Ignored::NotExecuting);
    let leader = street.tell(ARI, Event::OutOfPosition(id));
    assert_ignored(&leader, Ignored::NotExecuting);
}
