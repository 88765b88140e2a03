//! The settings of the robots, and their places.

use crossguard_crossing::{
    Coverage, Ground, Leg, Plan, Point, Pose, PositionRules, Sensors, Setup, Shape, Stage,
    WaitingRules, Way, Who,
};
use crossguard_protocol::{Config, HelpRequest, Millis, Settings, StationId, TaskSet, TaskType};

use super::street::{Guard, LATE_TIME, TICK};
use super::{GUARDS_MAX, MISS_MAX, Street, Watch};

pub(super) const LEADING: StationId = StationId(1);

/// The stations of followers, and the places from which they guard.
pub(super) const FOLLOWING: [StationId; GUARDS_MAX] = [StationId(2), StationId(3)];
pub(super) const POSTS: [Point; GUARDS_MAX] = [Point::new(-200, 200), Point::new(-200, 500)];

/// Where guards wait without a session, at the kerbs.
pub(super) const HOMES: [Point; GUARDS_MAX] = [Point::new(-200, -100), Point::new(-200, 800)];

/// Where a guard is that has drifted: 4 m off its place.
const DRIFT: Way = Way {
    east_cm: -400,
    north_cm: 0,
};

/// How long before it would be at the crossing a vehicle is asked: whenever it is heard.
const ASKS: Millis = Millis(10_000);

/// A machine. It has room for more tracks than there are people: those whose ids change have two.
pub(super) type Machine = crossguard_crossing::Crossing<4>;

/// Where the body of a guard says that it is, if it is there but for what went wrong.
pub(super) fn pose(guard: Guard, follower: usize, at: Point) -> Option<Pose> {
    let at = if guard.is_drifted {
        POSTS[follower].plus(DRIFT)
    } else {
        at
    };
    (!guard.is_lost).then_some(Pose { at, error_cm: 10 })
}

#[derive(Clone, Debug)]
pub(super) struct Rules {
    pub(super) watch: Watch,
    /// Of the leader, and then of its followers.
    pub(super) setups: Vec<Setup>,
    pub(super) config: Config,
}

impl Rules {
    pub(super) fn new(street: Street, change: fn(&mut Setup)) -> Self {
        let config = config();
        let mut setups = setups(street, &config);
        setups.iter_mut().for_each(change);
        Self {
            watch: street.watch,
            setups,
            config,
        }
    }
}

/// The timers are as in use, or shorter where that makes fewer states, and multiples of a tick but for leases.
fn config() -> Config {
    let settings = Settings {
        ram_period: TICK,
        t_select: TICK,
        t_offer: Millis(2_000),
        t_help: Millis(3_000),
        t_safety: Millis(2_000),
        t_lease: Millis(1_800),
        t_farewell: Millis(1_500),
        drift_ppm: 0,
        delay_max: Millis::ZERO,
        ..Settings::default()
    };
    Config::new(settings).unwrap_or_default()
}

fn rectangle(west: i32, south: i32, east: i32, north: i32) -> Option<Shape> {
    let corners = [(west, south), (east, south), (east, north), (west, north)];
    Shape::new(&corners.map(|(east, north)| Point::new(east, north)))
}

fn setups(street: Street, config: &Config) -> Vec<Setup> {
    let ground = Ground {
        road: rectangle(-3_000, 0, 3_000, 700),
        crossing: rectangle(-300, 0, 300, 700),
        waiting: rectangle(-300, -250, 300, 950),
        parts: Coverage(1),
    };
    let task = TaskType::BLOCK;
    let legs = POSTS.map(|to| Leg {
        task,
        to,
        speed_mmps: 1_000,
        heading_ddeg: None,
    });
    let parts = (0..street.guards).map(Who::Role).zip(legs);
    let stage = Stage {
        parts: parts.collect(),
    };
    let followers = usize::from(street.guards);
    let mut leader = Setup {
        watches: true,
        calls: true,
        sensors: Sensors {
            miss_max: MISS_MAX,
            // People go from cell to cell within a tick.
            speed_max_cmps: 900,
            age_max: Millis(250),
            gap_max: TICK,
            ..Sensors::default()
        },
        waiting: WaitingRules {
            dwell: TICK,
            step_off: if street.late { LATE_TIME } else { Millis::ZERO },
            ..WaitingRules::default()
        },
        position: PositionRules {
            lease: Millis(750),
            ..PositionRules::default()
        },
        ground,
        plan: Some(Plan {
            followers: street.guards,
            stages: core::iter::once(stage).collect(),
            roles: FOLLOWING.into_iter().take(followers).map(Some).collect(),
            own_place: None,
            patience: Millis(10_000),
            kerbs: None,
        }),
        ..Setup::default()
    }
    .with(config);
    leader.traffic.asks = if street.asks { ASKS } else { Millis::ZERO };
    leader.request = HelpRequest {
        tasks: TaskSet::of(&[task]),
        followers: street.guards,
        ..leader.request
    };
    let follower = |home| Setup {
        watches: street.watch != Watch::Leader,
        calls: false,
        plan: None,
        home: Some(home),
        ..leader.clone()
    };
    let followers: Vec<_> = HOMES.into_iter().take(followers).map(follower).collect();
    core::iter::once(leader).chain(followers).collect()
}
