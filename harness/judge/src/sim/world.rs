//! One run: robots, the radio between them, and time.

mod connected;
mod deeds;
mod flow;
mod lies;
mod people;
mod radio;
mod sensors;
mod truth;
mod walkers;

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::fmt;
use std::rc::Rc;
use std::time::Duration;

use crossguard_codec::Service;
use crossguard_codec::si::timestamp_its;
use crossguard_endpoint::{Effect, Moment, Stimulus};
use crossguard_model_check::monitor::Monitor;
use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::timed::Limits;
use crossguard_protocol::{Event, Output, Phase, Robot, StationId};
use crossguard_robot::machine::Machine;
use crossguard_robot::perception::Newest;
use crossguard_robot::sign::Sign;
use crossguard_robot::site::Place;
use crossguard_robot::trace::{Entry, Reception, Record, recorded};
use crossguard_robot::transport::Channel;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use self::flow::Flow;
use self::people::{Corner, OnRoad, Progress};
use self::radio::Arrival;
use self::sensors::{FrameInFlight, SimulatedSensor};
use self::truth::ObservedBody;
pub use self::walkers::Waits;
use self::walkers::Walker;
use super::clock::Drifting;
use super::insider::Insider;
use super::place::PlaceLog;
use super::road::{Overdue, Post, Road, Sight};
use super::ruled::Ruled;
use super::swarm::{HEALED_DELAY_MS, Hazard, RobotDraw, Swarm};
use super::times::{Measure, Times, Worst};

/// When runs begin, in milliseconds since 1970: 2026-01-01. Any moment does.
const EPOCH_UNIX_MS: i64 = 1_767_225_600_000;

/// The timestamp of messages, in ms since 2004, so many ms after a run began.
pub(super) fn timestamp_at(since_ms: u64) -> u64 {
    timestamp_its(EPOCH_UNIX_MS + i64::try_from(since_ms).unwrap_or(i64::MAX))
}

/// How long after the network was healed, and a crossing was to be completed, all robots are at rest at the
/// latest: a leader gives up after its patience of 40 s, and what it has set off takes as long again.
const REST_US: u64 = 120_000_000;

/// How long all robots must have been at rest for a run to be over, in microseconds. Messages that
/// were still under way may set something off.
const QUIET_US: u64 = 1_000_000;

/// A fault that a run has shown.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Finding {
    /// Id of the property.
    pub property: String,
    /// Its statement.
    pub statement: String,
    /// When it was broken, in milliseconds since the run began.
    pub at_ms: u64,
    /// The robot whose step broke it.
    pub robot: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at_s = Duration::from_millis(self.at_ms).as_secs_f64();
        let (property, statement, robot) = (&self.property, &self.statement, &self.robot);
        write!(f, "{property}: {statement} ({robot} at {at_s:.3} s)")
    }
}

/// Outcome of a run.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Outcome {
    /// The fault, if there was one. The run ended there.
    pub finding: Option<Finding>,
    /// How long the run was, in milliseconds of virtual time.
    pub virtual_ms: u64,
    /// How many robots there were.
    pub robots: usize,
    /// How many steps of the transition function there were.
    pub steps: u64,
    /// How many packets were sent.
    pub packets: u64,
    /// The properties whose premise was met, or of which a time was measured.
    pub premises: BTreeSet<String>,
    /// Hazards of the run.
    pub hazards: Vec<Hazard>,
    /// Properties that were not judged, because the run's own faults leave them open.
    pub left_out: Vec<&'static str>,
    /// The longest times.
    pub worst: Worst,
    /// Crossings and waiting times of the people in front of sensors: of arrivals before the network was healed, and after.
    pub waits: [Waits; 2],
}

/// Observer of a run.
pub trait Watch {
    /// A robot did something.
    fn record(&mut self, record: Record);

    /// A packet is on the air, at this time since 1970.
    fn packet(&mut self, _at: Duration, _packet: &[u8]) {}
}

