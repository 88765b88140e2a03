//! States that no step produces, each a small change away from one that a step did.
//!
//! A line of a table names a change, and then the places of the state's JSON that it sets: from the root where they begin with
//! `/`, otherwise in the robot's part in its session. A value is JSON, or one of the names that are given with the table.
#![cfg(feature = "serde")]

use crossguard_protocol::*;
use serde_json::{Value, json};

use crate::script::*;

fn json_of(robot: &Robot) -> Value {
    serde_json::to_value(robot).unwrap()
}

/// What the robot's part in its session is called, and its JSON.
fn part_of(robot: &Robot) -> (String, Value) {
    match &json_of(robot)["phase"] {
        Value::Object(phase) => {
            let (name, part) = phase.iter().next().unwrap();
            (name.clone(), part.clone())
        }
        _ => (String::new(), Value::Null),
    }
}

/// Asserts that `robot` is valid, and whether it still is after each change of the table.
#[track_caller]
fn assert_each(robot: &Robot, is_valid: bool, names: &[(&str, Value)], table: &str) {
    let config = Config::default();
    assert!(robot.is_valid(&config), "{robot:#?}");
    let part = part_of(robot).0;
    for line in table.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let (what, changes) = line.split_once(": ").expect("what it is");
        let mut other = json_of(robot);
        for change in changes.split("; ") {
            let (place, value) = change.split_once(" = ").expect("a place and a value");
            let known = names.iter().find(|(name, _)| *name == value);
            let value = known.map_or_else(
                || serde_json::from_str(value).expect("JSON"),
                |(_, value)| value.clone(),
            );
            let place = match place.strip_prefix('/') {
                Some(_) => place.to_owned(),
                None => format!("/phase/{part}/{place}"),
            };
            *other.pointer_mut(&place).expect("a place of the state") = value;
        }
        let other: Robot = serde_json::from_value(other).unwrap();
        assert_ne!(other, *robot, "{what} changes nothing");
        assert_eq!(other.is_valid(&config), is_valid, "{what}: {other:#?}");
    }
}

fn session(leader: StationId) -> Value {
    json!({ "leader": leader, "number": { "boot": 1, "count": 0 } })
}

/// A farewell to a session of this leader, and how long it stands.
fn left(leader: StationId, left: Option<u32>) -> Value {
    let farewell = json!({ "left": [session(leader), { "boot": 1, "count": 0 }] });
    json!({ "farewell": farewell, "left": left })
}

/// A farewell to the own session of this number.
fn ended(number: &Value) -> Value {
    json!({ "farewell": { "ended": [number, "aborted"] }, "left": 1 })
}

fn duty(leader: StationId) -> Value {
    let id = json!({ "session": session(leader), "request": 0 });
    json!({ "fallingBack": { "id": id, "task": TaskType::MOVE } })
}

#[test]
fn an_idle_robot() {
    let robot = Robot::new(ARI, 1);
    let names = [
        ("left", left(GO2, Some(1))),
        ("ended", ended(&json!({ "boot": 1, "count": 0 }))),
        ("duty", duty(GO2)),
    ];
    let breaks = r#"
        the RAM timer runs: /ram = 1
        the RAM timer is longer than it is ever armed: /ram = 1000000
        the identity is locked for nothing: /identity = {"locked": 1}
        the lock expires for nothing: /identity = "expiring"
        a farewell without a lock: /ram = 1; /farewell = left
    "#;
    assert_each(&robot, false, &names, breaks);
    let keeps = r#"
        it says farewell to its own session: /ram = 1; /identity = {"locked": 1}; /farewell = ended
        it says farewell while its lock expires: /ram = 1; /identity = "expiring"; /farewell = left
        it is unavailable: /availability = {"unavailable": "lowBattery"}
        it has a duty: /duty = duty
    "#;
    assert_each(&robot, true, &names, keeps);
}

#[test]
fn a_farewell() {
    let mut robot = json_of(&Robot::new(ARI, 1));
    robot["ram"] = json!(1);
    robot["identity"] = json!({ "locked": 1 });
    robot["farewell"] = left(GO2, Some(1));
    let robot: Robot = serde_json::from_value(robot).unwrap();
    let names = [
        ("own", left(ARI, Some(1))),
        ("endless", left(GO2, None)),
        ("due", left(GO2, Some(0))),
    ];
    let breaks = r#"
        it has left its own session: /farewell = own
        it stands without end: /farewell = endless
        it was due: /farewell = due
        no RAM says it: /ram = null
        the lock has no end: /identity = {"locked": null}
        the identity is not locked: /identity = "unlocked"
    "#;
    assert_each(&robot, false, &names, breaks);
}

