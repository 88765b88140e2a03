//! A run on the air: vehicles send CAM, people's devices VAM, robots RAM, all on one channel.
//!
//! Event by event, in microseconds. Every station checks its generation rule every 100 ms, each at its
//! own phase; the message is ready a moment later, waits for the channel, and is heard when its frame
//! ends. A robot's announcement goes through the octets of a real RAM, and a device decides by the messages that it
//! heard whether it falls silent.

#![allow(clippy::similar_names, reason = "the same time in us and in ms")]

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use crossguard_endpoint::ras::congestion::Reactive;
use crossguard_endpoint::ras::generation::{Cadence, LOW_FREQUENCY_INTERVAL_MS, Limits, Trigger};
use crossguard_endpoint::ras::motion::{Change, Motion};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::behaviour::Behaviour;
use super::messages::{CERTIFICATE_INTERVAL_MS, Signed, Sizes, air_time_us, frame_octets};
use super::radio::{Channel, Transmission, WINDOW_US};
use super::robot::{Message, Robot, RobotError};
use super::trace::{Run, Track};
use super::vru::VruStation;

/// How often a generation rule is checked, in ms (`T_CheckVamGen`): what is sent at an interval is sent at a
/// multiple of it.
pub const CHECK_MS: u64 = 100;
/// The same in microseconds.
const CHECK_US: u64 = 1_000 * CHECK_MS;
/// How long a message takes to be built at most, in microseconds.
const ASSEMBLY_MAX_US: u64 = 10_000;
/// Stations are switched on one after the other until then, and what happens before is not counted, in
/// microseconds.
pub const SETTLING_US: u64 = 5_000_000;
/// Frames that a station keeps waiting at most; a further one takes the place of the oldest.
const QUEUE_MAX: usize = 2;

/// Measurements of a run.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Measured {
    /// Mean channel busy ratio over vehicles, devices and windows of 100 ms, 0..1. Robots are left out, so that it is
    /// the mean over the same stations whatever the number of robots.
    pub mcbr: f64,
    /// Share of devices' time in which they leave their announcement to a robot, 0..1.
    pub passive: f64,
    /// Share of devices' time in which they do so though no robot perceives them, 0..1.
    pub wrongly_silent: f64,
    /// Air time of CAM by time, 0..1.
    pub cam_load: f64,
    /// Air time of VAM by time, 0..1.
    pub vam_load: f64,
    /// Air time of RAM, RMCM and of robots' cluster VAM by time, 0..1.
    pub ram_load: f64,
    /// CAM per second.
    pub cam_rate: f64,
    /// VAM per second.
    pub vam_rate: f64,
    /// RAM, RMCM and robots' cluster VAM per second.
    pub ram_rate: f64,
    /// Share of frames that overlapped with another anywhere on the grid, also out of its range, 0..1.
    pub overlapped: f64,
    /// Messages that a newer one replaced before they could be sent, per second.
    pub replaced_rate: f64,
}

#[derive(Clone, Debug)]
pub(super) enum Payload {
    Cam,
    Vam,
    /// RAM, RMCM, or a robot's cluster VAM.
    Robot(Box<Message>),
}

#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) octets: usize,
    pub(super) payload: Payload,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Event {
    End(usize),
    Window,
    Attempt(usize),
    Ready(usize),
    Check(usize),
}

enum Role<'a> {
    Vehicle {
        track: &'a Track,
        cadence: Cadence,
        said: Motion,
        low_frequency_ms: Option<u64>,
    },
    Device {
        /// Number of the person who carries it.
        person: u32,
        track: &'a Track,
        station: Box<VruStation>,
        silent_since_ms: Option<u64>,
    },
    Robot(Box<Robot<'a>>),
}