impl<F: FnMut(Record)> Watch for F {
    fn record(&mut self, record: Record) {
        self(record);
    }
}

/// Runs a swarm to its end or to the first thing that is wrong. `watch`, if there is one, sees it.
#[must_use]
pub fn run<'a>(swarm: &'a Swarm, watch: Option<&'a mut dyn Watch>) -> Outcome {
    run_with(swarm, &Protocol, watch)
}

/// [`run`], with all that its robots recorded.
#[must_use]
pub fn run_recorded(swarm: &Swarm) -> (Outcome, Vec<Record>) {
    let mut records = Vec::new();
    let mut watch = |record| records.push(record);
    let outcome = run(swarm, Some(&mut watch));
    (outcome, records)
}

/// [`run`] with another transition function in place of the kit's.
pub fn run_with<'a>(
    swarm: &'a Swarm,
    rules: &'static dyn Rules,
    watch: Option<&'a mut dyn Watch>,
) -> Outcome {
    finish(&mut World::new(swarm, rules, watch))
}

/// [`run_with`] of a swarm with demand, and what happened to people and vehicles.
pub(super) fn run_flow(swarm: &Swarm, rules: &'static dyn Rules) -> (Outcome, PlaceLog) {
    let mut world = World::new(swarm, rules, None);
    (finish(&mut world), world.flow.log)
}

fn finish(world: &mut World<'_>) -> Outcome {
    let swarm = world.swarm;
    let finding = world.go_on().err();
    let mut worst = world.times.worst();
    worst.add(world.road.worst());
    let met = world.monitor.premises_met().map(|id| id.to_string());
    let measured = Measure::ALL.into_iter();
    let measured = measured.filter(|measure| worst.of(*measure).is_some());
    let mut premises: BTreeSet<_> = met.collect();
    premises.extend(measured.map(|measure| measure.property().to_owned()));
    premises.extend(world.met.iter().map(|id| (*id).to_owned()));
    Outcome {
        finding,
        virtual_ms: world.now_us / 1_000,
        robots: swarm.robots.len(),
        steps: world.steps,
        packets: world.packets,
        premises,
        hazards: swarm.hazards().collect(),
        left_out: left_out(swarm),
        worst,
        waits: world.waits(),
    }
}

/// Properties that the faults of a run leave open, so that they are not judged.
fn left_out(swarm: &Swarm) -> Vec<&'static str> {
    let mut left_out = Vec::new();
    if !swarm.is_in_time() {
        left_out.extend(["I10", "I11 in ms", "L1 in ms", "W3 in ms", "W6", "W8"]);
    }
    if !swarm.is_in_time() || !swarm.replays.is_empty() {
        left_out.push("L5 in ms");
    }
    if swarm.insider.is_some() {
        left_out.extend(["I2", "I3", "I6", "I8", "I15"]);
    }
    if swarm.waits_at.is_none() {
        left_out.push("W7");
    }
    left_out
}

/// Next event somewhere.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Next {
    /// Something of the script, by its place there.
    Happens(usize),
    /// The network is healed.
    Heals,
    /// A packet arrives.
    Arrives(Arrival),
    /// Recorded packets are sent once more, by the place in the swarm's list.
    Replays(usize),
    /// A person who waits at a corner looks at the signs.
    Looks(usize),
    /// Something happens to a robot whose team lets people cross.
    Strikes(usize),
    /// A robot that was struck boots again.
    Boots(usize),
    /// Robots notice who waits after the network was healed.
    Notices,
    /// A robot is told of time.
    Wakes(usize),
    /// A robot that hung goes on.
    GoesOn(usize),
    /// The insider says something.
    Lies,
    /// A sensor looks.
    Senses(usize),
    /// A frame arrives at a robot, by its place in the list of frames.
    Sees(usize, usize),
    /// A vehicle says where it is.
    Drives(usize),
    /// The streams of people and vehicles go on.
    Flows,
}

