//! From a command to its acknowledgement between two running robots over UDP on the loopback interface:
//! median and the tail, of several thousand commands.
//!
//! `cargo bench -p crossguard-harness --bench latency [-- COMMANDS]`

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use crossguard_codec::TaskParameters;
use crossguard_harness::application::{Application, Wish};
use crossguard_harness::body::{Body, Build};
use crossguard_harness::counters::Cause;
use crossguard_harness::journal::{Journal, WhenFull};
use crossguard_harness::plan::Plan;
use crossguard_harness::ras::surroundings::Awareness;
use crossguard_harness::runtime::{Clock, Order, Running, Setup};
use crossguard_harness::site::{Place, Site};
use crossguard_harness::station::Security;
use crossguard_harness::trace::{Entry, Record};
use crossguard_harness::transport::{Link, Transport};
use crossguard_harness::wire::Wire;
use crossguard_protocol::{Config, Event, Notice, Output, Phase, Rmcm, StationId, TaskType};

const COMMANDS: usize = 5_000;

/// A leader whose commands are given from here, and its follower.
struct Pair {
    leader: Running,
    follower: Running,
    records: Receiver<Arc<Record>>,
}

fn start() -> Pair {
    // Ports that nobody has now; whoever takes them in between makes the benchmark fail.
    let free = || UdpSocket::bind("127.0.0.1:0").and_then(|socket| socket.local_addr());
    let (first, second) = (free().expect("a port"), free().expect("a port"));
    let mut journal = Journal::new();
    let records = journal.reader(65_536, WhenFull::End, Cause::LogFull);
    let clock = Clock::start();
    let robot = |name: &str, station, address: SocketAddr, peer| {
        let peers = vec![peer];
        let body = Body::new(
            Build::Quadruped,
            Site::default(),
            Place::new(0.0, f64::from(station)),
            1.0,
            1,
        );
        Setup {
            name: name.to_owned(),
            station: StationId(station),
            boot: 1,
            config: Config::default(),
            wire: Wire::default(),
            security: Security::default(),
            awareness: Awareness::default(),
            application: Application::new(body, None),
            link: Link::Peers { address, peers }
                .open()
                .expect("the sockets open"),
            journal: journal.clone(),
            clock,
        }
        .start()
    };
    assert!(first.ip() == Ipv4Addr::LOCALHOST);
    Pair {
        leader: robot("leader", 1, first, second),
        follower: robot("follower", 2, second, first),
        records,
    }
}

impl Pair {
    /// Gives commands one after the other; how long each took to be acknowledged, in µs.
    fn measure(&self, commands: usize) -> Vec<u64> {
        let plan = Plan::crossing(Site::default());
        let detected = Event::PedestrianDetected(plan.request());
        self.leader.order(Order::Wish(Wish::Tell(detected)));
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
                            self.leader.order(Order::Wish(Wish::Tell(detected)));
                        }
                    }
                    _ => {}
                }
            }
            if is_free {
                self.leader.order(Order::Wish(Wish::Order {
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
    let pair = start();
    let mut taken = pair.measure(wanted.unwrap_or(COMMANDS));
    pair.leader.stop();
    pair.follower.stop();
    assert!(!taken.is_empty(), "no command was acknowledged");
    taken.sort_unstable();
    let quantile = |per_mille: usize| taken[(taken.len() - 1) * per_mille / 1_000];
    println!("| commands | median [µs] | 99 % [µs] | 99.9 % [µs] | longest [µs] |");
    println!("|--:|--:|--:|--:|--:|");
    println!(
        "| {} | {} | {} | {} | {} |",
        taken.len(),
        quantile(500),
        quantile(990),
        quantile(999),
        quantile(1_000)
    );
}
