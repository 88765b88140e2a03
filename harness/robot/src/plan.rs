//! What a leader has its followers do: stage by stage, each follower its part.

use crossguard_protocol::{HelpRequest, StationId, TaskSet, TaskType, Urgency};

use crate::site::{Place, Site};

/// One follower's part of a stage.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Leg {
    /// The maneuver.
    pub task: TaskType,
    /// Where it leads.
    pub to: Place,
    /// How fast, in m/s.
    pub speed_mps: f64,
}

/// What happens at a time. A stage is over when every part is done; a `block` is when it has begun,
/// and goes on through the stages that have nothing else for its follower.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Stage {
    /// Who does what.
    pub parts: Vec<(Who, Leg)>,
}

/// Who does a part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Who {
    /// Every follower without a part of its own in the stage.
    Everybody,
    /// This robot.
    Station(StationId),
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
    /// Where the leader itself stands while it leads, if it is to go there.
    pub own_place: Option<Place>,
    /// How long a simulated pedestrian takes to cross, in seconds of the robots' own time.
    pub crossing_s: f64,
    /// After which time the leader gives up, in seconds.
    pub patience_s: f64,
    /// The kerbs between which a person is escorted, where that can be done in either direction.
    pub kerbs: Option<[Place; 2]>,
}

impl Leg {
    /// A leg at the pace of a robot that is in no hurry.
    #[must_use]
    pub const fn new(task: TaskType, to: Place) -> Self {
        Self {
            task,
            to,
            speed_mps: 1.4,
        }
    }
}

impl Stage {
    /// A stage in which everybody does the same.
    #[must_use]
    pub fn everybody(leg: Leg) -> Self {
        Self {
            parts: vec![(Who::Everybody, leg)],
        }
    }

    /// A stage with a part for each of these robots.
    #[must_use]
    pub fn of(parts: &[(StationId, Leg)]) -> Self {
        let parts = parts
            .iter()
            .map(|&(station, leg)| (Who::Station(station), leg));
        Self {
            parts: parts.collect(),
        }
    }

    /// Whether the pedestrian is escorted in it.
    #[must_use]
    pub fn is_escort(&self) -> bool {
        let mut parts = self.parts.iter();
        parts.any(|(_, leg)| leg.task == TaskType::MOVE)
    }

    /// The part of a follower; `None` when it has none.
    #[must_use]
    pub fn leg(&self, follower: StationId) -> Option<Leg> {
        let of = |who| self.parts.iter().find(|(part, _)| *part == who);
        let part = of(Who::Station(follower)).or_else(|| of(Who::Everybody));
        part.map(|(_, leg)| *leg)
    }
}

// Places on a street of two lanes that runs from west to east; the kerb is at 0, the other side at 8 m north
// of it.
const KERB: Place = Place::new(1.0, -1.0);
const OTHER_SIDE: Place = Place::new(1.0, 8.0);
/// Where a robot blocks the lane that is next to the kerb.
pub const NEAR_LANE: Place = Place::new(-4.0, 2.0);
/// Where a robot blocks the other lane.
pub const FAR_LANE: Place = Place::new(6.0, 5.0);

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
            own_place: None,
            crossing_s: 8.0,
            patience_s: 200.0,
            kerbs: None,
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

    /// Has an escort begin at the kerb that is nearer to the people who wait.
    pub fn begin_near(&mut self, people: Place) {
        let Some([from, to]) = self.kerbs else {
            return;
        };
        if people.distance(to) < people.distance(from) {
            *self = Self {
                followers: self.followers,
                urgency: self.urgency,
                own_place: self.own_place,
                patience_s: self.patience_s,
                ..Self::escort(self.site, to, from)
            };
        }
    }

    /// Two humanoids block both directions: the leader the near lane, its follower the far one. The
    /// pedestrian crosses between them.
    #[must_use]
    pub fn bilateral(site: Site, follower: StationId) -> Self {
        let stages = vec![
            Stage::of(&[(follower, Leg::new(TaskType::INITIAL_POS, FAR_LANE))]),
            Stage::of(&[(follower, Leg::new(TaskType::BLOCK, FAR_LANE))]),
        ];
        Self {
            own_place: Some(NEAR_LANE),
            ..Self::with(site, 1, stages)
        }
    }

    /// The leader blocks one direction, a second humanoid the other, and a dog escorts.
    #[must_use]
    pub fn trio(site: Site, blocker: StationId, escort: StationId) -> Self {
        Self {
            own_place: Some(NEAR_LANE),
            ..Self::team(site, &[(blocker, FAR_LANE)], escort)
        }
    }

    /// Some robots block, each at its place, while one escorts.
    #[must_use]
    pub fn team(site: Site, blockers: &[(StationId, Place)], escort: StationId) -> Self {
        let parts = |task| {
            let parts = blockers
                .iter()
                .map(|&(station, place)| (station, Leg::new(task, place)));
            parts.collect::<Vec<_>>()
        };
        let mut places = parts(TaskType::INITIAL_POS);
        places.push((escort, Leg::new(TaskType::INITIAL_POS, KERB)));
        let way = Leg {
            speed_mps: ESCORT_MPS,
            ..Leg::new(TaskType::MOVE, OTHER_SIDE)
        };
        let stages = [places, parts(TaskType::BLOCK), vec![(escort, way)]];
        // Without blockers nobody has a part in the second one, and it would have no end.
        let stages = stages.iter().filter(|parts| !parts.is_empty());
        let stages = stages.map(|parts| Stage::of(parts)).collect();
        let followers = u8::try_from(blockers.len() + 1).unwrap_or(u8::MAX);
        Self::with(site, followers, stages).at_escorts_pace()
    }

    /// What a leader with this plan asks for.
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

    /// Whether somebody may cross in its last stage, under a maneuver that guards.
    #[must_use]
    pub fn lets_cross(&self, guarding: TaskSet) -> bool {
        let mut legs = self
            .stages
            .last()
            .into_iter()
            .flat_map(|stage| &stage.parts);
        legs.any(|(_, leg)| guarding.contains(leg.task))
    }

    /// Whether the pedestrian is escorted in a stage.
    #[must_use]
    pub fn is_escort(&self, stage: usize) -> bool {
        self.stages.get(stage).is_some_and(Stage::is_escort)
    }
}
