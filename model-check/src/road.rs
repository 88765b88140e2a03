//! Ground truth on the road, whatever the robots believe: bodies, signs and a pedestrian. The properties W1 to W8
//! are about them.
//!
//! Nothing here asks a robot's state what is so. A body observes the outputs of its robot and moves by its
//! own actions; the pedestrian looks at signs and at nothing else.
//!
//! An application is truthful. It says that its body is in position when it is, and out of it when it is not any more; that a
//! maneuver which guards is finished, that the road is clear and that the task is done only when nobody is on the road. Where
//! guards see for themselves, a leader may say that the task is done while all of them see somebody. To be in
//! position and to say so is one action here, and so is to end a fallback and to say that the road is clear:
//! between the two nothing but the robot's own knowledge could differ, and less of it.

use std::cmp::Reverse;
use std::fmt;

use crossguard_protocol::{
    Coordination, Event, FallbackPolicy, Heartbeat, Input, Maneuver, ManeuverId, Output, Outputs,
    Place, Ram, Renaming, SessionId, Settings, StopReason,
};

use crate::serial::beat_is_newer;

/// Activity of a robot's body.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Body {
    /// Nothing.
    #[default]
    Parked,
    /// It is on its way.
    UnderWay(Maneuver),
    /// It holds the place that its maneuver is about.
    InPosition(Maneuver),
    /// It has left that place without an end of its maneuver.
    OutOfPosition(Maneuver),
    /// It carries out a fallback. Where that is to hold, it holds its place.
    FallingBack(Maneuver, FallbackPolicy),
    /// It did this last, and does nothing now.
    Ended(ManeuverId, End),
}

/// How a body has come to do nothing, without having been stopped.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum End {
    /// It has finished.
    Done,
    /// It could not go on.
    Failed,
    /// Its fallback is over.
    Safe,
    /// It lost power, and is where it was.
    Off,
}

impl Body {
    /// The body after a step of its robot.
    #[must_use]
    pub fn after(self, input: Input, outputs: &Outputs) -> Self {
        let mut body = self;
        if outputs.ignored().is_none()
            && let Input::Local(event) = input
        {
            body = body.after_own(event);
        }
        outputs.iter().fold(body, Self::told)
    }

    /// It has done something by itself, and its application has said so.
    fn after_own(self, event: Event) -> Self {
        match (event, self) {
            (Event::InPosition(id), Self::UnderWay(maneuver) | Self::OutOfPosition(maneuver))
                if maneuver.id == id =>
            {
                Self::InPosition(maneuver)
            }
            (Event::OutOfPosition(id), Self::InPosition(maneuver)) if maneuver.id == id => {
                Self::OutOfPosition(maneuver)
            }
            (Event::ManeuverCompleted(id), body) if body.runs(id) => Self::Ended(id, End::Done),
            (Event::ManeuverFailed(id), body) if body.runs(id) => Self::Ended(id, End::Failed),
            (Event::RoadClear, Self::FallingBack(maneuver, _)) => {
                Self::Ended(maneuver.id, End::Safe)
            }
            (_, body) => body,
        }
    }

    fn told(self, output: &Output) -> Self {
        match *output {
            Output::StartManeuver(maneuver) => Self::UnderWay(maneuver),
            Output::StopManeuver(maneuver, why) if self.runs(maneuver.id) => match why {
                StopReason::Unavailable(_) => Self::Ended(maneuver.id, End::Failed),
                StopReason::Superseded | StopReason::Released(_) => Self::Parked,
            },
            Output::FallBack(maneuver, policy) => Self::FallingBack(maneuver, policy),
            _ => self,
        }
    }

    /// The body when its robot loses power.
    #[must_use]
    pub fn off(self) -> Self {
        self.maneuver()
            .map_or(Self::Parked, |id| Self::Ended(id, End::Off))
    }

    fn runs(self, id: ManeuverId) -> bool {
        self.running().is_some_and(|maneuver| maneuver.id == id)
    }

    /// The maneuver that it carries out.
    #[must_use]
    pub const fn running(self) -> Option<Maneuver> {
        match self {
            Self::UnderWay(maneuver)
            | Self::InPosition(maneuver)
            | Self::OutOfPosition(maneuver) => Some(maneuver),
            Self::Parked | Self::FallingBack(..) | Self::Ended(..) => None,
        }
    }

    /// The maneuver that it carries out, falls back from, or did last.
    #[must_use]
    pub const fn maneuver(self) -> Option<ManeuverId> {
        match self {
            Self::Parked => None,
            Self::UnderWay(Maneuver { id, .. })
            | Self::InPosition(Maneuver { id, .. })
            | Self::OutOfPosition(Maneuver { id, .. })
            | Self::FallingBack(Maneuver { id, .. }, _)
            | Self::Ended(id, _) => Some(id),
        }
    }

    /// The maneuver by which it guards people now: by holding its place, or by going with them.
    #[must_use]
    pub fn guards(self, settings: &Settings) -> Option<Maneuver> {
        let guarding = |maneuver: &Maneuver| settings.guarding.contains(maneuver.task);
        let is_there = |maneuver: &Maneuver| {
            matches!(self, Self::InPosition(_)) || !settings.holding.contains(maneuver.task)
        };
        self.running().filter(guarding).filter(is_there)
    }

