//! Settings of a crossing machine: the assumptions about its sensors, its rules, its ground and its plan.

use crossguard_protocol::{Config, HelpRequest, Millis, Place, TaskSet, Urgency};

use crate::ground::{Ground, Point};
use crate::input::RoadUser;
use crate::plan::Plan;

/// The assumption about sensors (`sees`), and which frames count.
///
/// A person on a covered part of the carriageway is in at least one of any `miss_max` consecutive frames that
/// cover it, within `error_cm`, and nobody walks faster than `speed_max_cmps`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Sensors {
    /// In so many consecutive frames somebody who is there may be missed, less one; 5 by default. The road is clear
    /// after more than so many empty frames.
    pub miss_max: u8,
    /// Largest error of a place, in centimetres, unless a sighting says more; 20 by default.
    pub error_cm: u16,
    /// Largest speed of people, in cm/s; 400 by default.
    pub speed_max_cmps: u16,
    /// Largest age of a frame, counted from when it was measured; 500 ms by default.
    pub age_max: Millis,
    /// Longest time from one frame of a source to its next; 500 ms by default. A longer one starts the count anew.
    pub gap_max: Millis,
    /// For how long a person on the road counts as wanting the corridor after they were seen there last; 1 s by
    /// default.
    pub linger: Millis,
    /// For how long a report by another station keeps the road from being clear; 2 s by default: a CPM has everything once a second
    /// (TS 103 324), and one may be lost.
    pub heard: Millis,
}

impl Default for Sensors {
    fn default() -> Self {
        Self {
            miss_max: 5,
            error_cm: 20,
            speed_max_cmps: 400,
            age_max: Millis(500),
            gap_max: Millis(500),
            linger: Millis(1_000),
            heard: Millis(2_000),
        }
    }
}

/// When somebody waits to cross, and sets out: see [`tracks`](crate::tracks).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct WaitingRules {
    /// For how long somebody has to stand or to come to the road; 1 s by default.
    pub dwell: Millis,
    /// Largest speed of a person who stands, in cm/s; 50 by default.
    pub speed_max_cmps: u16,
    /// A person who heads for the road counts from so long before it; 3 s by default. 0: only standing people wait.
    pub approach: Millis,
    /// The zone is deserted after so long in which nobody waited or was on the road; 3 s by default.
    pub clear: Millis,
    /// Smallest confidence of a person who waits, in percent; 50 by default. Half of it is enough for a person who
    /// waits already.
    pub confidence_min: u8,
    /// For how long after go has ended somebody who saw it steps on the road (assumption `steps_off`); 2 s by default, a
    /// second to react and a metre to the kerb. The road is clear by frames that are taken later.
    pub step_off: Millis,
}

impl Default for WaitingRules {
    fn default() -> Self {
        Self {
            dwell: Millis(1_000),
            speed_max_cmps: 50,
            approach: Millis(3_000),
            clear: Millis(3_000),
            confidence_min: 50,
            step_off: Millis(2_000),
        }
    }
}

/// When it is safe to let somebody cross in front of vehicles: see [`traffic`](crate::traffic).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct TrafficRules {
    /// Time of reaction of a driver; 2 s by default.
    pub reaction: Millis,
    /// Comfortable deceleration, in cm/s²; 300 by default.
    pub deceleration_cmps2: u16,
    /// A slower vehicle stands, in cm/s; 50 by default.
    pub standing_cmps: u16,
    /// How far from the middle of the crossing the line of a vehicle may pass it, in centimetres, besides half of
    /// the crossing; 1,000 by default.
    pub aside_cm: u16,
    /// How long a vehicle may be, in centimetres; 1,200 by default, a bus (Directive 96/53/EC: 12 m for rigid vehicles).
    pub length_cm: u16,
    /// For how long a vehicle counts after it was heard last, and its word that it will stop; 5 s by default.
    pub keep: Millis,
    /// Vehicles that tell where they are and would be at the crossing within this time are asked to stop, and go does not begin
    /// before they have said that they will; zero by default: none is asked.
    pub asks: Millis,
}

impl Default for TrafficRules {
    fn default() -> Self {
        Self {
            reaction: Millis(2_000),
            deceleration_cmps2: 300,
            standing_cmps: 50,
            aside_cm: 1_000,
            length_cm: 1_200,
            keep: Millis(5_000),
            asks: Millis::ZERO,
        }
    }
}

impl TrafficRules {
    /// The rules for an attentive driver who brakes hard: half of the time, twice the deceleration.
    pub(crate) const fn urgent(self) -> Self {
        Self {
            reaction: Millis(self.reaction.0 / 2),
            deceleration_cmps2: self.deceleration_cmps2.saturating_mul(2),
            ..self
        }
    }
}

/// When a robot is where it should be: see [`position`](crate::position).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct PositionRules {
    /// How far a body may be from its place, error of its position included, in centimetres; 200 by default, less
    /// than the width of a lane.
    pub tolerance_cm: u16,
    /// For how long a position counts, from when it was measured; 1 s by default.
    pub lease: Millis,
    /// How far an escort may be ahead of its person, in centimetres; 200 by default.
    pub ahead_cm: u16,
}

