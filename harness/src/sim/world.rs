//! One run: robots, the radio between them, and time.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::rc::Rc;
use std::time::Duration;

use crossguard_codec::TaskParameters;
use crossguard_codec::si::timestamp_its;
use crossguard_model_check::monitor::Monitor;
use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::timed::Limits;
use crossguard_protocol::{Availability, Event, Millis, Robot, StationId};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use super::clock::Drifting;
use super::script::{Deed, Happening};
use super::swarm::{PSEUDONYM_STEP, RobotDraw, Swarm};
use super::times::{Measure, Times, Worst};
use crate::application::Application;
use crate::body::Body;
use crate::endpoint::{Effect, Endpoint, Moment, Stimulus};
use crate::machine::Machine;
use crate::trace::{Entry, Record, recorded};
use crate::transport::{Channel, Fate};
use crate::wire::Wire;

/// When runs begin, in milliseconds since 1970: 2026-01-01. Any moment does.
const EPOCH_UNIX_MS: i64 = 1_767_225_600_000;

/// How long after the network was healed all robots are at rest at the latest: a leader gives up
/// after its patience of 40 s, and what it has set off takes as long again.
const REST_US: u64 = 120_000_000;

/// How long all robots must have been at rest for a run to be over, in microseconds. Messages that
/// were still under way may set something off.
const QUIET_US: u64 = 1_000_000;

/// What a run has shown to be wrong.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Finding {
    /// Id of the property.
    pub property: String,
    /// What it says.
    pub statement: String,
    /// When it was broken, in milliseconds since the run began.
    pub at_ms: u64,
    /// The robot whose step broke it.
    pub robot: String,
}

/// What came of a run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Outcome {
    /// What was wrong, if anything was. The run ended there.
    pub finding: Option<Finding>,
    /// How long the run was, in milliseconds of virtual time.
    pub virtual_ms: u64,
    /// How many robots there were.
    pub robots: usize,
    /// How many steps of the transition function there were.
    pub steps: u64,
    /// How many packets were sent.
    pub packets: u64,
    /// The properties whose premise was met.
    pub premises: BTreeSet<PropertyId>,
    /// The longest times.
    pub worst: Worst,
}

/// Who sees what happens in a run.
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

/// [`run`] with another transition function in place of the kit's.
pub fn run_with<'a>(
    swarm: &'a Swarm,
    rules: &'static dyn Rules,
    watch: Option<&'a mut dyn Watch>,
) -> Outcome {
    let mut world = World::new(swarm, rules, watch);
    let finding = world.go_on().err();
    Outcome {
        finding,
        virtual_ms: world.now_us / 1_000,
        robots: swarm.robots.len(),
        steps: world.steps,
        packets: world.packets,
        premises: world.monitor.premises_met().collect(),
        worst: world.times.worst(),
    }
}

/// What happens next somewhere.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Next {
    /// Something of the script, by its place there.
    Happens(usize),
    /// The network is healed.
    Heals,
    /// A packet arrives.
    Arrives { to: usize, packet: Rc<[u8]> },
    /// A robot is told of time.
    Wakes(usize),
}

struct Seat<'a> {
    draw: &'a RobotDraw,
    clock: Drifting,
    /// Its newest boot counter: what its boot file holds.
    boot: u16,
    machine: Option<Machine>,
    /// How often it has changed its pseudonym.
    changes: u32,
    /// When it wakes up next.
    wakes_us: Option<u64>,
}

struct World<'a> {
    swarm: &'a Swarm,
    rules: &'static dyn Rules,
    watch: Option<&'a mut dyn Watch>,
    now_us: u64,
    seats: Vec<Seat<'a>>,
    ways: Vec<Channel>,
    queue: BinaryHeap<Reverse<(u64, u64, Next)>>,
    queued: u64,
    draws: ChaCha8Rng,
    monitor: Monitor,
    times: Times,
    is_healed: bool,
    rests_since_us: Option<u64>,
    steps: u64,
    packets: u64,
}

