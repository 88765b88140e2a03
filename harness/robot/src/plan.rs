//! Plan of a leader for its followers: stage by stage, each follower its part.

use crossguard_codec::PublicSignal;
use crossguard_crossing as crossing;
pub use crossguard_crossing::Who;
use crossguard_protocol::{HelpRequest, Millis, Settings, StationId, TaskSet, TaskType, Urgency};

use crate::site::{Place, Site};
use crate::zone::point;

/// One follower's part of a stage.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Leg {
    /// The maneuver.
    pub task: TaskType,
    /// Where it leads.
    pub to: Place,
    /// How fast, in m/s.
    pub speed_mps: f64,
    /// Which way to face there, in degrees clockwise from north, if that matters.
    pub heading_deg: Option<f64>,
}

/// Parts that happen at a time. A stage is over when every part is done; a `block` is when it has begun,
/// and goes on through the stages that have nothing else for its follower.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Stage {
    /// Parts, with the robots that do them.
    pub parts: Vec<(Who, Leg)>,
}

/// What a leader has its followers do.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// Where it happens.
    pub site: Site,
    /// How many followers it takes.
    pub followers: u8,
    /// How urgent it is.
    pub urgency: Urgency,
    /// The stages.
    pub stages: Vec<Stage>,
    /// The roles of followers, each with the station that it is for, or for any. Without roles, everybody does the same.
    pub roles: Vec<Option<StationId>>,
    /// Where the leader itself stands while it leads, if it is to go there.
    pub own_place: Option<Place>,
    /// Which way it faces there, in degrees clockwise from north, if that matters.
    pub own_heading_deg: Option<f64>,
    /// The leader's signal to vehicles while it leads, if the plan has one.
    pub shows: Option<PublicSignal>,
    /// How long a simulated pedestrian takes to cross, in seconds of the robots' own time.
    pub crossing_s: f64,
    /// After which time the leader gives up, in seconds.
    pub patience_s: f64,
    /// The kerbs between which a person is escorted, where that can be done in either direction.
    pub kerbs: Option<[Place; 2]>,
    /// Vehicles that would be at the crossing within this time are asked to stop before go begins, in seconds; 0: none.
    pub asks_vehicles_s: f64,
}

impl Leg {
    /// A leg at the pace of a robot that is in no hurry.
    #[must_use]
    pub const fn new(task: TaskType, to: Place) -> Self {
        Self {
            task,
            to,
            speed_mps: 1.4,
            heading_deg: None,
        }
    }

    /// The time that a way of this length takes, in seconds, and the setting that gives it less: its name, and how much that is.
    pub(crate) fn too_long(
        &self,
        way_m: f64,
        settings: &Settings,
    ) -> Option<(f64, &'static str, f64)> {
        let way_s = way_m / self.speed_mps;
        let of_task = settings.t_exec[usize::from(self.task.value())];
        let escorts = settings.guarding.without(settings.holding);
        let of_crossing = escorts.contains(self.task).then_some(settings.t_cross);
        let limits = [("t_exec", Some(of_task)), ("t_cross", of_crossing)];
        limits.into_iter().find_map(|(limit, time)| {
            let most_s = f64::from(time?.0) / 1e3;
            (way_s > most_s).then_some((way_s, limit, most_s))
        })
    }

    /// The leg as the crossing machine has it.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "casts of numbers saturate"
    )]
    fn lead(&self) -> crossing::Leg {
        crossing::Leg {
            task: self.task,
            to: point(self.to),
            speed_mmps: (self.speed_mps * 1e3).round() as u16,
            heading_ddeg: self
                .heading_deg
                .map(|degrees| (degrees * 10.0).round() as u16),
        }
    }
}

/// Milliseconds, saturating.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "casts of numbers saturate"
)]
pub(crate) fn millis(seconds: f64) -> Millis {
    Millis((seconds * 1e3).round() as u32)
}

impl Stage {
    /// A stage in which everybody does the same.
    #[must_use]
    pub fn everybody(leg: Leg) -> Self {
        Self {
            parts: vec![(Who::Everybody, leg)],
        }
    }
}