#[test]
fn a_requester() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    street.tell(ARI, Event::PedestrianDetected(escort(2)));
    let part = part_of(&street[ARI]).1;
    let offer = |station: StationId, distance: u16| {
        let mut offer = part["offers"][0].clone();
        offer["station"] = json!(station);
        offer["distance"] = json!(distance);
        offer
    };
    let (first, second) = (offer(GO2, NEAR.0), part["offers"][1].clone());
    let config = Config::default();
    let names = [
        ("own", json!([offer(ARI, NEAR.0)])),
        ("disordered", json!([second, first])),
        ("twice", json!([first, first])),
        ("two", json!([first, offer(GO2, NEAR.0 + 1)])),
        (
            "three",
            json!([offer(SPOT, 1), offer(GO2, 2), offer(NAO, 2)]),
        ),
        ("long", json!(config.t_offer_lease().0 + 1)),
        ("longer", json!(config.settings().t_help.0 + 1)),
        ("ended", ended(&part["number"])),
        ("left", left(GO2, Some(1))),
        ("duty", duty(GO2)),
    ];
    let breaks = r#"
        a number of another life: number/boot = 2
        a number that was not given out: number/count = 1
        it is unavailable: /availability = {"unavailable": "notSafe"}
        it asks for nobody: request/followers = 0
        it asks for more than can follow: request/followers = 17
        it asks for nothing: request/tasks = 0
        it asks without end: help = null
        it never selects: selection = null
        it has an offer of its own: offers = own
        offers out of order: offers = disordered
        one offer twice: offers = twice
        two offers of one robot: offers = two
        the identity is not locked: /identity = "unlocked"
        the lock has expired: /identity = "expiring"
        no RAM: /ram = null
        the RAM was due: /ram = 0
        it says that its session is over: /farewell = ended
        it asks while it has a duty: /duty = duty
        an offer stands without end: offers/0/standing = null
        an offer stands longer than it is counted on: offers/0/standing = long
        it asks for longer than T_help: help = longer
    "#;
    assert_each(&street[ARI], false, &names, breaks);
    let keeps = "offers of several robots that differ: offers = three";
    assert_each(&street[ARI], true, &names, keeps);
    let mut alone = Street::new(&[ARI]);
    alone.tell(ARI, Event::PedestrianDetected(escort(2)));
    let keeps = "
        it still says farewell to a former session: /farewell = left
        it asks for as many as can follow: request/followers = 4
    ";
    assert_each(&alone[ARI], true, &names, keeps);
}

#[test]
fn a_helper() {
    let mut street = Street::new(&[ARI, GO2]);
    street.tell(ARI, Event::PedestrianDetected(escort(2)));
    let names = [("left", left(ARI, Some(1))), ("duty", duty(GO2))];
    let breaks = r#"
        a number of another life: number/boot = 2
        a number that was not given out: number/count = 1
        it is unavailable: /availability = {"unavailable": "notSafe"}
        it offers to itself: session/leader = 2
        it is reserved without end: reservation = null
        it can do nothing: capabilities = 0
        it offers while it has a duty: /duty = duty
        it has given out another number since: /nextCount = 2
        it says that it has left: /farewell = left
    "#;
    assert_each(&street[GO2], false, &names, breaks);
}

