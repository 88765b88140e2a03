//! Long commands that are told to stop, or whose disk is full: they end in order, with what they have.

use std::path::Path;
use std::process::{Child, Output, Stdio};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(2);

/// A scenario of so many states that no check of it ends before it is told to stop.
const LONG: &str = "team-of-four";

/// Commands, each in a folder of its own; how long it handles signals before it gets one, its exit code, and what it then
/// says. Some write a file, and what is in it stands behind the name.
const ROWS: &str = r#"
demo --speed 1 --port PORT --log log --report page  | 500 ms -INT = 3   | Stopped before it was done; T_neg | page </html>
demo --speed 1 --port PORT --log log --json | 500 ms -TERM = 3 | "stopped": true; "crossings": 0; "traceValid": true | log "entry":"stopped"
check team-of-four pair --json --threads 1          | 2000 ms -INT = 3  | "exhaustive": false; "cutOff": "stopped"
fuzz --seeds 1000000 --threads 1 --json --out out   | 2000 ms -TERM = 3 | "seeds":
simulate cbr --set threads=1 --json --csv csv | 1000 ms -INT = 3 | "cells": []; cells with fewer seeds than asked for are left out | csv
studio --no-browser --port 0                        | 1000 ms -INT = 0  | in a browser; Ctrl-C ends it
conform --config Go2.toml --start START --typed --json | 5000 ms -TERM = 3 | "played":
"#;

/// Waits until a process handles SIGTERM, and so SIGINT, whose handler is set before.
fn wait_for_handler(child: &Child) {
    const SIGTERM: u64 = 1 << 14;
    let path = format!("/proc/{}/status", child.id());
    wait_until("a signal handler", || {
        let status = std::fs::read_to_string(&path).unwrap();
        let caught = status.lines().find_map(|it| it.strip_prefix("SigCgt:"));
        u64::from_str_radix(caught.unwrap().trim(), 16).unwrap() & SIGTERM != 0
    });
}

fn cut_short(row: &str) {
    let mut cells = row.split('|').map(str::trim);
    let [command, ends, says] = [(); 3].map(|()| cells.next().unwrap());
    let [after_ms, _, name, _, code] = ends.split_whitespace().collect::<Vec<_>>()[..] else {
        panic!("{row}");
    };
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    robot_file(folder.path(), "Go2", 2, port, port + 1);
    let start = format!("{} run --config Go2.toml", env!("CARGO_BIN_EXE_crossguard"));
    let port = port.to_string();
    let words = command.split_whitespace().map(|word| match word {
        "PORT" => &*port,
        "START" => &start,
        word => word,
    });
    let mut child = crossguard(&words.collect::<Vec<_>>());
    child.current_dir(&folder).stdin(Stdio::null());
    let child = child.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = child.spawn().unwrap();
    wait_for_handler(&child);
    if command.starts_with("demo ") {
        wait_until_in(folder.path().join("log"), "\"startManeuver\"");
    }
    std::thread::sleep(Duration::from_millis(after_ms.parse().unwrap()));
    signal(&child, name);
    let began = Instant::now();
    let output = child.wait_with_output().unwrap();
    let said = format!("{command}:\n{}{}", stdout(&output), stderr(&output));
    assert!(began.elapsed() < PATIENCE, "{said}");
    assert_eq!(output.status.code(), code.parse().ok(), "{said}");
    said.must_have(&says.split("; ").collect::<Vec<_>>());
    if let Some(file) = cells.next() {
        let (file, text) = file.split_once(' ').unwrap_or((file, ""));
        let written = std::fs::read_to_string(folder.path().join(file)).unwrap();
        assert!(written.contains(text), "{command}: no '{text}' in {file}");
    }
}

#[test]
fn a_command_that_is_told_to_stop_ends_in_order_with_what_it_has() {
    std::thread::scope(|scope| {
        for row in ROWS.trim().lines() {
            scope.spawn(move || cut_short(row));
        }
    });
}

#[test]
fn a_check_ends_when_its_time_is_over_and_at_once_at_a_second_interrupt() {
    let output = run(&["check", LONG, "--timeout", "1", "--threads", "2", "--json"]);
    assert_code(&output, 3);
    assert_eq!(json(&output)["scenarios"][0]["cutOff"], "time-limit");
    let mut command = crossguard(&["check", LONG, "--threads", "1"]);
    let child = command.stdout(Stdio::null()).spawn().unwrap();
    wait_for_handler(&child);
    std::thread::sleep(Duration::from_secs(1));
    // Both come before the command can end because of the first.
    for name in ["-STOP", "-INT", "-TERM", "-CONT"] {
        signal(&child, name);
    }
    let output = child.wait_with_output().unwrap();
    assert_code(&output, 130);
}

/// The command with its standard output on a disk that is full.
fn to_a_full_disk(arguments: &[&str]) -> Output {
    let full = std::fs::File::create("/dev/full").unwrap();
    let mut command = crossguard(arguments);
    command.stdin(Stdio::null()).stdout(full).output().unwrap()
}

#[test]
fn a_disk_that_is_full_is_named_by_each_command_that_writes_to_it() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log").display().to_string();
    let port = two_free_ports().to_string();
    let demo = ["demo", "--speed", "50", "--port", &port];
    // A crossing goes on all the same.
    let written = run(&[&demo[..], &["--log", &log, "--report", "/dev/full"]].concat());
    stdout(&written).must_have(&["1 of 1 crossings completed"]);
    assert_code(&written, 2);
    let lost = run(&[&demo[..], &["--log", "/dev/full"]].concat());
    stdout(&lost).must_have(&["1 of 1 crossings completed"]);
    assert_code(&lost, 3);
    let simulate = "simulate obs --csv /dev/full --pedestrians 20 --robots 0 --radius 10 --seeds 1";
    let simulate: Vec<_> = simulate.split(' ').collect();
    for arguments in [
        &["report", &log, "--output", "/dev/full"][..],
        &["export", &log, "--facts", "/dev/full"],
        &simulate,
        // A capture begins with a header, so this is known before the robots start.
        &[&demo[..], &["--pcap", "/dev/full"]].concat(),
    ] {
        assert_refused(&run(arguments), "/dev/full: No space left on device");
    }
    for arguments in [
        &demo[..],
        &["check", "paper-literal"],
        &["fuzz", "--seeds", "1", "--robots", "2"],
        &["simulate", "obs", "--pedestrians", "20", "--seeds", "1"],
        &["bounds"],
        &["odds", "--loss", "0"],
        &["conform", "--list"],
    ] {
        let output = to_a_full_disk(arguments);
        assert_refused(&output, "standard output: No space left on device");
    }
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut command = crossguard(&["check", "--list"]);
    let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_code(&output, 0);
    assert_eq!(stderr(&output), "");
}

#[test]
fn a_pki_is_made_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pki");
    let pki = path.to_str().unwrap();
    // The remains of a try that was killed are in nobody's way.
    std::fs::create_dir_all(path.join(".unfinished/robots")).unwrap();
    let early = run(&["pki", "init", pki, "--start-in", "-5", "--json"]);
    assert_code(&early, 0);
    for it in json(&early).as_array().unwrap() {
        let is_there = Path::new(it["file"].as_str().unwrap()).is_file();
        assert!(it["isValidNow"] == true && is_there, "{it}");
    }
    assert!(!path.join(".unfinished").exists());
}
