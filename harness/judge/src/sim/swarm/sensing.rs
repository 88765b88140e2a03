//! Draws of people, of the sensors that see them, of bodies that are pushed away, and of vehicles.

use crossguard_protocol::{self as protocol, Config, Event, Millis, Settings, TaskSet, TaskType};
use crossguard_robot::plan::{Leg, Plan, Stage, Who};
use crossguard_robot::site::Place;
use crossguard_robot::zone::Zone;
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

use super::draws::{CROSSINGS, PATIENCE_MS};
use super::{SECOND_US, Swarm};
use crate::sim::swarm::{Deed, Happening};

/// Sensors of the robots, and vehicles on the street.
#[derive(Clone, Debug)]
pub struct Sensing {
    /// The assumption of the robots: somebody is in at least one of any so many consecutive frames.
    pub miss_max: u8,
    /// The sensors of each robot, by its place.
    pub sources: Vec<Vec<SourceDraw>>,
    /// The vehicles.
    pub cars: Vec<CarDraw>,
    /// Wrong assumption of the robots, in a test of the judges.
    pub weakening: fn(&mut Zone),
}

/// Draw for one sensor.
#[derive(Clone, Debug)]
pub struct SourceDraw {
    /// Time from a frame to the next, in milliseconds.
    pub period_ms: u32,
    /// How old a frame is at most when its robot has it, in milliseconds.
    pub latency_ms: u32,
    /// How probable it is that somebody is missed in a frame, within the assumption.
    pub misses: f64,
    /// Largest error of a place on each axis, in metres.
    pub error_m: f64,
    /// Reliability of its ids.
    pub ids: Ids,
    /// The stretch that it covers: from where to where along the road, in metres to the east; `None` for everything.
    pub covers: Option<[f64; 2]>,
    /// How probable it is that a frame arrives as something that is none.
    pub garbled: f64,
    /// From when to when it delivers nothing.
    pub silent: Option<[u64; 2]>,
}

/// How a tracker numbers people.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ids {
    /// Everybody keeps a number.
    Kept,
    /// There are none.
    None,
    /// Everybody has another one in each so many frames.
    Renewed(u32),
    /// People are numbered from 1 on in each frame, in an order that changes.
    Shuffled,
}

/// Draw for a vehicle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CarDraw {
    /// When it comes.
    pub at_us: u64,
    /// How fast it drives, in m/s to the east.
    pub speed_mps: f64,
}

impl Swarm {
    /// The same run, in which robots see people by sensors of their own, in this share of the seeds.
    #[must_use]
    pub fn with_sensors(mut self, share: f64) -> Self {
        let Some(mut draws) = self.draws_of(0x5345_4e53, share) else {
            return self;
        };
        let time_scale = draws.random_range(1.0..3.0);
        let plan = plan(&mut draws, self.robots.len());
        let all = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK]);
        let can_all = draws.random_bool(0.8);
        for robot in &mut self.robots {
            (robot.corner, robot.time_scale) = (0, time_scale);
            let settings = robot.config.settings().clone();
            robot.config = Config::new(Settings {
                t_cross: Settings::default().t_cross,
                capabilities: if can_all { all } else { settings.capabilities },
                ..settings
            })
            .unwrap_or_default();
            let mut site = robot.plan.site;
            if site.crossing != protocol::Place::UNKNOWN {
                site.crossing = CROSSINGS[0];
            }
            robot.plan = Plan {
                site,
                urgency: robot.plan.urgency,
                ..plan.clone()
            };
        }
        // An application that does as it likes is for the other runs.
        self.script.retain(|it| {
            let Deed::Event(event) = it.deed else {
                return true;
            };
            !matches!(
                event,
                Event::OpenCorridor | Event::CloseCorridor | Event::CommandManeuver { .. }
            )
        });
        let has_faults = draws.random_bool(0.8);
        let miss_max = draws.random_range(1..=5);
        let sources = (0..self.robots.len())
            .map(|_| sources(&mut draws, self.heals_us, has_faults))
            .collect();
        let cars = (0..draws.random_range(0..=6) * u64::from(draws.random_bool(0.5))).map(|_| {
            let speed_mps = draws.random_range(6.0..20.0);
            CarDraw {
                at_us: draws.random_range(0..self.heals_us),
                speed_mps: if draws.random() {
                    speed_mps
                } else {
                    -speed_mps
                },
            }
        });
        let cars = cars.collect();
        self.sensing = Some(Sensing {
            miss_max,
            sources,
            cars,
            weakening: |_| (),
        });
        for _ in 0..draws.random_range(0..=4) * u32::from(draws.random_bool(0.5)) {
            let by = [0, 1].map(|_| draws.random_range(-6.0..6.0));
            self.script.push(Happening {
                at_us: draws.random_range(0..self.heals_us),
                place: draws.random_range(0..self.robots.len()),
                deed: Deed::Push(by),
            });
        }
        self.script.sort_by_key(|happening| happening.at_us);
        self.waits_at = self.waits_at();
        self
    }
}

