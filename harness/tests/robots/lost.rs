//! Losses in the middle of a crossing, and what each log must have then: the sign ends before a guard falls back,
//! and whatever is left comes to rest.

use std::fs;
use std::path::Path;
use std::time::Duration;

use crossguard_robot::boot;
use crossguard_testkit::command::*;
use serde_json::Value;

use crate::street::{ARI, CLOCKS_MS, CROSS, GO2, Street, side_by_side, sign_ended_ms};

struct Row {
    what: &'static str,
    /// Happens while the corridor is open and Go2 walks.
    lose: fn(&mut Street),
    guard_leaves: bool,
    /// Entries that the logs of ARI and Go2 have, and entries that they lack.
    has: [&'static [&'static str]; 2],
    lacks: [&'static [&'static str]; 2],
}

/// A row that says nothing.
const ROW: Row = Row {
    what: "",
    lose: |_| (),
    guard_leaves: false,
    has: [&[], &[]],
    lacks: [&[], &[]],
};

const ROWS: [Row; 6] = [
    Row {
        what: "the leader is killed and boots again",
        lose: |street| {
            street.signal(ARI, "-KILL");
            street.until(GO2, "contactLost");
            // Its word is about a road on which nobody sets out any more.
            street.say(GO2, "until idle 30\nwait 2.5\nclear\n");
            street.boot(ARI);
            street.say(ARI, CROSS);
            street.until(ARI, "taskCompleted");
        },
        has: [&["taskCompleted"], &["fallBack"]],
        ..ROW
    },
    Row {
        what: "the follower is killed and boots again",
        lose: |street| {
            street.signal(GO2, "-KILL");
            street.until(ARI, "noFollowers");
            street.boot(GO2);
            // A person may have been on the road: it asks nobody before the road is clear.
            street.say(ARI, "until idle 30\nwait 6\n");
            street.say(ARI, CROSS);
            street.until(ARI, "taskCompleted");
        },
        has: [&["corridorClosed", "leaseExpired"], &["taskCompleted"]],
        ..ROW
    },
    Row {
        what: "the leader hangs for longer than its sign may show go",
        lose: |street| {
            street.signal(ARI, "-STOP");
            street.until(GO2, "contactLost");
            street.signal(ARI, "-CONT");
        },
        has: [
            &["corridorClosed", "waited too long"],
            &["fallBack", "contactLost"],
        ],
        ..ROW
    },
    Row {
        what: "the follower hangs for a moment",
        lose: |street| {
            street.signal(GO2, "-STOP");
            std::thread::sleep(Duration::from_millis(400));
            street.signal(GO2, "-CONT");
            street.until(ARI, "taskCompleted");
        },
        has: [&[], &["waited too long"]],
        lacks: [&[], &["fallBack"]],
        ..ROW
    },
    Row {
        what: "the leader is told to stop",
        lose: |street| street.signal(ARI, "-TERM"),
        has: [
            &["leaveRequested", "corridorClosed"],
            &["fallBack", "sessionEnded"],
        ],
        // Released by name, not by silence.
        lacks: [&[], &["contactLost"]],
        ..ROW
    },
    Row {
        what: "the follower is told to stop",
        guard_leaves: true,
        lose: |street| street.signal(GO2, "-TERM"),
        has: [&["followerGone", "noFollowers", "corridorClosed"], &[]],
        lacks: [&["leaseExpired"], &[]],
    },
];

fn lose(row: &Row) {
    let what = row.what;
    let mut street = Street::started(&[("speed = 40.0", "speed = 2.0")]);
    street.say(ARI, "wait 0.5\ndetect\n");
    street.until(ARI, "\"corridorOpened\"");
    std::thread::sleep(Duration::from_millis(300));
    (row.lose)(&mut street);
    let logs = street.end();
    for robot in [ARI, GO2] {
        let log = &logs[robot];
        assert_eq!(log.last().unwrap()["entry"], "stopped", "{what}");
        let log: String = log.iter().map(Value::to_string).collect();
        let missing = row.has[robot].iter().find(|it| !log.contains(**it));
        assert_eq!(missing, None, "{what}: not in the log of {robot}");
        let wrong = row.lacks[robot].iter().find(|it| log.contains(**it));
        assert_eq!(wrong, None, "{what}: in the log of {robot}");
    }
    let [of_leader, of_follower] = [ARI, GO2].map(|robot| happenings(&street.first_log(robot)));
    let fell_back_ms = first(&of_follower, |it| it.get("fallBack").is_some());
    // The leader closes the corridor before it releases anybody.
    let mut outputs = of_leader.iter().map(|(_, it)| it);
    let is_closing = |it: &Value| it.get("corridorClosed").is_some();
    let is_release = |it: &Value| it["notify"].get("sessionEnded").is_some();
    let next = outputs.find(|it| is_closing(it) || is_release(it));
    assert!(next.is_none_or(is_closing), "{what}");
    // The sign ends first, but where the guard itself is told to leave.
    let ended_ms = sign_ended_ms(&of_leader) - CLOCKS_MS;
    let is_first = row.guard_leaves || fell_back_ms.is_none_or(|ms| ended_ms <= ms);
    assert!(is_first, "{what}: {ended_ms}, {fell_back_ms:?}");
}

#[test]
fn whatever_is_lost_the_sign_ends_before_a_guard_falls_back_and_all_come_to_rest() {
    side_by_side(&ROWS, lose);
}

#[test]
fn robots_that_are_killed_while_they_start_never_boot_with_a_counter_twice() {
    let street = Street::new(&[]);
    let (config, counter) = (&street.configs[ARI], street.path("ARI.boot"));
    let mut booted = Vec::new();
    // The later ones get longer to start, and busy cores need longer.
    for attempt in 0..200 {
        if attempt > 24 && booted.len() > 2 {
            break;
        }
        let robot = Killed(start(config));
        std::thread::sleep(Duration::from_millis(attempt * 8));
        drop(robot);
        let log = street.log(ARI);
        let first = log.lines().next().map(serde_json::from_str::<Value>);
        booted.extend(first.and_then(|it| it.ok()?["boot"].as_u64()));
        if let Ok(text) = fs::read_to_string(&counter) {
            assert!(text.ends_with('\n'), "{text:?}");
        }
    }
    assert!(!booted.is_empty(), "none of them came to start");
    assert!(booted.is_sorted_by(|a, b| a < b), "{booted:?}");
    let last = boot::take(Path::new(&counter)).unwrap().counter;
    assert!(Some(&u64::from(last)) > booted.last());
}
