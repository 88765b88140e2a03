//! Logs under a flood, logs of the run before, logs with a missing piece, and logs and certificates with names that a
//! terminal would obey.

use std::collections::BTreeMap;
use std::net::UdpSocket;
use std::path::Path;
use std::process::Child;
use std::time::{Duration, Instant};

use crossguard_codec::Identifiers;
use crossguard_codec::security::Duration as Term;
use crossguard_protocol::{Config, StationId};
use crossguard_robot::pki;
use crossguard_robot::trace::{Entry, Record, write};
use crossguard_testkit::command::*;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_mins(1);

/// A robot that logs to a file beside its configuration.
fn start_logging(config: &str, log: &Path) -> Child {
    start_with(config, &["--log", log.to_str().unwrap()])
}

fn stop(mut robot: Child) {
    type_to(&mut robot, "quit\n");
    assert_eq!(wait_for(&mut robot, PATIENCE).code(), Some(0));
}

/// Waits until a log has more than this many octets.
fn wait_for_octets(log: &Path, octets: u64) {
    let deadline = Instant::now() + PATIENCE;
    while std::fs::metadata(log).map_or(0, |it| it.len()) <= octets {
        assert!(Instant::now() < deadline, "nothing is written");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// How many octets of garbage arrived, by cause, as the log's last record has it; and how many have a record.
fn counted_and_recorded(log: &[Value]) -> (u64, u64) {
    let of = |it: &Value| it["packet"].as_object().cloned().unwrap_or_default();
    let counted = of(&log.last().unwrap()["counters"]);
    let counted = counted.values().filter_map(Value::as_u64).sum();
    let is_recorded = |it: &&Value| it["entry"] == "dropped" && it["layer"] == "packet";
    (counted, log.iter().filter(is_recorded).count() as u64)
}

#[test]
fn garbage_does_not_fill_the_disk_and_every_piece_of_it_is_counted() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "R", 1, port, port + 1);
    let log = folder.path().join("r.jsonl");
    let robot = start_logging(&config, &log);
    wait_for_octets(&log, 0);
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(3) {
        for _ in 0..20 {
            let _ = socket.send_to(&[0x55; 1_200], ("127.0.0.1", port));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    stop(robot);
    let seconds = began.elapsed().as_secs() + 2;
    let records = records(&std::fs::read_to_string(&log).unwrap());
    let (counted, recorded) = counted_and_recorded(&records);
    assert!(counted > 1_000, "{counted} arrived");
    // Of each cause so many in a second; these have one or two.
    assert!(recorded <= 2 * 32 * seconds, "{recorded} in {seconds} s");
    let validated = run(&["validate", log.to_str().unwrap(), "--json"]);
    assert_eq!(validated.status.code(), Some(0), "{}", stderr(&validated));
    let mut kinds = BTreeMap::new();
    for record in &records {
        *kinds.entry(record["entry"].to_string()).or_insert(0) += 1;
    }
    assert!(kinds["\"unrecorded\""] >= 1, "{kinds:?}");
}

#[test]
fn a_log_is_kept_when_the_next_run_begins_and_a_missing_line_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "R", 1, port, port + 1);
    let log = folder.path().join("r.jsonl");
    let older = folder.path().join("r.jsonl.1");
    for _ in 0..2 {
        let robot = start_logging(&config, &log);
        wait_for_octets(&log, 2_000);
        stop(robot);
    }
    let boot = |log: &Path| {
        let text = std::fs::read_to_string(log).unwrap();
        records(&text)[0]["boot"].as_u64().unwrap()
    };
    assert_eq!((boot(&older), boot(&log)), (1, 2));
    let both = [&older, &log].map(|log| log.to_str().unwrap());
    let validated = run(&["validate", both[0], both[1]]);
    assert_eq!(validated.status.code(), Some(0), "{}", stderr(&validated));

    let text = std::fs::read_to_string(&log).unwrap();
    let without = |gone: usize| {
        let lines = text.split_inclusive('\n').enumerate();
        let kept = lines.filter(|(at, _)| *at != gone).map(|(_, line)| line);
        let path = folder.path().join("gone.jsonl");
        std::fs::write(&path, kept.collect::<String>()).unwrap();
        run(&["validate", path.to_str().unwrap()])
    };
    for (gone, said) in [
        (0, "line 1: is not the first"),
        (1, "line 2: does not follow"),
    ] {
        let refused = without(gone);
        assert_eq!(refused.status.code(), Some(1));
        let said_all = stdout(&refused) + &stderr(&refused);
        assert!(said_all.contains(said), "{said_all}");
    }
}

/// What a terminal would obey: it sets the title, and clears the screen.
const EVIL: &str = "R\u{1b}]0;owned\u{7}\u{1b}[2J\u{9b}31m";

fn assert_harmless(output: &std::process::Output) {
    let said = stdout(output) + &stderr(output);
    assert!(said.contains("\\u{1b}]0;owned"), "{said}");
    let obeyed = |char: char| char.is_control() && !matches!(char, '\n' | '\t');
    assert!(!said.contains(obeyed), "{said:?}");
}

#[test]
fn names_in_logs_do_not_reach_the_terminal_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("evil.jsonl");
    let started = Record {
        at_us: 0,
        robot: EVIL.to_owned(),
        entry: Entry::Started {
            station: StationId(1),
            boot: 1,
            epoch: None,
            settings: Box::new(Config::default().settings().clone()),
            identifiers: Identifiers::default(),
            unix_ms: 0,
            speed: None,
        },
    };
    let mut text = Vec::new();
    // It boots twice with one counter, which is refused by its name.
    write(&mut text, &started).unwrap();
    write(&mut text, &started).unwrap();
    std::fs::write(&log, text).unwrap();
    assert_harmless(&run(&["validate", log.to_str().unwrap()]));
}

#[test]
fn names_in_certificates_do_not_reach_the_terminal_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let term = pki::Term {
        from: pki::now(),
        duration: Term::hours(1),
    };
    let root = pki::new_root(EVIL, term, None, &[36]).unwrap();
    root.write(folder.path(), "root").unwrap();
    let file = folder.path().join("root.cert");
    assert_harmless(&run(&["pki", "show", file.to_str().unwrap()]));
}

#[test]
fn a_line_without_an_end_is_refused_and_not_read_whole() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("long.jsonl");
    std::fs::write(&log, vec![b'{'; 4 << 20]).unwrap();
    for command in ["validate", "timing", "report"] {
        let mut arguments = vec![command, log.to_str().unwrap()];
        let page = folder.path().join("page.html");
        if command == "report" {
            arguments.extend(["-o", page.to_str().unwrap()]);
        }
        let refused = run(&arguments);
        let said = stdout(&refused) + &stderr(&refused);
        assert!(!refused.status.success(), "{command}");
        assert!(said.contains("is longer than"), "{command}: {said}");
    }
}