struct Seat<'a> {
    draw: &'a RobotDraw,
    /// The corner at which it is.
    corner: usize,
    clock: Drifting,
    /// Its newest boot counter: what its boot file holds.
    boot: u16,
    machine: Option<Machine<Ruled>>,
    /// Where its body is when it boots: where it lost power.
    lies_at: Place,
    /// The sign that people see; that of a robot that is down ends by itself.
    sign: Sign,
    /// Whether it has asked for the next boot counter.
    is_to_renew: bool,
    /// How often it has changed its pseudonym.
    changes: u32,
    /// When it wakes up next.
    wakes_us: Option<u64>,
    /// Until when it hangs.
    hangs_until_us: Option<u64>,
    /// Arrivals while it hangs.
    inbox: Vec<Next>,
    /// The people in the newest frames of its sensors.
    newest: Newest,
    /// When it heard each vehicle last.
    heard_us: BTreeMap<usize, u64>,
    observed: ObservedBody,
}

struct World<'a> {
    swarm: &'a Swarm,
    rules: &'static dyn Rules,
    watch: Option<&'a mut dyn Watch>,
    now_us: u64,
    seats: Vec<Seat<'a>>,
    corners: Vec<Corner>,
    people: Vec<OnRoad>,
    walkers: Vec<Walker>,
    walkers_came: u32,
    waits: [Waits; 2],
    sensors: Vec<SimulatedSensor<'a>>,
    frames: Vec<FrameInFlight>,
    flow: Flow,
    /// When somebody may have been on the road last.
    occupied_us: Option<u64>,
    /// The properties of the truth that had something to say.
    met: BTreeSet<&'static str>,
    progress: Option<Progress>,
    road: Road,
    /// The robots by the station ids that they have had.
    names: BTreeMap<StationId, usize>,
    ways: Vec<Channel>,
    queue: BinaryHeap<Reverse<(u64, u64, Next)>>,
    queued: u64,
    draws: ChaCha8Rng,
    monitor: Monitor,
    times: Times,
    /// Whether the packet that arrived last was understood as a RAM.
    has_heard_ram: bool,
    /// Packets that were sent so far, with their senders, where they are to be sent once more.
    aired: Vec<(usize, Rc<[u8]>)>,
    is_healed: bool,
    insider: Option<Insider>,
    rests_since_us: Option<u64>,
    steps: u64,
    packets: u64,
}

impl<'a> World<'a> {
    fn new(swarm: &'a Swarm, rules: &'static dyn Rules, watch: Option<&'a mut dyn Watch>) -> Self {
        let mut draws = ChaCha8Rng::seed_from_u64(swarm.seed ^ 0x5741_4553);
        let mut monitor = Monitor::new(swarm.is_in_time());
        let seats = swarm.robots.iter().map(|draw| {
            monitor.add(draw.station);
            Seat {
                draw,
                corner: draw.corner,
                clock: Drifting::new(draw.drift_ppm),
                boot: draw.boot,
                machine: None,
                sign: Sign::default(),
                is_to_renew: false,
                changes: 0,
                wakes_us: None,
                hangs_until_us: None,
                inbox: Vec::new(),
                newest: Newest::default(),
                heard_us: BTreeMap::new(),
                lies_at: draw.place,
                observed: ObservedBody::default(),
            }
        });
        let seats: Vec<_> = seats.collect();
        let ways = swarm.ways.iter();
        let ways = ways.map(|faults| Channel::new(faults.clone(), draws.random()));
        let limits = limits(swarm);
        let posts = posts(swarm, &limits);
        let road = Road::new(posts, swarm.delay_max(), swarm.is_in_time());
        let mut world = Self {
            ways: ways.collect(),
            road,
            times: Times::new(swarm, limits),
            corners: people::corners(swarm),
            people: Vec::new(),
            walkers: Vec::new(),
            walkers_came: 0,
            waits: Default::default(),
            sensors: sensors::of(swarm),
            frames: Vec::new(),
            flow: Flow::default(),
            occupied_us: None,
            met: BTreeSet::new(),
            progress: None,
            names: BTreeMap::new(),
            has_heard_ram: false,
            aired: Vec::new(),
            swarm,
            rules,
            watch,
            now_us: 0,
            seats,
            queue: BinaryHeap::new(),
            queued: 0,
            draws,
            monitor,
            is_healed: false,
            insider: lies::insider(swarm),
            rests_since_us: None,
            steps: 0,
            packets: 0,
        };
        for (i, happening) in swarm.script.iter().enumerate() {
            world.at(happening.at_us, Next::Happens(i));
        }
        for (i, replay) in swarm.replays.iter().enumerate() {
            world.at(replay.at_us, Next::Replays(i));
        }
        for sensor in 0..world.sensors.len() {
            let at_us = world.draws.random_range(0..200_000);
            world.at(at_us, Next::Senses(sensor));
        }
        let cars = swarm.sensing.iter().flat_map(|it| it.cars.iter());
        for (number, car) in cars.enumerate() {
            world.at(car.at_us, Next::Drives(number));
        }
        if let Some(insider) = &world.insider {
            world.monitor.lies(insider.station());
            world.at(0, Next::Lies);
        }
        world.begin_flow();
        world.at(swarm.heals_us, Next::Heals);
        world
    }

