//! Streams of people and vehicles at one crossing of the street, how they behave there, and the robots that guard it.

use crossguard_protocol::{Config, StationId};
use crossguard_robot::body::Build;
use crossguard_robot::plan::Plan;
use crossguard_robot::plan_file::PlanFile;
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::transport::{Delay, Faults};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::{Ids, RobotDraw, SECOND_US, Sensing, SourceDraw, Swarm};
use crate::sim::swarm::{Deed, Happening};

/// A road user who comes: a person on foot, or a vehicle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arrival {
    /// When, in microseconds.
    pub at_us: u64,
    /// How far a person is from the middle of the road by then, or a vehicle from the crossing, in metres.
    pub away_m: f64,
    /// Whether a person comes from the north, or a vehicle from the east.
    pub comes_back: bool,
    /// How fast a person walks, in m/s.
    pub speed_mps: f64,
}

/// How people and drivers behave, and what leaders ask of vehicles. Sources and assumptions: `harness/doc/school-street.md`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Habits {
    /// Mean of the speeds that drivers want, in m/s.
    pub speed_limit_mps: f64,
    /// The share of vehicles that hear RAM and VAM, and send CAM.
    pub connected_share: f64,
    /// The share of people with a phone that sends VAM.
    pub phone_share: f64,
    /// The share of drivers who stop for a person who waits.
    pub yielding_share: f64,
    /// The share of drivers who stop for a robot that shows stop.
    pub heeding_share: f64,
    /// The share of drivers who react late.
    pub distracted_share: f64,
    /// Time from seeing somebody on the road to braking, in seconds.
    pub reaction_s: f64,
    /// The same of a driver who reacts late.
    pub distracted_reaction_s: f64,
    /// From how far drivers see people and robots, in metres.
    pub sight_m: f64,
    /// From how far stations hear each other, in metres.
    pub radio_m: f64,
    /// The share of people who wait for the sign where a robot is.
    pub trusting_share: f64,
    /// After which time they cross by themselves all the same, in seconds.
    pub hope_s: f64,
    /// After which time people give up: shortest and longest, in seconds.
    pub patience_s: [f64; 2],
    /// Time that people add to their time across for a gap that is long enough, in seconds.
    pub start_up_s: f64,
    /// The deviation of people's critical gaps, as a share of the mean.
    pub gap_spread: f64,
    /// The share of messages that are lost, between robots and to and from vehicles.
    pub loss: f64,
    /// A leader asks connected vehicles to stop that would be at the crossing within so many seconds; 0: none.
    pub asks_vehicles_s: f64,
}

impl Habits {
    /// Whether they can be.
    ///
    /// # Errors
    /// Which one cannot be, and what is wanted.
    pub fn check(&self) -> Result<(), String> {
        let shares = [
            ("connected_share", self.connected_share),
            ("phone_share", self.phone_share),
            ("yielding_share", self.yielding_share),
            ("heeding_share", self.heeding_share),
            ("distracted_share", self.distracted_share),
            ("trusting_share", self.trusting_share),
            ("loss", self.loss),
        ];
        if let Some((name, share)) = shares.iter().find(|(_, it)| !(0.0..=1.0).contains(it)) {
            return Err(format!("{name} is {share}: 0 to 1 is wanted"));
        }
        let [least, most] = self.patience_s;
        let numbers = [
            ("speed_limit_mps", self.speed_limit_mps, 1.0..=40.0),
            ("reaction_s", self.reaction_s, 0.0..=1e6),
            (
                "distracted_reaction_s",
                self.distracted_reaction_s,
                0.0..=1e6,
            ),
            ("sight_m", self.sight_m, 0.0..=1e4),
            ("radio_m", self.radio_m, 0.0..=1e4),
            ("hope_s", self.hope_s, 0.0..=1e6),
            ("start_up_s", self.start_up_s, 0.0..=60.0),
            ("gap_spread", self.gap_spread, 0.0..=1.0),
            ("asks_vehicles_s", self.asks_vehicles_s, 0.0..=60.0),
            ("patience_s, the shortest,", least, 0.0..=3_600.0),
            ("patience_s, the longest,", most, least..=3_600.0),
        ];
        match numbers.iter().find(|(_, it, range)| !range.contains(it)) {
            None => Ok(()),
            Some((name, it, range)) => {
                let (from, to) = (range.start(), range.end());
                Err(format!("{name} is {it}: {from} to {to} is wanted"))
            }
        }
    }
}

impl Default for Habits {
    fn default() -> Self {
        Self {
            speed_limit_mps: 30.0 / 3.6,
            connected_share: 0.3,
            phone_share: 0.5,
            yielding_share: 0.2,
            heeding_share: 0.95,
            distracted_share: 0.03,
            reaction_s: 1.25,
            distracted_reaction_s: 3.0,
            sight_m: 40.0,
            radio_m: 200.0,
            trusting_share: 0.9,
            hope_s: 30.0,
            patience_s: [60.0, 180.0],
            start_up_s: 3.0,
            gap_spread: 0.25,
            loss: 0.05,
            asks_vehicles_s: 0.0,
        }
    }
}

/// A person on foot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(in crate::sim) struct PersonDraw {
    pub(in crate::sim) arrival: Arrival,
    /// Where they cross, in metres to the east.
    pub(in crate::sim) east_m: f64,
    pub(in crate::sim) has_phone: bool,
    pub(in crate::sim) trusts: bool,
    pub(in crate::sim) patience_us: u64,
    /// How much longer than needed a gap has to be.
    pub(in crate::sim) gap_factor: f64,
}

