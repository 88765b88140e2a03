//! Draws for each seed.
//!
//! Every seed has some of the faults and not others, each in a strength of its own: a run with few
//! faults goes far into a session, one with many goes astray in every way. A run that has a little of
//! everything would do neither.

mod demand;
mod draws;
mod hazards;
mod sensing;

use crossguard_model_check::timed::longest;
use crossguard_protocol::{Config, Event, Millis, Settings, StationId};
use crossguard_robot::body::Build;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::Place;
use crossguard_robot::transport::Faults;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

pub use self::demand::{Arrival, Demand, Habits};
pub(super) use self::demand::{DriverDraw, PersonDraw};
use self::draws::Draws;
pub use self::hazards::Hazard;
pub(super) use self::sensing::longest_us;
pub use self::sensing::{CarDraw, Ids, Sensing, SourceDraw};
use super::insider::InsiderDraw;

/// By how much a station id grows when the robot changes its pseudonym.
pub(super) const PSEUDONYM_STEP: u32 = 100;

pub(super) const SECOND_US: u64 = 1_000_000;

/// How long a message takes at most once the network is healed, in milliseconds.
pub(super) const HEALED_DELAY_MS: u32 = 50;

/// All that a run is made of.
#[derive(Clone, Debug, Default)]
pub struct Swarm {
    /// The seed that it was drawn from.
    pub seed: u64,
    /// The robots, by place.
    pub robots: Vec<RobotDraw>,
    /// The faults of each way, `from * robots + to`.
    pub ways: Vec<Faults>,
    /// Events, in order of time.
    pub script: Vec<Happening>,
    /// When the network is healed, in microseconds.
    pub heals_us: u64,
    /// By how much endpoints are late to be told of time at most, in microseconds, until the network is healed.
    pub late_max_us: u64,
    /// How probable it is that something happens to the team of a sign that begins to show *go*.
    pub strikes: f64,
    /// Which packets are sent once more, by somebody who has recorded them.
    pub replays: Vec<Replay>,
    /// Whether robots sign what they send, and take in nothing without a signature.
    pub is_secured: bool,
    /// Sensing by the robots themselves; without it, they know everybody on the road.
    pub sensing: Option<Sensing>,
    /// The streams of people and vehicles, if there are any.
    pub demand: Option<Demand>,
    /// The insider that lies, if there is one.
    pub insider: Option<InsiderDraw>,
    /// The corner at which somebody waits once the network is healed, where a team can exist.
    pub waits_at: Option<usize>,
}

/// Draw for one robot.
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
    /// Its plan for leading.
    pub plan: Plan,
    /// The corner at which it notices people, by number. The same crossing has the same number, whatever its
    /// reference says.
    pub corner: usize,
    /// Its body.
    pub build: Build,
    /// Where it begins.
    pub place: Place,
    /// How many times as fast as real it moves.
    pub time_scale: f64,
    /// By how much its clock is off, in parts per million.
    pub drift_ppm: i64,
}

/// Packets that are sent once more, to everybody.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Replay {
    /// When, in microseconds since the run began.
    pub at_us: u64,
    /// Where it begins among the packets so far: 0 is the oldest, 1 the newest.
    pub begins: f64,
    /// How many packets.
    pub packets: usize,
    /// The time from one to the next, in microseconds.
    pub every_us: u64,
}

/// Something that happens to one robot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Happening {
    /// When, in microseconds since the run began.
    pub at_us: u64,
    /// To which robot, by its place.
    pub place: usize,
    /// What.
    pub deed: Deed,
}