    /// The maneuver by which it guards people now, also by a fallback that stays with them.
    pub(crate) fn guards_still(self, settings: &Settings) -> Option<Maneuver> {
        use FallbackPolicy::{EscortToKerb, HoldUntilClear};
        match self {
            Self::FallingBack(maneuver, EscortToKerb | HoldUntilClear) => {
                let guards = settings.guarding.contains(maneuver.task);
                guards.then_some(maneuver)
            }
            _ => self.guards(settings),
        }
    }

    /// Whether to start this is to go on with what it falls back from, for the same leader: it is where it was.
    #[must_use]
    pub fn resumes(self, started: Maneuver) -> bool {
        matches!(self, Self::FallingBack(maneuver, _)
            if maneuver.task == started.task && maneuver.id.session == started.id.session)
    }

    pub(crate) fn renamed(self, to: &mut impl Renaming) -> Self {
        let mut id = |id: ManeuverId| ManeuverId {
            session: id.session.renamed(to),
            ..id
        };
        let mut maneuver = |m: Maneuver| Maneuver { id: id(m.id), ..m };
        match self {
            Self::Parked => Self::Parked,
            Self::UnderWay(m) => Self::UnderWay(maneuver(m)),
            Self::InPosition(m) => Self::InPosition(maneuver(m)),
            Self::OutOfPosition(m) => Self::OutOfPosition(maneuver(m)),
            Self::FallingBack(m, policy) => Self::FallingBack(maneuver(m), policy),
            Self::Ended(m, end) => Self::Ended(id(m), end),
        }
    }
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parked => f.write_str("parked"),
            Self::UnderWay(m) => write!(f, "under way ({} {})", m.task, m.id),
            Self::InPosition(m) => write!(f, "in position ({} {})", m.task, m.id),
            Self::OutOfPosition(m) => write!(f, "out of position ({} {})", m.task, m.id),
            Self::FallingBack(m, policy) => write!(f, "falls back from {}: {policy}", m.id),
            Self::Ended(id, end) => write!(f, "{end:?} ({id})"),
        }
    }
}

/// Messages that a leader has received of leaders that go before it at its place, in this session.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Heard {
    /// Nothing.
    #[default]
    Nothing,
    /// One message, which may be late.
    Once(SessionId, Heartbeat),
    /// Another one as well: a newer one of the same session, or one of another. A leader is there.
    Twice,
}

impl Heard {
    /// After a step in which a robot that said `before` received `input`, and says `after` now.
    #[must_use]
    pub fn after(self, before: &Ram, input: Input, after: &Ram) -> Self {
        let (Some(own), Some(now)) = (LeaderClaim::of(before), LeaderClaim::of(after)) else {
            return Self::Nothing;
        };
        if own.session != now.session {
            return Self::Nothing;
        }
        let Input::Ram { ram, .. } = input else {
            return self;
        };
        if ram.station == before.station {
            return self;
        }
        match (self, LeaderClaim::of(&ram)) {
            (Self::Once(session, beat), Some(other))
                if other.goes_before(&own)
                    && (other.session != session || beat_is_newer(other.beat, beat)) =>
            {
                Self::Twice
            }
            (Self::Nothing, Some(other)) if other.goes_before(&own) => {
                Self::Once(other.session, other.beat)
            }
            _ => self,
        }
    }

    pub(crate) fn renamed(self, to: &mut impl Renaming) -> Self {
        match self {
            Self::Once(session, beat) => {
                let beat = to.heartbeat(session, beat);
                Self::Once(session.renamed(to), beat)
            }
            Self::Nothing | Self::Twice => self,
        }
    }
}

struct LeaderClaim {
    session: SessionId,
    beat: Heartbeat,
    urgency: crossguard_protocol::Urgency,
    place: Place,
    yields: bool,
}

impl LeaderClaim {
    fn of(ram: &Ram) -> Option<Self> {
        match ram.coordination {
            Coordination::Leader {
                number,
                heartbeat: beat,
                urgency,
                place,
                yields,
                ..
            } => {
                let leader = ram.station;
                let session = SessionId { leader, number };
                Some(Self {
                    session,
                    beat,
                    urgency,
                    place,
                    yields,
                })
            }
            _ => None,
        }
    }

    /// More urgent, or as urgent and with the smaller station id; and perhaps at the same place.
    fn goes_before(&self, own: &Self) -> bool {
        let rank = |claim: &Self| (Reverse(claim.urgency), claim.session.leader);
        let one_place = self.place == own.place || self.place.0 == 0 || own.place.0 == 0;
        !self.yields && one_place && self.session != own.session && rank(self) < rank(own)
    }
}

/// The pedestrian at the place that the scenario is about.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Pedestrian {
    /// Waits for a sign that shows go.
    #[default]
    Waiting,
    /// Is on the road, having stepped on it at the sign of this session's leader.
    OnRoad(SessionId),
    /// Has crossed. Where the scenario is not cooperative the next one waits instead: whatever can happen
    /// after a crossing can happen to one that waits.
    Across,
}

impl Pedestrian {
    /// The session at whose sign the pedestrian on the road stepped on it.
    #[must_use]
    pub const fn on_road(self) -> Option<SessionId> {
        match self {
            Self::OnRoad(session) => Some(session),
            Self::Waiting | Self::Across => None,
        }
    }

    pub(crate) fn renamed(self, to: &mut impl Renaming) -> Self {
        match self {
            Self::OnRoad(session) => Self::OnRoad(session.renamed(to)),
            Self::Waiting | Self::Across => self,
        }
    }
}
