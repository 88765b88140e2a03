//! Commands to robots by their operator ports, as a person has confirmed them on the page.
//!
//! Each question of the page is a connection of its own. Without an order it hears who is there and how that robot is. With
//! one it commands the robot that was confirmed, and no other, and hears what the robot says then.

use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::net::UnixStream;
use std::sync::{Mutex, TryLockError};
use std::time::{Duration, Instant};

use crossguard_robot::operator::Command;
use crossguard_robot::operator::port::VERSION;
use crossguard_robot::port::{PortAddress, connect};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// How long a robot may take to say who and how it is, and how long it is heard after an order.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often a question looks whether it has its turn.
const LOOK: Duration = Duration::from_millis(10);

/// The longest line that is read of a robot, and the longest order, in octets.
const LINE_MAX: u64 = 1 << 20;
const ORDER_MAX: usize = 512;

/// The orders that have a key and a button: label, key, line.
const KEYS: [[&str; 3]; 2] = [
    ["Stop", "s", "unavailable emergency-stop"],
    ["Clear", "c", "clear"],
];

/// A question of the page.
#[derive(Deserialize)]
struct Question {
    /// The place of the port among those of the studio.
    port: usize,
    order: Option<Order>,
}

#[derive(Deserialize)]
struct Order {
    /// The robot that the person confirmed, in the boot that it had then.
    robot: String,
    boot: u64,
    line: String,
}

/// Ports, commands and keys that the page offers.
#[derive(Serialize)]
pub(super) struct Offered {
    ports: Vec<String>,
    commands: Vec<&'static Command>,
    keys: [[&'static str; 3]; 2],
}

/// Answer of a robot, as lines of its port.
#[derive(Serialize)]
struct Answer {
    robot: String,
    boot: u64,
    /// The newest `state`, if one came.
    state: Option<Value>,
    /// Other lines after an order.
    said: Vec<Value>,
}

/// Why a robot does not answer.
#[derive(Debug, thiserror::Error)]
enum Trouble {
    #[error("it is no question: {0}")]
    Garbled(#[from] serde_json::Error),
    #[error("this studio has no such port")]
    NoPort,
    #[error("another question to this robot is under way. Nothing was sent: ask again")]
    Busy,
    #[error("an order has {ORDER_MAX} octets at most: nothing was sent")]
    Long,
    #[error(
        "{0}: no robot is reached: {1}. It does not run with this 'listen' under [operator], or it hangs"
    )]
    Absent(PortAddress, std::io::Error),
    #[error("{0}: nothing is heard of the robot: it hangs, or has just ended. Nothing was sent")]
    Silent(PortAddress),
    #[error("{0}: the robot refuses: {1}. Nothing was sent")]
    Refused(PortAddress, String),
    #[error(
        "{0}: {1}, boot {2}, is there now, and not the robot that you confirmed. Nothing was sent: ask again"
    )]
    Another(PortAddress, String, u64),
    #[error(
        "{0}: the connection ended while the order was sent: it is not known whether the robot has it"
    )]
    Lost(PortAddress),
}

/// The operator ports of a studio, each with the turn of the question to it.
pub(super) struct Operators(Vec<(PortAddress, Mutex<()>)>);

impl Operators {
    pub(super) fn new(ports: Vec<PortAddress>) -> Self {
        Self(ports.into_iter().map(|it| (it, Mutex::new(()))).collect())
    }

    pub(super) fn offered(&self) -> Offered {
        Offered {
            ports: self.0.iter().map(|(port, _)| port.to_string()).collect(),
            commands: Command::of_programs().collect(),
            keys: KEYS,
        }
    }

    /// The answer to a question of the page, or why there is none.
    pub(super) fn ask(&self, question: &[u8]) -> Result<String, String> {
        let answer = self.answer(question).map_err(|cause| cause.to_string())?;
        serde_json::to_string(&answer).map_err(|cause| cause.to_string())
    }