impl Role<'_> {
    /// Whether it is on the street. Robots always are.
    fn is_there(&self, now_us: u64) -> bool {
        match self {
            Self::Vehicle { track, .. } | Self::Device { track, .. } => track.is_there(now_us),
            Self::Robot(_) => true,
        }
    }

    /// When it is switched on: what begins with the run during its first seconds, who comes later at once.
    fn on_us(&self, random: &mut ChaCha8Rng) -> u64 {
        match self {
            Self::Vehicle { track, .. } | Self::Device { track, .. } if track.begin_ms() > 0 => {
                track.begin_ms() * 1_000 + random.random_range(0..CHECK_US)
            }
            _ => random.random_range(0..SETTLING_US),
        }
    }

    /// The silence of a device that ends now, if it is silent.
    fn silence_until(&mut self, now_ms: u64) -> Option<Silence> {
        let Self::Device {
            person,
            silent_since_ms,
            ..
        } = self
        else {
            return None;
        };
        let from_ms = silent_since_ms.take()?;
        Some(Silence::new(*person, from_ms, now_ms))
    }
}

struct Station<'a> {
    role: Role<'a>,
    /// Frames that are built and ready at their time, and then wait for the channel.
    building: VecDeque<Frame>,
    waiting: VecDeque<Frame>,
    sending: Option<Frame>,
    certificate_ms: Option<u64>,
    congestion: Reactive,
}

pub(super) struct Simulation<'a> {
    behaviour: &'a Behaviour,
    sizes: &'a Sizes,
    run: &'a Run,
    stations: Vec<Station<'a>>,
    channel: Channel,
    random: ChaCha8Rng,
    events: BinaryHeap<Reverse<(u64, Event)>>,
    end_us: u64,
    sums: Sums,
    silences: Vec<Silence>,
}

/// A time in which a device was silent because of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Silence {
    /// Number of the person who carries it, in the order of the trace, from 0.
    pub person: u32,
    /// From when, in ms from the beginning of the run: the first check at which it was silent.
    pub from_ms: u64,
    /// Until when: the first check at which it was not, or the end of the run.
    pub to_ms: u64,
}

impl Silence {
    const fn new(person: u32, from_ms: u64, to_ms: u64) -> Self {
        Self {
            person,
            from_ms,
            to_ms,
        }
    }
}

#[derive(Default)]
struct Sums {
    busy_us: u64,
    station_windows: u64,
    passive: u64,
    wrongly_silent: u64,
    device_checks: u64,
    air_us: [u64; 3],
    frames: [u64; 3],
    overlapped: u64,
    replaced: u64,
}

/// Measures a run with robots on these ways, and says when each device was silent.
///
/// # Errors
/// When a robot's message cannot be encoded.
pub fn simulate(
    run: &Run,
    duration_ms: u64,
    robots: &[Track],
    behaviour: &Behaviour,
    sizes: &Sizes,
) -> Result<(Measured, Vec<Silence>), RobotError> {
    let mut simulation = Simulation::new(run, duration_ms, robots, behaviour, sizes);
    while let Some(Reverse((now_us, event))) = simulation.events.pop() {
        if now_us >= simulation.end_us {
            break;
        }
        simulation.happen(now_us, event)?;
    }
    let measured = simulation.measured();
    Ok((measured, simulation.into_silences()))
}

