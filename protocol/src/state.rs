//! The state of a robot.
//!
//! ```text
//!                       PedestrianDetected                    enough offers
//!             ┌────────────────────────────► Requesting ─────────────────────► Leading
//!             │                               │      ▲                            │
//!             │           a request goes before own  │ renewed session            │ ended
//!   Idle ─────┤                               ▼      └────────────────────────────┤
//!     ▲       │      needHelp heard                      listed by the leader     │
//!     │       └────────────────────────────► Offering ─────────────────────► Following
//!     │                                       │                                   │
//!     └───────────────────────────────────────┴───────────────────────────────────┘
//!                        ended, left, not listed, or out of time
//! ```
//!
//! `Requesting` and `Offering` are the paper's *help requested*; `Leading` and `Following` are its
//! *role established* and, while a maneuver runs, its *maneuver executing*. Each state owns its
//! timers: leaving the state drops them.

use crate::MAX_FOLLOWERS;
use crate::id::{
    Heartbeat, ManeuverId, OfferNumber, RequestId, SessionId, SessionNumber, StationId,
};
use crate::input::Decimetres;
use crate::list::List;
use crate::message::{Farewell, Progress, Rejection};
use crate::output::Maneuver;
use crate::task::{Availability, HelpRequest, TaskSet, TaskType};
use crate::time::{Countdown, Millis};
use crate::words::words;

/// The state of one robot; the transition function is [`Robot::step`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub struct Robot {
    pub(crate) station: StationId,
    pub(crate) boot: u16,
    /// Count of the next session or offer number; `u16::MAX` is never given out.
    pub(crate) next_count: u16,
    pub(crate) availability: Availability,
    pub(crate) identity: Identity,
    /// The duty on the road that must end before the robot takes part in anything new.
    pub(crate) duty: Option<Duty>,
    /// Time to the next periodic RAM; armed in a session and while a farewell stands.
    pub(crate) ram: Countdown,
    pub(crate) farewell: Option<StandingFarewell>,
    pub(crate) phase: Phase,
}

/// A robot's part in a session.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[repr(u8)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is no heap, and room for sixteen followers is in one variant"
)]
pub enum Phase {
    /// None.
    Idle,
    /// Has opened a session and asks for help.
    Requesting(Requesting),
    /// Is reserved for a requester.
    Offering(Offering),
    /// Leads a session.
    Leading(Leading),
    /// Follows in a session.
    Following(Following),
}

words! {
    /// The state of the paper's finite-state model.
    pub enum State in "PascalCase" #[derive(PartialOrd, Ord)] {
        /// Stages 1 and 5: no part in a session.
        Idle = 0;
        /// Stage 2: asks for help, or offers it.
        HelpRequested = 1;
        /// Stage 3: has a role; nothing is executed.
        RoleEstablished = 2;
        /// Stage 4: a maneuver is executed.
        ManeuverExecuting = 3;
    }
}

words! {
    /// A robot's role in a session.
    pub enum Role #[derive(PartialOrd, Ord)] {
        /// No part in a session.
        None = 0;
        /// Asks for help.
        Requester = 1;
        /// Offers help.
        Helper = 2;
        /// Leads.
        Leader = 3;
        /// Follows.
        Follower = 4;
    }
}

/// The lock of the pseudonym.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Identity {
    /// It may.
    Unlocked,
    /// It may not: the robot has a part in a session or says farewell to one.
    Locked(Countdown),
    /// The lock has lasted as long as it may. The robot still says farewell, and takes part in no
    /// session before the identity has been unlocked.
    Expiring,
}

/// A duty on the road that outlives its command or its session.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[repr(u8)]
pub enum Duty {
    /// The body carries out the fallback of this maneuver.
    FallingBack(Maneuver),
    /// The robot led this session, which ended while people may have been on the road.
    Crossing(SessionId),
}

/// A farewell that is announced for a while.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StandingFarewell {
    /// The farewell itself.
    pub farewell: Farewell,
    /// For how long yet.
    pub left: Countdown,
}