    fn at(&mut self, at_us: u64, next: Next) {
        self.queued += 1;
        self.queue.push(Reverse((at_us, self.queued, next)));
    }

    fn go_on(&mut self) -> Result<(), Finding> {
        while let Some(Reverse((at_us, _, next))) = self.queue.pop() {
            self.now_us = at_us;
            if let Err(late) = self.road.pass(at_us) {
                return Err(self.too_late(late));
            }
            self.get_across();
            self.demand_progress()?;
            if at_us > self.swarm.heals_us + self.crossing_us() + REST_US {
                return Err(self.not_at_rest());
            }
            self.take(next)?;
            self.judge_bodies()?;
            if self.is_over() {
                break;
            }
        }
        Ok(())
    }

    fn take(&mut self, next: Next) -> Result<(), Finding> {
        match next {
            Next::Happens(i) => self.happen(self.swarm.script[i])?,
            Next::Heals => self.heal(),
            Next::Arrives(arrival) => self.arrive(arrival)?,
            Next::Replays(i) => self.replay(self.swarm.replays[i]),
            Next::Lies => self.lie(),
            Next::Looks(_) if self.swarm.sensing.is_some() => self.walkers_look()?,
            Next::Looks(corner) => self.look(corner)?,
            Next::Senses(sensor) => self.sense(sensor),
            Next::Sees(place, frame) => self.see_frame(place, frame)?,
            Next::Drives(car) => self.drive(car)?,
            Next::Flows => self.flows()?,
            Next::Strikes(place) => self.strike(place)?,
            Next::Boots(place) => self.boot(place)?,
            Next::Notices => self.notice_again()?,
            Next::Wakes(place) if self.seats[place].wakes_us == Some(self.now_us) => {
                let seat = &mut self.seats[place];
                seat.wakes_us = None;
                if seat.hangs_until_us.is_none() {
                    self.handle(place, Stimulus::Time)?;
                }
            }
            Next::GoesOn(place) if self.seats[place].hangs_until_us == Some(self.now_us) => {
                self.go_on_after_hanging(place)?;
            }
            // Another time was planned since.
            Next::Wakes(_) | Next::GoesOn(_) => {}
        }
        Ok(())
    }

    /// Whether the sign of a robot shows go.
    fn shows_go(&self, place: usize) -> bool {
        let seat = &self.seats[place];
        seat.sign.shows_go(seat.clock.shows_us(self.now_us))
    }

    fn heal(&mut self) {
        self.is_healed = true;
        for way in &mut self.ways {
            way.heal(HEALED_DELAY_MS);
        }
        self.begin_progress();
    }

