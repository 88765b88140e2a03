//! One leader, several followers: each with its own command, none touched by the loss of another.

use crossguard_protocol::*;

use crate::script::*;

fn team() -> Street {
    Street::with_roles(&[ARI, GO2, SPOT, NAO, PEPPER])
}

fn member(street: &Street, station: StationId) -> Member {
    *street.leading(ARI).member(station).unwrap()
}

#[test]
fn each_follower_gets_its_own_command() {
    let mut street = team();
    let orders = [
        (GO2, TaskType::MOVE),
        (SPOT, TaskType::BLOCK),
        (NAO, TaskType::BLOCK),
        (PEPPER, TaskType::INITIAL_POS),
    ];
    for (follower, task) in orders {
        street.tell(ARI, order(follower, task));
    }
    for (follower, task) in orders {
        let maneuver = street.executes(follower);
        assert_eq!((maneuver.task, maneuver.id.request), (task, RequestId(0)));
    }
}

#[test]
fn the_numbers_of_one_follower_are_not_those_of_another() {
    let mut street = team();
    let order = |follower| order(follower, TaskType::BLOCK);
    for _ in 0..3 {
        street.tell(ARI, order(GO2));
    }
    street.tell(ARI, order(SPOT));
    assert_eq!(street.executes(GO2).id.request, RequestId(2));
    assert_eq!(street.executes(SPOT).id.request, RequestId(0));
}

#[test]
fn losing_one_follower_leaves_the_records_of_the_others_unchanged() {
    let mut street = team();
    for follower in [GO2, SPOT, NAO, PEPPER] {
        street.tell(ARI, order(follower, TaskType::BLOCK));
    }
    let others = [GO2, NAO, PEPPER];
    let before = others.map(|station| member(&street, station));
    street.tell(SPOT, Event::LeaveRequested);
    assert_eq!(street.leading(ARI).member(SPOT), None);
    assert_eq!(others.map(|station| member(&street, station)), before);
    for station in others {
        assert_eq!(street[station].state(), State::ManeuverExecuting);
    }
}

#[test]
fn a_silent_follower_is_given_up_and_the_others_go_on() {
    let mut street = team();
    street.part(ARI, SPOT);
    for follower in [GO2, SPOT] {
        street.tell(ARI, order(follower, TaskType::BLOCK));
    }
    street.pass(2_400);
    assert!(street.was_told(
        ARI,
        Notice::FollowerGone(SPOT, GoneReason::NoAcknowledgement)
    ));
    assert_eq!(street[GO2].state(), State::ManeuverExecuting);
    assert_eq!(street.leading(ARI).members.len(), 3);
    // If it can hear again, it learns that it is no longer listed.
    street.heal();
    street.pass(100);
    assert_eq!(street[SPOT].role(), Role::None);
}

#[test]
fn the_leader_is_at_work_while_any_follower_is() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    for follower in [GO2, SPOT] {
        street.tell(ARI, order(follower, TaskType::INITIAL_POS));
    }
    let id = street.maneuver(ARI, 0);
    street.tell(GO2, Event::ManeuverCompleted(id));
    assert_eq!(street[ARI].state(), State::ManeuverExecuting);
    street.tell(SPOT, Event::ManeuverCompleted(id));
    assert_eq!(street[ARI].state(), State::RoleEstablished);
}

#[test]
fn the_end_of_the_session_frees_them_all() {
    let mut street = team();
    street.tell(ARI, Event::TaskCompleted);
    for station in [ARI, GO2, SPOT, NAO, PEPPER] {
        assert_eq!(street[station].state(), State::Idle);
    }
}

#[test]
fn one_step_of_a_full_team_stays_within_the_capacity_for_outputs() {
    let everybody = [ARI, GO2, SPOT, NAO, PEPPER];
    // The leader sleeps until everything is due at once: under an open corridor, and with commands that
    // nobody acknowledges.
    let open = Street::open(&everybody, TaskType::BLOCK);
    let mut commanded = team();
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
