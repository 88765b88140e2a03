//! The paper's proof of concept: a humanoid and a robot dog help a pedestrian across.
//!
//! Two endpoints with sockets of their own on the loopback interface; fan-out to the peer stands for
//! the radio's broadcast. Nothing leaves the machine.

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use crossguard_protocol::{Config, Event, Notice, Output, Phase, StationId};
use serde::Serialize;

use crate::application::{Application, Wish};
use crate::body::{Body, Build};
use crate::capture::Capture;
use crate::plan::Plan;
use crate::runtime::{Clock, Order, Running, Setup};
use crate::site::{Place, Site};
use crate::station::{Mode, Security};
use crate::timing::{Summary, Timing};
use crate::trace::{self, Entry, Record};
use crate::transport::{Faults, Halves, Link, LinkError, Transport, WithFaults};
use crate::validate::{self, Validated};
use crate::wire::Wire;

/// The humanoid, which leads.
pub const ARI: (&str, StationId) = ("ARI", StationId(1));
/// The robot dog, which follows.
pub const GO2: (&str, StationId) = ("Go2", StationId(2));

/// How many records the log may lag behind.
const LOG: usize = 65_536;

/// How often a crossing that did not succeed is begun again within one trial.
const ATTEMPTS: usize = 5;

/// What a demonstration is like.
#[derive(Clone, Debug)]
pub struct Options {
    /// How many crossings.
    pub trials: usize,
    /// How many times as fast as real the robots move.
    pub time_scale: f64,
    /// What happens to datagrams on the way to each robot.
    pub faults: Faults,
    /// Seed of faults and gait.
    pub seed: u64,
    /// Port of the first robot; the second has the next one.
    pub port: u16,
    /// How much security there is.
    pub security_mode: Mode,
    /// The security of each robot.
    pub security: [Security; 2],
    /// Where packets are recorded.
    pub capture: Option<Capture>,
}

/// What came of a demonstration.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Times by kind of maneuver.
    pub maneuvers: Vec<Summary>,
    /// Whether the log, replayed through the transition function, is what the robots did.
    pub trace_valid: bool,
    /// What the log holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace: Option<Validated>,
    /// Why the log is not valid, where it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace_error: Option<String>,
    /// How many crossings were completed.
    pub crossings: usize,
    /// How many were asked for.
    pub trials: usize,
    /// How many were begun again because something got lost.
    pub retries: usize,
    /// How many times as fast as real the robots moved.
    pub speed: f64,
    /// What happened to datagrams on the way to each robot.
    pub faults: String,
    /// Seed of faults and gait.
    pub seed: u64,
    /// How much security there was.
    pub security: Mode,
    /// The state of each robot in the end.
    pub final_states: BTreeMap<String, String>,
    /// What came to nothing, by robot and cause.
    pub counters: BTreeMap<String, BTreeMap<String, u64>>,
}

impl Outcome {
    /// Whether every crossing was completed, all robots are idle, and the log is valid.
    #[must_use]
    pub fn succeeded(&self) -> bool {
        self.trace_valid
            && self.crossings == self.trials
            && self.final_states.values().all(|state| state == "Idle")
    }
}

/// A demonstration that runs.
struct Demo<'a> {
    robots: [(&'static str, Running); 2],
    records: Receiver<Record>,
    plan: Plan,
    timing: Timing,
    /// The log as it would stand in a file.
    log: Vec<u8>,
    /// For each robot, whether it is idle and says farewell to nothing, and its state's name.
    rest: BTreeMap<String, (bool, String)>,
    counters: BTreeMap<String, BTreeMap<String, u64>>,
    /// How the newest session of the leader ended.
    ended_well: Option<bool>,
    watch: &'a mut dyn FnMut(&Record),
}

/// Runs a demonstration. `watch` sees every record as it is made.
///
/// # Errors
/// When a socket cannot be opened.
pub fn run(
    options: &Options,
    watch: &mut dyn FnMut(&Record),
) -> Result<(Outcome, Vec<u8>), LinkError> {
    let mut demo = start(options, watch)?;
    let (mut crossings, mut retries) = (0, 0);
    for _ in 0..options.trials {
        for attempt in 0..ATTEMPTS {
            retries += usize::from(attempt > 0);
            if demo.cross(options) {
                crossings += 1;
                break;
            }
        }
    }
    Ok(demo.finish(options, crossings, retries))
}

fn start<'a>(options: &Options, watch: &'a mut dyn FnMut(&Record)) -> Result<Demo<'a>, LinkError> {
    let (log, records) = sync_channel(LOG);
    let site = Site::default();
    let plan = Plan::crossing(site);
    let clock = Clock::start();
    let addresses = [options.port, options.port.wrapping_add(1)]
        .map(|port| SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
    let robot = |(name, station), build, place, seed, security: &Security| {
        let body = Body::new(
            build,
            site,
            place,
            options.time_scale,
            options.seed.wrapping_add(seed),
        );
        Robot {
            name,
            station,
            body,
            clock,
            log: SyncSender::clone(&log),
            security: security.clone(),
        }
    };
    let [of_ari, of_go2] = &options.security;
    let ari = robot(ARI, Build::Humanoid, Place::new(0.0, -1.5), 1, of_ari);
    let go2 = robot(GO2, Build::Quadruped, Place::new(-2.0, -2.5), 2, of_go2);
    let open = |address, peer, seed| {
        let peers = vec![peer];
        let link = Link::Peers { address, peers };
        let seed = options.seed.wrapping_add(seed);
        WithFaults::new(link, options.faults.clone(), seed).open()
    };
    let record = |link| match &options.capture {
        Some(capture) => capture.of_sent(link),
        None => link,
    };
    // Both sockets are open before either robot says anything.
    let first = record(open(addresses[0], addresses[1], 3)?);
    let second = record(open(addresses[1], addresses[0], 4)?);
    let robots = [
        (ARI.0, ari.start(first, Some(plan.clone()))),
        (GO2.0, go2.start(second, None)),
    ];
    Ok(Demo {
        robots,
        records,
        plan,
        timing: Timing::default(),
        log: Vec::new(),
        rest: BTreeMap::new(),
        counters: BTreeMap::new(),
        ended_well: None,
        watch,
    })
}

