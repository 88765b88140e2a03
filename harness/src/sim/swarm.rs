//! What is drawn for each seed.
//!
//! Every seed has some of the faults and not others, each in a strength of its own: a run with few
//! faults goes far into a session, one with many goes astray in every way. A run that has a little of
//! everything would do neither.

use crossguard_protocol::{
    Availability, Config, Heartbeat, Millis, RequestId, Settings, StationId, TaskSet, TaskType,
    Unavailability, Urgency,
};
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::script::{Deed, Happening};
use crate::body::Build;
use crate::plan::{Leg, Plan, Stage};
use crate::site::{Place, Site};
use crate::transport::{Burst, Delay, Faults, Outage};

/// By how much a station id grows when the robot changes its pseudonym.
pub(super) const PSEUDONYM_STEP: u32 = 100;

const SECOND_US: u64 = 1_000_000;

/// All that a run is made of.
#[derive(Clone, Debug)]
pub struct Swarm {
    /// The seed that it was drawn from.
    pub seed: u64,
    /// The robots, by place.
    pub robots: Vec<RobotDraw>,
    /// The faults of each way, `from * robots + to`.
    pub ways: Vec<Faults>,
    /// What happens, in order of time.
    pub script: Vec<Happening>,
    /// When the network is healed, in microseconds.
    pub heals_us: u64,
    /// By how much endpoints are late to be told of time at most, in microseconds.
    pub late_max_us: u64,
}

/// What is drawn for one robot.
#[derive(Clone, Debug)]
pub struct RobotDraw {
    /// Its name in logs.
    pub name: String,
    /// Its first station id.
    pub station: StationId,
    /// Its boot counter at its first boot.
    pub boot: u16,
    /// Its configuration.
    pub config: Config,
    /// What it does when it leads.
    pub plan: Plan,
    /// Its body.
    pub build: Build,
    /// Where it begins.
    pub place: Place,
    /// How many times as fast as real it moves.
    pub time_scale: f64,
    /// By how much its clock is off, in parts per million.
    pub drift_ppm: i64,
}

impl Swarm {
    /// The timers that runs are drawn with: those in use, and shorter ones, so that more happens.
    #[must_use]
    pub fn timers() -> [Settings; 2] {
        let short = Settings {
            t_safety: Millis(1_000),
            t_lease: Millis(900),
            t_leave: Millis(1_500),
            t_ack: Millis(250),
            t_offer: Millis(1_500),
            t_help: Millis(4_000),
            ..Settings::default()
        };
        [Settings::default(), short]
    }

    /// Draws a run of 2 to `robots` robots. With `faults`, every way has these instead of its own.
    #[must_use]
    pub fn draw(seed: u64, robots: usize, faults: Option<&Faults>) -> Self {
        let mut draws = Draws(ChaCha8Rng::seed_from_u64(seed));
        let robots = draws.0.random_range(2..=robots.max(2));
        let heals_us = draws.0.random_range(8 * SECOND_US..=60 * SECOND_US);
        let settings = draws.settings();
        let time_scale = draws.0.random_range(3.0..30.0);
        let members: Vec<_> = (0..robots)
            .map(|place| draws.robot(place, robots, &settings, time_scale))
            .collect();
        let script = draws.script(&members, heals_us);
        let mut ways = match faults {
            Some(faults) => vec![faults.clone(); robots * robots],
            None => draws.ways(robots),
        };
        for cut in draws.partitions(robots, heals_us) {
            for (from, to) in (0..robots).flat_map(|from| (0..robots).map(move |to| (from, to))) {
                if (cut.0 >> from & 1) != (cut.0 >> to & 1) {
                    ways[from * robots + to].outages.push(cut.1);
                }
            }
        }
        let delay_max_us = u64::from(settings.delay_max.0) * 1_000;
        Self {
            seed,
            robots: members,
            ways,
            script,
            heals_us,
            // A millisecond is lost to clocks that are read to the millisecond.
            late_max_us: draws.0.random_range(0..=delay_max_us.saturating_sub(2_000)),
        }
    }
}

struct Draws(ChaCha8Rng);

impl Draws {
    /// Whether a run has something at all, and then how much of it.
    fn perhaps(&mut self, max: f64) -> f64 {
        if self.0.random_bool(0.5) {
            self.0.random_range(0.0..max)
        } else {
            0.0
        }
    }

