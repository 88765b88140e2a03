//! What a running robot shows: a status line, and what it drops with its cause.

use std::net::{TcpListener, UdpSocket};
use std::process::Stdio;
use std::time::Duration;

use crossguard_testkit::command::*;

#[test]
fn what_a_robot_drops_is_told_with_its_cause_and_a_status_line_counts_it() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let arguments = ["-vv", "run", "--config", &ari, "--status", "always"];
    let mut robot = crossguard(&arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let stranger = UdpSocket::bind("127.0.0.1:0").unwrap();
    for _ in 0..6 {
        std::thread::sleep(Duration::from_millis(300));
        stranger.send_to(&[0xA5; 80], ("127.0.0.1", port)).unwrap();
    }
    type_to(&mut robot, "leave\nquit\n");
    let output = robot.wait_with_output().unwrap();
    let said = stderr(&output);
    assert!(output.status.success(), "{said}");
    for expected in [
        "INFO robot{name=\"ARI\"}: started station=1 boot=1",
        "WARN robot{name=\"ARI\"}: dropped layer=packet cause=",
        "DEBUG robot{name=\"ARI\"}: ignored cause=not in session input=leave requested",
        "ARI Idle, available; sent ",
    ] {
        assert!(said.contains(expected), "'{expected}' is not in:\n{said}");
    }
    let line = |text: &&str| text.contains(" heard 0 of 0 stations, ");
    let last = said.lines().rfind(line).unwrap();
    assert!(!last.contains(", 0 dropped or ignored"), "{last}");
}

#[test]
fn without_a_terminal_nothing_is_told_that_was_not_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let output = run_with(&["run", "--config", &ari], b"wait 0.3\nquit\n");
    assert!(output.status.success());
    assert_eq!(stderr(&output), "");
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let arguments = ["run", "--config", &ari, "--metrics", &address];
    assert_refused(&run(&arguments), &format!("--metrics {address}: "));
    let arguments = ["run", "--config", &ari, "--metrics", "here"];
    assert_refused(
        &run(&arguments),
        "a port from 0 to 65535, or an address and a port like 127.0.0.1:9100, is wanted",
    );
}
