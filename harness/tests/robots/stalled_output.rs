//! A reader of an output that does not read: the robot goes on, and hears a signal.

use std::io::Write as _;
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::process::Stdio;

use crossguard_testkit::command::*;

use crate::clock_step::WallClock;
use crate::street::{ARI, GO2, PATIENCE, Street, assert_valid, side_by_side};

/// Arguments, and lines that make it say more than a pipe holds.
type Row = (&'static [&'static str], &'static str);

// A person who looks away, and a program that does not take the log.
const ROWS: [Row; 2] = [(&[], "help\n"), (&["--json"], "wait 0.01\n")];

fn cross_unread((arguments, chatter): &Row) {
    let mut street = Street::new(&[]);
    street.robots = [ARI, GO2]
        .map(|robot| {
            let config = &street.configs[robot];
            if robot == GO2 {
                return Killed(start(config));
            }
            let log = ["--log", &street.path("ari.jsonl")].map(str::to_owned);
            let mut command = crossguard(&["run", "--config", config]);
            let command = command.args(*arguments).args(log);
            let piped = command.stdin(Stdio::piped()).stderr(Stdio::piped());
            Killed(piped.stdout(Stdio::piped()).spawn().unwrap())
        })
        .into();
    street.say(ARI, &chatter.repeat(200));
    street.say(ARI, "wait 0.3\ndetect\n");
    // The dog sees the whole crossing, although nobody reads what its leader says.
    street.until(GO2, "\"taskCompleted\"");
    street.signal(ARI, "-TERM");
    let status = wait_for(&mut street.robots[ARI].0, PATIENCE);
    street.say(GO2, "until idle 30\nquit\n");
    assert_eq!(
        wait_for(&mut street.robots[GO2].0, PATIENCE).code(),
        Some(0)
    );
    assert!(!street.log(GO2).contains("fallBack"));
    // The log has all, and is that of a robot that stopped in order.
    let log = street.path("ari.jsonl");
    let text = std::fs::read_to_string(&log).unwrap();
    assert_eq!(records(&text).pop().unwrap()["entry"], "stopped");
    assert_valid([log.into()].into_iter());
    let mut said = String::new();
    let unread = street.robots[ARI].0.stderr.take().unwrap();
    std::io::Read::read_to_string(&mut { unread }, &mut said).unwrap();
    said.must_have(&["standard output is not read"]);
    assert_eq!(status.code(), Some(3));
}

#[test]
fn an_output_that_nobody_reads_does_not_stop_the_robot() {
    side_by_side(&ROWS, cross_unread);
}

/// Hazard: a robot's thread panics, and waits for who reads standard error before it halts its body.
#[test]
fn a_robot_that_panics_ends_although_nobody_reads_why() {
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = shim(folder.path(), "tests/clock/step.c") else {
        return;
    };
    let street = Street::new(&[]);
    let clock = WallClock::of(&street, &library);
    let (_unread, mut full) = UnixStream::pair().unwrap();
    full.set_nonblocking(true).unwrap();
    while full.write(b" ").is_ok() {}
    full.set_nonblocking(false).unwrap();
    let ari = clock.ari(&street).stderr(OwnedFd::from(full)).spawn();
    let mut ari = Killed(ari.unwrap());
    street.until(ARI, "\"started\"");
    clock.set(i64::MIN);
    assert_eq!(wait_for(&mut ari.0, PATIENCE).code(), Some(1));
}
