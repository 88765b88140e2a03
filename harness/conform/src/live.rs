//! A robot under test over a link, as a process of its own or anywhere else.

use std::io::{BufRead, Write};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use crossguard_codec::si::timestamp_its;
use crossguard_robot::transport::{Arrival, Halves};

use crate::subject::{Gone, Local, NotTold, Packet, Subject, Telling};

/// Ways in which events come about at the robot.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Events {
    /// Not at all.
    Nobody,
    /// By lines on the standard input of the process that was started, as `crossguard run` takes them.
    Typed,
    /// By this command, to which the words of the line are added. It ends with 0 when that was done.
    Hook(String),
    /// By a person who is asked.
    Ask,
    /// The robot does it by itself, when it likes.
    Unattended,
}

/// A robot that is reached over a link.
pub struct Live {
    link: Halves,
    began: Instant,
    start: Option<String>,
    events: Events,
    child: Option<Child>,
    stop: Arc<AtomicBool>,
}

/// How long the link is waited at before it is looked whether the tester is to stop.
const LOOK: Duration = Duration::from_millis(50);

impl Live {
    /// A robot at this link; `start` is the command that starts it, if the tester is to do that.
    #[must_use]
    pub fn new(link: Halves, start: Option<String>, events: Events, stop: Arc<AtomicBool>) -> Self {
        Self {
            link,
            began: Instant::now(),
            start,
            events,
            child: None,
            stop,
        }
    }

    /// Whether the tester starts the robot.
    #[must_use]
    pub const fn is_started_here(&self) -> bool {
        self.start.is_some()
    }

    /// Ends the process, if there is one.
    pub fn end(&mut self) {
        if let Some(mut child) = self.child.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }

    fn has_ended(&mut self) -> bool {
        let child = self.child.as_mut();
        child.is_some_and(|child| matches!(child.try_wait(), Ok(Some(_))))
    }

    fn type_line(&mut self, line: &str) -> Result<(), String> {
        let child = self.child.as_mut();
        let input = child.and_then(|child| child.stdin.as_mut());
        let input = input.ok_or_else(|| "the robot was not started by --start".to_owned())?;
        writeln!(input, "{line}")
            .and_then(|()| input.flush())
            .map_err(|error| error.to_string())
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.end();
    }
}

/// Has a command of the user do it.
fn run_hook(command: &str, line: &str) -> Result<(), String> {
    let status = shell(&format!("{command} {line}"))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .status()
        .map_err(|error| error.to_string())?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("the hook ended with {status}"))
    }
}

fn ask(line: &str) -> Result<(), String> {
    let mut answer = String::new();
    let _ = write!(
        std::io::stderr(),
        "At the robot: {line}. Press Enter when that is done, or type 'no' if it cannot be: "
    );
    let read = std::io::stdin().lock().read_line(&mut answer);
    match read {
        Ok(octets) if octets > 0 && answer.trim() != "no" => Ok(()),
        _ => Err("it could not be done".to_owned()),
    }
}

fn shell(command: &str) -> Command {
    let mut shell = Command::new("sh");
    shell.arg("-c").arg(command);
    shell
}

impl Subject for Live {
    fn now_ms(&self) -> u64 {
        u64::try_from(self.began.elapsed().as_millis()).unwrap_or(u64::MAX)
    }

    fn timestamp_its(&self) -> u64 {
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        let unix_ms = since.map_or(0, |since| since.as_millis());
        timestamp_its(i64::try_from(unix_ms).unwrap_or(i64::MAX))
    }

    fn listen(&mut self, until_ms: u64) -> Result<Option<Packet>, Gone> {
        loop {
            if self.stop.load(Ordering::Relaxed) {
                return Err(Gone::Stopped);
            }
            let left = Duration::from_millis(until_ms.saturating_sub(self.now_ms()));
            let arrival = self.link.receiver.receive(left.min(LOOK));
            match arrival.map_err(|error| Gone::Link(error.to_string()))? {
                Some(Arrival::Datagram { octets, at, .. }) => {
                    let at_ms = at.saturating_duration_since(self.began).as_millis();
                    let at_ms = u64::try_from(at_ms).unwrap_or(u64::MAX);
                    return Ok(Some(Packet { at_ms, octets }));
                }
                _ if self.has_ended() => return Err(Gone::Ended),
                _ if self.now_ms() >= until_ms => return Ok(None),
                _ => {}
            }
        }
    }

    fn send(&mut self, packet: &[u8]) -> Result<(), Gone> {
        match self.link.sender.send(packet) {
            // No robot may be there yet.
            Err(error)
                if !error.is_passing()
                    && error.cause.kind() != std::io::ErrorKind::ConnectionRefused =>
            {
                Err(Gone::Link(error.to_string()))
            }
            _ => Ok(()),
        }
    }

    fn tell(&mut self, local: Local) -> Result<Telling, NotTold> {
        let line = local.to_string();
        let told = match self.events.clone() {
            Events::Nobody => return Err(NotTold::NoWay(line)),
            Events::Unattended => return Ok(Telling::Awaited),
            Events::Typed => self.type_line(&line),
            Events::Hook(command) => run_hook(&command, &line),
            Events::Ask => ask(&line),
        };
        told.map(|()| Telling::Told)
            .map_err(|why| NotTold::Failed { what: line, why })
    }

    fn restart(&mut self) -> Result<(), NotTold> {
        let Some(start) = self.start.clone() else {
            return Err(NotTold::NoRestart);
        };
        self.end();
        // Messages of its last life do not count.
        while let Ok(Some(_)) = self.link.receiver.receive(Duration::from_millis(1)) {}
        let child = shell(&format!("exec {start}"))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .spawn();
        match child {
            Ok(child) => {
                self.child = Some(child);
                Ok(())
            }
            Err(error) => Err(NotTold::Failed {
                what: start,
                why: error.to_string(),
            }),
        }
    }
}