// Places on a street of two lanes that runs from west to east; the kerb is at 0, the other side at 8 m north
// of it.
const KERB: Place = Place::new(1.0, -1.0);
const OTHER_SIDE: Place = Place::new(1.0, 8.0);
/// How fast a robot walks beside a pedestrian, in m/s.
const ESCORT_MPS: f64 = 0.424;

/// For how long a pedestrian at its side is on the carriageway, in seconds of the robots' own time: the
/// escort begins and ends on the pavement.
const ESCORTED_S: f64 = 19.0;

impl Plan {
    fn with(site: Site, followers: u8, stages: Vec<Stage>) -> Self {
        Self {
            site,
            followers,
            urgency: Urgency::Medium,
            stages,
            roles: Vec::new(),
            own_place: None,
            own_heading_deg: None,
            shows: None,
            crossing_s: 8.0,
            patience_s: 200.0,
            kerbs: None,
            asks_vehicles_s: 0.0,
        }
    }

    /// The pedestrian walks at the side of an escort.
    fn at_escorts_pace(self) -> Self {
        Self {
            crossing_s: ESCORTED_S,
            ..self
        }
    }

    /// The paper's crossing: the dog takes its place at the kerb, then escorts the pedestrian over
    /// the road. The escort is as long as the paper's, 21.6 s.
    #[must_use]
    pub fn crossing(site: Site) -> Self {
        Self::escort(site, KERB, OTHER_SIDE)
    }

    /// The paper's crossing from one kerb to another.
    #[must_use]
    pub fn escort(site: Site, from: Place, to: Place) -> Self {
        let escort = Leg {
            speed_mps: ESCORT_MPS,
            ..Leg::new(TaskType::MOVE, to)
        };
        let stages = vec![
            Stage::everybody(Leg::new(TaskType::INITIAL_POS, from)),
            Stage::everybody(escort),
        ];
        Self {
            kerbs: Some([from, to]),
            ..Self::with(site, 1, stages).at_escorts_pace()
        }
    }

    /// The plan as the crossing machine has it.
    #[must_use]
    pub fn lead(&self) -> crossing::Plan {
        let stages = self.stages.iter().map(|stage| crossing::Stage {
            parts: stage
                .parts
                .iter()
                .map(|(who, leg)| (*who, leg.lead()))
                .collect(),
        });
        crossing::Plan {
            followers: self.followers,
            stages: stages.collect(),
            roles: self.roles.iter().copied().collect(),
            own_place: self.own_place.map(point),
            patience: millis(self.patience_s),
            kerbs: self.kerbs.map(|kerbs| kerbs.map(point)),
        }
    }

    /// The tasks that every follower is to do: all of them, where no role is told from another.
    #[must_use]
    pub fn needs(&self) -> TaskSet {
        if self.roles.is_empty() {
            self.request().tasks
        } else {
            TaskSet::EMPTY
        }
    }

    /// Request of a leader with this plan.
    #[must_use]
    pub fn request(&self) -> HelpRequest {
        let legs = self.stages.iter().flat_map(|stage| &stage.parts);
        let tasks: Vec<_> = legs.map(|(_, leg)| leg.task).collect();
        HelpRequest {
            urgency: self.urgency,
            followers: self.followers,
            tasks: TaskSet::of(&tasks),
            place: self.site.crossing,
        }
    }

    /// From how many sides simulated people come: from both where nobody is escorted, since the corridor is open for
    /// both (the paper, section III-A, bilateral traffic).
    #[must_use]
    pub fn sides(&self) -> usize {
        let mut legs = self.stages.iter().flat_map(|stage| &stage.parts);
        if legs.any(|(_, leg)| leg.task == TaskType::MOVE) {
            1
        } else {
            2
        }
    }

    /// How long the pedestrian is on the road, in microseconds, where robots move this many times as fast as real.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a crossing takes seconds"
    )]
    pub fn crossing_us(&self, time_scale: f64) -> u64 {
        (self.crossing_s / time_scale * 1e6) as u64
    }
}