    fn time(&mut self, until_us: u64) -> u64 {
        self.0.random_range(0..until_us)
    }

    /// Timers, the same for all robots.
    fn settings(&mut self) -> Settings {
        let [in_use, short] = Swarm::timers();
        let mut settings = if self.0.random_bool(0.3) {
            short
        } else {
            in_use
        };
        settings.t_exec[usize::from(TaskType::INITIAL_POS.value())].0 = 20_000;
        settings.n_ack = self.0.random_range(1..=4);
        settings
    }

    /// One robot; its counters may be close to wrapping round.
    fn robot(
        &mut self,
        place: usize,
        robots: usize,
        settings: &Settings,
        time_scale: f64,
    ) -> RobotDraw {
        let all = [TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK];
        let can = |draws: &mut Self| {
            let can: Vec<_> = all
                .into_iter()
                .filter(|_| draws.0.random_bool(0.85))
                .collect();
            TaskSet::of(&can)
        };
        let settings = Settings {
            capabilities: can(self),
            first_request: RequestId(self.0.random()),
            first_heartbeat: Heartbeat(self.0.random()),
            ..settings.clone()
        };
        let drift_ppm = i64::from(settings.drift_ppm);
        let station = StationId(u32::try_from(place).unwrap_or(0) + 1);
        RobotDraw {
            name: format!("R{station}"),
            station,
            boot: self.0.random_range(1..60_000),
            config: Config::new(settings).expect("drawn within the inequalities"),
            plan: self.plan(robots),
            build: if self.0.random() {
                Build::Humanoid
            } else {
                Build::Quadruped
            },
            place: self.place(),
            time_scale,
            drift_ppm: self.0.random_range(-drift_ppm..=drift_ppm),
        }
    }

    fn place(&mut self) -> Place {
        let mut metres = || self.0.random_range(-10.0..10.0);
        Place::new(metres(), metres())
    }

    fn plan(&mut self, robots: usize) -> Plan {
        let site = Site::default();
        let tasks = [TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK];
        let stages = (0..self.0.random_range(1..=4)).map(|_| {
            let task = *tasks.choose(&mut self.0).expect("there are tasks");
            Stage::everybody(Leg::new(task, self.place()))
        });
        let stages = stages.collect();
        let most = (robots - 1).min(crossguard_protocol::MAX_FOLLOWERS);
        let urgencies = [Urgency::Low, Urgency::Medium, Urgency::High];
        Plan {
            followers: u8::try_from(self.0.random_range(1..=most)).unwrap_or(1),
            urgency: *urgencies.choose(&mut self.0).expect("there are urgencies"),
            stages,
            crossing_s: 6.0,
            patience_s: 40.0,
            ..Plan::crossing(site)
        }
    }

    /// The faults of every way: alike in both directions, or each with its own.
    fn ways(&mut self, robots: usize) -> Vec<Faults> {
        let common = self.faults();
        let is_uneven = self.0.random_bool(0.3);
        let mut way = || {
            if is_uneven {
                let share = self.0.random_range(0.0..1.0);
                Faults {
                    loss: common.loss * share,
                    burst: common.burst.filter(|_| self.0.random_bool(share)),
                    delay: common.delay,
                    ..common.clone()
                }
            } else {
                common.clone()
            }
        };
        (0..robots * robots).map(|_| way()).collect()
    }

    fn faults(&mut self) -> Faults {
        let burst = self.0.random_bool(0.5).then(|| Burst {
            loss: self.0.random_range(0.05..=0.4),
            length: self.0.random_range(1.0..20.0),
        });
        // Quick, slow, or so slow that messages outlive the session that they belong to.
        let longest = *[10, 300, 4_000]
            .choose(&mut self.0)
            .expect("there are three");
        let max_ms = self.0.random_range(0..longest);
        Faults {
            loss: self.perhaps(0.4),
            burst,
            duplication: self.perhaps(0.3),
            reordering: self.perhaps(0.3),
            delay: Delay {
                min_ms: 0,
                max_ms,
                mean_ms: self.0.random_bool(0.3).then_some(30.0),
            },
            outages: Vec::new(),
        }
    }