impl Default for PositionRules {
    fn default() -> Self {
        Self {
            tolerance_cm: 200,
            lease: Millis(1_000),
            ahead_cm: 200,
        }
    }
}

/// Settings of a crossing machine.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Setup {
    /// Whether the robot has sensors of its own for people: while they do not cover the carriageway, it lets nobody cross; true by
    /// default. Of a robot that says it has none, no sensor is missed that dies.
    pub watches: bool,
    /// Whether it calls for help when somebody waits, or somebody else tells of them.
    pub calls: bool,
    /// The assumptions about its sensors.
    pub sensors: Sensors,
    /// When somebody waits.
    pub waiting: WaitingRules,
    /// When it is safe in front of vehicles.
    pub traffic: TrafficRules,
    /// When a robot is in position.
    pub position: PositionRules,
    /// Where people wait and cross.
    pub ground: Ground,
    /// Where the body waits when it has no part in a session, off the carriageway. Without it, it stays where it is.
    pub home: Option<Point>,
    /// Its request when somebody waits; the urgency is that of the people.
    pub request: HelpRequest,
    /// Its acts as a leader; without a plan, the application commands them.
    pub plan: Option<Plan>,
    /// The maneuvers under which people cross, as in the protocol's settings.
    pub guarding: TaskSet,
    /// The maneuvers that guard from a place.
    pub holding: TaskSet,
    /// The protocol's `t_safety`: no sign that counts on this robot shows go for longer.
    pub t_safety: Millis,
}

impl Default for Setup {
    /// No ground, no plan, and the protocol's default settings.
    fn default() -> Self {
        Self {
            watches: true,
            calls: false,
            sensors: Sensors::default(),
            waiting: WaitingRules::default(),
            traffic: TrafficRules::default(),
            position: PositionRules::default(),
            ground: Ground::default(),
            home: None,
            request: HelpRequest {
                urgency: Urgency::Medium,
                followers: 1,
                tasks: TaskSet::EMPTY,
                place: Place::UNKNOWN,
            },
            plan: None,
            guarding: TaskSet::EMPTY,
            holding: TaskSet::EMPTY,
            t_safety: Millis::ZERO,
        }
        .with(&Config::default())
    }
}

impl Setup {
    /// How fast a slow walker is, in cm/s: crossings are designed so for elderly people and small children, for others by 120 cm/s.
    pub const SLOW_CMPS: u16 = 90;

    /// The same, beside a protocol with these settings.
    #[must_use]
    pub fn with(mut self, config: &Config) -> Self {
        self.learn(config);
        self
    }

    /// The protocol beside it has these settings.
    pub fn learn(&mut self, config: &Config) {
        let settings = config.settings();
        self.guarding = settings.guarding;
        self.holding = settings.holding;
        self.t_safety = settings.t_safety;
    }

    /// Whether a road user who is at most `error_cm` from a place may be a person on the road. Cyclists and motorcyclists who ride or
    /// wait beside the crossing are traffic: guards that waited for them would wait for each other.
    pub(crate) fn is_person_on_road(&self, what: RoadUser, at: Point, error_cm: u32) -> bool {
        let is_here = match what {
            RoadUser::Vehicle => false,
            RoadUser::Bicyclist | RoadUser::Motorcyclist => self.is_at_crossing(at, error_cm),
            _ => true,
        };
        is_here && self.ground.may_be_road(at, error_cm)
    }

    /// Whether somebody who is at most `error_cm` from a place may be on the crossing, or as near to it as an escort waits for its person.
    pub(crate) fn is_at_crossing(&self, at: Point, error_cm: u32) -> bool {
        let limit = error_cm.saturating_add(self.position.ahead_cm.into());
        let crossing = self.ground.crossing;
        crossing.is_none_or(|crossing| crossing.distance_cm(at) <= limit)
    }

    /// How long a slow walker needs from one kerb to the other.
    #[must_use]
    pub fn slow_walk(&self) -> Millis {
        self.walk(Self::SLOW_CMPS)
    }

    /// How long a person needs from one kerb to the other who walks: faster than people who stand, and no faster than slow walkers.
    pub(crate) fn crossing_time(&self) -> Millis {
        self.walk(self.waiting.speed_max_cmps.min(Self::SLOW_CMPS))
    }

    /// How long a person needs from one kerb to the other at this speed.
    fn walk(&self, speed_cmps: u16) -> Millis {
        let width_cm = self.ground.road.map_or(0, |road| road.width_cm());
        let time = u64::from(width_cm) * 1_000 / u64::from(speed_cmps.max(1));
        Millis(u32::try_from(time).unwrap_or(u32::MAX))
    }

    /// The maneuvers that guard people on their way: escorts.
    #[must_use]
    pub const fn escorts(&self) -> TaskSet {
        self.guarding.without(self.holding)
    }
}
