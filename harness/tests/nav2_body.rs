//! The body that drives by Nav2, `examples/nav2_body.py`, against a program that plays Nav2 and its robot
//! (`tests/nav2/server.py`), by a module that stands for rclpy (`tests/nav2/rclpy.py`). Neither Nav2 nor rclpy was at hand.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;
use serde_json::{Value, json};

const PATIENCE: Duration = Duration::from_mins(1);

fn python(script: &str) -> Command {
    let mut command = Command::new("python3");
    command
        .arg(here(script))
        .env("PYTHONDONTWRITEBYTECODE", "1");
    command
}

fn here(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}

/// The lines of a stream, as they come.
fn lines_of(stream: impl Read + Send + 'static) -> Receiver<String> {
    let (tell, lines) = channel();
    std::thread::spawn(move || {
        for line in BufReader::new(stream).lines().map_while(Result::ok) {
            if tell.send(line).is_err() {
                return;
            }
        }
    });
    lines
}

/// Nav2 and a robot that is at this place of the map.
struct Nav2 {
    process: Killed,
    address: String,
    tells: Receiver<String>,
}

impl Nav2 {
    fn at(place: [f64; 2], faster: f64) -> Self {
        let mut child = python("tests/nav2/server.py")
            .args([place[0], place[1], faster].map(|it| it.to_string()))
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let tells = lines_of(child.stdout.take().unwrap());
        let address = tells.recv_timeout(PATIENCE).unwrap();
        Self {
            process: Killed(child),
            address,
            tells,
        }
    }

    /// Waits until something happens whose line begins like this; what happened until then.
    fn until(&self, what: &str) -> Vec<String> {
        let mut all = Vec::new();
        let deadline = Instant::now() + PATIENCE;
        while all.last().is_none_or(|it: &String| !it.starts_with(what)) {
            let left = deadline.saturating_duration_since(Instant::now());
            let line = self.tells.recv_timeout(left);
            all.push(line.unwrap_or_else(|_| panic!("no '{what}' in {all:?}")));
        }
        all
    }

    /// A body that drives by it, for the robot at this address.
    fn body(&self, port: &str, more: &[&str]) -> Killed {
        let child = python("examples/nav2_body.py")
            .arg(port)
            .args(more)
            .env("PYTHONPATH", here("tests/nav2"))
            .env("NAV2_SERVER", &self.address)
            .spawn();
        Killed(child.unwrap())
    }
}

/// A robot, as its body knows it: what it says is said here.
struct Kit {
    stream: TcpStream,
    hears: Receiver<String>,
    beats: Arc<AtomicBool>,
    body: Killed,
}

impl Drop for Kit {
    fn drop(&mut self) {
        self.beats.store(false, Ordering::Relaxed);
    }
}

impl Kit {
    fn with_body(nav2: &Nav2) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let body = nav2.body(&listener.local_addr().unwrap().to_string(), &[]);
        let (stream, _) = listener.accept().unwrap();
        let beats = Arc::new(AtomicBool::new(true));
        let kit = Self {
            hears: lines_of(stream.try_clone().unwrap()),
            stream,
            beats,
            body,
        };
        let (beats, mut stream) = (kit.beats.clone(), kit.stream.try_clone().unwrap());
        std::thread::spawn(move || {
            while beats.load(Ordering::Relaxed)
                && stream.write_all(b"{\"type\":\"beat\"}\n").is_ok()
            {
                std::thread::sleep(Duration::from_millis(50));
            }
        });
        assert_eq!(
            kit.until("hello"),
            json!({"type": "hello", "crossguard": 1})
        );
        kit
    }

    fn say(&mut self, line: &Value) {
        self.stream
            .write_all(format!("{line}\n").as_bytes())
            .unwrap();
    }

    fn start(&mut self, id: &str, [east, north]: [f64; 2], speed: f64) {
        self.say(&json!({
            "type": "start", "id": id, "task": "move", "report": "completed",
            "to": {"east_m": east, "north_m": north, "latitude": 49.0, "longitude": 8.0},
            "speed_mps": speed, "heading_deg": null, "pedestrian_distance_m": null,
        }));
    }

    /// The next line for which this holds.
    fn next(&self, what: &str, is: impl Fn(&Value) -> bool) -> Value {
        let deadline = Instant::now() + PATIENCE;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            let line = self.hears.recv_timeout(left);
            let line = line.unwrap_or_else(|_| panic!("the body does not say {what}"));
            let line = serde_json::from_str(&line).unwrap();
            if is(&line) {
                return line;
            }
        }
    }

    fn until(&self, kind: &str) -> Value {
        self.next(kind, |it| it["type"] == kind)
    }

    /// The next report, whatever it is.
    fn report(&self) -> Value {
        self.next("a report", |it| {
            it["type"] != "pose" && it["type"] != "beat"
        })
    }
}