    /// Times in which one group of robots does not hear the other, by one bit for each robot.
    fn partitions(&mut self, robots: usize, heals_us: u64) -> Vec<(u64, Outage)> {
        let partitions = self.0.random_range(0..=4);
        let partition = |_| {
            let group = self.0.random_range(1..(1 << robots) - 1);
            let from_us = self.time(heals_us);
            let until_us = (from_us + self.0.random_range(0..10 * SECOND_US)).min(heals_us);
            let outage = Outage {
                from_ms: from_us / 1_000,
                until_ms: until_us / 1_000,
            };
            (group, outage)
        };
        (0..partitions).map(partition).collect()
    }

    fn script(&mut self, robots: &[RobotDraw], heals_us: u64) -> Vec<Happening> {
        let mut script = Vec::new();
        let mut add = |at_us, place, deed| script.push(Happening { at_us, place, deed });
        let any = |draws: &mut Self| draws.0.random_range(0..robots.len());
        for place in 0..robots.len() {
            add(self.time(SECOND_US / 4), place, Deed::Boot);
        }
        for _ in 0..self.0.random_range(1..=8) {
            let first = self.time(heals_us);
            add(first, any(self), Deed::Detect);
            if self.0.random_bool(0.3) {
                // Another robot sees the same pedestrian.
                add(first + self.time(SECOND_US / 5), any(self), Deed::Detect);
            }
        }
        for _ in 0..self.0.random_range(0..=5) {
            let (at, place) = (self.time(heals_us), any(self));
            add(at, place, Deed::Crash);
            // One in four stays down until the network is healed.
            let stays_down = self.0.random_bool(0.25);
            let up = if stays_down {
                heals_us
            } else {
                at + self.time(6 * SECOND_US)
            };
            add(up, place, Deed::Boot);
        }
        let mischief = self.0.random_range(0..=12) * u32::from(self.0.random_bool(0.6));
        for _ in 0..mischief {
            let deed = self.mischief(robots);
            add(self.time(heals_us), any(self), deed);
        }
        for place in 0..robots.len() {
            // What was broken is repaired in the end.
            add(heals_us, place, Deed::Availability(Availability::Available));
        }
        script.sort_by_key(|happening| happening.at_us);
        script
    }

    fn mischief(&mut self, robots: &[RobotDraw]) -> Deed {
        let reasons = [
            Unavailability::LowBattery,
            Unavailability::Teleoperated,
            Unavailability::EmergencyStop,
            Unavailability::LocalFault,
            Unavailability::NotSafe,
        ];
        match self.0.random_range(0..9) {
            0 => Deed::Fail,
            1 => Deed::Leave,
            2 => {
                let reason = *reasons.choose(&mut self.0).expect("there are reasons");
                Deed::Availability(Availability::Unavailable(reason))
            }
            3 => Deed::Availability(Availability::Available),
            4 => Deed::OpenCorridor,
            5 => Deed::CloseCorridor,
            6 => {
                let to = robots.choose(&mut self.0).expect("there are robots");
                let tasks = [TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK];
                let task = *tasks.choose(&mut self.0).expect("there are tasks");
                Deed::Command(to.station, task)
            }
            7 => Deed::TaskCompleted,
            _ => Deed::ChangeIdentity,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_draws_the_same_run_every_time_and_another_one_another() {
        let draw = |seed| format!("{:?}", Swarm::draw(seed, 6, None));
        assert_eq!(draw(7), draw(7));
        assert_ne!(draw(7), draw(8));
    }

    #[test]
    fn all_sizes_and_faults_are_drawn_at_some_time() {
        let swarms: Vec<_> = (0..200).map(|seed| Swarm::draw(seed, 6, None)).collect();
        for robots in 2..=6 {
            assert!(swarms.iter().any(|swarm| swarm.robots.len() == robots));
        }
        let some = |has: fn(&Faults) -> bool| swarms.iter().any(|s| s.ways.iter().any(has));
        assert!(some(|faults| faults.loss > 0.3));
        assert!(some(|faults| faults.burst.is_some_and(|b| b.loss > 0.35)));
        assert!(some(|faults| faults.duplication > 0.2));
        assert!(some(|faults| faults.reordering > 0.2));
        assert!(some(|faults| !faults.outages.is_empty()));
        let crashes = |swarm: &&Swarm| swarm.script.iter().any(|h| h.deed == Deed::Crash);
        assert!(swarms.iter().any(|swarm| crashes(&swarm)));
    }
}
