//! The drawing itself: each part of a run by a function of its own.

use crossguard_protocol::{
    self as protocol, Availability, Config, Event, Heartbeat, Millis, RequestId, Settings,
    StationId, TaskSet, TaskType, Unavailability, Urgency,
};
use crossguard_robot::body::Build;
use crossguard_robot::plan::{Leg, Plan, Stage};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::transport::{Burst, Delay, Faults, Outage};
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Replay, RobotDraw, SECOND_US, Swarm};
use crate::sim::swarm::{Deed, Happening};

pub(super) struct Draws(ChaCha8Rng);

/// A robot becomes available or not.
const fn available(availability: Availability) -> Deed {
    Deed::Event(Event::AvailabilityChanged(availability))
}

/// How long leaders try, in milliseconds.
pub(super) const PATIENCE_MS: u32 = 40_000;

/// The references of two crossings, by their corners.
pub(super) const CROSSINGS: [protocol::Place; 2] = [protocol::Place(7), protocol::Place(8)];

/// Draws that all robots of a run have in common.
struct CommonDraw {
    settings: Settings,
    /// Whether each robot has timers of its own.
    is_unequal: bool,
    /// At how many corners people cross.
    corners: usize,
    /// How probable it is that a robot knows the reference of its crossing.
    knows_place: f64,
    /// Whether some people are slow.
    has_slow_people: bool,
    time_scale: f64,
}

impl Draws {
    pub(super) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// A run of 2 to `robots` robots.
    pub(super) fn swarm(mut self, seed: u64, robots: usize, faults: Option<&Faults>) -> Swarm {
        let is_secured = self.0.random_bool(0.03);
        // Signatures cost the time of many runs without them.
        let most = if is_secured { robots.min(4) } else { robots };
        let robots = self.0.random_range(2..=most.max(2));
        let is_long = !is_secured && self.0.random_bool(0.02);
        let seconds = if is_long { 60..=240 } else { 8..=60 };
        let heals_us = self.0.random_range(seconds) * SECOND_US;
        let common = self.common();
        let members: Vec<_> = (0..robots)
            .map(|place| self.robot(place, robots, &common))
            .collect();
        let mut script = self.script(&members, heals_us);
        let mut ways = match faults {
            Some(faults) => vec![faults.clone(); robots * robots],
            None => self.ways(robots),
        };
        let mut cuts = self.partitions(robots, heals_us);
        if robots >= 4 && self.0.random_bool(0.25) {
            cuts.push(self.two_teams(&members, heals_us, &mut script));
        }
        for cut in cuts {
            for (from, to) in (0..robots).flat_map(|from| (0..robots).map(move |to| (from, to))) {
                if (cut.0 >> from & 1) != (cut.0 >> to & 1) {
                    ways[from * robots + to].outages.push(cut.1);
                }
            }
        }
        script.sort_by_key(|happening| happening.at_us);
        let delay_max_us = u64::from(common.settings.delay_max.0) * 1_000;
        let late_max_us = if self.0.random_bool(0.1) {
            self.0.random_range(delay_max_us..=20 * delay_max_us)
        } else {
            // A millisecond is lost to clocks that are read to the millisecond.
            self.0.random_range(0..=delay_max_us.saturating_sub(2_000))
        };
        let mut swarm = Swarm {
            seed,
            robots: members,
            ways,
            script,
            heals_us,
            late_max_us,
            strikes: self.perhaps(0.8),
            replays: self.replays(heals_us),
            is_secured,
            sensing: None,
            demand: None,
            insider: None,
            waits_at: None,
        };
        swarm.waits_at = swarm.waits_at();
        swarm
    }

    fn common(&mut self) -> CommonDraw {
        let corners = if self.0.random_bool(0.3) { 2 } else { 1 };
        let shares = [0.0, 0.5, 1.0];
        CommonDraw {
            settings: self.settings(),
            is_unequal: self.0.random_bool(0.25),
            corners,
            knows_place: *shares.choose(&mut self.0).expect("there are three"),
            has_slow_people: self.0.random_bool(0.3),
            time_scale: self.0.random_range(3.0..30.0),
        }
    }

