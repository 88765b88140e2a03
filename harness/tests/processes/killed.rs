//! `kill -9` of either robot at moments all over a crossing: the other ends idle by its own timers, and
//! the killed one takes part again after it has booted. Also while it starts.

use std::fs;
use std::path::Path;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crossguard_robot::boot;
use crossguard_testkit::command::*;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_mins(1);

/// How long a crossing takes, from before the request to after the farewell, in ms.
const CROSSING_MS: u64 = 4_200;

/// How many moments of it are tried for each robot.
const MOMENTS: u64 = 6;

/// What ARI is told to do a crossing.
const CROSS: &str = "wait 0.3\ndetect\nuntil maneuver-executing 30\nuntil idle 30\n";

/// A robot that takes about 3 s for a crossing.
fn robot(folder: &Path, name: &str, station: u32, port: u16, peer: u16) -> String {
    let path = robot_file(folder, name, station, port, peer);
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("speed = 40.0", "speed = 10.0")).unwrap();
    path
}

/// Kills one of two robots this long after they were started, and boots it again.
fn kill(victim: usize, after_ms: u64) {
    let case = format!("{} killed after {after_ms} ms", ["ARI", "Go2"][victim]);
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot(folder.path(), "Go2", 2, port + 1, port);
    let configs = [&ari, &go2];
    let mut robots = configs.map(|config| start(config));
    type_to(&mut robots[0], "wait 0.3\ndetect\n");
    std::thread::sleep(Duration::from_millis(after_ms));
    signal(&robots[victim], "-KILL");
    wait_for(&mut robots[victim], PATIENCE);
    let before = folder.path().join("before.log");
    fs::rename(Path::new(configs[victim]).with_extension("log"), &before).unwrap();

    // The survivor becomes idle, whichever is silent, and crosses with the one that is back.
    robots[victim] = start(configs[victim]);
    // A follower that fell back helps again once somebody says that the road is clear.
    type_to(&mut robots[1], "until idle 30\nclear\n");
    let come_to_rest = if victim == 0 {
        "wait 8\n"
    } else {
        // The pedestrian may have been on the road: then it asks nobody before the road is clear.
        "until idle 30\nwait 6\n"
    };
    type_to(&mut robots[0], &format!("{come_to_rest}{CROSS}quit\n"));
    assert_eq!(wait_for(&mut robots[0], PATIENCE).code(), Some(0), "{case}");
    type_to(&mut robots[1], "quit\n");
    assert_eq!(wait_for(&mut robots[1], PATIENCE).code(), Some(0), "{case}");
    // It may have been killed before it had a boot counter, or after.
    let boot_of = |log: &str| {
        let first = log.lines().next()?;
        serde_json::from_str::<Value>(first).ok()?["boot"].as_u64()
    };
    let boots = [
        boot_of(&fs::read_to_string(&before).unwrap()),
        boot_of(&log_of(configs[victim])),
    ];
    assert!(boots[0] < boots[1], "{case}: {boots:?}");
    assert!(log_of(&ari).contains("\"taskCompleted\""), "{case}");

    let logs = [ari, go2].map(|config| {
        let log = Path::new(&config).with_extension("log");
        log.display().to_string()
    });
    let before = before.display().to_string();
    let all = [&before, &logs[0], &logs[1]].map(String::as_str);
    let written = if boots[0].is_some() { &all } else { &all[1..] };
    let output = run(&[&["validate"], written].concat());
    let said = stdout(&output) + &stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{case}: {said}");
}

#[test]
fn the_other_robot_comes_to_rest_whenever_one_is_killed_and_both_cross_again() {
    // Other moments in every run; the case is in the message of a failure.
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap();
    let jitter_ms = u64::from(now.subsec_millis()) % (CROSSING_MS / MOMENTS);
    std::thread::scope(|scope| {
        for moment in 0..MOMENTS {
            for victim in [0, 1] {
                let after_ms = moment * CROSSING_MS / MOMENTS + jitter_ms;
                scope.spawn(move || kill(victim, after_ms));
            }
        }
    });
}

#[test]
fn robots_that_are_killed_while_they_start_never_boot_with_a_counter_twice() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let counter = folder.path().join("ARI.boot");
    let mut booted = Vec::new();
    for attempt in 0..24 {
        let mut robot = start(&config);
        std::thread::sleep(Duration::from_millis(attempt * 2));
        signal(&robot, "-KILL");
        wait_for(&mut robot, PATIENCE);
        let log = log_of(&config);
        let first = log
            .lines()
            .next()
            .and_then(|line| serde_json::from_str(line).ok());
        let first: Option<serde_json::Value> = first;
        booted.extend(first.and_then(|record| record["boot"].as_u64()));
        if let Ok(text) = fs::read_to_string(&counter) {
            assert!(text.ends_with('\n'), "{text:?}");
        }
    }
    assert!(!booted.is_empty(), "none of them came to start");
    assert!(booted.is_sorted_by(|a, b| a < b), "{booted:?}");
    let last = booted.last().copied().unwrap_or(0);
    assert!(u64::from(boot::take(&counter).unwrap().counter) > last);
}