    /// Whether all robots have been at rest for a while since the network was healed.
    fn is_over(&mut self) -> bool {
        if self.swarm.demand.is_some() {
            return self.is_healed;
        }
        let at_rest = |seat: &Seat| seat.machine.as_ref().is_none_or(Machine::is_at_rest);
        let is_asked = self.progress.as_ref().is_some_and(|it| !it.is_done);
        if !self.is_healed || is_asked || !self.seats.iter().all(at_rest) {
            self.rests_since_us = None;
            return false;
        }
        let since = *self.rests_since_us.get_or_insert(self.now_us);
        self.now_us - since >= QUIET_US
    }

    fn not_at_rest(&self) -> Finding {
        let busy = |seat: &&Seat| seat.machine.as_ref().is_some_and(|m| !m.is_at_rest());
        let robot = self
            .seats
            .iter()
            .find(busy)
            .map(|seat| seat.draw.name.clone());
        Finding {
            property: "L4".to_owned(),
            statement: "after the network is healed, all robots come to rest".to_owned(),
            at_ms: self.now_us / 1_000,
            robot: robot.unwrap_or_default(),
        }
    }

    /// Hands something to a robot, and carries out what it wants; nothing if the robot is down.
    fn handle(&mut self, place: usize, stimulus: Stimulus<'_>) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        let Some(machine) = &mut seat.machine else {
            return Ok(());
        };
        let shows_us = seat.clock.shows_us(self.now_us);
        // The timestamp is that of satellites, whatever the robot's own clock does.
        let moment = Moment {
            now_ms: shows_us / 1_000,
            timestamp_its: timestamp_at(self.now_us / 1_000),
        };
        #[expect(clippy::cast_precision_loss, reason = "runs take minutes")]
        let now_s = shows_us as f64 / 1e6;
        for effect in machine.handle(moment, now_s, stimulus) {
            self.carry_out(place, effect)?;
        }
        let seat = &mut self.seats[place];
        if std::mem::take(&mut seat.is_to_renew) {
            seat.boot = seat.boot.saturating_add(1);
            let renewed = Event::EpochRenewed(seat.boot);
            return self.handle(place, Stimulus::Event(renewed));
        }
        let late = self
            .times
            .look(self.now_us, place, self.monitor.node(place));
        self.plan_wakeup(place);
        if let Some(measure) = late {
            return Err(self.too_late((measure, place)));
        }
        self.see(place)
    }

    /// The road looks at a robot.
    fn see(&mut self, place: usize) -> Result<(), Finding> {
        let seat = &self.seats[place];
        let robot = seat.machine.as_ref().map(|it| it.endpoint.robot());
        let ends_us = seat.sign.ends_us(seat.clock.shows_us(self.now_us));
        let sight = Sight {
            go_ends_us: ends_us.map(|shown_us| seat.clock.true_us(shown_us)),
            leads: robot
                .filter(|robot| matches!(robot.phase(), Phase::Leading(_)))
                .and_then(Robot::session),
            guards: self.monitor.guards(place).map(|it| it.id.session),
            is_awake: seat.machine.is_some() && seat.hangs_until_us.is_none(),
        };
        let showed_go = self.road.shows_go(place);
        let seen = self.road.see(self.now_us, place, sight);
        seen.map_err(|late| self.too_late(late))?;
        if !showed_go && self.road.shows_go(place) {
            self.judge_go(place)?;
            self.plan_strike(place);
        }
        Ok(())
    }

    fn too_late(&self, (measure, place): Overdue) -> Finding {
        self.broken((measure.property(), measure.statement()), place)
    }

    fn finding(&self, broken: PropertyId, place: usize) -> Finding {
        self.broken((broken.name(), broken.statement()), place)
    }

    /// A robot breaks a property now.
    fn broken(&self, (property, statement): (&str, &str), place: usize) -> Finding {
        Finding {
            property: property.to_owned(),
            statement: statement.to_owned(),
            at_ms: self.now_us / 1_000,
            robot: self.seats[place].draw.name.clone(),
        }
    }

    fn carry_out(&mut self, place: usize, effect: Effect) -> Result<(), Finding> {
        match &effect {
            Effect::Stepped {
                input,
                outputs,
                state,
            } => {
                self.steps += 1;
                self.names.insert(state.station(), place);
                if self.swarm.sensing.is_some() {
                    self.judge_word(place, *input, outputs)?;
                }
                if let Some(broken) = self.monitor.step(place, *input, outputs, state) {
                    let finding = self.finding(broken, place);
                    self.log(place, effect);
                    return Err(finding);
                }
                let told = self.tell_road(place, *input, outputs);
                told.map_err(|late| self.too_late(late))?;
            }
            Effect::Transmit { kind, packet, .. } => {
                let packet = Rc::from(packet.as_slice());
                self.transmit(place, &packet, *kind == Service::Ram);
            }
            Effect::Heard { kind, .. } => self.has_heard_ram |= *kind == Service::Ram,
            Effect::Act(Output::StartManeuver(_), parameters) => {
                let seat = &mut self.seats[place];
                let site = &seat.draw.plan.site;
                seat.observed.target = site.place_of(parameters.target);
            }
            Effect::Act(Output::RenewEpoch, _) => self.seats[place].is_to_renew = true,
            _ => {}
        }
        self.log(place, effect);
        Ok(())
    }

    fn log(&mut self, place: usize, effect: Effect) {
        if self.watch.is_none() {
            return;
        }
        let Some(mut entry) = recorded(effect) else {
            return;
        };
        if let Entry::Heard { reception, .. } = &mut entry {
            // The log's clock shows the true time, the robot's does not.
            let clock = self.seats[place].clock;
            *reception = reception.map(|shown| Reception {
                arrived_us: clock.true_us(shown.arrived_us),
                told_us: clock.true_us(shown.told_us),
            });
        }
        self.record(place, entry);
    }

    /// Wakes the robot when it is to be told of time, give or take its lateness.
    fn plan_wakeup(&mut self, place: usize) {
        let late_max_us = self.late_max_us(place);
        let seat = &mut self.seats[place];
        let Some(machine) = &seat.machine else { return };
        let shown_ms = machine.endpoint.next_wakeup_ms();
        let due_us = seat
            .clock
            .true_us(shown_ms.saturating_mul(1_000))
            .max(self.now_us);
        if seat.wakes_us.is_some_and(|wakes_us| wakes_us <= due_us) {
            return;
        }
        let wakes_us = due_us + self.draws.random_range(0..=late_max_us);
        seat.wakes_us = Some(wakes_us);
        self.at(wakes_us, Next::Wakes(place));
    }

    /// By how much an endpoint is late at most.
    fn late_max_us(&self, place: usize) -> u64 {
        let delay_max = self.seats[place].draw.config.settings().delay_max;
        let in_time_us = (u64::from(delay_max.0) * 1_000).saturating_sub(2_000);
        let late_max_us = self.swarm.late_max_us;
        if self.is_healed {
            late_max_us.min(in_time_us)
        } else {
            late_max_us
        }
    }

    fn record(&mut self, place: usize, entry: Entry) {
        if let Some(watch) = &mut self.watch {
            watch.record(Record {
                at_us: self.now_us,
                robot: self.seats[place].draw.name.clone(),
                entry,
            });
        }
    }
}

/// The longest times for each robot of a swarm.
fn limits(swarm: &Swarm) -> Vec<Limits> {
    let delay = swarm.delay_max();
    let robots = swarm.robots.iter();
    robots
        .map(|robot| Limits::new(&robot.config, delay))
        .collect()
}

fn posts<'a>(swarm: &'a Swarm, limits: &'a [Limits]) -> impl Iterator<Item = Post> + 'a {
    let of_robots = swarm.robots.iter().zip(limits);
    of_robots.map(|(robot, limits)| {
        let (plan, settings) = (&robot.plan, robot.config.settings());
        let required = usize::from(plan.followers);
        Post::new(robot.corner, required, plan.patience_s, settings, limits)
    })
}
