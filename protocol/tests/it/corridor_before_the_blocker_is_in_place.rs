//! Hazard: the corridor opens while the blocker is still on its way. `executing` is reported on acceptance;
//! a task that guards from a place asks for `inPosition`.

use crossguard_protocol::*;

use crate::script::*;

fn refusal(street: &mut Street) -> Option<Ignored> {
    street.tell(ARI, Event::OpenCorridor).ignored()
}

const ON_ITS_WAY: Ignored = Ignored::NotEngaged(GO2, Disengagement::NotInPosition);

#[test]
fn a_blocker_that_is_on_its_way_holds_nobody_back() {
    let mut street = Street::executing(TaskType::BLOCK);
    assert_eq!(refusal(&mut street), Some(ON_ITS_WAY));
    street.pass(25_000);
    assert_eq!(refusal(&mut street), Some(ON_ITS_WAY), "25 s of 25 m");
    street.in_position(GO2);
    let id = street.maneuver(ARI, 0);
    assert!(street.was_told(ARI, Notice::ManeuverInPosition(GO2, id)));
    assert_eq!(refusal(&mut street), None);
}

#[test]
fn an_escort_moves_along_and_needs_no_place() {
    let mut street = Street::executing(TaskType::MOVE);
    assert_eq!(refusal(&mut street), None);
}

#[test]
fn each_of_two_blockers_must_be_there() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    for guard in [GO2, SPOT] {
        street.tell(ARI, order(guard, TaskType::BLOCK));
    }
    street.in_position(SPOT);
    assert_eq!(refusal(&mut street), Some(ON_ITS_WAY));
    street.in_position(GO2);
    assert_eq!(refusal(&mut street), None);
}

#[test]
fn only_the_maneuver_that_runs_gets_into_position_and_only_once() {
    let mut street = Street::executing(TaskType::INITIAL_POS);
    let first = street.maneuver(GO2, 0);
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    let early = street.tell(GO2, Event::InPosition(first));
    assert_ignored(&early, Ignored::NotExecuting);
    assert_eq!(refusal(&mut street), Some(ON_ITS_WAY));
    street.in_position(GO2);
    let again = street.tell(GO2, Event::InPosition(street.maneuver(GO2, 1)));
    assert_ignored(&again, Ignored::NothingNew);
    let nowhere = street.tell(ARI, Event::InPosition(first));
    assert_ignored(&nowhere, Ignored::NotExecuting);
}

#[test]
fn a_late_report_of_the_way_does_not_undo_the_position() {
    let mut street = Street::executing(TaskType::BLOCK);
    let on_the_way = street[GO2].ram();
    street.in_position(GO2);
    assert_eq!(refusal(&mut street), None);
    let outputs = street.hears_ram(ARI, on_the_way);
    assert_ignored(&outputs, Ignored::NothingNew);
    assert_eq!(street.corridor(ARI), Corridor::Open);
}

#[test]
fn the_settings_say_which_tasks_guard_from_a_place() {
    let settings = Settings {
        holding: TaskSet::of(&[TaskType::MOVE, TaskType::BLOCK]),
        ..Settings::default()
    };
    let mut street = Street::with_roles_and_settings(&[ARI, GO2], settings);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(refusal(&mut street), Some(ON_ITS_WAY));
    street.in_position(GO2);
    assert_eq!(refusal(&mut street), None);
}
