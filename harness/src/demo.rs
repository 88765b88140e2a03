//! Demonstrations: robots with sockets of their own on the loopback interface help a pedestrian across.
//!
//! The paper's proof of concept is one of them; the others are its extensions to teams, and what
//! happens when a robot dies. Fan-out to the peers stands for the radio's broadcast. Nothing
//! leaves the machine.

#[cfg(feature = "full")]
mod car;
mod links;
mod scenario;

pub use links::Links;
pub use scenario::{NoScenario, Participant, Scenario};

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use crossguard_endpoint::Stimulus;
use crossguard_endpoint::counters::Counts;
use crossguard_protocol::{Config, EndReason, Event, Notice, Output, StationId};
use serde::Serialize;

use crossguard_codec::Identifiers;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::station::{Mode, Security};
use crossguard_judge::timing::{Summary, TeamSummary, Timing};
use crossguard_judge::validate::{self, Validated};
use crossguard_robot::application::Application;
use crossguard_robot::body::Simulated;
use crossguard_robot::boot::Boot;
#[cfg(feature = "full")]
use crossguard_robot::capture::Capture;
use crossguard_robot::journal::{Journal, WhenFull};
use crossguard_robot::machine::is_at_rest;
use crossguard_robot::perception::Feed;
use crossguard_robot::runtime::{Clock, Order, Running, Setup};
use crossguard_robot::sign::Sign;
use crossguard_robot::street::{Road, Street};
use crossguard_robot::trace::{self, Entry, Record};
use crossguard_robot::transport::Faults;
use scenario::Ending;

/// How many records the log may lag behind.
const LOG: usize = 65_536;

/// How often a crossing that did not succeed is begun again within one trial.
const ATTEMPTS: usize = 5;

/// Options of a demonstration.
#[derive(Clone, Debug)]
pub struct Options {
    /// The scenario.
    pub scenario: Scenario,
    /// How many followers a team has.
    pub followers: u8,
    /// How many crossings.
    pub trials: usize,
    /// How many times as fast as real the robots move.
    pub time_scale: f64,
    /// Faults of datagrams on the way to each robot.
    pub faults: Faults,
    /// Seed of faults and gait.
    pub seed: u64,
    /// Port of the first robot; the others have the next ones. `None`: the first that are free.
    pub port: Option<u16>,
    /// How much security there is.
    pub security_mode: Mode,
    /// The security of each participant, in their order; off for those beyond the list.
    pub security: Vec<Security>,
    /// Where packets are recorded.
    #[cfg(feature = "full")]
    pub capture: Option<Capture>,
    /// People that the robots' sensors report.
    pub perceived: Option<Feed>,
    /// How robots announce the people around them.
    pub awareness: Awareness,
    /// Set when it is to end before all crossings are done.
    pub stop: Arc<AtomicBool>,
}

/// Outcome of a demonstration.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Outcome {
    /// The scenario.
    pub scenario: Scenario,
    /// Times by kind of maneuver.
    pub maneuvers: Vec<Summary>,
    /// Times by size of the team.
    pub teams: Vec<TeamSummary>,
    /// Whether the log, replayed through the transition function, is what the robots did.
    pub trace_valid: bool,
    /// Content of the log.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace: Option<Validated>,
    /// Why the log is not valid, where it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace_error: Option<String>,
    /// How many crossings ended as the scenario has it.
    pub crossings: usize,
    /// How many were asked for.
    pub trials: usize,
    /// Whether it was told to stop before all of them were done.
    pub stopped: bool,
    /// How many were begun again because something got lost.
    pub retries: usize,
    /// How many times as fast as real the robots moved.
    pub speed: f64,
    /// Faults of datagrams on the way to each robot.
    pub faults: String,
    /// Seed of faults and gait.
    pub seed: u64,
    /// How much security there was.
    pub security: Mode,
    /// The state of each robot in the end.
    pub final_states: BTreeMap<String, String>,
    /// Dropped and ignored inputs, by robot and cause.
    pub counters: BTreeMap<String, Counts>,
}