    /// Packets of earlier in the run that somebody sends once more.
    fn replays(&mut self, heals_us: u64) -> Vec<Replay> {
        let replays = self.0.random_range(1..=6) * usize::from(self.0.random_bool(0.25));
        let replay = |_| Replay {
            at_us: self.time(heals_us),
            begins: self.0.random_range(0.0..1.0),
            packets: self.0.random_range(1..=60),
            every_us: self.0.random_range(0..=100_000),
        };
        (0..replays).map(replay).collect()
    }

    /// Two groups that do not hear each other from the beginning on; somebody is noticed in each of them.
    fn two_teams(
        &mut self,
        robots: &[RobotDraw],
        heals_us: u64,
        script: &mut Vec<Happening>,
    ) -> (u64, Outage) {
        let until_us = self.0.random_range(3 * SECOND_US..30 * SECOND_US);
        let until_us = until_us.min(heals_us);
        let odd = (0..robots.len()).filter(|place| place % 2 == 1);
        let group = odd.map(|place| 1 << place).sum();
        for place in 0..2 {
            let at_us = SECOND_US / 2 + self.time(SECOND_US);
            let deed = Deed::Detect;
            script.push(Happening { at_us, place, deed });
        }
        let outage = Outage {
            from_ms: 0,
            until_ms: until_us / 1_000,
        };
        (group, outage)
    }

    /// Timers of a robot's own, within the inequalities. They may fit those of the others or not.
    fn own_timers(&mut self, common: &Settings) -> Settings {
        let t_safety = self.0.random_range(800..=4_000);
        let ram_period = self.0.random_range(50..=(t_safety / 10).min(200));
        // The drift and `delay_max` take away less than 5 % and 60 ms.
        let lease_max = t_safety * 95 / 100 - 60;
        let t_offer = self.0.random_range(1_000..=3_000);
        let mut millis = |from, to| Millis(self.0.random_range(from..=to));
        Settings {
            ram_period: Millis(ram_period),
            t_safety: Millis(t_safety),
            t_lease: millis(6 * ram_period, lease_max),
            t_leave: millis(1_000, 5_000),
            t_offer: Millis(t_offer),
            t_help: millis(t_offer.max(4_000), 10_000),
            t_select: millis(100, 500),
            t_ack: millis(250, 800),
            t_farewell: millis(600, 1_500),
            ..common.clone()
        }
    }
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

    /// Timers, the same for all robots unless each has its own.
    fn settings(&mut self) -> Settings {
        let [in_use, short] = Swarm::timers();
        let mut settings = if self.0.random_bool(0.3) {
            short
        } else {
            in_use
        };
        settings.t_exec[usize::from(TaskType::INITIAL_POS.value())].0 = 20_000;
        settings.n_ack = self.0.random_range(1..=4);
        if self.0.random_bool(0.5) {
            settings.t_cross = Millis(self.0.random_range(5_000..=30_000));
        }
        settings
    }

