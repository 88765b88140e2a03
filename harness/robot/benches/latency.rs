//! From a command to its acknowledgement between two running robots on the loopback interface: median and the
//! tail, of several thousand commands, over UDP.
//!
//! `cargo bench -p crossguard-robot --bench latency [-- COMMANDS]`

use std::net::UdpSocket;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use crossguard_codec::TaskParameters;
use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{Event, Notice, Output, Phase, Rmcm, StationId, TaskType};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::journal::{Journal, WhenFull};
use crossguard_robot::plan::Plan;
use crossguard_robot::runtime::{Clock, Order, Running, Setup};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::trace::{Entry, Record};
use crossguard_robot::transport::{Framing, Halves, Link, Transport};

const COMMANDS: usize = 5_000;

/// A leader whose commands are given from here, and its follower.
struct Pair {
    leader: Running,
    follower: Running,
    records: Receiver<Arc<Record>>,
}

/// Ports that are free now; where another process takes them in between, the benchmark fails.
fn udp() -> [Halves; 2] {
    let free = || UdpSocket::bind("127.0.0.1:0").and_then(|socket| socket.local_addr());
    let (first, second) = (free().expect("a port"), free().expect("a port"));
    [(first, second), (second, first)].map(|(address, peer)| {
        let link = Link::Peers {
            address,
            peers: vec![peer],
            framing: Framing::default(),
        };
        link.open().expect("free ports")
    })
}

fn start([leader, follower]: [Halves; 2]) -> Pair {
    let mut journal = Journal::new();
    let records = journal.reader(65_536, WhenFull::End, Cause::LogFull);
    let clock = Clock::start();
    let robot = |name, station, link| {
        let place = Place::new(0.0, f64::from(station));
        let body = Simulated::new(Build::Quadruped, Site::default(), place, 1.0, 1);
        let application = Application::new(Box::new(body), None);
        Setup {
            journal: journal.clone(),
            clock,
            ..Setup::new(name, StationId(station), application, link)
        }
        .start()
    };
    Pair {
        leader: robot("leader", 1, leader),
        follower: robot("follower", 2, follower),
        records,
    }
}

impl Pair {
    /// Gives commands one after the other; how long each took to be acknowledged, in µs.
    fn measure(&self, commands: usize) -> Vec<u64> {
        let plan = Plan::crossing(Site::default());
        let detected = Event::PedestrianDetected(plan.request());
        self.leader.order(Order::Wish(Stimulus::Event(detected)));
        let (mut taken, mut commanded_us) = (Vec::new(), None);
        let deadline = Instant::now() + Duration::from_mins(10);
        while taken.len() < commands && Instant::now() < deadline {
            let record = match self.records.recv_timeout(Duration::from_millis(100)) {
                Ok(record) => record,
                Err(RecvTimeoutError::Timeout) => continue,
                Err(RecvTimeoutError::Disconnected) => break,
            };
            let Entry::Step { outputs, state, .. } = &record.entry else {
                continue;
            };
            if record.robot != "leader" {
                continue;
            }
            let mut is_free = false;
            for output in outputs.iter() {
                match output {
                    Output::SendRmcm(Rmcm::Command(_)) => {
                        commanded_us = commanded_us.or(Some(record.at_us));
                    }
                    Output::Notify(Notice::CommandAcknowledged(..)) => {
                        if let Some(began_us) = commanded_us.take() {
                            taken.push(record.at_us - began_us);
                        }
                        is_free = true;
                    }
                    Output::Notify(Notice::FollowerJoined(_)) => is_free = true,
                    Output::Notify(Notice::SessionEnded(..)) => {
                        // The numbers of the session's commands are used up, or something went wrong.
                        commanded_us = None;
                        if matches!(state.phase(), Phase::Idle) {
                            self.leader.order(Order::Wish(Stimulus::Event(detected)));
                        }
                    }
                    _ => {}
                }
            }
            if is_free {
                self.leader.order(Order::Wish(Stimulus::Order {
                    follower: StationId(2),
                    task: TaskType::MOVE,
                    parameters: TaskParameters::default(),
                }));
            }
        }
        taken
    }
}

fn main() {
    let wanted = std::env::args().skip(1).find_map(|word| word.parse().ok());
    let pair = start(udp());
    let mut taken = pair.measure(wanted.unwrap_or(COMMANDS));
    pair.leader.stop().expect("no panic");
    pair.follower.stop().expect("no panic");
    assert!(!taken.is_empty(), "no command was acknowledged");
    taken.sort_unstable();
    let quantile = |per_mille: usize| taken[(taken.len() - 1) * per_mille / 1_000];
    println!("| over | commands | median [µs] | 99 % [µs] | 99.9 % [µs] | longest [µs] |");
    println!("|---|--:|--:|--:|--:|--:|");
    println!(
        "| UDP | {} | {} | {} | {} | {} |",
        taken.len(),
        quantile(500),
        quantile(990),
        quantile(999),
        quantile(1_000)
    );
}
