//! Orders that the studio passes on to a robot by its operator port: real processes, on loopback.

use std::os::unix::net::UnixStream;
use std::os::unix::process::CommandExt as _;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crossguard_testkit::command::*;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::studio::{Studio, is_refused, parts};

/// The start of a request that is of the studio's own page.
const TYPED: &str = "Content-Type: application/json\r\n";

/// A question without an order.
const LOOK: &str = r#"{"port": 0}"#;

/// A robot with an operator port, and a studio that has this port and one where nobody is.
struct Street {
    folder: TempDir,
    ari: String,
    ports: [String; 2],
    log: String,
    studio: Studio,
}

impl Street {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let port = two_free_ports();
        let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
        let listen = "[operator]\nlisten = \"unix:ARI.sock\"\n\n[link]";
        edit(&ari, &[("[link]", listen)]);
        let unix = |name| format!("unix:{}", folder.path().join(name).display());
        let ports = ["ARI.sock", "absent.sock"].map(unix);
        let log = Path::new(&ari).with_extension("log");
        let log = log.to_str().unwrap().to_owned();
        let [one, other] = &ports;
        let arguments = ["--follow", &log, "--operator", one, "--operator", other];
        let studio = Studio::of(&arguments.map(Path::new));
        Self {
            folder,
            ari,
            ports,
            log,
            studio,
        }
    }

    fn start(&self) -> Killed {
        let robot = Killed(start(&self.ari));
        drop(self.connect());
        robot
    }

    fn connect(&self) -> UnixStream {
        connect(self.folder.path().join("ARI.sock"))
    }

    /// The code of the answer to a question, and the answer.
    fn ask(&self, question: &str, head: &str) -> (String, String) {
        let head = format!("Content-Length: {}\r\n{head}", question.len());
        let own = &self.studio.address;
        let request = "POST /live/api/operator";
        parts(&self.studio.send(request, own, &head, question.as_bytes()))
    }

    fn order(&self, boot: u64, robot: &str, line: &str) -> (String, String) {
        let order = json!({"robot": robot, "boot": boot, "line": line});
        self.ask(&json!({"port": 0, "order": order}).to_string(), TYPED)
    }
}

#[track_caller]
fn answered((code, answer): (String, String)) -> Value {
    assert_eq!(code, "200", "{answer}");
    serde_json::from_str(&answer).unwrap()
}