impl<'a> World<'a> {
    fn new(swarm: &'a Swarm, rules: &'static dyn Rules, watch: Option<&'a mut dyn Watch>) -> Self {
        let mut draws = ChaCha8Rng::seed_from_u64(swarm.seed ^ 0x5741_4553);
        let mut monitor = Monitor::new(true);
        let seats = swarm.robots.iter().map(|draw| {
            monitor.add(draw.station);
            Seat {
                draw,
                clock: Drifting::new(draw.drift_ppm),
                boot: draw.boot,
                machine: None,
                changes: 0,
                wakes_us: None,
            }
        });
        let seats: Vec<_> = seats.collect();
        let ways = swarm.ways.iter();
        let ways = ways.map(|faults| Channel::new(faults.clone(), draws.random()));
        let mut world = Self {
            ways: ways.collect(),
            times: Times::new(limits(swarm), seats.len()),
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
            rests_since_us: None,
            steps: 0,
            packets: 0,
        };
        for (i, happening) in swarm.script.iter().enumerate() {
            world.at(happening.at_us, Next::Happens(i));
        }
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
            if at_us > self.swarm.heals_us + REST_US {
                return Err(self.not_at_rest());
            }
            match next {
                Next::Happens(i) => self.happen(self.swarm.script[i])?,
                Next::Heals => self.heal(),
                Next::Arrives { to, packet } => self.handle(to, Stimulus::Datagram(&packet))?,
                Next::Wakes(place) => {
                    if self.seats[place].wakes_us == Some(at_us) {
                        self.seats[place].wakes_us = None;
                        self.handle(place, Stimulus::Time)?;
                    }
                }
            }
            if self.is_over() {
                break;
            }
        }
        Ok(())
    }

    fn heal(&mut self) {
        self.is_healed = true;
        for way in &mut self.ways {
            way.heal();
        }
    }

    /// Whether all robots have been at rest for a while since the network was healed.
    fn is_over(&mut self) -> bool {
        let at_rest = |seat: &Seat| seat.machine.as_ref().is_none_or(Machine::is_at_rest);
        if !self.is_healed || !self.seats.iter().all(at_rest) {
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

    fn happen(&mut self, Happening { place, deed, .. }: Happening) -> Result<(), Finding> {
        match deed {
            Deed::Crash => self.crash(place),
            Deed::Boot => return self.boot(place),
            _ => {}
        }
        let Some(event) = self.event(place, deed) else {
            return Ok(());
        };
        let is_own_failure = match event {
            Event::ManeuverFailed(_) => true,
            Event::AvailabilityChanged(availability) => availability != Availability::Available,
            _ => false,
        };
        if is_own_failure {
            let nodes = (0..self.seats.len()).map(|place| self.monitor.node(place));
            self.times.fail(self.now_us, place, nodes);
        }
        match event {
            Event::CommandManeuver { follower, task } => {
                let parameters = TaskParameters::default();
                let order = Stimulus::Order {
                    follower,
                    task,
                    parameters,
                };
                self.handle(place, order)
            }
            event => self.handle(place, Stimulus::Event(event)),
        }
    }

    /// What a robot that is up is told.
    fn event(&mut self, place: usize, deed: Deed) -> Option<Event> {
        let seat = &mut self.seats[place];
        let machine = seat.machine.as_mut()?;
        Some(match deed {
            Deed::Detect => Event::PedestrianDetected(seat.draw.plan.request()),
            Deed::Fail => machine.finish(false)?,
            Deed::Leave => Event::LeaveRequested,
            Deed::Availability(availability) => Event::AvailabilityChanged(availability),
            Deed::OpenCorridor => Event::OpenCorridor,
            Deed::CloseCorridor => Event::CloseCorridor,
            Deed::Command(follower, task) => Event::CommandManeuver { follower, task },
            Deed::TaskCompleted => Event::TaskCompleted,
            Deed::ChangeIdentity => {
                seat.changes += 1;
                let station = seat.draw.station.0 + seat.changes * PSEUDONYM_STEP;
                Event::IdentityChanged(StationId(station))
            }
            Deed::Crash | Deed::Boot => return None,
        })
    }

    fn crash(&mut self, place: usize) {
        let nodes = (0..self.seats.len()).map(|place| self.monitor.node(place));
        self.times.crash(self.now_us, place, nodes);
        self.monitor.crash(place);
        self.seats[place].machine = None;
        self.seats[place].wakes_us = None;
    }

    /// Boots a robot that is down, with the next boot counter.
    fn boot(&mut self, place: usize) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        if seat.machine.is_some() {
            return Ok(());
        }
        let draw = seat.draw;
        seat.boot += 1;
        let robot = Robot::new(draw.station, seat.boot);
        self.monitor.boot(place, &robot, &draw.config);
        let now_ms = seat.clock.shows_us(self.now_us) / 1_000;
        let endpoint = Endpoint::with_rules(
            robot,
            draw.config.clone(),
            Wire::default(),
            now_ms,
            self.rules,
        );
        let gait = self.swarm.seed.wrapping_add(place as u64);
        let body = Body::new(
            draw.build,
            draw.plan.site,
            draw.place,
            draw.time_scale,
            gait,
        );
        let application = Application::new(body, Some(draw.plan.clone()));
        seat.machine = Some(Machine::new(endpoint, application));
        let entry = Entry::Started {
            station: draw.station,
            boot: self.seats[place].boot,
            settings: Box::new(draw.config.settings().clone()),
            identifiers: Wire::default().identifiers,
            unix_ms: u64::try_from(EPOCH_UNIX_MS).unwrap_or(0) + self.now_us / 1_000,
        };
        self.record(place, entry);
        self.handle(place, Stimulus::Time)
    }

    /// Hands something to a robot, and carries out what it wants; nothing if the robot is down.
    fn handle(&mut self, place: usize, stimulus: Stimulus<'_>) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        let Some(machine) = &mut seat.machine else {
            return Ok(());
        };
        let shows_us = seat.clock.shows_us(self.now_us);
        let since_ms = i64::try_from(shows_us / 1_000).unwrap_or(i64::MAX);
        let moment = Moment {
            now_ms: shows_us / 1_000,
            timestamp_its: timestamp_its(EPOCH_UNIX_MS + since_ms),
        };
        #[expect(clippy::cast_precision_loss, reason = "runs take minutes")]
        let now_s = shows_us as f64 / 1e6;
        for effect in machine.handle(moment, now_s, stimulus) {
            self.carry_out(place, effect)?;
        }
        let late = self
            .times
            .look(self.now_us, place, self.monitor.node(place));
        self.plan_wakeup(place);
        match late {
            None => Ok(()),
            Some(measure) => Err(self.too_late(place, measure)),
        }
    }

    fn too_late(&self, place: usize, measure: Measure) -> Finding {
        Finding {
            property: measure.property().to_owned(),
            statement: measure.statement().to_owned(),
            at_ms: self.now_us / 1_000,
            robot: self.seats[place].draw.name.clone(),
        }
    }

    fn carry_out(&mut self, place: usize, effect: Effect) -> Result<(), Finding> {
        let broken = match &effect {
            Effect::Stepped {
                input,
                outputs,
                state,
            } => {
                self.steps += 1;
                self.monitor.step(place, *input, outputs, state)
            }
            _ => None,
        };
        if let Effect::Transmit { packet, .. } = &effect {
            let packet = Rc::from(packet.as_slice());
            self.transmit(place, &packet);
        }
        if self.watch.is_some()
            && let Some(entry) = recorded(effect)
        {
            self.record(place, entry);
        }
        match broken {
            None => Ok(()),
            Some(broken) => Err(Finding {
                property: broken.name(),
                statement: broken.statement().to_owned(),
                at_ms: self.now_us / 1_000,
                robot: self.seats[place].draw.name.clone(),
            }),
        }
    }

    fn transmit(&mut self, from: usize, packet: &Rc<[u8]>) {
        self.packets += 1;
        if let Some(watch) = &mut self.watch {
            let epoch = Duration::from_millis(EPOCH_UNIX_MS.unsigned_abs());
            watch.packet(epoch + Duration::from_micros(self.now_us), packet);
        }
        for to in (0..self.seats.len()).filter(|&to| to != from) {
            match self.ways[from * self.seats.len() + to].fate(self.now_us) {
                Fate::Lost(how) => {
                    if self.seats[to].machine.is_some() && self.watch.is_some() {
                        let entry = Entry::Dropped {
                            cause: how.name().to_owned(),
                            detail: "by the simulator".to_owned(),
                            octets: packet.to_vec(),
                        };
                        self.record(to, entry);
                    }
                }
                Fate::Arrives {
                    after_us,
                    again_after_us,
                } => {
                    for after_us in [Some(after_us), again_after_us].into_iter().flatten() {
                        let packet = Rc::clone(packet);
                        self.at(self.now_us + after_us, Next::Arrives { to, packet });
                    }
                }
            }
        }
    }

    /// Wakes the robot when it is to be told of time, give or take its lateness.
    fn plan_wakeup(&mut self, place: usize) {
        let seat = &mut self.seats[place];
        let Some(machine) = &seat.machine else { return };
        let shown_ms = machine.endpoint().next_wakeup_ms();
        let due_us = seat
            .clock
            .true_us(shown_ms.saturating_mul(1_000))
            .max(self.now_us);
        if seat.wakes_us.is_some_and(|wakes_us| wakes_us <= due_us) {
            return;
        }
        let wakes_us = due_us + self.draws.random_range(0..=self.swarm.late_max_us);
        seat.wakes_us = Some(wakes_us);
        self.at(wakes_us, Next::Wakes(place));
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

/// The longest times for the robots of a swarm, which all have the same timers.
fn limits(swarm: &Swarm) -> Limits {
    let delay_max = swarm
        .ways
        .iter()
        .map(crate::transport::Faults::delay_max_ms);
    Limits::new(
        &swarm.robots[0].config,
        Millis(delay_max.max().unwrap_or(0)),
    )
}
