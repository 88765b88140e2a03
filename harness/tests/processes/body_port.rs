//! Bodies that are processes of their own, by the body port: a whole crossing, and what happens when one is killed, stops,
//! or talks nonsense.

use std::io::{BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use crossguard_testkit::command::*;
use serde_json::{Value, json};

use crate::street::{ARI, GO2, Street, assert_valid, counted};

/// Gives a robot a site, and a body port at a UNIX socket beside its file, with these lines more; where the socket is.
fn listens(file: &str, lines: &str) -> PathBuf {
    let socket = Path::new(file).with_extension("sock");
    let name = socket.file_name().unwrap().display();
    let body = format!(
        "[site]\nlatitude = 49.0\nlongitude = 8.4\n\n\
         [body]\n{lines}simulated_people = true\nlisten = \"unix:{name}\"\n\n[link]"
    );
    // On a site that is said a plan is wanted that is said.
    let plan = ("autopilot = true", "plan_file = \"crossing\"");
    edit(file, &[plan, ("[link]", &body)]);
    socket
}

/// The example body at a place.
fn body(socket: &Path, [east, north]: [f64; 2], faster: f64) -> Killed {
    wait_until("the body port", || socket.exists());
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/body.py");
    let body = Command::new("python3")
        .arg(source)
        .arg(format!("unix:{}", socket.display()))
        .args([east, north, faster].map(|number| number.to_string()))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    Killed(body.unwrap())
}

/// ARI, which asks for help soon, and Go2, with a body in Python for each.
fn begin(faster: f64, silence_ms: u64) -> (Street, [Killed; 2]) {
    let mut street = Street::new(&[]);
    let silence = format!("silence_ms = {silence_ms}\n");
    let sockets = street
        .configs
        .each_ref()
        .map(|file| listens(file, &silence));
    street.start(&[]);
    let bodies = [
        body(&sockets[ARI], [0.0, -1.5], faster),
        body(&sockets[GO2], [1.0, -1.11], faster),
    ];
    street.say(ARI, "wait 1.5\ndetect\n");
    (street, bodies)
}

/// Ends both. Their logs, each of which is valid; together they need not be, as simulated people walk at another pace than
/// the bodies.
fn end(street: &mut Street) -> [Vec<Value>; 2] {
    street.quit();
    street.configs.each_ref().map(|file| {
        assert_valid([Path::new(file).with_extension("log")].into_iter());
        records(&log_of(file))
    })
}

/// Whether a robot takes part, by the last state in its log.
fn availability(log: &[Value]) -> &Value {
    let state = log.iter().rev().find_map(|record| record.get("state"));
    &state.unwrap()["availability"]
}

#[test]
fn two_bodies_in_python_do_a_whole_crossing() {
    let (mut street, _bodies) = begin(10.0, 5_000);
    street.until(ARI, "taskCompleted");
    for log in end(&mut street) {
        let dropped = ["silent", "not understood"].map(|cause| counted(&log, "body", cause));
        assert_eq!(dropped, [0, 0]);
    }
    let [ari, go2] = [ARI, GO2].map(|robot| street.log(robot));
    assert_eq!(ari.matches("\"corridorOpened\"").count(), 1);
    assert_eq!(go2.matches("\"startManeuver\"").count(), 2);
}

/// Loses a body in the middle of the road by this signal, and checks the end of the corridor.
fn lose(victim: usize, how: &str) {
    let (mut street, bodies) = begin(1.5, 500);
    street.until(ARI, "\"corridorOpened\"");
    std::thread::sleep(Duration::from_millis(500));
    signal(&bodies[victim].0, how);
    street.until(ARI, "\"corridorClosed\"");
    // The robot tells it after half a second of silence, and does not just fall silent itself.
    let log = street.log(ARI);
    let (open, _) = log.split_once("\"corridorClosed\"").unwrap();
    assert!(!open.contains("leaseExpired"), "{log}");
    street.until(victim, "\"unavailable\":\"emergencyStop\"");
    street.until(ARI, "sessionEnded");
    // A body that wakes up, or comes again, does not end the stop.
    if how == "-STOP" {
        signal(&bodies[victim].0, "-CONT");
    }
    std::thread::sleep(Duration::from_millis(300));
    let stopped = &end(&mut street)[victim];
    assert_eq!(counted(stopped, "body", "silent"), 1);
    assert_eq!(availability(stopped)["unavailable"], "emergencyStop");
}

#[test]
fn the_corridor_closes_when_the_body_of_the_leader_or_escort_is_killed_or_stops() {
    // One after the other: eight more processes at once are late where there are few processors.
    for (victim, how) in [(1, "-KILL"), (1, "-STOP"), (0, "-KILL"), (0, "-STOP")] {
        lose(victim, how);
    }
}

/// Next line of the kit, beats left out.
fn hears(from: &mut impl BufRead) -> Value {
    read_until(from, |line| line["type"] != "beat")
}

#[test]
fn a_body_that_is_not_understood_is_counted_and_a_second_one_is_refused() {
    let street = Street::new(&[]);
    let go2 = &street.configs[GO2];
    let socket = listens(go2, "silence_ms = 5000\n");
    let mut robot = start(go2);
    let mut first = connect(&socket);
    let mut said = BufReader::new(first.try_clone().unwrap());
    assert_eq!(hears(&mut said), json!({"type": "hello", "crossguard": 3}));
    for line in [
        "{\"type\": \"hello\", \"crossguard\": 3}",
        "{\"type\": \"dance\"}",
        "no json",
        "{\"type\": \"pose\", \"eastM\": 1e30, \"northM\": 0}",
        "{\"type\": \"completed\", \"id\": \"1#1.0/0\"}",
        "{\"type\": \"beat\"}",
        "{\"type\": \"fault\", \"text\": \"hot motor\"}",
    ] {
        writeln!(first, "{line}").unwrap();
    }
    let second = UnixStream::connect(&socket).unwrap();
    let refused = hears(&mut BufReader::new(second));
    assert_eq!(refused["type"], "refused");
    let fault = r#""layer":"body","cause":"fault""#;
    street.until(GO2, fault);
    quit(&mut robot);
    let log = street.log(GO2);
    log.must_have(&["hot motor"]);
    let log = records(&log);
    let counts = ["not understood", "fault", "silent"].map(|cause| counted(&log, "body", cause));
    assert_eq!(counts, [4, 1, 0]);
    assert_eq!(availability(&log)["unavailable"], "localFault");
}

#[test]
fn a_port_that_cannot_be_is_refused() {
    let street = Street::new(&[]);
    let file = &street.configs[ARI];
    listens(file, "");
    for row in [
        "unix:ARI.sock => 192.0.2.1:4000 => [body] listen: '192.0.2.1:4000'",
        "192.0.2.1:4000\" => unix:a.sock\"\nsilence_ms = 10 => [body] silence_ms is 10",
        "silence_ms = 10 => \n[operator]\nlisten = \"unix:\" => [operator] listen: 'unix:'",
        "unix:\" => unix:ARI.toml\" => ARI.toml is there, and is no socket",
    ] {
        let [from, to, cause] = row.split(" => ").collect::<Vec<_>>()[..] else {
            panic!("{row}");
        };
        edit(file, &[(from, to)]);
        assert_refused(&run(&["run", "--config", file]), cause);
    }
}