/// An escort, guards that block the road, or both.
fn plan(draws: &mut ChaCha8Rng, robots: usize) -> Plan {
    let most = (robots - 1).min(crossguard_protocol::MAX_FOLLOWERS);
    let most = u8::try_from(most).unwrap_or(1);
    let post = Place::new(draws.random_range(-5.0..-2.0), draws.random_range(1.0..6.0));
    let block = Leg::new(TaskType::BLOCK, post);
    let escorted = Plan::crossing(crossguard_robot::site::Site::default());
    let plan = match draws.random_range(0..3) {
        0 => Plan {
            followers: draws.random_range(1..=most),
            ..escorted
        },
        1 if most > 1 => {
            // The escort has a role of its own, and the guard takes its place in the first stage.
            let mut stages = escorted.stages.clone();
            let parts = stages.iter_mut().flat_map(|stage| stage.parts.iter_mut());
            parts.for_each(|(who, _)| *who = Who::Role(1));
            stages[0].parts.insert(0, (Who::Role(0), block));
            Plan {
                followers: 2,
                roles: vec![None; 2],
                stages,
                ..escorted
            }
        }
        _ => Plan {
            followers: draws.random_range(1..=most),
            stages: vec![Stage::everybody(block)],
            ..escorted
        },
    };
    Plan {
        own_place: draws
            .random_bool(0.3)
            .then(|| Place::new(draws.random_range(-4.0..-2.0), -1.0)),
        patience_s: f64::from(PATIENCE_MS) / 1_000.0,
        ..plan
    }
}

/// One sensor that covers everything, or two that cover a half each or the same.
fn sources(draws: &mut ChaCha8Rng, heals_us: u64, has_faults: bool) -> Vec<SourceDraw> {
    let halves = [Some([-20.0, 2.0]), Some([0.0, 20.0])];
    let [west, east] = halves;
    let covers = [
        vec![None],
        vec![None, None],
        vec![west, east],
        vec![west, east, None],
    ];
    let covers = covers.choose(draws).expect("there are four");
    let source = |covers: &Option<[f64; 2]>| {
        let ids = [
            Ids::Kept,
            Ids::None,
            Ids::Renewed(draws.random_range(1..30)),
            Ids::Shuffled,
        ];
        let period_ms = draws.random_range(60..=250);
        let good = SourceDraw {
            period_ms,
            latency_ms: draws.random_range(0..=100),
            misses: 0.0,
            error_m: draws.random_range(0.0..=0.2),
            ids: Ids::Kept,
            covers: *covers,
            garbled: 0.0,
            silent: None,
        };
        if !has_faults {
            return good;
        }
        let from_us = draws.random_range(0..heals_us);
        SourceDraw {
            latency_ms: *[20, 100, 450, 700].choose(draws).expect("there are four"),
            misses: *[0.0, 0.1, 0.5, 1.0].choose(draws).expect("there are four"),
            ids: *ids.choose(draws).expect("there are four"),
            garbled: *[0.0, 0.0, 0.02, 0.2].choose(draws).expect("there are four"),
            silent: draws.random_bool(0.3).then(|| {
                let lasts_us = draws.random_range(0..10 * SECOND_US);
                [from_us, (from_us + lasts_us).min(heals_us)]
            }),
            ..good
        }
    };
    covers.iter().map(source).collect()
}

impl SourceDraw {
    /// The same sensor once everything is repaired.
    #[must_use]
    pub fn repaired(&self) -> Self {
        Self {
            latency_ms: self.latency_ms.min(100),
            misses: 0.0,
            ids: Ids::Kept,
            garbled: 0.0,
            silent: None,
            ..self.clone()
        }
    }
}

/// For how long somebody is on the road at most.
pub(in crate::sim) fn longest_us(settings: &Settings) -> u64 {
    let Millis(t_cross) = settings.t_cross;
    u64::from(t_cross) * 900
}