/// Hazards: the robot that obeys is not the one that somebody confirmed; a robot that is gone or hangs looks as if it had obeyed.
#[test]
fn a_robot_is_told_what_was_confirmed_for_it_and_its_own_answer_is_passed_on() {
    let street = Street::new();
    is_refused(&street.ask(LOOK, TYPED), "400", "no robot is reached");
    let mut robot = street.start();
    let there = answered(street.ask(LOOK, TYPED));
    assert_eq!(
        (&there["robot"], &there["state"]["state"], &there["said"]),
        (&json!("ARI"), &json!("Idle"), &json!([]))
    );
    let boot = there["boot"].as_u64().unwrap();
    let another = "ARI, boot 1, is there now, and not the robot";
    for (boot, robot, line, cause) in [
        (boot, "Go2", "clear", another),
        (boot + 1, "ARI", "clear", another),
        (boot, "ARI", &*"x".repeat(513), "512 octets"),
    ] {
        is_refused(&street.order(boot, robot, line), "400", cause);
    }

    // A robot that hangs is told nothing, and takes nobody in when so many wait.
    signal(&robot.0, "-STOP");
    let cause = "it hangs, or has just ended. Nothing was sent";
    is_refused(&street.order(boot, "ARI", "clear"), "400", cause);
    for _ in 0..16 {
        drop(street.connect());
    }
    let cause = "no robot is reached";
    is_refused(&street.order(boot, "ARI", "clear"), "400", cause);
    signal(&robot.0, "-CONT");
    wait_until("the robot to go on", || street.ask(LOOK, TYPED).0 == "200");

    let obeys = |line: &str| answered(street.order(boot, "ARI", line));
    let said = |answer: &Value, key: &str, value: &str| {
        let said = answer["said"].as_array().unwrap();
        said.iter().any(|it| it[key] == value)
    };
    let (answer, why) = (obeys("dance"), "no command 'dance'; type 'help'");
    assert!(said(&answer, "why", why), "{answer}");
    let answer = obeys("clear");
    assert!(said(&answer, "reason", "nothingNew"), "{answer}");
    // The port takes each order that has a key, but not what a person cannot have looked for again.
    let own = &street.studio.address;
    let offered = street.studio.ask("GET /live/api/operators", own, "");
    let offered = answered(parts(&offered));
    assert_eq!(offered["ports"], json!(street.ports));
    for order in offered["keys"].as_array().unwrap() {
        let line = order[2].as_str().unwrap();
        let answer = obeys(line);
        let is_refused = said(&answer, "type", "refused");
        assert_eq!(is_refused, line == "clear", "{answer}");
        let is_stopped = answer["state"]["availability"] == "emergencyStop";
        assert!(is_stopped || is_refused, "{answer}");
    }
    let answer = obeys("quit");
    assert!(said(&answer, "type", "stopped"), "{answer}");
    let ended = wait_for(&mut robot.0, Duration::from_mins(1));
    assert_eq!(ended.code(), Some(0));
    let told = records(&std::fs::read_to_string(&street.log).unwrap());
    let told = told.iter().filter_map(|it| it["input"].get("local"));
    let told: Vec<_> = told.map(ToString::to_string).collect();
    let stop = r#"{"availabilityChanged":{"unavailable":"emergencyStop"}}"#;
    assert_eq!(told, [r#""roadClear""#, stop]);
    let answer = street.order(boot, "ARI", "clear");
    is_refused(&answer, "400", "no robot is reached");
}

/// Hazard: a page of a stranger, or another account of the machine, opens the corridor or sends guards away.
#[test]
fn a_stranger_commands_no_robot_through_the_studio() {
    let street = Street::new();
    let _robot = street.start();
    let evil = format!("Origin: http://evil.example\r\n{TYPED}");
    let (plain, absent) = (
        "Content-Type: text/plain\r\n",
        "absent.sock: no robot is reached",
    );
    for (question, head, code, cause) in [
        (LOOK, TYPED, "200", "ARI"),
        (LOOK, &*evil, "403", "another origin"),
        (LOOK, "", "403", "application/json"),
        (LOOK, plain, "403", "application/json"),
        ("{}", TYPED, "400", "missing field `port`"),
        (r#"{"port": 2}"#, TYPED, "400", "no such port"),
        (r#"{"port": 1}"#, TYPED, "400", absent),
    ] {
        is_refused(&street.ask(question, head), code, cause);
    }
    let own = &*street.studio.address;
    for (request, host, code) in [
        ("GET /live/api/operator", own, "400"),
        ("POST /live/api/operator", "evil.example", "421"),
    ] {
        let (got, answer) = parts(&street.studio.send(request, host, TYPED, b""));
        assert_eq!(got, code, "{answer}");
    }
    let [port, _] = &street.ports;
    for (listen, name, value, cause) in [
        (&**port, "--address", "0.0.0.0", "others than this machine"),
        ("127.0.0.1:47700", "--port", "0", "is no UNIX socket"),
    ] {
        let follow = ["studio", "--follow", &street.log, "--operator", listen];
        let output = run(&[&follow[..], &[name, value]].concat());
        assert_refused(&output, cause);
    }

    let python = "import sys, urllib.request as it; it.urlopen(it.Request(sys.argv[1], sys.argv[2].encode(), \
                  {'Content-Type': 'application/json'}))";
    let url = format!("http://{own}/live/api/operator");
    let ask_as = |user| {
        let mut program = Command::new("/usr/bin/python3");
        program.args(["-c", python, &url, LOOK]).uid(user).output()
    };
    match ask_as(12_345) {
        Ok(other) => {
            stderr(&other).must_have(&["HTTP Error 403"]);
            assert_code(&ask_as(0).unwrap(), 0);
        }
        Err(cause) => skipped(&format!("no python3 of another user: {cause}")),
    }
}