/// A driver.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(in crate::sim) struct DriverDraw {
    pub(in crate::sim) arrival: Arrival,
    /// Wanted speed.
    pub(in crate::sim) speed_mps: f64,
    pub(in crate::sim) is_connected: bool,
    pub(in crate::sim) yields: bool,
    pub(in crate::sim) heeds: bool,
    pub(in crate::sim) reaction_us: u64,
}

/// Everybody who comes in a run. The same for any number of robots.
#[derive(Clone, PartialEq, Debug)]
pub struct Demand {
    pub(in crate::sim) people: Vec<PersonDraw>,
    pub(in crate::sim) drivers: Vec<DriverDraw>,
    pub(in crate::sim) habits: Habits,
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "times are some minutes"
)]
fn micros(seconds: f64) -> u64 {
    (seconds * 1e6) as u64
}

/// A number around 1 with this deviation, normal but for its tails.
fn normal(draws: &mut ChaCha8Rng, deviation: f64) -> f64 {
    let twelve: f64 = (0..12).map(|_| draws.random::<f64>()).sum();
    1.0 + deviation * (twelve - 6.0)
}

impl Demand {
    /// Draws how everybody behaves who comes, in order of time.
    #[must_use]
    pub fn draw(seed: u64, people: &[Arrival], vehicles: &[Arrival], habits: Habits) -> Self {
        let mut draws = ChaCha8Rng::seed_from_u64(seed ^ 0x504c_4143);
        let in_order = |of: &[Arrival]| {
            let mut of = of.to_vec();
            of.sort_by_key(|it| it.at_us);
            of
        };
        let mut is = |share: f64| draws.random_bool(share.clamp(0.0, 1.0));
        let mut walking = Vec::new();
        for arrival in in_order(people) {
            walking.push((arrival, is(habits.phone_share), is(habits.trusting_share)));
        }
        let mut driving = Vec::new();
        for arrival in in_order(vehicles) {
            let reaction_s = if is(habits.distracted_share) {
                habits.distracted_reaction_s
            } else {
                habits.reaction_s
            };
            driving.push(DriverDraw {
                arrival,
                speed_mps: 0.0,
                is_connected: is(habits.connected_share),
                yields: is(habits.yielding_share),
                heeds: is(habits.heeding_share),
                reaction_us: micros(reaction_s),
            });
        }
        let [least, most] = habits.patience_s;
        let people = walking
            .into_iter()
            .map(|(arrival, has_phone, trusts)| PersonDraw {
                arrival,
                east_m: draws.random_range(0.0..2.0),
                has_phone,
                trusts,
                gap_factor: normal(&mut draws, habits.gap_spread).clamp(0.2, 3.0),
                patience_us: micros(least + draws.random::<f64>() * (most - least)),
            });
        let people = people.collect();
        for driver in &mut driving {
            // As SUMO draws it.
            let factor = normal(&mut draws, 0.1).clamp(0.8, 1.2);
            driver.speed_mps = habits.speed_limit_mps * factor;
        }
        Self {
            people,
            drivers: driving,
            habits,
        }
    }

    /// How long a run is: everybody who comes has crossed or given up, and driven on.
    fn lasts_us(&self) -> u64 {
        let people = self
            .people
            .iter()
            .map(|it| it.arrival.at_us + it.patience_us);
        let drivers = self.drivers.iter().map(|it| it.arrival.at_us);
        people.chain(drivers).max().unwrap_or(0) + 120 * SECOND_US
    }
}

impl Swarm {
    /// This many robots at the crossing of the street, and everybody who comes there. Two robots follow the plan
    /// `bilateral`, more the plan `team`; one asks for help in vain.
    ///
    /// # Panics
    /// Never: the plans come with the kit.
    #[must_use]
    pub fn at_place(seed: u64, robots: usize, demand: Demand) -> Self {
        let name = if robots < 3 { "bilateral" } else { "team" };
        let file =
            PlanFile::open(name.as_ref(), SiteFile::street()).expect("it comes with the kit");
        let followers = u8::try_from(robots.saturating_sub(1).max(1)).unwrap_or(u8::MAX);
        let team = file.taking_part(followers);
        let (leaders, others): (Vec<_>, Vec<_>) = team.into_iter().partition(|it| it.leads);
        let team = leaders.into_iter().chain(others).take(robots);
        let plan = Plan {
            asks_vehicles_s: demand.habits.asks_vehicles_s,
            ..file.plan(StationId(1), followers)
        };
        let robots: Vec<_> = team
            .map(|role| RobotDraw {
                name: role.robot.clone().unwrap_or_default(),
                station: role.station.unwrap_or(StationId(1)),
                boot: 1,
                config: Config::default(),
                plan: plan.clone(),
                corner: 0,
                build: role.build.unwrap_or(Build::Humanoid),
                place: role.waits.unwrap_or_default(),
                time_scale: 1.0,
                drift_ppm: 0,
            })
            .collect();
        let way = Faults {
            loss: demand.habits.loss,
            delay: Delay {
                min_ms: 1,
                max_ms: 5,
                mean_ms: None,
            },
            ..Faults::default()
        };
        let source = SourceDraw {
            period_ms: 100,
            latency_ms: 50,
            misses: 0.05,
            error_m: 0.1,
            ids: Ids::Kept,
            covers: None,
            garbled: 0.0,
            silent: None,
        };
        let boots = (0..robots.len()).map(|place| Happening {
            at_us: 0,
            place,
            deed: Deed::Boot,
        });
        Self {
            seed,
            ways: vec![way; robots.len() * robots.len()],
            script: boots.collect(),
            heals_us: demand.lasts_us(),
            sensing: Some(Sensing {
                miss_max: 5,
                sources: vec![vec![source]; robots.len()],
                cars: Vec::new(),
                weakening: |_| (),
            }),
            demand: Some(demand),
            robots,
            ..Self::default()
        }
    }
}