    /// One robot; its counters may be close to wrapping round.
    fn robot(&mut self, place: usize, robots: usize, common: &CommonDraw) -> RobotDraw {
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
            ..if common.is_unequal {
                self.own_timers(&common.settings)
            } else {
                common.settings.clone()
            }
        };
        let corner = place % common.corners;
        let drift_ppm = i64::from(settings.drift_ppm);
        let station = StationId(u32::try_from(place).unwrap_or(0) + 1);
        RobotDraw {
            name: format!("R{station}"),
            station,
            boot: self.0.random_range(1..60_000),
            plan: self.plan(robots, corner, common),
            config: Config::new(settings).expect("drawn within the inequalities"),
            corner,
            build: if self.0.random() {
                Build::Humanoid
            } else {
                Build::Quadruped
            },
            place: self.place(),
            time_scale: common.time_scale,
            drift_ppm: self.0.random_range(-drift_ppm..=drift_ppm),
        }
    }

    fn place(&mut self) -> Place {
        let mut metres = || self.0.random_range(-10.0..10.0);
        Place::new(metres(), metres())
    }

    fn plan(&mut self, robots: usize, corner: usize, common: &CommonDraw) -> Plan {
        let mut site = Site::default();
        if self.0.random_bool(common.knows_place) {
            site.crossing = CROSSINGS[corner];
        }
        // People take no longer than `t_cross`, on any clock.
        let t_cross_s = f64::from(common.settings.t_cross.0) / 1_000.0;
        let slowest_s = 0.95 * t_cross_s * common.time_scale;
        let crossing_s = if common.has_slow_people {
            self.0.random_range(6.0..slowest_s)
        } else {
            6.0
        };
        // People are escorted in the last stage, in which the corridor is open.
        let before = [TaskType::INITIAL_POS, TaskType::BLOCK];
        let last = [TaskType::INITIAL_POS, TaskType::BLOCK, TaskType::MOVE];
        let mut stages = Vec::new();
        for left in (0..self.0.random_range(1..=4)).rev() {
            let tasks: &[TaskType] = if left == 0 { &last } else { &before };
            let task = *tasks.choose(&mut self.0).expect("there are tasks");
            stages.push(Stage::everybody(Leg::new(task, self.place())));
        }
        // A robot that escorts for the second time has to come back first.
        if let [stage] = &stages[..]
            && stage
                .parts
                .iter()
                .any(|(_, leg)| leg.task == TaskType::MOVE)
        {
            let back = Stage::everybody(Leg::new(TaskType::INITIAL_POS, self.place()));
            stages.insert(0, back);
        }
        let most = (robots - 1).min(crossguard_protocol::MAX_FOLLOWERS);
        let urgencies = [Urgency::Low, Urgency::Medium, Urgency::High];
        Plan {
            followers: u8::try_from(self.0.random_range(1..=most)).unwrap_or(1),
            urgency: *urgencies.choose(&mut self.0).expect("there are urgencies"),
            stages,
            crossing_s,
            patience_s: f64::from(PATIENCE_MS) / 1_000.0,
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
        for _ in 0..self.0.random_range(1..=4) * u32::from(self.0.random_bool(0.35)) {
            // Too short for anything to run out, or long enough for everything.
            let longest_ms = *[300, 3_000, 9_000]
                .choose(&mut self.0)
                .expect("there are three");
            let (at, ms) = (self.time(heals_us), self.0.random_range(50..longest_ms));
            let left_ms = u32::try_from((heals_us - at) / 1_000).unwrap_or(u32::MAX);
            add(at, any(self), Deed::Hang(ms.min(left_ms)));
        }
        let mischief = self.0.random_range(0..=12) * u32::from(self.0.random_bool(0.6));
        for _ in 0..mischief {
            let deed = self.mischief(robots);
            add(self.time(heals_us), any(self), deed);
        }
        for place in 0..robots.len() {
            // All that was broken is repaired in the end.
            add(heals_us, place, available(Availability::Available));
        }
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
            1 => Deed::Event(Event::LeaveRequested),
            2 => {
                let reason = *reasons.choose(&mut self.0).expect("there are reasons");
                available(Availability::Unavailable(reason))
            }
            3 => available(Availability::Available),
            4 => Deed::Event(Event::OpenCorridor),
            5 => Deed::Event(Event::CloseCorridor),
            6 => {
                let to = robots.choose(&mut self.0).expect("there are robots");
                let tasks = [TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK];
                let task = *tasks.choose(&mut self.0).expect("there are tasks");
                let follower = to.station;
                Deed::Event(Event::CommandManeuver { follower, task })
            }
            7 => Deed::Event(Event::TaskCompleted),
            _ => Deed::ChangeIdentity,
        }
    }
}
