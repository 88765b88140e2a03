//! A reader of standard output that does not read: the robot goes on, and hears a signal.

use std::path::Path;
use std::process::{Child, Stdio};
use std::time::Duration;

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

/// Waits until Go2, which is configured by the file `config`, has seen the whole crossing.
fn assert_sees_all(dog: &mut Child, config: &str) {
    type_to(dog, "until maneuver-executing 30\nuntil idle 30\nquit\n");
    assert_eq!(wait_for(dog, PATIENCE).code(), Some(0));
    let log = log_of(config);
    assert!(log.contains("\"taskCompleted\"") && !log.contains("fallBack"));
}

/// ARI, whose output nobody reads, in a crossing with Go2. It is then told to stop; what it complained.
fn cross_unread(more: &[&str], chatter: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let mut dog = start(&go2);
    let log = folder.path().join("ari.jsonl");
    let log = log.to_str().unwrap();
    let mut humanoid: Child = crossguard(&["run", "--config", &ari, "--log", log])
        .args(more)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    type_to(&mut humanoid, chatter);
    type_to(&mut humanoid, "wait 0.3\ndetect\n");
    // The dog sees the whole crossing, although nobody reads what its leader says.
    assert_sees_all(&mut dog, &go2);
    signal(&humanoid, "-TERM");
    let status = wait_for(&mut humanoid, PATIENCE);
    // The log has all, and is that of a robot that stopped in order.
    let text = std::fs::read_to_string(Path::new(log)).unwrap();
    let last = records(&text).pop().unwrap();
    assert_eq!(last["entry"], "stopped");
    let verdict = run(&["validate", log]);
    assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
    let output = humanoid.wait_with_output().unwrap();
    assert_eq!(status.code(), Some(3), "{}", stderr(&output));
    stderr(&output)
}

#[test]
fn a_person_who_looks_away_does_not_stop_the_robot() {
    // More than a pipe holds.
    let complaint = cross_unread(&[], &"help\n".repeat(200));
    assert!(
        complaint.contains("standard output is not read"),
        "{complaint}"
    );
}

#[test]
fn a_program_that_does_not_take_the_log_does_not_stop_the_robot() {
    let complaint = cross_unread(&["--json"], "wait 2\n");
    assert!(
        complaint.contains("standard output is not read"),
        "{complaint}"
    );
}

#[test]
fn who_asks_for_all_details_and_does_not_read_them_does_not_stop_the_robot() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let mut dog = start(&go2);
    let mut humanoid = crossguard(&["-vvv", "run", "--config", &ari, "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Long enough that more is told than a pipe holds.
    type_to(&mut humanoid, "wait 4\ndetect\n");
    assert_sees_all(&mut dog, &go2);
    signal(&humanoid, "-TERM");
    let output = humanoid.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.len() > 65_536, "{}", output.stderr.len());
}
