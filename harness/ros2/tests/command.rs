//! The program: how it ends, and what it refuses.

mod support;

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command as Process, Output, Stdio};
use std::time::Instant;

use crossguard_judge::validate;
use crossguard_ros2::msgs::{Command, Status};
use support::{Observer, PATIENCE, free_endpoint, meeting, robot, two_free_ports};

fn program(arguments: &[&str]) -> Process {
    let mut program = Process::new(env!("CARGO_BIN_EXE_crossguard-ros2"));
    program.args(arguments).env_remove("ROS_DOMAIN_ID");
    program
}

fn assert_refused(output: &Output, cause: &str) {
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.contains(cause), "'{cause}' is not in: {message}");
}

fn wait_for(child: &mut Child) -> Option<i32> {
    let deadline = Instant::now() + PATIENCE;
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        if Instant::now() > deadline {
            let _ = child.kill();
            panic!("still there after {PATIENCE:?}");
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
}

#[test]
fn bad_usage_and_input_are_refused_with_a_cause() {
    let offline = ["--no-connect", "--zenoh-listen", "tcp/127.0.0.1:0"];
    let refused = |arguments: &[&str]| program(arguments).args(offline).output().unwrap();
    let nowhere = ["--config", "nowhere.toml"];
    assert_refused(&program(&[]).output().unwrap(), "--config");
    let named = [&nowhere[..], &["--name", "a/b"]].concat();
    assert_refused(&refused(&named), "is not a name in ROS");
    let signed = [&nowhere[..], &["--security", "sign"]].concat();
    assert_refused(&refused(&signed), "--pki FOLDER");
    let started = [&nowhere[..], &["--autostart"]].concat();
    assert_refused(&refused(&started), "nowhere.toml");
    let lost = [&nowhere[..], &["--zenoh-listen", "carrier-pigeon/coop"]].concat();
    let output = program(&lost).arg("--no-connect").output().unwrap();
    assert_refused(&output, "zenoh");
}

/// Whether the log of the robot is one of what could have happened.
fn assert_valid(log: &Path) {
    let log = BufReader::new(std::fs::File::open(log).unwrap());
    if let Err(error) = validate::one(log) {
        panic!("{error}");
    }
}

#[test]
fn a_program_that_is_told_to_end_leaves_its_session_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let ([port, peer], first) = (two_free_ports(), free_endpoint());
    let ari = robot(folder.path(), "ARI", 1, port, peer);
    let log = folder.path().join("ARI.jsonl");
    let config = ari.config.to_str().unwrap();
    let arguments = [
        "--config",
        config,
        "--namespace",
        "/ari",
        "--domain",
        "7",
        "--no-connect",
        "--zenoh-listen",
        &first,
        "--autostart",
        "--log",
        log.to_str().unwrap(),
    ];
    let mut child = program(&arguments).stdout(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    let mut stdout = BufReader::new(child.stdout.take().unwrap());
    stdout.read_line(&mut line).unwrap();
    assert!(line.contains("The node is there"), "{line}");
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let status = observer.hear::<Status>("/ari/crossguard/status");
    status.until("a robot", |it| it.state == Status::STATE_IDLE);
    let detect = Command {
        kind: Command::DETECT,
        followers: 1,
        ..Command::default()
    };
    observer.commands("/ari").publish(&detect).unwrap();
    status.until("a request", |it| it.state == Status::STATE_HELP_REQUESTED);
    let pid = child.id().to_string();
    let told = Process::new("kill").args(["-TERM", &pid]).status().unwrap();
    assert!(told.success());
    status.until("its end", |it| it.state == Status::STATE_INACTIVE);
    assert_eq!(wait_for(&mut child), Some(0));
    let text = std::fs::read_to_string(&log).unwrap();
    assert!(
        text.lines().last().unwrap().contains("\"stopped\""),
        "{text}"
    );
    assert!(text.contains("leaveRequested"), "{text}");
    assert_valid(&log);
}