impl<'a> Simulation<'a> {
    fn new(
        run: &'a Run,
        duration_ms: u64,
        robots: &'a [Track],
        behaviour: &'a Behaviour,
        sizes: &'a Sizes,
    ) -> Self {
        let devices = behaviour.devices(run.pedestrians.len());
        let vehicles = run.vehicles.iter().map(|track| Role::Vehicle {
            track,
            cadence: Cadence::default(),
            said: Motion::default(),
            low_frequency_ms: None,
        });
        let people = (0_u32..).zip(&run.pedestrians);
        let devices = people.take(devices).map(|(person, track)| Role::Device {
            person,
            track,
            station: Box::new(VruStation::new(
                behaviour.vam,
                behaviour.understands,
                behaviour.suppression,
            )),
            silent_since_ms: None,
        });
        let robots = (0_u32..).zip(robots).map(|(number, track)| {
            Role::Robot(Box::new(Robot::new(number, track, run, behaviour)))
        });
        let station = |role| Station {
            role,
            building: VecDeque::new(),
            waiting: VecDeque::new(),
            sending: None,
            certificate_ms: None,
            congestion: Reactive::default(),
        };
        let stations: Vec<Station> = vehicles.chain(devices).chain(robots).map(station).collect();
        let mut random = ChaCha8Rng::seed_from_u64(run.seed);
        let mut events = BinaryHeap::from([Reverse((WINDOW_US, Event::Window))]);
        for (number, station) in stations.iter().enumerate() {
            let on_us = station.role.on_us(&mut random);
            events.push(Reverse((on_us, Event::Check(number))));
        }
        let mut simulation = Self {
            behaviour,
            sizes,
            run,
            channel: Channel::new(behaviour.radio, stations.len()),
            stations,
            random,
            events,
            end_us: duration_ms * 1_000,
            sums: Sums::default(),
            silences: Vec::new(),
        };
        simulation.place_all(0);
        simulation
    }

    fn place_all(&mut self, now_us: u64) {
        for (number, station) in self.stations.iter().enumerate() {
            let place = match &station.role {
                Role::Vehicle { track, .. } | Role::Device { track, .. } => {
                    track.motion(now_us).position_m
                }
                Role::Robot(robot) => robot.place(now_us),
            };
            self.channel.place(number, place);
        }
    }

    fn happen(&mut self, now_us: u64, event: Event) -> Result<(), RobotError> {
        match event {
            Event::Window => self.window(now_us),
            Event::Check(number) => self.check(now_us, number)?,
            Event::Ready(number) => self.ready(now_us, number),
            Event::Attempt(number) => self.attempt(now_us, number),
            Event::End(number) => self.end(now_us, number),
        }
        Ok(())
    }

    fn window(&mut self, now_us: u64) {
        let (sums, stations) = (&mut self.sums, &mut self.stations);
        let counts = now_us > SETTLING_US;
        let has_dcc = self.behaviour.dcc;
        self.channel.close_window(now_us, |number, busy_us| {
            let role = &stations[number].role;
            if counts && !matches!(role, Role::Robot(_)) && role.is_there(now_us) {
                sums.busy_us += u64::from(busy_us);
                sums.station_windows += 1;
            }
            if has_dcc {
                stations[number]
                    .congestion
                    .approach(f64::from(busy_us) / 1e5);
            }
        });
        self.place_all(now_us);
        self.events
            .push(Reverse((now_us + WINDOW_US, Event::Window)));
    }

