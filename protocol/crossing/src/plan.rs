//! The plan of a leader for its followers: stage by stage, each follower its part.

use crossguard_protocol::{List, MAX_FOLLOWERS, Millis, StationId, TaskSet, TaskType};

use crate::ground::{Point, Way};

/// Capacity of a plan for stages.
pub const STAGES_MAX: usize = 8;

/// How far apart followers with the same part are, in centimetres.
const BESIDE_CM: i32 = 150;

/// One follower's part of a stage.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Leg {
    /// The maneuver.
    pub task: TaskType,
    /// Where it leads.
    pub to: Point,
    /// How fast, in mm/s.
    pub speed_mmps: u16,
    /// Which way to face there, in tenths of a degree clockwise from north, if that matters.
    pub heading_ddeg: Option<u16>,
}

/// The followers that do a part.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Who {
    /// Every follower without a part of its own in the stage, side by side.
    Everybody,
    /// The follower with this role of the plan.
    Role(u8),
}

/// The parts of a time. A stage is over when every part is done; a part that holds a place is when it has begun, and goes
/// on through the stages that have nothing else for its follower.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Stage {
    /// The parts, with their followers.
    pub parts: List<(Who, Leg), MAX_FOLLOWERS>,
}

impl Stage {
    /// A stage in which everybody does the same.
    #[must_use]
    pub fn everybody(leg: Leg) -> Self {
        Self {
            parts: core::iter::once((Who::Everybody, leg)).collect(),
        }
    }
}

/// The plan of a leader for its followers.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Plan {
    /// How many followers it takes.
    pub followers: u8,
    /// The stages.
    pub stages: List<Stage, STAGES_MAX>,
    /// The roles of followers, each with the station that it is for, or for any. Without roles, everybody does the same.
    pub roles: List<Option<StationId>, MAX_FOLLOWERS>,
    /// Where the leader itself stands while it leads, if it is to go there.
    pub own_place: Option<Point>,
    /// After which time the leader gives up.
    pub patience: Millis,
    /// The kerbs between which a person is escorted, where that can be done in either direction.
    pub kerbs: Option<[Point; 2]>,
}

impl Plan {
    /// The stage with this number.
    #[must_use]
    pub fn stage(&self, stage: u8) -> Option<&Stage> {
        self.stages.iter().nth(usize::from(stage))
    }

    /// Whether a stage is the last one.
    #[must_use]
    pub fn is_last(&self, stage: u8) -> bool {
        usize::from(stage) + 1 >= self.stages.len()
    }

    /// The part of the follower in this seat in a stage; `None` when it has none. Seats are the roles, or else the
    /// followers in the order in which they joined, who stand side by side. `turned` takes the kerbs the other way round.
    #[must_use]
    pub fn leg(&self, stage: u8, seat: usize, turned: bool) -> Option<Leg> {
        if !self.has_role(seat) {
            return None;
        }
        let parts = &self.stage(stage)?.parts;
        let of = |who| parts.iter().find(|(part, _)| *part == who);
        let role = u8::try_from(seat).ok().and_then(|seat| of(Who::Role(seat)));
        if let Some((_, leg)) = role {
            let to = self.turn(leg.to, turned);
            return Some(Leg { to, ..*leg });
        }
        let (_, leg) = of(Who::Everybody)?;
        let to = self.beside(self.turn(leg.to, turned), seat);
        Some(Leg { to, ..*leg })
    }

    /// Whether a seat has a part in the plan: any where everybody does the same, otherwise one with a role.
    pub(crate) fn has_role(&self, seat: usize) -> bool {
        self.roles.is_empty() || seat < self.roles.len()
    }

    /// A place, or the other kerb for a kerb where the plan is turned.
    fn turn(&self, place: Point, turned: bool) -> Point {
        match self.kerbs {
            Some([from, to]) if turned && place == from => to,
            Some([from, to]) if turned && place == to => from,
            _ => place,
        }
    }

    /// Whether an escort should begin at the second kerb: people are nearer to it.
    #[must_use]
    pub fn begins_over_there(&self, people: Point) -> bool {
        self.kerbs
            .is_some_and(|[from, to]| people.distance_cm(to) < people.distance_cm(from))
    }

    /// The place of the follower in this seat, where the first one is at `place`: by turns on either side of it, along
    /// the road.
    fn beside(&self, place: Point, seat: usize) -> Point {
        let across = match self.kerbs {
            Some([from, to]) => from.to(to),
            None => Way {
                east_cm: 0,
                north_cm: 1,
            },
        };
        let along = Way {
            east_cm: across.north_cm,
            north_cm: -across.east_cm,
        };
        let steps = i32::try_from(seat.div_ceil(2)).unwrap_or(i32::MAX);
        let side = if seat.is_multiple_of(2) { -1 } else { 1 };
        let length = i32::try_from(along.length_cm()).unwrap_or(i32::MAX).max(1);
        place.plus(along.part(side * BESIDE_CM * steps.min(64), length))
    }

    /// Whether somebody may cross in its last stage, under a maneuver that guards.
    #[must_use]
    pub fn lets_cross(&self, guarding: TaskSet) -> bool {
        let last = self.stages.iter().last();
        last.is_some_and(|stage| {
            stage
                .parts
                .iter()
                .any(|(_, leg)| guarding.contains(leg.task))
        })
    }

    /// Whether a guard is sent to its place, or somebody escorts, in a stage or one before it.
    #[must_use]
    pub(crate) fn guards_by(&self, stage: u8, guarding: TaskSet) -> bool {
        let stages = self.stages.iter().take(usize::from(stage) + 1);
        let mut legs = stages.flat_map(|stage| stage.parts.iter());
        legs.any(|(_, leg)| guarding.contains(leg.task))
    }

    /// Whether people are escorted in a stage: somebody guards without holding a place.
    #[must_use]
    pub fn is_escort(&self, stage: u8, escorts: TaskSet) -> bool {
        self.stage(stage).is_some_and(|stage| {
            stage
                .parts
                .iter()
                .any(|(_, leg)| escorts.contains(leg.task))
        })
    }
}
