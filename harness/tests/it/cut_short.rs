//! Long commands that are told to stop, or whose disk is full: they end in order, with what they have.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(2);

/// A scenario of so many states that no check of it ends before it is told to stop.
const LONG: &str = "team-of-four";

/// A command in a folder of its own, how long it handles signals before it gets one, its exit code, and what it then says
/// or has written to a file.
struct Row {
    command: &'static str,
    after_ms: u64,
    signal: &'static str,
    code: i32,
    says: &'static [&'static str],
    writes: Option<(&'static str, &'static str)>,
}

const ROWS: [Row; 8] = [
    Row {
        command: "demo --speed 1 --port PORT --log log --report page",
        after_ms: 500,
        signal: "-INT",
        code: 3,
        says: &["Stopped before it was done", "T_neg"],
        writes: Some(("page", "</html>")),
    },
    Row {
        command: "demo --speed 1 --port PORT --log log --json",
        after_ms: 500,
        signal: "-TERM",
        code: 3,
        says: &[
            "\"stopped\": true",
            "\"crossings\": 0",
            "\"traceValid\": true",
        ],
        writes: Some(("log", "\"entry\":\"stopped\"")),
    },
    Row {
        command: "check team-of-four pair --json --threads 1",
        after_ms: 2_000,
        signal: "-INT",
        code: 3,
        says: &["\"exhaustive\": false", "\"cutOff\": \"stopped\""],
        writes: None,
    },
    Row {
        command: "fuzz --seeds 1000000 --threads 1 --json --out out",
        after_ms: 2_000,
        signal: "-TERM",
        code: 3,
        says: &["\"seeds\": "],
        writes: None,
    },
    Row {
        command: "simulate cbr --threads 1 --json --csv csv",
        after_ms: 1_000,
        signal: "-INT",
        code: 3,
        says: &[
            "\"cells\": []",
            "cells with fewer seeds than asked for are left out",
        ],
        writes: Some(("csv", "")),
    },
    Row {
        command: "sniff --address 127.0.0.1:0",
        after_ms: 1_000,
        signal: "-TERM",
        code: 0,
        says: &[],
        writes: None,
    },
    Row {
        command: "studio --no-browser --port 0",
        after_ms: 1_000,
        signal: "-INT",
        code: 0,
        says: &["in a browser; Ctrl-C ends it"],
        writes: None,
    },
    Row {
        command: "conform --config Go2.toml --start START --typed --json",
        after_ms: 5_000,
        signal: "-TERM",
        code: 3,
        says: &["\"played\": "],
        writes: None,
    },
];

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

fn cut_short(row: &Row) {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    robot_file(folder.path(), "Go2", 2, port, port + 1);
    let start = format!("{} run --config Go2.toml", env!("CARGO_BIN_EXE_crossguard"));
    let words = row.command.split(' ').map(|word| match word {
        "PORT" => port.to_string(),
        "START" => start.clone(),
        word => word.to_owned(),
    });
    let words: Vec<_> = words.collect();
    let mut command = crossguard(&words.iter().map(String::as_str).collect::<Vec<_>>());
    command.current_dir(&folder).stdin(Stdio::null());
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = child.spawn().unwrap();
    wait_for_handler(&child);
    if row.command.starts_with("demo ") {
        wait_until_in(folder.path().join("log"), "\"startManeuver\"");
    }
    std::thread::sleep(Duration::from_millis(row.after_ms));
    signal(&child, row.signal);
    let began = Instant::now();
    let output = child.wait_with_output().unwrap();
    let said = stdout(&output) + &stderr(&output);
    assert!(
        began.elapsed() < PATIENCE,
        "{}: {:?}",
        row.command,
        began.elapsed()
    );
    assert_eq!(
        output.status.code(),
        Some(row.code),
        "{}: {said}",
        row.command
    );
    for it in row.says {
        assert!(said.contains(it), "{}: no '{it}' in {said}", row.command);
    }
    if let Some((file, text)) = row.writes {
        let written = std::fs::read_to_string(folder.path().join(file)).unwrap();
        assert!(
            written.contains(text),
            "{}: no '{text}' in {file}",
            row.command
        );
    }
}

#[test]
fn a_command_that_is_told_to_stop_ends_in_order_with_what_it_has() {
    std::thread::scope(|scope| {
        for row in &ROWS {
            scope.spawn(|| cut_short(row));
        }
    });
}

#[test]
fn a_check_ends_when_its_time_is_over_and_at_once_at_a_second_interrupt() {
    let output = run(&["check", LONG, "--timeout", "1", "--threads", "2", "--json"]);
    assert_eq!(output.status.code(), Some(3));
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
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
}

/// The command with its standard output on a disk that is full.
fn to_a_full_disk(arguments: &[&str]) -> Output {
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let mut command: Command = crossguard(arguments);
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
    assert!(stdout(&written).contains("1 of 1 crossings completed"));
    assert_eq!(written.status.code(), Some(2), "{}", stderr(&written));
    let lost = run(&[&demo[..], &["--log", "/dev/full"]].concat());
    assert!(stdout(&lost).contains("1 of 1 crossings completed"));
    assert_eq!(lost.status.code(), Some(3), "{}", stderr(&lost));
    let small = [
        "--pedestrians",
        "20",
        "--robots",
        "0",
        "--radius",
        "10",
        "--seeds",
        "1",
    ];
    let simulate = [&["simulate", "obs", "--csv", "/dev/full"], &small[..]].concat();
    for arguments in [
        &["report", &log, "--output", "/dev/full"][..],
        &["export", &log, "--facts", "/dev/full"],
        &["sniff", "--address", "127.0.0.1:0", "--pcap", "/dev/full"],
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
    assert_eq!(
        (output.status.code(), stderr(&output)),
        (Some(0), String::new())
    );
}

#[test]
fn a_pki_is_made_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pki");
    let pki = path.to_str().unwrap();
    // What a try that was killed has left behind is in nobody's way.
    std::fs::create_dir_all(path.join(".unfinished/robots")).unwrap();
    let early = run(&["pki", "init", pki, "--start-in", "-5", "--json"]);
    assert_eq!(early.status.code(), Some(0), "{}", stderr(&early));
    let shown = json(&early);
    let mut shown = shown.as_array().unwrap().iter();
    assert!(
        shown
            .all(|it| it["isValidNow"] == true
                && Path::new(it["file"].as_str().unwrap()).is_file())
    );
    assert!(!path.join(".unfinished").exists());
}