/// What can happen to a robot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Deed {
    /// It detects a pedestrian.
    Detect,
    /// It loses its volatile state.
    Crash,
    /// It boots with the next boot counter, if it is down.
    Boot,
    /// Its body cannot finish what it does.
    Fail,
    /// Its application says this, whatever the plan says.
    Event(Event),
    /// It changes its pseudonym, if it may.
    ChangeIdentity,
    /// Its process hangs for this many milliseconds. What arrives waits for it.
    Hang(u32),
    /// Its body is pushed so far to the east and to the north, in metres.
    Push([f64; 2]),
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
        Draws::new(seed).swarm(seed, robots, faults)
    }

    /// This many robots with the default settings on an undisturbed network, the first of which detects a pedestrian
    /// after a second.
    #[must_use]
    pub fn quiet(robots: usize) -> Self {
        let mut swarm = Self::draw(3, robots, Some(&Faults::default()));
        swarm.robots.iter_mut().for_each(|robot| {
            robot.config = Config::default();
            robot.plan = Plan::crossing(robot.plan.site);
            (robot.time_scale, robot.drift_ppm) = (1.0, 0);
        });
        swarm.script.retain(|it| it.deed == Deed::Boot);
        swarm.script.push(Happening {
            at_us: SECOND_US,
            place: 0,
            deed: Deed::Detect,
        });
        Self {
            ways: vec![Faults::default(); swarm.ways.len()],
            late_max_us: 0,
            strikes: 0.0,
            replays: Vec::new(),
            is_secured: false,
            waits_at: None,
            ..swarm
        }
    }

    /// The same robots, each of which does what this plan says when it leads. Any robot takes any role. People take no
    /// longer across than `t_cross`, a leader is as patient as a drawn one, and whether it names its crossing stays as drawn.
    #[must_use]
    pub fn with_plan(mut self, plan: &Plan) -> Self {
        for robot in &mut self.robots {
            let drawn = &robot.plan;
            // As where a plan is drawn.
            let t_cross_s = f64::from(robot.config.settings().t_cross.0) / 1_000.0;
            let slowest_s = 0.95 * t_cross_s * robot.time_scale;
            let mut site = plan.site;
            site.crossing = drawn.site.crossing;
            robot.plan = Plan {
                site,
                roles: vec![None; plan.roles.len()],
                crossing_s: plan.crossing_s.min(slowest_s),
                patience_s: drawn.patience_s,
                ..plan.clone()
            };
        }
        self.waits_at = self.waits_at();
        self
    }

    /// The first corner at which a team can exist. Where robots see people by sensors, each of them calls, so it has to be able to
    /// lead.
    fn waits_at(&self) -> Option<usize> {
        let corners = self.robots.iter().map(|robot| robot.corner + 1).max();
        let enough = if self.sensing.is_some() {
            self.robots.len()
        } else {
            1
        };
        let mut corners = 0..corners.unwrap_or(0);
        corners.find(|corner| self.who_can_lead(*corner).len() >= enough)
    }

    /// Draws apart from all others, in this share of the seeds. Those of a seed are the same for every share.
    pub(super) fn draws_of(&self, salt: u64, share: f64) -> Option<ChaCha8Rng> {
        let mut draws = ChaCha8Rng::seed_from_u64(self.seed ^ salt);
        // `random_bool` draws nothing for a share of 1.
        let part: f64 = draws.random();
        (part < share).then_some(draws)
    }

    /// The longest time that a message is under way, in milliseconds.
    pub(super) fn delay_max(&self) -> Millis {
        let delays = self.ways.iter().map(Faults::delay_max_ms);
        Millis(delays.max().unwrap_or(0))
    }

    /// Whether endpoints are told of time within `delay_max`. A millisecond is lost to clocks that are read to
    /// the millisecond.
    pub(super) fn is_in_time(&self) -> bool {
        let in_time = |robot: &RobotDraw| {
            let delay_max = u64::from(robot.config.settings().delay_max.0);
            self.late_max_us <= (delay_max * 1_000).saturating_sub(1_000)
        };
        self.robots.iter().all(in_time)
    }

    /// The robots that may notice somebody at a corner and can have a team: helpers enough, each of
    /// which can do all that the plan asks for and has timers that fit.
    pub(super) fn who_can_lead(&self, corner: usize) -> Vec<usize> {
        let robots = self.robots.iter().enumerate();
        let can = robots.filter(|(place, robot)| robot.corner == corner && self.can_lead(*place));
        can.map(|(place, _)| place).collect()
    }

    fn can_lead(&self, place: usize) -> bool {
        let leader = &self.robots[place];
        let tasks = leader.plan.request().tasks;
        let helps = |(other, helper): &(usize, &RobotDraw)| {
            let settings = helper.config.settings();
            *other != place
                && settings.capabilities.intersection(tasks) == tasks
                && leader.config.lease_fits(settings.t_safety)
        };
        let helpers = self.robots.iter().enumerate().filter(helps).count();
        helpers >= usize::from(leader.plan.followers)
            && leader
                .plan
                .lead()
                .lets_cross(leader.config.settings().guarding)
    }

    /// How long after healing a crossing is completed (W7): what went on before has ended, with people on the
    /// road and duties of their guards, and so has one try that failed because of it.
    pub(super) fn crossing_bound(&self) -> Millis {
        let bound = |robot: &RobotDraw| {
            let settings = robot.config.settings();
            let parts = [
                settings.t_help,
                settings.t_cross,
                settings.t_safety,
                settings.t_leave,
                settings.t_farewell,
            ];
            let patience = Millis(draws::PATIENCE_MS);
            let one = parts.into_iter().fold(patience, Millis::saturating_add);
            longest(one.saturating_add(one), settings)
        };
        self.robots.iter().map(bound).max().unwrap_or(Millis::ZERO)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The line that runs a failed seed again has shares of 0 and 1.
    #[test]
    fn sensors_and_liars_of_a_seed_are_the_same_for_every_share() {
        let mut compared = 0;
        for seed in 0..100 {
            let draw = |share| {
                let swarm = Swarm::draw(seed, 6, None).with_sensors(share);
                swarm.with_insider(share)
            };
            let (some, all) = (draw(0.5), draw(1.0));
            if some.sensing.is_some() && some.insider.is_some() {
                assert_eq!(format!("{some:?}"), format!("{all:?}"), "seed {seed}");
                compared += 1;
            }
        }
        assert!(compared > 0);
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