#[test]
fn an_escort_that_drives_by_nav2_does_a_whole_crossing() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    edit(
        &go2,
        &[("[link]", "[body]\nlisten = \"unix:Go2.sock\"\n\n[link]")],
    );
    let socket = folder.path().join("Go2.sock");
    let mut robots = [Killed(start(&ari)), Killed(start(&go2))];
    let deadline = Instant::now() + PATIENCE;
    while !socket.exists() {
        assert!(Instant::now() < deadline, "no port");
        std::thread::sleep(Duration::from_millis(20));
    }
    // The map's x axis points to the south of the site: a place (e, n) is at (10 - n, e - 5).
    let nav2 = Nav2::at([11.11, -4.0], 10.0);
    let _body = nav2.body(
        &format!("unix:{}", socket.display()),
        &["--site-in-map", "10", "-5", "90"],
    );
    let available = Instant::now() + PATIENCE;
    while !log_of(&go2).contains("\"availabilityChanged\":\"available\"") {
        assert!(Instant::now() < available, "{}", log_of(&go2));
        std::thread::sleep(Duration::from_millis(20));
    }
    type_to(&mut robots[0].0, "wait 1.5\ndetect\n");
    let deadline = Instant::now() + PATIENCE;
    while !log_of(&ari).contains("taskCompleted") {
        assert!(Instant::now() < deadline, "{}", log_of(&ari));
        std::thread::sleep(Duration::from_millis(20));
    }
    for robot in &mut robots {
        type_to(&mut robot.0, "quit\n");
        assert_eq!(wait_for(&mut robot.0, PATIENCE).code(), Some(0));
    }
    let (ari, go2) = (log_of(&ari), log_of(&go2));
    assert_eq!(ari.matches("\"corridorOpened\"").count(), 1);
    for log in [&ari, &go2] {
        crossguard_judge::validate::one(log.as_bytes()).unwrap();
    }
    let first = nav2.until("goal");
    assert!(first.last().unwrap().starts_with("goal 11.0"), "{first:?}");
    let second = nav2.until("goal");
    assert!(
        second.iter().any(|it| it.starts_with("succeeded")),
        "{second:?}"
    );
    assert!(second.last().unwrap().starts_with("goal 2.0"), "{second:?}");
    nav2.until("succeeded at 2.0");
}

#[test]
fn feedback_is_where_the_body_is_and_the_result_ends_the_maneuver() {
    let nav2 = Nav2::at([0.0, 0.0], 1.0);
    let mut kit = Kit::with_body(&nav2);
    kit.start("1", [0.0, 2.0], 1.5);
    let way = |it: &Value| {
        it["north_m"]
            .as_f64()
            .is_some_and(|north| north > 0.3 && north < 1.9)
    };
    let pose = kit.next("a pose on its way", way);
    assert!(pose["speed_mps"].as_f64().unwrap() > 0.1, "{pose}");
    assert!(pose["heading_deg"].as_f64().unwrap().abs() < 1.0, "{pose}");
    assert_eq!(kit.report(), json!({"type": "completed", "id": "1"}));
    let pose = kit.until("pose");
    assert_eq!(
        [&pose["north_m"], &pose["speed_mps"]],
        [&json!(2.0), &json!(0.0)]
    );
    let told = nav2.until("succeeded");
    assert_eq!(told[..2], ["limit 1.5", "goal 0.00 2.00 in map"]);
}

#[test]
fn a_goal_that_is_refused_or_aborted_is_a_maneuver_that_failed() {
    let nav2 = Nav2::at([0.0, 0.0], 1.0);
    let mut kit = Kit::with_body(&nav2);
    for (id, north) in [("refused", 2_000.0), ("aborted", 600.0)] {
        kit.start(id, [0.0, north], 1.0);
        assert_eq!(kit.report(), json!({"type": "failed", "id": id}));
    }
    // Nor does it go on to where it went before.
    kit.start("before", [0.0, 50.0], 1.0);
    nav2.until("goal 0.00 50.00");
    kit.start("refused", [0.0, 2_000.0], 1.0);
    nav2.until("cancelled");
    assert_eq!(kit.report(), json!({"type": "failed", "id": "refused"}));
}