    fn answer(&self, question: &[u8]) -> Result<Answer, Trouble> {
        let Question { port, order } = serde_json::from_slice(question)?;
        let (port, turn) = self.0.get(port).ok_or(Trouble::NoPort)?;
        // An order that waits longer for its turn would come late.
        let until = Instant::now() + PATIENCE;
        let turn = loop {
            match turn.try_lock() {
                Err(TryLockError::WouldBlock) if Instant::now() >= until => {
                    return Err(Trouble::Busy);
                }
                Err(TryLockError::WouldBlock) => std::thread::sleep(LOOK),
                turn => break turn,
            }
        };
        if order.as_ref().is_some_and(|it| it.line.len() > ORDER_MAX) {
            return Err(Trouble::Long);
        }
        let (mut robot, mut answer) = meet(port)?;
        if let Some(order) = order {
            if (&order.robot, order.boot) != (&answer.robot, answer.boot) {
                return Err(Trouble::Another(port.clone(), answer.robot, answer.boot));
            }
            let command = json!({"type": "command", "line": order.line});
            say(robot.get_ref(), &command).map_err(|_| Trouble::Lost(port.clone()))?;
            // Another order, a stop, need not wait for what is said of this one.
            drop(turn);
            answer.state = None;
            let until = Instant::now() + PATIENCE;
            while let Some(line) = hear(&mut robot, until) {
                match line["type"].as_str() {
                    Some("state") => answer.state = Some(line),
                    Some("map" | "dropped") => {}
                    kind => {
                        let is_last = matches!(kind, Some("refused" | "stopped"));
                        answer.said.push(line);
                        if is_last {
                            break;
                        }
                    }
                }
            }
        }
        Ok(answer)
    }
}

/// Connects to a robot, and hears who and how it is.
fn meet(port: &PortAddress) -> Result<(BufReader<UnixStream>, Answer), Trouble> {
    let until = Instant::now() + PATIENCE;
    let robot = connect(port, PATIENCE).map_err(|cause| Trouble::Absent(port.clone(), cause))?;
    let mut robot = BufReader::new(robot);
    let hello = next(&mut robot, "hello", port, until)?;
    let greeting = json!({"type": "hello", "crossguard": VERSION});
    say(robot.get_ref(), &greeting).map_err(|_| Trouble::Silent(port.clone()))?;
    let answer = Answer {
        robot: hello["robot"].as_str().unwrap_or_default().to_owned(),
        boot: hello["boot"].as_u64().unwrap_or_default(),
        state: Some(next(&mut robot, "state", port, until)?),
        said: Vec::new(),
    };
    Ok((robot, answer))
}

/// The next line of this type.
fn next(
    robot: &mut BufReader<UnixStream>,
    kind: &str,
    port: &PortAddress,
    until: Instant,
) -> Result<Value, Trouble> {
    loop {
        let line = hear(robot, until).ok_or_else(|| Trouble::Silent(port.clone()))?;
        match line["type"].as_str() {
            Some("refused") => {
                let why = line["why"].as_str().unwrap_or_default();
                return Err(Trouble::Refused(port.clone(), why.to_owned()));
            }
            Some(it) if it == kind => return Ok(line),
            _ => {}
        }
    }
}

/// The next line of a robot; `None` when none comes until then, or none that is JSON.
fn hear(robot: &mut BufReader<UnixStream>, until: Instant) -> Option<Value> {
    let left = until.saturating_duration_since(Instant::now());
    // A time of zero is refused.
    robot.get_ref().set_read_timeout(Some(left)).ok()?;
    let mut line = String::new();
    robot.by_ref().take(LINE_MAX).read_line(&mut line).ok()?;
    serde_json::from_str(&line).ok()
}

fn say(mut robot: &UnixStream, line: &Value) -> std::io::Result<()> {
    robot.write_all(format!("{line}\n").as_bytes())
}