/// A requester's state.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Requesting {
    /// Number of the session.
    pub number: SessionNumber,
    /// The help that it asks for.
    pub request: HelpRequest,
    /// Newest heartbeat.
    pub heartbeat: Heartbeat,
    /// A request or leader at the same place that goes before, as heard first.
    pub rival: Option<Rival>,
    /// The offers it has heard, best first.
    pub offers: List<Offer, MAX_FOLLOWERS>,
    /// `T_help`.
    pub help: Countdown,
    /// Time left to gather offers; armed from the first offer on.
    pub selection: Countdown,
}

/// A request or a leader at the same place that goes before this robot's own. One message may be late, of a session
/// that is over: the next newer message of it counts, and so does one of any other that goes before.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rival {
    /// Its session.
    pub session: SessionId,
    /// The heartbeat that was heard of it.
    pub heartbeat: Heartbeat,
}

/// An offer as a requester has heard it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Offer {
    /// The helper.
    pub station: StationId,
    /// Number of the offer.
    pub number: OfferNumber,
    /// Maneuvers that the helper can do.
    pub capabilities: TaskSet,
    /// How far away the helper is.
    pub distance: Decimetres,
    /// Newest heartbeat that it echoed.
    pub echo: Heartbeat,
    /// How long the offer stands without a newer echo: until then the helper is still reserved.
    pub standing: Countdown,
}

/// A helper's state.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub struct Offering {
    /// The session it offers to.
    pub session: SessionId,
    /// Number of the offer.
    pub number: OfferNumber,
    /// Maneuvers that it can do, of those that are asked for.
    pub capabilities: TaskSet,
    /// Newest heartbeat of the request that it heard.
    pub heard: Heartbeat,
    /// Its `t_safety`, as the offer tells it.
    pub t_safety: Millis,
    /// `T_offer`, since the newest heartbeat.
    pub reservation: Countdown,
}

/// A leader's state.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub struct Leading {
    /// Number of the session.
    pub number: SessionNumber,
    /// The help that was asked for.
    pub request: HelpRequest,
    /// Newest heartbeat.
    pub heartbeat: Heartbeat,
    /// The followers.
    pub members: List<Member, MAX_FOLLOWERS>,
    /// The right of the pedestrian to cross, and the knowledge that the road is clear.
    pub corridor: Corridor,
    /// A leader at the same place that goes before, as heard first.
    pub rival: Option<Rival>,
    /// The leader that it has yielded the place to. It lets nobody cross any more, keeps its followers
    /// until the road is clear, and ends.
    pub yields_to: Option<StationId>,
}

words! {
    /// The corridor of a leader.
    pub enum Corridor #[derive(PartialOrd, Ord)] {
        /// Nobody may cross, and nobody is on the road.
        Clear = 0;
        /// The pedestrian may cross.
        Open = 1;
        /// Nobody may cross any more, and people may still be on the road.
        Clearing = 2;
    }
}

#[expect(
    clippy::derivable_impls,
    reason = "the macro has no place for a default"
)]
impl Default for Corridor {
    fn default() -> Self {
        Self::Clear
    }
}

/// A leader's record of one follower.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub struct Member {
    /// The follower.
    pub station: StationId,
    /// The offer that was confirmed.
    pub offer: OfferNumber,
    /// Newest heartbeat that it echoed; `None` until it has taken its role.
    pub echoed: Option<Heartbeat>,
    /// The lease on it.
    pub lease: Lease,
    /// Number of the next command.
    pub next_request: RequestId,
    /// The command that it has not acknowledged yet.
    pub outstanding: Option<Outstanding>,
    /// The newest command that it acknowledged.
    pub order: Option<Order>,
}

/// A leader's lease on a follower.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Lease {
    /// It stands for this long: until then the follower cannot have fallen back.
    Stands(Countdown),
    /// There is none; the follower is kept for this long.
    Expired(Countdown),
}

/// A command that is not acknowledged yet.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Outstanding {
    /// Its number.
    pub request: RequestId,
    /// Its task.
    pub task: TaskType,
    /// How often it was repeated.
    pub repeats: u8,
    /// `T_ack`.
    pub acknowledgement: Countdown,
}

