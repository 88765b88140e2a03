//! From a command to its acknowledgement between two running robots on the loopback interface: median and the
//! tail, of several thousand commands, over UDP and, with the feature `zenoh`, over zenoh.
//!
//! `cargo bench -p crossguard-robot --features zenoh --bench latency [-- COMMANDS]`

use std::net::{TcpListener, UdpSocket};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use crossguard_codec::{Identifiers, TaskParameters};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::station::Security;
use crossguard_protocol::{Config, Event, Notice, Output, Phase, Rmcm, StationId, TaskType};
use crossguard_robot::application::{Application, Wish};
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::boot::Boot;
use crossguard_robot::journal::{Journal, WhenFull};
use crossguard_robot::plan::Plan;
use crossguard_robot::runtime::{Clock, Order, Running, Setup};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::trace::{Entry, Record};
use crossguard_robot::transport::{
    Framing, Halves, Link, LinkError, Transport, Zenoh, ZenohError, ZenohMode, ZenohRouter,
};

const COMMANDS: usize = 5_000;

/// A leader whose commands are given from here, and its follower.
struct Pair {
    leader: Running,
    follower: Running,
    records: Receiver<Arc<Record>>,
}

/// What two robots meet over.
struct Street {
    leader: Halves,
    follower: Halves,
    _router: Option<ZenohRouter>,
}

type Open = fn() -> Result<Street, LinkError>;

/// Ports that are free now; where another process takes them in between, the benchmark fails.
fn udp() -> Result<Street, LinkError> {
    let free = || UdpSocket::bind("127.0.0.1:0").and_then(|socket| socket.local_addr());
    let (first, second) = (free().expect("a port"), free().expect("a port"));
    let link = |address, peer| Link::Peers {
        address,
        peers: vec![peer],
        framing: Framing::default(),
    };
    Ok(Street {
        leader: link(first, second).open()?,
        follower: link(second, first).open()?,
        _router: None,
    })
}

/// An endpoint of zenoh whose port nobody has now.
fn endpoint() -> Vec<String> {
    let free = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
    vec![format!("tcp/{}", free.expect("a port"))]
}

fn zenoh_peers() -> Result<Street, LinkError> {
    let (listen, part) = (endpoint(), Zenoh::new(ZenohMode::Peer));
    let (connect, other) = (listen.clone(), part.clone());
    Ok(Street {
        leader: Link::Zenoh(Zenoh { listen, ..part }).open()?,
        follower: Link::Zenoh(Zenoh { connect, ..other }).open()?,
        _router: None,
    })
}

fn zenoh_router() -> Result<Street, LinkError> {
    let listen = endpoint();
    let client = Link::Zenoh(Zenoh {
        connect: listen.clone(),
        ..Zenoh::new(ZenohMode::Client)
    });
    let router = ZenohRouter::open(&Zenoh {
        listen,
        ..Zenoh::new(ZenohMode::Router)
    })?;
    Ok(Street {
        leader: client.open()?,
        follower: client.open()?,
        _router: Some(router),
    })
}

fn start(leader: Halves, follower: Halves) -> Pair {
    let mut journal = Journal::new();
    let records = journal.reader(65_536, WhenFull::End, Cause::LogFull);
    let clock = Clock::start();
    let robot = |name: &str, station, link| {
        let body = Simulated::new(
            Build::Quadruped,
            Site::default(),
            Place::new(0.0, f64::from(station)),
            1.0,
            1,
        );
        Setup {
            name: name.to_owned(),
            station: StationId(station),
            boot: Boot::first_of_its_kind(),
            config: Config::default(),
            identifiers: Identifiers::default(),
            security: Security::default(),
            awareness: Awareness::default(),
            application: Application::new(Box::new(body), None),
            link,
            journal: journal.clone(),
            clock,
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
    println!("| over | commands | median [µs] | 99 % [µs] | 99.9 % [µs] | longest [µs] |");
    println!("|---|--:|--:|--:|--:|--:|");
    let streets: [(&str, Open); 3] = [
        ("UDP", udp),
        ("zenoh, peers", zenoh_peers),
        ("zenoh, through a router", zenoh_router),
    ];
    for (over, street) in streets {
        match street() {
            Ok(street) => measure(over, street, wanted.unwrap_or(COMMANDS)),
            Err(LinkError::Zenoh(ZenohError::NotBuilt)) => {
                println!("| {over} | takes `--features zenoh` | | | | |");
            }
            Err(error) => panic!("{error}"),
        }
    }
}

fn measure(over: &str, street: Street, commands: usize) {
    let pair = start(street.leader, street.follower);
    let mut taken = pair.measure(commands);
    pair.leader.stop().expect("no panic");
    pair.follower.stop().expect("no panic");
    assert!(!taken.is_empty(), "no command was acknowledged");
    taken.sort_unstable();
    let quantile = |per_mille: usize| taken[(taken.len() - 1) * per_mille / 1_000];
    println!(
        "| {over} | {} | {} | {} | {} | {} |",
        taken.len(),
        quantile(500),
        quantile(990),
        quantile(999),
        quantile(1_000)
    );
}