impl Outcome {
    /// Whether every crossing ended as it should, all robots that have power are idle, and the log is
    /// valid.
    #[must_use]
    pub fn succeeded(&self) -> bool {
        let is_good = |state: &String| state == "Idle" || state == WITHOUT_POWER;
        self.trace_valid && self.crossings == self.trials && self.final_states.values().all(is_good)
    }
}

/// The state of a robot that has lost power.
const WITHOUT_POWER: &str = "without power";

/// A demonstration that runs.
struct Demo<'a> {
    #[cfg(feature = "full")]
    _car: Option<car::Driving>,
    scenario: Scenario,
    robots: Vec<(Participant, Running)>,
    records: Receiver<Arc<Record>>,
    clock: Clock,
    timing: Timing,
    /// The log as it would stand in a file.
    log: Vec<u8>,
    /// For each robot, whether it is idle and says farewell to nothing, and its state's name.
    rest: BTreeMap<String, (bool, String)>,
    counters: BTreeMap<String, Counts>,
    /// How the newest session ended.
    end: Option<Ending>,
    /// The pedestrian, and what shows him or her when to cross.
    street: Street,
    signs: Vec<Sign>,
    /// Whether the victim of the scenario has lost power.
    has_struck: bool,
    /// People that the robots' sensors report.
    perceived: Option<Feed>,
    watch: &'a mut dyn FnMut(Seen<'_>),
}

/// Event of a demonstration that can be watched.
#[derive(Clone, Copy, Debug)]
pub enum Seen<'a> {
    /// A robot has made a record.
    Record(&'a Record),
    /// A robot loses power, of which it leaves no record.
    PowerLoss {
        /// Microseconds since the log's clock started.
        at_us: u64,
        /// The robot's name.
        robot: &'a str,
    },
    /// Pedestrians step on the road, or are across.
    Pedestrians {
        /// Microseconds since the log's clock started.
        at_us: u64,
        /// Whether they are on the road now.
        are_on_road: bool,
        /// How many.
        count: usize,
    },
}

