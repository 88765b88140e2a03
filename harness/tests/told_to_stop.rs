//! SIGTERM in the middle of a maneuver: the robot that gets it leaves its session by name, and says so before
//! it ends.

use std::path::Path;
use std::time::Duration;

use crossguard_testkit::command::*;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_mins(1);

/// The logs of ARI and Go2 after one of them was told to stop while Go2 walks.
fn logs_after_a_stop_of(stopped: usize) -> [Vec<Value>; 2] {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let configs = [("ARI", 1, port, port + 1), ("Go2", 2, port + 1, port)];
    let configs = configs.map(|(name, station, port, peer)| {
        let path = robot_file(folder.path(), name, station, port, peer);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.replace("speed = 40.0", "speed = 1.0")).unwrap();
        path
    });
    let mut robots = [&configs[0], &configs[1]].map(|config| start(config));
    type_to(
        &mut robots[0],
        "wait 0.3\ndetect\nuntil maneuver-executing 30\n",
    );
    type_to(&mut robots[1], "until maneuver-executing 30\n");
    std::thread::sleep(Duration::from_millis(1_800));
    signal(&robots[stopped], "-TERM");
    assert_eq!(wait_for(&mut robots[stopped], PATIENCE).code(), Some(0));
    type_to(&mut robots[1 - stopped], "until idle 30\nquit\n");
    let other = wait_for(&mut robots[1 - stopped], PATIENCE);
    assert_eq!(other.code(), Some(0));
    let paths = [&configs[0], &configs[1]].map(|config| {
        let path = Path::new(config).with_extension("log");
        path.display().to_string()
    });
    let output = run(&["validate", &paths[0], &paths[1]]);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
    [&configs[0], &configs[1]].map(|config| records(&log_of(config)))
}

/// What a robot was told by its own transition function, as text.
fn outputs(log: &[Value]) -> String {
    let outputs = log.iter().filter_map(|line| line.get("outputs"));
    outputs.map(ToString::to_string).collect()
}

fn assert_stopped_in_order(log: &[Value]) {
    assert_eq!(log.last().unwrap()["entry"], "stopped");
    assert!(log.iter().any(|line| !line["state"]["farewell"].is_null()));
}

#[test]
fn a_leader_ends_its_session_and_its_follower_falls_back_at_once() {
    let [ari, go2] = logs_after_a_stop_of(0);
    assert_stopped_in_order(&ari);
    assert!(outputs(&ari).contains("\"leaveRequested\""));
    let go2 = outputs(&go2);
    assert!(
        go2.contains("fallBack") && go2.contains("sessionEnded"),
        "{go2}"
    );
    assert!(
        !go2.contains("contactLost"),
        "released by name, not by silence"
    );
}

#[test]
fn a_follower_leaves_its_session_and_its_leader_does_not_wait_for_it() {
    let [ari, go2] = logs_after_a_stop_of(1);
    assert_stopped_in_order(&go2);
    let ari = outputs(&ari);
    assert!(
        ari.contains("followerGone") && ari.contains("noFollowers"),
        "{ari}"
    );
    assert!(
        !ari.contains("leaseExpired"),
        "told by name, not by silence"
    );
}
