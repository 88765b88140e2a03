//! Bodies that are processes of their own, by the body port: a whole crossing, and what happens when one is killed, stops,
//! or talks nonsense.

use std::io::{BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;
use serde_json::{Value, json};

const PATIENCE: Duration = Duration::from_mins(1);

/// ARI and Go2 as processes, and a body in Python for each.
struct Street {
    _folder: tempfile::TempDir,
    files: [String; 2],
    robots: [Killed; 2],
    bodies: [Killed; 2],
}

/// The robot file of a robot with a body port at a UNIX socket beside it.
fn ported(folder: &Path, name: &str, station: u32, port: u16, peer: u16) -> String {
    let file = robot_file(folder, name, station, port, peer);
    let body = format!("[body]\nsimulated_people = true\nlisten = \"unix:{name}.sock\"\n\n[link]");
    edit(&file, &[("[link]", &body)]);
    file
}

fn socket_of(file: &str) -> String {
    let socket = Path::new(file).with_extension("sock");
    socket.display().to_string()
}

/// The example body at a place.
fn body(file: &str, [east, north]: [f64; 2], faster: f64) -> Killed {
    let socket = socket_of(file);
    wait_until("the body port", || Path::new(&socket).exists());
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/body.py");
    let body = Command::new("python3")
        .arg(source)
        .arg(format!("unix:{socket}"))
        .args([east, north, faster].map(|number| number.to_string()))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    Killed(body.unwrap())
}

impl Street {
    fn begin(faster: f64, silence_ms: u64) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let port = two_free_ports();
        let files = [
            ported(folder.path(), "ARI", 1, port, port + 1),
            ported(folder.path(), "Go2", 2, port + 1, port),
        ];
        let silence = format!("[body]\nsilence_ms = {silence_ms}");
        for file in &files {
            edit(file, &[("[body]", &silence)]);
        }
        let robots = [0, 1].map(|robot| Killed(start(&files[robot])));
        let bodies = [
            body(&files[0], [0.0, -1.5], faster),
            body(&files[1], [1.0, -1.11], faster),
        ];
        let mut street = Self {
            _folder: folder,
            files,
            robots,
            bodies,
        };
        type_to(&mut street.robots[0].0, "wait 1.5\ndetect\n");
        street
    }

    /// Waits until the log of a robot has this after this many octets; how long the log is then.
    fn until(&self, robot: usize, what: &str, from: usize) -> usize {
        let deadline = Instant::now() + PATIENCE;
        loop {
            let log = log_of(&self.files[robot]);
            if let Some(at) = log.get(from..).and_then(|log| log.find(what)) {
                return from + at + what.len();
            }
            assert!(Instant::now() < deadline, "no '{what}' in:\n{log}");
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// Stops everybody in order; the logs, which are valid.
    fn end(mut self) -> [String; 2] {
        for robot in &mut self.robots {
            type_to(&mut robot.0, "quit\n");
        }
        for robot in &mut self.robots {
            assert_eq!(wait_for(&mut robot.0, PATIENCE).code(), Some(0));
        }
        let logs = self.files.each_ref().map(|file| log_of(file));
        for log in &logs {
            crossguard_judge::validate::one(log.as_bytes()).unwrap();
        }
        logs
    }
}

/// The counter of a cause of the body in a robot's last record.
fn counted(log: &str, reason: &str) -> u64 {
    let last = records(log).pop().unwrap();
    last["counters"]["body"][reason].as_u64().unwrap_or(0)
}

/// Whether a robot takes part, by the last state in its log.
fn availability(log: &str) -> Value {
    let mut last = records(log).into_iter().rev();
    let last = last.find_map(|record| record.get("state").cloned());
    last.unwrap()["availability"].clone()
}

#[test]
fn two_bodies_in_python_do_a_whole_crossing() {
    let street = Street::begin(10.0, 5_000);
    street.until(0, "taskCompleted", 0);
    let [ari, go2] = street.end();
    assert_eq!(ari.matches("\"corridorOpened\"").count(), 1);
    assert_eq!(go2.matches("\"startManeuver\"").count(), 2);
    for log in [&ari, &go2] {
        let dropped = counted(log, "silent") + counted(log, "not understood");
        assert_eq!(dropped, 0, "{log}");
    }
}

/// Loses a body in the middle of the road by this signal, and checks the end of the corridor.
fn lose(victim: usize, how: &str) {
    let street = Street::begin(1.5, 500);
    let opened = street.until(0, "\"corridorOpened\"", 0);
    std::thread::sleep(Duration::from_millis(500));
    signal(&street.bodies[victim].0, how);
    let closed = street.until(0, "\"corridorClosed\"", opened);
    // The robot tells it after half a second of silence, and does not just fall silent itself.
    let log = log_of(&street.files[0]);
    assert!(!log[opened..closed].contains("leaseExpired"), "{log}");
    street.until(victim, "\"unavailable\":\"emergencyStop\"", 0);
    street.until(0, "sessionEnded", opened);
    // A body that wakes up, or comes again, does not end the stop.
    if how == "-STOP" {
        signal(&street.bodies[victim].0, "-CONT");
    }
    std::thread::sleep(Duration::from_millis(300));
    let logs = street.end();
    let stopped = &logs[victim];
    assert_eq!(counted(stopped, "silent"), 1, "{stopped}");
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
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let go2 = ported(folder.path(), "Go2", 2, port, port + 1);
    edit(&go2, &[("[body]", "[body]\nsilence_ms = 5000")]);
    let mut robot = start(&go2);
    let socket = socket_of(&go2);
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
    wait_until("the fault", || log_of(&go2).contains(fault));
    quit(&mut robot);
    let log = log_of(&go2);
    let counts = ["not understood", "fault", "silent"].map(|reason| counted(&log, reason));
    assert_eq!(counts, [4, 1, 0], "{log}");
    log.must_have(&["hot motor"]);
    assert_eq!(availability(&log)["unavailable"], "localFault", "{log}");
}

#[test]
fn a_port_that_cannot_be_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = ported(folder.path(), "ARI", 1, 47_000, 47_001);
    for row in [
        "unix:ARI.sock => 192.0.2.1:4000 => [body] listen: '192.0.2.1:4000'",
        "192.0.2.1:4000\" => unix:a.sock\"\nsilence_ms = 10 => [body] silence_ms is 10",
        "silence_ms = 10 => \n[operator]\nlisten = \"unix:\" => [operator] listen: 'unix:'",
        "unix:\" => unix:ARI.toml\" => ARI.toml is there, and is no socket",
    ] {
        let [from, to, cause] = row.split(" => ").collect::<Vec<_>>()[..] else {
            panic!("{row}");
        };
        edit(&file, &[(from, to)]);
        assert_refused(&run(&["run", "--config", &file]), cause);
    }
}