/// A command that is acknowledged.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Order {
    /// Its number.
    pub request: RequestId,
    /// Its task.
    pub task: TaskType,
    /// The progress that the follower reported; `None` before its first report.
    pub progress: Option<Progress>,
    /// `T_exec`; armed until the progress is final.
    pub execution: Countdown,
}

/// A follower's state.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub struct Following {
    /// The session.
    pub session: SessionId,
    /// The offer that was confirmed.
    pub offer: OfferNumber,
    /// Newest heartbeat that it heard.
    pub heard: Heartbeat,
    /// Contact with the leader.
    pub contact: Contact,
    /// Newest command that it accepted.
    pub job: Option<Job>,
    /// Newest command that it rejected, where that is newer than the job.
    pub refused: Option<Refusal>,
    /// True if it has seen somebody on the road itself, and has not said since then that the road is clear.
    pub sees_people: bool,
}

/// A follower's contact with its leader.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Contact {
    /// `T_safety` runs.
    Fresh(Countdown),
    /// `T_safety` ran out; `T_leave` runs.
    Lost(Countdown),
}

/// A command that a follower accepted.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Job {
    /// Its number.
    pub request: RequestId,
    /// Its task.
    pub task: TaskType,
    /// How far it is.
    pub progress: Progress,
}

/// A command that a follower rejected.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Refusal {
    /// Its number.
    pub request: RequestId,
    /// Why.
    pub reason: Rejection,
}

impl Leading {
    /// The record of `station`, if it is a follower in this session.
    #[must_use]
    pub fn member(&self, station: StationId) -> Option<&Member> {
        self.members.iter().find(|member| member.station == station)
    }

    /// Changes the record of `station` and returns the result of `change`, `None` where there is no such follower.
    pub(crate) fn update_member<R>(
        &mut self,
        station: StationId,
        change: impl FnOnce(&mut Member) -> R,
    ) -> Option<R> {
        self.members
            .update_first(|member| member.station == station, change)
    }

    /// True if a follower executes an acknowledged command.
    #[must_use]
    pub fn is_executing(&self) -> bool {
        self.members
            .iter()
            .any(|member| member.order.is_some_and(Order::is_running))
    }
}

impl Member {
    /// True if the follower has taken its role.
    #[must_use]
    pub const fn has_joined(&self) -> bool {
        self.echoed.is_some()
    }

    /// True if the follower has completed its newest acknowledged command.
    #[must_use]
    pub fn has_completed(&self) -> bool {
        self.order
            .is_some_and(|order| order.progress == Some(Progress::Completed))
    }
}

impl Lease {
    /// True if the lease stands.
    #[must_use]
    pub const fn stands(self) -> bool {
        matches!(self, Self::Stands(_))
    }

    /// The time that is left of the lease, or of the time without one.
    pub(crate) const fn countdown(self) -> Countdown {
        let (Self::Stands(left) | Self::Expired(left)) = self;
        left
    }
}

impl Order {
    /// True if the command is acknowledged and not finished.
    #[must_use]
    pub const fn is_running(self) -> bool {
        match self.progress {
            None => true,
            Some(progress) => progress.is_running(),
        }
    }
}

impl Following {
    /// The maneuver that runs.
    #[must_use]
    pub fn executing(&self) -> Option<Maneuver> {
        let job = self.job.filter(|job| job.progress.is_running())?;
        let id = ManeuverId::of(self.session, job.request);
        Some(Maneuver { id, task: job.task })
    }

    /// The newest command that was answered, accepted or not.
    #[must_use]
    pub fn newest_request(&self) -> Option<RequestId> {
        self.refused
            .map(|refused| refused.request)
            .or(self.job.map(|job| job.request))
    }
}

impl Contact {
    /// True if `T_safety` has run out without a newer heartbeat or command.
    #[must_use]
    pub const fn is_lost(self) -> bool {
        matches!(self, Self::Lost(_))
    }

    /// The time that is left of `T_safety` or `T_leave`.
    pub(crate) const fn countdown(self) -> Countdown {
        let (Self::Fresh(left) | Self::Lost(left)) = self;
        left
    }
}