/// Runs a demonstration. `watch` sees everything as it happens.
pub fn run(options: &Options, links: Links, watch: &mut dyn FnMut(Seen<'_>)) -> (Outcome, Vec<u8>) {
    let mut demo = start(options, links, watch);
    let (mut crossings, mut retries) = (0, 0);
    let is_stopped = || options.stop.load(Ordering::Relaxed);
    for _ in 0..options.trials {
        if is_stopped() {
            break;
        }
        for attempt in 0..ATTEMPTS {
            retries += usize::from(attempt > 0);
            let is_done = demo.cross(options);
            crossings += usize::from(is_done);
            if is_done || demo.has_struck || is_stopped() {
                break;
            }
        }
    }
    demo.finish(options, crossings, retries)
}

fn start<'a>(options: &Options, links: Links, watch: &'a mut dyn FnMut(Seen<'_>)) -> Demo<'a> {
    let mut journal = Journal::new();
    let records = journal.reader(LOG, WhenFull::End, Cause::LogFull);
    let clock = Clock::start();
    let participants = options.scenario.participants(options.followers);
    let securities: Vec<_> = options.security.clone();
    let stations = stations(&participants, &securities);
    let mut securities = securities.into_iter();
    let (mut robots, mut signs) = (Vec::new(), Vec::new());
    let street = Street::default();
    let mut links = links.halves.into_iter();
    for ((participant, link), nth) in participants.into_iter().zip(links.by_ref()).zip(1..) {
        let (site, seed) = (options.scenario.site(), options.seed.wrapping_add(nth));
        let (build, place) = (participant.build, participant.place);
        let body = Simulated::new(build, site, place, options.time_scale, seed);
        let mut plan = participant.plan.clone();
        for role in plan
            .iter_mut()
            .flat_map(|plan| plan.roles.iter_mut())
            .flatten()
        {
            *role = stations.get(role).copied().unwrap_or(*role);
        }
        let application = Application::new(Box::new(body), plan).with_home(place);
        let application = application.at(site).on(Road::Known(street.clone()));
        let application = application.showing_by(build.means());
        signs.push(application.sign().clone());
        let running = Setup {
            name: participant.name.clone(),
            station: participant.station,
            // Nothing of a demonstration outlives it, so each of its boots is the first.
            boot: Boot::first_of_its_kind(),
            config: Config::default(),
            identifiers: Identifiers::default(),
            security: securities.next().unwrap_or_default(),
            awareness: options.awareness,
            application,
            link,
            journal: journal.clone(),
            clock,
        }
        .start();
        robots.push((participant, running));
    }
    Demo {
        #[cfg(feature = "full")]
        _car: options.scenario.car().zip(links.next()).map(|(car, link)| {
            car::Driving::start(car.clone(), options.scenario.street().clone(), link, clock)
        }),
        scenario: options.scenario.clone(),
        robots,
        records,
        clock,
        timing: Timing::default(),
        log: Vec::new(),
        rest: BTreeMap::new(),
        counters: BTreeMap::new(),
        end: None,
        street,
        signs,
        has_struck: false,
        perceived: options.perceived.clone(),
        watch,
    }
}

/// How long a crossing may take. The paper's takes about 26 s; commands may have to be given again.
fn patience(options: &Options) -> Duration {
    Duration::from_secs_f64(60.0 + 120.0 / options.time_scale)
}

/// The station ids by which participants go, which follow from their tickets, by those of the plan.
fn stations(
    participants: &[Participant],
    securities: &[Security],
) -> BTreeMap<StationId, StationId> {
    let ids = Identifiers::default();
    let pairs = participants.iter().zip(securities);
    let pairs = pairs.map(|(it, security)| (it.station, security.station_id(&ids, it.station)));
    pairs.collect()
}

impl Demo<'_> {
    /// One crossing; whether it ended as it should.
    fn cross(&mut self, options: &Options) -> bool {
        self.end = None;
        for (_, robot) in &self.robots {
            robot.order(Order::Reset);
        }
        for (participant, robot) in &self.robots {
            if let Some(plan) = &participant.plan {
                let crossing_us = plan.crossing_us(options.time_scale);
                self.street.arrive(crossing_us, plan.sides());
                let detected = Event::PedestrianDetected(plan.request());
                robot.order(Order::Tell(Stimulus::Event(detected)));
            }
        }
        let deadline = Instant::now() + patience(options);
        while Instant::now() < deadline && !options.stop.load(Ordering::Relaxed) {
            self.take_records(Duration::from_millis(50));
            self.strike();
            if let Some(end) = self.end
                && self.all_at_rest()
            {
                return end == self.scenario.end();
            }
        }
        false
    }

    /// The pedestrians look at the signs.
    fn look(&mut self) {
        let at_us = self.clock.now_us();
        let shows_go = self.signs.iter().any(|sign| sign.shows_go(at_us));
        let before = self.street.on_road();
        self.street.look(at_us, shows_go);
        let now = self.street.on_road();
        if (before == 0) != (now == 0) {
            (self.watch)(Seen::Pedestrians {
                at_us,
                are_on_road: now > 0,
                count: before.max(now),
            });
        }
    }

    /// Takes the victim's power once the pedestrian is on the road.
    fn strike(&mut self) {
        let victim = self.scenario.victim();
        let victim = victim.filter(|_| !self.street.is_clear() && !self.has_struck);
        for (participant, robot) in &self.robots {
            if Some(&*participant.name) == victim {
                robot.order(Order::Die);
                (self.watch)(Seen::PowerLoss {
                    at_us: self.clock.now_us(),
                    robot: &participant.name,
                });
                self.has_struck = true;
                let state = (true, WITHOUT_POWER.to_owned());
                self.rest.insert(participant.name.clone(), state);
            }
        }
    }

    fn all_at_rest(&self) -> bool {
        self.robots
            .iter()
            .all(|(one, _)| self.rest.get(&one.name).is_some_and(|(rest, _)| *rest))
    }

    /// Takes in what the robots report within a moment.
    fn take_records(&mut self, moment: Duration) {
        self.tell_perceived();
        let deadline = Instant::now() + moment;
        loop {
            self.look();
            let left = deadline.saturating_duration_since(Instant::now());
            match self.records.recv_timeout(left) {
                Ok(record) => self.take(&record),
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Tells all robots what their sensors report.
    fn tell_perceived(&mut self) {
        for perceived in self.perceived.iter().flat_map(Feed::due) {
            for (_, robot) in &self.robots {
                robot.order(perceived.clone());
            }
        }
    }

    fn take(&mut self, record: &Record) {
        self.timing.record(0, record.at_us, record);
        trace::write(&mut self.log, record).expect("writing to memory does not fail");
        match &record.entry {
            Entry::Step { outputs, state, .. } if !self.is_dead(&record.robot) => {
                let at_rest = is_at_rest(state);
                let name = format!("{:?}", state.state());
                self.rest.insert(record.robot.clone(), (at_rest, name));
                outputs.iter().for_each(|output| self.note(*output));
            }
            Entry::Stopped { counters } => {
                self.counters.insert(record.robot.clone(), counters.clone());
            }
            _ => {}
        }
        (self.watch)(Seen::Record(record));
    }

    /// Whether the robot has lost power. Its records from before may be read after that.
    fn is_dead(&self, robot: &str) -> bool {
        self.has_struck && self.scenario.victim() == Some(robot)
    }

    fn note(&mut self, output: Output) {
        match output {
            // Of two requesters one withdraws, and the other goes on.
            Output::Notify(Notice::SessionEnded(_, EndReason::Withdrawn(_))) => {}
            Output::Notify(Notice::SessionEnded(_, why)) => self.end = Some(Ending::Session(why)),
            Output::Notify(Notice::Released(_, why)) if self.has_struck && self.end.is_none() => {
                self.end = Some(Ending::Released(why));
            }
            _ => {}
        }
    }

    /// Stops the robots in order, and replays their log.
    fn finish(mut self, options: &Options, crossings: usize, retries: usize) -> (Outcome, Vec<u8>) {
        for (_, robot) in &self.robots {
            robot.order(Order::Stop);
        }
        // An escort that falls back waits for the pedestrian, who walks on for as long as somebody looks.
        let deadline = Instant::now() + patience(options);
        while self.robots.iter().any(|(_, robot)| !robot.has_stopped()) && Instant::now() < deadline
        {
            self.take_records(Duration::from_millis(20));
        }
        self.take_records(Duration::from_millis(20));
        let lost_records = self
            .counters
            .values()
            .map(|counters| counters.of(&Cause::LogFull.into()))
            .sum::<u64>();
        let validated = validate::one(&*self.log).map_err(|error| error.to_string());
        let validated = match validated {
            Ok(_) if lost_records > 0 => Err(format!("{lost_records} records were lost")),
            other => other,
        };
        let outcome = Outcome {
            scenario: self.scenario.clone(),
            maneuvers: self.timing.summaries(),
            teams: self.timing.teams(),
            trace_valid: validated.is_ok(),
            trace: validated.as_ref().ok().cloned(),
            trace_error: validated.err(),
            crossings,
            trials: options.trials,
            stopped: options.stop.load(Ordering::Relaxed) && crossings < options.trials,
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
            if let Err(panicked) = robot.wait() {
                panic!("{panicked}");
            }
        }
        (outcome, self.log)
    }
}