#[test]
fn only_the_newest_act_counts() {
    let nav2 = Nav2::at([0.0, 0.0], 1.0);
    let mut kit = Kit::with_body(&nav2);
    kit.start("old", [0.0, 50.0], 1.0);
    nav2.until("goal");
    kit.start("new", [0.0, 0.5], 1.0);
    nav2.until("replaced");
    assert_eq!(kit.report(), json!({"type": "completed", "id": "new"}));
    // A start and its stop in one breath: Nav2 has not answered yet.
    kit.start("taken back", [0.0, 50.0], 1.0);
    kit.say(&json!({"type": "stop", "id": "taken back", "why": "a test"}));
    nav2.until("cancelled");
    kit.start("last", [0.0, 50.0], 1.0);
    nav2.until("goal");
    kit.say(&json!({"type": "halt"}));
    nav2.until("cancelled");
    kit.start("end", [0.0, 0.6], 1.0);
    assert_eq!(kit.report(), json!({"type": "completed", "id": "end"}));
}

#[test]
fn a_fallback_goes_to_the_nearer_kerb_or_stands() {
    let nav2 = Nav2::at([0.0, 0.0], 3.0);
    let mut kit = Kit::with_body(&nav2);
    kit.start("escort", [0.0, 8.0], 1.0);
    kit.next("the far half", |it| {
        it["north_m"].as_f64().is_some_and(|it| it > 4.5)
    });
    kit.say(&json!({"type": "fall-back", "id": "escort", "policy": "escort-to-kerb"}));
    assert_eq!(kit.report(), json!({"type": "fallen-back"}));
    nav2.until("succeeded at 0.00 8.00");
    kit.start("guard", [0.0, 50.0], 1.0);
    nav2.until("goal 0.00 50.00");
    kit.say(&json!({"type": "fall-back", "id": "guard", "policy": "hold-until-clear"}));
    nav2.until("cancelled");
    assert_eq!(kit.report(), json!({"type": "fallen-back"}));
}

#[test]
fn it_stands_when_the_kit_is_silent() {
    let nav2 = Nav2::at([0.0, 0.0], 1.0);
    let mut kit = Kit::with_body(&nav2);
    kit.start("1", [0.0, 400.0], 1.0);
    nav2.until("goal");
    kit.beats.store(false, Ordering::Relaxed);
    nav2.until("cancelled");
    // The connection ends as well.
    let nav2 = Nav2::at([0.0, 0.0], 1.0);
    let mut kit = Kit::with_body(&nav2);
    kit.start("1", [0.0, 400.0], 1.0);
    nav2.until("goal");
    kit.stream.shutdown(std::net::Shutdown::Both).unwrap();
    nav2.until("cancelled");
    assert_ne!(wait_for(&mut kit.body.0, PATIENCE).code(), Some(0));
}

/// Nav2 goes on driving when its client is gone; somebody else has to stop it.
fn lose(how: &str) {
    let nav2 = Nav2::at([0.0, 0.0], 1.0);
    let mut kit = Kit::with_body(&nav2);
    kit.start("1", [0.0, 400.0], 1.0);
    nav2.until("goal");
    signal(&kit.body.0, how);
    nav2.until("all cancelled");
    if how == "-STOP" {
        // What the kit has said meanwhile is of no use any more.
        kit.start("late", [0.0, 450.0], 1.0);
        signal(&kit.body.0, "-CONT");
        assert_ne!(wait_for(&mut kit.body.0, PATIENCE).code(), Some(0));
        // A late goal would be told before the end of the connection, which cancels everything again.
        let more: Vec<_> = nav2.tells.try_iter().collect();
        assert!(!more.iter().any(|it| it.starts_with("goal")), "{more:?}");
    }
}

#[test]
fn nav2_stands_when_the_body_is_killed() {
    lose("-KILL");
}

#[test]
fn nav2_stands_when_the_body_hangs() {
    lose("-STOP");
}

#[test]
fn a_nav2_that_hangs_or_does_not_stop_is_a_fault() {
    let nav2 = Nav2::at([0.0, 0.0], 1.0);
    let mut kit = Kit::with_body(&nav2);
    kit.start("1", [0.0, 400.0], 1.0);
    nav2.until("goal");
    signal(&nav2.process.0, "-STOP");
    kit.next("a fault", |it| it["type"] == "fault");
    // Nobody knows where it is.
    kit.until("beat");
    signal(&nav2.process.0, "-CONT");
    nav2.until("cancelled");
    // It can be used again.
    kit.start("2", [0.0, 1.0], 5.0);
    assert_eq!(kit.report(), json!({"type": "completed", "id": "2"}));
    kit.start("3", [510.0, 0.0], 1.0);
    nav2.until("goal");
    kit.say(&json!({"type": "stop", "id": "3", "why": "a test"}));
    assert_eq!(kit.report()["type"], "fault");
}