    fn check(&mut self, now_us: u64, number: usize) -> Result<(), RobotError> {
        let now_ms = now_us / 1_000;
        let behaviour = self.behaviour;
        let station = &mut self.stations[number];
        if !station.role.is_there(now_us) {
            self.silences.extend(station.role.silence_until(now_ms));
            return Ok(());
        }
        self.events
            .push(Reverse((now_us + CHECK_US, Event::Check(number))));
        let congestion_ms = station.congestion.interval_ms();
        match &mut station.role {
            Role::Vehicle {
                track,
                cadence,
                said,
                low_frequency_ms,
            } => {
                #[expect(clippy::cast_precision_loss, reason = "a few minutes")]
                if behaviour
                    .vehicles_leave_s
                    .is_some_and(|s| now_us as f64 >= s * 1e6)
                {
                    return Ok(());
                }
                let motion = track.motion(now_us);
                if !cam_due(behaviour, cadence, now_ms, congestion_ms, said, &motion) {
                    return Ok(());
                }
                *said = motion;
                let low_frequency =
                    low_frequency_ms.is_none_or(|last| now_ms - last >= LOW_FREQUENCY_INTERVAL_MS);
                if low_frequency {
                    *low_frequency_ms = Some(now_ms);
                }
                let octets = self.sizes.cam(low_frequency);
                self.build(now_us, number, octets, Payload::Cam);
            }
            Role::Device {
                person,
                track,
                station,
                silent_since_ms,
            } => {
                let due = station.poll(now_ms, &track.motion(now_us), congestion_ms);
                let (person, is_silent) = (*person, station.is_passive());
                let since_ms = if is_silent {
                    silent_since_ms.get_or_insert(now_ms);
                    None
                } else {
                    silent_since_ms.take()
                };
                self.silences
                    .extend(since_ms.map(|from_ms| Silence::new(person, from_ms, now_ms)));
                if now_us > SETTLING_US {
                    let is_wrong = is_silent && !self.is_perceived(person);
                    self.sums.passive += u64::from(is_silent);
                    self.sums.wrongly_silent += u64::from(is_wrong);
                    self.sums.device_checks += 1;
                }
                if let Some(due) = due {
                    let octets = self.sizes.vam(&due);
                    self.build(now_us, number, octets, Payload::Vam);
                }
            }
            Role::Robot(robot) => {
                for message in robot.check(now_us, self.run, congestion_ms)? {
                    let octets = message.octets;
                    self.build(now_us, number, octets, Payload::Robot(Box::new(message)));
                }
            }
        }
        Ok(())
    }

    fn is_perceived(&self, person: u32) -> bool {
        self.stations.iter().any(|station| match &station.role {
            Role::Robot(robot) => robot.perceives(person),
            Role::Vehicle { .. } | Role::Device { .. } => false,
        })
    }

    /// A message is built; it will be ready after a moment.
    fn build(&mut self, now_us: u64, number: usize, message_octets: usize, payload: Payload) {
        let now_ms = now_us / 1_000;
        let station = &mut self.stations[number];
        let is_due = |last: u64| now_ms.saturating_sub(last) >= CERTIFICATE_INTERVAL_MS;
        let signed = if !self.behaviour.signed {
            Signed::No
        } else if station.certificate_ms.is_none_or(is_due) {
            station.certificate_ms = Some(now_ms);
            Signed::WithCertificate
        } else {
            Signed::ByDigest
        };
        station.building.push_back(Frame {
            octets: frame_octets(message_octets, signed),
            payload,
        });
        let ready_us = now_us + self.random.random_range(0..ASSEMBLY_MAX_US);
        self.events.push(Reverse((ready_us, Event::Ready(number))));
    }

    fn ready(&mut self, now_us: u64, number: usize) {
        let station = &mut self.stations[number];
        let Some(frame) = station.building.pop_front() else {
            return;
        };
        let was_idle = station.waiting.is_empty() && station.sending.is_none();
        if station.waiting.len() >= QUEUE_MAX {
            station.waiting.pop_front();
            self.sums.replaced += 1;
        }
        station.waiting.push_back(frame);
        if was_idle {
            self.want(now_us, number);
        }
    }

    fn want(&mut self, now_us: u64, number: usize) {
        let at_us = self.channel.want(number, now_us, &mut self.random);
        self.events.push(Reverse((at_us, Event::Attempt(number))));
    }

    fn attempt(&mut self, now_us: u64, number: usize) {
        if !self.channel.may_send(number, now_us) {
            return;
        }
        let station = &mut self.stations[number];
        let Some(frame) = station.waiting.pop_front() else {
            return;
        };
        let duration_us = air_time_us(frame.octets, self.behaviour.radio.data_rate_mbps);
        if now_us > SETTLING_US {
            let kind = match frame.payload {
                Payload::Cam => 0,
                Payload::Vam => 1,
                Payload::Robot(_) => 2,
            };
            self.sums.air_us[kind] += duration_us;
            self.sums.frames[kind] += 1;
        }
        station.sending = Some(frame);
        let events = &mut self.events;
        let postponed = |other, at_us| events.push(Reverse((at_us, Event::Attempt(other))));
        let end_us = self
            .channel
            .send(number, now_us, duration_us, &mut self.random, postponed);
        self.events.push(Reverse((end_us, Event::End(number))));
    }

