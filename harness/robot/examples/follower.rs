//! A robot stack that embeds the endpoint: it offers its help, and does what its leader commands, one crossing
//! long. Its peer is another process:
//!
//! ```text
//! crossguard run --config harness/examples/ari.toml
//! ```
//!
//! ```text
//! Usage: follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]
//! ```
//!
//! The body is a stand-in that takes three seconds for everything, and eight for an escort. Yours goes to the same places.
//!
//! It is an example of the protocol alone, and no robot for a road. It leaves these rules of `protocol/doc/integration.md` to you:
//! its body has no sensors (24), waits for no vehicle (27) and as escort for nobody (29), and does not look before it leaves the road
//! after a boot (30).

use std::error::Error;
use std::fs::File;
use std::io::ErrorKind;
use std::net::UdpSocket;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use crossguard_codec::{Identifiers, Position, RobotState, Target, TaskParameters, si};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Event, ManeuverId, Notice, Output, Robot, StationId, TaskType};
use crossguard_robot::boot;
use crossguard_robot::trace::{self, Entry, Record};

/// Longer than any packet, so that a longer one is seen to be too long.
const DATAGRAM_MAX: usize = 2_048;
/// How long the stand-in takes for a maneuver.
const MANEUVER: Duration = Duration::from_secs(3);
/// And for an escort, which stays until its person is off the road: people of `harness/examples/ari.toml` are on it for less.
const ESCORT: Duration = Duration::from_secs(8);

struct Follower {
    endpoint: Endpoint,
    socket: UdpSocket,
    peer: u16,
    log: Option<File>,
    began: Instant,
    /// Where the body is, in degrees. A leader does not believe a follower that is elsewhere than it was sent.
    position: Position,
    /// The maneuver that the body carries out, its target, and when it ends.
    running: Option<(ManeuverId, Option<Target>, Instant)>,
    completed: usize,
    is_released: bool,
}

impl Follower {
    /// Tells the endpoint what happened, and carries out what it wants, in its order.
    fn handle(&mut self, stimulus: Stimulus<'_>) -> Result<(), Box<dyn Error>> {
        let now_ms = self.now_ms();
        let moment = Moment {
            now_ms,
            timestamp_its: si::timestamp_its(unix_ms()),
        };
        // State of the body as the sensors know it; unknown fields stay unavailable.
        let state = RobotState {
            position: self.position,
            speed: Some(if self.running.is_some() { 0.5 } else { 0.0 }.into()),
            ..RobotState::default()
        };
        for effect in self.endpoint.handle(moment, &state, stimulus) {
            let packet = match &effect {
                Effect::Transmit { packet, .. } => Some(packet.clone()),
                _ => None,
            };
            if let Effect::Act(output, parameters) = &effect {
                self.act(*output, parameters);
            }
            // A packet is logged before it is sent: no receiver logs it before its sender.
            if let Some(entry) = trace::recorded(effect) {
                self.record(entry)?;
            }
            if let Some(packet) = packet {
                // A message that cannot be sent is a message that is lost.
                let _ = self.socket.send_to(&packet, ("127.0.0.1", self.peer));
            }
        }
        Ok(())
    }

    /// The body, and the application.
    fn act(&mut self, output: Output, parameters: &TaskParameters) {
        println!("{output}");
        match output {
            Output::StartManeuver(maneuver) => {
                let is_escort = maneuver.task == TaskType::MOVE;
                let takes = if is_escort { ESCORT } else { MANEUVER };
                self.running = Some((maneuver.id, parameters.target, Instant::now() + takes));
            }
            // A body that falls back takes its time. Until the application tells `Event::RoadClear`, once the
            // body is where the policy wants it and nobody is on the road, the robot helps nobody else.
            Output::StopManeuver(..) | Output::FallBack(..) => self.running = None,
            Output::Notify(Notice::Released(..)) => self.is_released = true,
            _ => {}
        }
    }

    /// Says so when the body has finished.
    fn advance(&mut self) -> Result<(), Box<dyn Error>> {
        match self.running {
            Some((maneuver, target, until)) if Instant::now() >= until => {
                self.running = None;
                self.completed += 1;
                if let Some(Target::Position {
                    latitude,
                    longitude,
                    ..
                }) = target
                {
                    self.position = Position::at(latitude, longitude);
                }
                self.handle(Stimulus::Event(Event::ManeuverCompleted(maneuver)))
            }
            _ => Ok(()),
        }
    }

    fn now_ms(&self) -> u64 {
        u64::try_from(self.began.elapsed().as_millis()).unwrap_or(u64::MAX)
    }

    fn record(&mut self, entry: Entry) -> Result<(), Box<dyn Error>> {
        let record = Record {
            at_us: u64::try_from(self.began.elapsed().as_micros())?,
            robot: "follower".to_owned(),
            entry,
        };
        if let Some(log) = &mut self.log {
            trace::write(log, &record)?;
        }
        Ok(())
    }

    /// Until the leader has ended its session.
    fn run(&mut self) -> Result<(), Box<dyn Error>> {
        let robot = self.endpoint.robot();
        let (station, boot) = (robot.station(), robot.boot());
        self.record(Entry::Started {
            station,
            boot,
            epoch: None,
            settings: Box::new(self.endpoint.config().settings().clone()),
            identifiers: *self.endpoint.identifiers(),
            unix_ms: u64::try_from(unix_ms())?,
            speed: None,
        })?;
        let mut packet = [0; DATAGRAM_MAX];
        while !self.is_released {
            // The socket waits for 10 ms at most, which is less than `delay_max`.
            match self.socket.recv(&mut packet) {
                Ok(length) => {
                    // The socket is asked all the time, so that nothing has been waiting there. A stack with
                    // a queue notes the time where it fills it.
                    let datagram = Stimulus::Datagram {
                        packet: &packet[..length],
                        arrived_ms: self.now_ms(),
                    };
                    self.handle(datagram)?;
                }
                Err(error) if is_nothing(&error) => self.handle(Stimulus::Time)?,
                Err(error) => return Err(error.into()),
            }
            self.advance()?;
        }
        let counters = self.endpoint.counters().named();
        self.record(Entry::Stopped { counters })
    }
}

/// Whether the socket only says that nothing came in time.
fn is_nothing(error: &std::io::Error) -> bool {
    use ErrorKind::{Interrupted, TimedOut, WouldBlock};
    matches!(error.kind(), Interrupted | TimedOut | WouldBlock)
}

fn unix_ms() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |since| {
        i64::try_from(since.as_millis()).unwrap_or(i64::MAX)
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [station, port, peer, boot_file, rest @ ..] = &arguments[..] else {
        return Err("usage: follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]".into());
    };
    // Counted up and on the disk before anything is sent; held until the end.
    let boot = boot::take(Path::new(boot_file))?;
    let robot = Robot::new(StationId(station.parse()?), boot.counter);
    let socket = UdpSocket::bind(("127.0.0.1", port.parse()?))?;
    socket.set_read_timeout(Some(Duration::from_millis(10)))?;
    let mut follower = Follower {
        endpoint: Endpoint::new(robot, Config::default(), Identifiers::default(), 0),
        socket,
        peer: peer.parse()?,
        log: rest.first().map(File::create).transpose()?,
        began: Instant::now(),
        position: Position::at(49.010_1, 8.412_4),
        running: None,
        completed: 0,
        is_released: false,
    };
    follower.run()?;
    println!("{} maneuvers completed", follower.completed);
    Ok(())
}