struct Robot {
    name: &'static str,
    station: StationId,
    body: Body,
    clock: Clock,
    log: SyncSender<Record>,
    security: Security,
}

impl Robot {
    fn start(self, link: Halves, plan: Option<Plan>) -> Running {
        Setup {
            name: self.name.to_owned(),
            station: self.station,
            // Nothing of a demonstration outlives it, so each of its boots is the first.
            boot: 1,
            config: Config::default(),
            wire: Wire::default(),
            security: self.security,
            application: Application::new(self.body, plan),
            link,
            log: self.log,
            clock: self.clock,
        }
        .start()
    }
}

impl Demo<'_> {
    /// One crossing; whether it was completed.
    fn cross(&mut self, options: &Options) -> bool {
        for (_, robot) in &self.robots {
            robot.order(Order::Reset);
        }
        self.ended_well = None;
        let detected = Event::PedestrianDetected(self.plan.request());
        self.robots[0].1.order(Order::Wish(Wish::Tell(detected)));
        // The paper's crossing takes about 26 s; commands may have to be given again.
        let patience = Duration::from_secs_f64(60.0 + 120.0 / options.time_scale);
        let deadline = Instant::now() + patience;
        while Instant::now() < deadline {
            self.take_records(Duration::from_millis(50));
            if let Some(ended_well) = self.ended_well
                && self.all_at_rest()
            {
                return ended_well;
            }
        }
        false
    }

    fn all_at_rest(&self) -> bool {
        self.robots
            .iter()
            .all(|(name, _)| self.rest.get(*name).is_some_and(|(rest, _)| *rest))
    }

    /// Takes in what the robots report within a moment.
    fn take_records(&mut self, moment: Duration) {
        let deadline = Instant::now() + moment;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            match self.records.recv_timeout(left) {
                Ok(record) => self.take(&record),
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    fn take(&mut self, record: &Record) {
        self.timing.record(record);
        trace::write(&mut self.log, record).expect("writing to memory does not fail");
        match &record.entry {
            Entry::Step { outputs, state, .. } => {
                let at_rest = matches!(state.phase(), Phase::Idle) && state.farewell().is_none();
                let name = format!("{:?}", state.state());
                self.rest.insert(record.robot.clone(), (at_rest, name));
                for output in outputs.iter() {
                    if let Output::Notify(Notice::SessionEnded(_, why)) = output
                        && record.robot == ARI.0
                    {
                        let completed = crossguard_protocol::EndReason::TaskCompleted;
                        self.ended_well = Some(*why == completed);
                    }
                }
            }
            Entry::Stopped { counters } => {
                self.counters.insert(record.robot.clone(), counters.clone());
            }
            _ => {}
        }
        (self.watch)(record);
    }

    /// Stops the robots in order, and replays their log.
    fn finish(mut self, options: &Options, crossings: usize, retries: usize) -> (Outcome, Vec<u8>) {
        for (_, robot) in &self.robots {
            robot.order(Order::Stop);
        }
        let deadline = Instant::now() + Duration::from_secs(10);
        while self.robots.iter().any(|(_, robot)| !robot.has_stopped()) && Instant::now() < deadline
        {
            self.take_records(Duration::from_millis(20));
        }
        self.take_records(Duration::from_millis(20));
        let lost_records = self
            .counters
            .values()
            .filter_map(|c| c.get("log full"))
            .sum::<u64>();
        let validated = validate::one(&*self.log).map_err(|error| error.to_string());
        let validated = match validated {
            Ok(_) if lost_records > 0 => Err(format!("{lost_records} records were lost")),
            other => other,
        };
        let outcome = Outcome {
            maneuvers: self.timing.summaries(options.time_scale),
            trace_valid: validated.is_ok(),
            trace: validated.as_ref().ok().cloned(),
            trace_error: validated.err(),
            crossings,
            trials: options.trials,
            retries,
            speed: options.time_scale,
            faults: options.faults.to_string(),
            seed: options.seed,
            security: options.security_mode,
            final_states: self
                .rest
                .iter()
                .map(|(name, (_, state))| (name.clone(), state.clone()))
                .collect(),
            counters: self.counters,
        };
        for (_, robot) in self.robots {
            robot.wait();
        }
        (outcome, self.log)
    }
}