    fn end(&mut self, now_us: u64, number: usize) {
        let Some(transmission) = self.channel.end(number) else {
            return;
        };
        let frame = self.stations[number].sending.take();
        if now_us > SETTLING_US {
            self.sums.overlapped += u64::from(Channel::overlapped(&transmission));
        }
        if let Some(Frame {
            payload: Payload::Robot(message),
            ..
        }) = frame
        {
            self.announce(now_us, &transmission, &message);
        }
        if !self.stations[number].waiting.is_empty() {
            self.want(now_us, number);
        }
    }

    /// Everybody in range who receives it hears what a robot says.
    fn announce(&mut self, now_us: u64, transmission: &Transmission, message: &Message) {
        for (number, station) in self.stations.iter_mut().enumerate() {
            let receives = || self.channel.receives(number, transmission);
            match &mut station.role {
                Role::Device { track, station, .. } if track.is_there(now_us) => {
                    if let Some(announced) = &message.announced
                        && receives()
                    {
                        station.hear(now_us / 1_000, &track.motion(now_us), announced);
                    }
                }
                Role::Robot(robot) if receives() => robot.hear(now_us, message),
                Role::Device { .. } | Role::Robot(_) | Role::Vehicle { .. } => {}
            }
        }
    }

    /// When devices were silent; who still is, is until the end.
    fn into_silences(mut self) -> Vec<Silence> {
        let (mut silences, end_ms) = (self.silences, self.end_us / 1_000);
        let stations = self.stations.iter_mut();
        silences.extend(stations.filter_map(|it| it.role.silence_until(end_ms)));
        silences
    }

    #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
    fn measured(&self) -> Measured {
        let sums = &self.sums;
        let measured_us = self.end_us.saturating_sub(SETTLING_US).max(1) as f64;
        let share = |part: u64, whole: u64| part as f64 / (whole as f64).max(1.0);
        let [cam_load, vam_load, ram_load] = sums.air_us.map(|us| us as f64 / measured_us);
        let [cam_rate, vam_rate, ram_rate] =
            sums.frames.map(|count| count as f64 * 1e6 / measured_us);
        Measured {
            mcbr: share(sums.busy_us, sums.station_windows * WINDOW_US),
            passive: share(sums.passive, sums.device_checks),
            wrongly_silent: share(sums.wrongly_silent, sums.device_checks),
            cam_load,
            vam_load,
            ram_load,
            cam_rate,
            vam_rate,
            ram_rate,
            overlapped: share(sums.overlapped, sums.frames.iter().sum()),
            replaced_rate: sums.replaced as f64 * 1e6 / self.end_us as f64,
        }
    }
}

/// Whether a vehicle's CAM is due; it counts as sent.
fn cam_due(
    behaviour: &Behaviour,
    cadence: &mut Cadence,
    now_ms: u64,
    congestion_ms: u64,
    said: &Motion,
    motion: &Motion,
) -> bool {
    let trigger = if let Some(interval_ms) = behaviour.cam_interval_ms {
        // Neither motion nor a shorter interval: only time.
        let last = cadence.last_ms();
        let is_due = |last| now_ms.saturating_sub(last) >= interval_ms.max(congestion_ms);
        last.is_none_or(is_due).then_some(Trigger::First)
    } else {
        let limits = Limits {
            congestion_ms,
            ..Limits::default()
        };
        cadence.trigger(now_ms, limits, &Change::of_motion(said, motion))
    };
    if let Some(trigger) = trigger {
        cadence.sent(now_ms, trigger);
    }
    trigger.is_some()
}