#[test]
fn a_leader() {
    let street = Street::with_roles(&[ARI, GO2, SPOT]);
    let part = part_of(&street[ARI]).1;
    let one = &part["members"][0];
    assert_eq!(one["echoed"], part["heartbeat"], "the newest was echoed");
    let command =
        json!({ "request": 0, "task": TaskType::MOVE, "repeats": 0, "acknowledgement": 1 });
    let names = [
        ("duty", duty(GO2)),
        ("twice", json!([one, one])),
        ("next", json!(street.leading(ARI).heartbeat.0 + 1)),
        ("most", json!(RequestId::MAX_PER_SESSION)),
        ("more", json!(RequestId::MAX_PER_SESSION + 1)),
        ("command", command),
    ];
    let breaks = r#"
        a number of another life: number/boot = 2
        a number that was not given out: number/count = 1
        it is unavailable: /availability = {"unavailable": "notSafe"}
        nobody follows: members = []
        more follow than were asked for: request/followers = 1
        more were asked for than can follow: request/followers = 17
        one follows twice: members = twice
        it follows itself: members/0/station = 1
        the corridor is open over robots that do nothing: corridor = "open"
        it yields with a clear road: yieldsTo = 3
        it yields, and people may cross: yieldsTo = 3; corridor = "open"
        it leads while it has a duty: /duty = duty
        it keeps a follower without end: members/0/lease = {"stands": null}
        so it does one without a lease: members/0/lease = {"expired": null}
        a lease on one that has not joined: members/0/echoed = null
        it commanded one that has not joined: members/0/echoed = null; members/0/lease = {"expired": 1}; members/0/nextRequest = 1; members/0/outstanding = command
        it echoed what was not sent yet: members/0/echoed = next
        more commands than a session may have: members/0/nextRequest = more
    "#;
    assert_each(&street[ARI], false, &names, breaks);
    let keeps = r#"
        it yields while the road clears: yieldsTo = 3; corridor = "clearing"
        one has not joined: members/0/echoed = null; members/0/lease = {"expired": 1}
        as many commands as a session may have: members/0/nextRequest = most
    "#;
    assert_each(&street[ARI], true, &names, keeps);
}

/// `GO2` executes a command of `ARI`, which waits for the acknowledgement of another one.
fn at_work() -> Street {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    street.part(ARI, GO2);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    street
}

#[test]
fn a_leader_with_commands() {
    let config = Config::default();
    let (n_ack, t_exec) = (config.settings().n_ack, config.t_exec(TaskType::MOVE).0);
    let names = [
        ("n_ack", json!(n_ack)),
        ("n_ack + 1", json!(n_ack + 1)),
        ("t_exec - 1", json!(t_exec - 1)),
        ("t_exec + 1", json!(t_exec + 1)),
    ];
    let breaks = r#"
        one repeat too many: members/0/outstanding/repeats = n_ack + 1
        it waits for an answer without end: members/0/outstanding/acknowledgement = null
        an older command is outstanding: members/0/outstanding/request = 0
        a command that was not given is outstanding: members/0/outstanding/request = 2
        there was a command since: members/0/nextRequest = 3
        what is outstanding is acknowledged: members/0/order/request = 1
        what was not given is acknowledged: members/0/outstanding = null; members/0/order/request = 2
        it waits for the end without limit: members/0/order/execution = null
        it waits longer than the task may take: members/0/order/execution = t_exec + 1
        it waits for the end of what is over: members/0/order/progress = "completed"
        orders for one that has not joined: members/0/echoed = null; members/0/lease = {"expired": 1}; members/0/outstanding = null
    "#;
    assert_each(&at_work()[ARI], false, &names, breaks);
    let keeps = r#"
        the last repeat: members/0/outstanding/repeats = n_ack
        nothing is outstanding: members/0/outstanding = null
        what is over has no limit: members/0/order/progress = "completed"; members/0/order/execution = null
        nearly all the time of the task is left: members/0/order/execution = t_exec - 1
    "#;
    assert_each(&at_work()[ARI], true, &names, keeps);
}

#[test]
fn a_follower() {
    let names = [("left", left(ARI, Some(1))), ("duty", duty(ARI))];
    let breaks = r#"
        an offer of another life: offer/boot = 2
        an offer that was not made: offer/count = 1
        it leads itself: session/leader = 2
        it executes while it has a duty: /duty = duty
        it executes while unavailable: /availability = {"unavailable": "notSafe"}
        it trusts in its leader without end: contact = {"fresh": null}
        it stays without end: job = null; contact = {"lost": null}
        it executes after contact was lost: contact = {"lost": 1}
        it reports what the leader alone can know: job/progress = {"failed": "executionLimit"}
        what it refused is as old as what it accepted: refused = {"request": 0, "reason": "unsupportedTask"}
        it says that it has left: /farewell = left
    "#;
    assert_each(&at_work()[GO2], false, &names, breaks);
    let keeps = r#"
        it is idle and unavailable: job = null; /availability = {"unavailable": "notSafe"}
        it is done: job/progress = "completed"; contact = {"lost": 1}
        it is in position: job/progress = "inPosition"
        it has a duty and executes nothing: job = null; /duty = duty
        it refused something newer: refused = {"request": 1, "reason": "unsupportedTask"}
        it refused and accepted nothing: job = null; refused = {"request": 0, "reason": "unsupportedTask"}
    "#;
    assert_each(&at_work()[GO2], true, &names, keeps);
}
