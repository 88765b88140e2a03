//! The protocol's view of RAM and RMCM: what the transition function reads and writes.
//!
//! The codec maps these views to and from the complete messages. Sizes, positions and everything
//! else that no rule of the protocol depends on stays there.

use core::cmp::Ordering;

use crate::MAX_FOLLOWERS;
use crate::id::{Heartbeat, OfferNumber, RequestId, SessionId, SessionNumber, StationId};
use crate::list::List;
use crate::task::{HelpRequest, Place, TaskSet, TaskType, Unavailability, Urgency};
use crate::time::Millis;
use crate::words::words;

/// The content of a Robot Awareness Message, as far as coordination goes.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub struct Ram {
    /// The station that sent it.
    pub station: StationId,
    /// Its part in a session.
    pub coordination: Coordination,
    /// A session that it names as over.
    pub farewell: Option<Farewell>,
    /// True if it still has a duty on the road from a maneuver or session that ended early.
    pub on_duty: bool,
}

/// A robot's part in a session, as its RAM tells.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(rename_all_fields = "camelCase", rename_all = "camelCase")
)]
#[repr(u8)]
pub enum Coordination {
    /// `helpStatus = none`: no part. It releases nobody from anything.
    None,
    /// `helpStatus = needHelp`: opens a session of its own and asks for followers.
    NeedHelp {
        /// Number of the session.
        number: SessionNumber,
        /// Newest heartbeat: it tells a request that stands from a late message.
        heartbeat: Heartbeat,
        /// The help that it asks for.
        request: HelpRequest,
    },
    /// `helpStatus = offerHelp`: reserved for one requester.
    OfferHelp {
        /// The session that the offer is for.
        session: SessionId,
        /// Number of the offer; the confirmation repeats it.
        offer: OfferNumber,
        /// The maneuvers that the helper can do.
        capabilities: TaskSet,
        /// Newest heartbeat of the request that it heard.
        echo: Heartbeat,
        /// Its own `t_safety`, which the leader's lease must fit.
        t_safety: Millis,
    },
    /// `RoleConfirmed`: leads a session and names its followers.
    Leader {
        /// Number of the session.
        number: SessionNumber,
        /// Newest heartbeat.
        heartbeat: Heartbeat,
        /// The followers; any other robot has no part in the session.
        followers: Followers,
        /// Urgency of the request; the first key in the order of leaders at one place.
        urgency: Urgency,
        /// The crossing of the session.
        place: Place,
        /// True if it has yielded the place to another leader and lets nobody cross any more.
        yields: bool,
    },
    /// Follows the leader of `session`.
    Follower {
        /// The session it follows in.
        session: SessionId,
        /// Newest heartbeat that it heard.
        echo: Heartbeat,
        /// Newest command that it accepted, and how far it is.
        last: Option<Report>,
    },
}

/// The followers that a leader's RAM names.
pub type Followers = List<Confirmation, MAX_FOLLOWERS>;

/// A confirmed follower: its station id and the offer that is confirmed.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Confirmation {
    /// The follower.
    pub station: StationId,
    /// The offer that is confirmed.
    pub offer: OfferNumber,
}

/// How far a follower is with its newest accepted command.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// The command.
    pub request: RequestId,
    /// How far it is.
    pub progress: Progress,
}

words! {
    /// Progress of an accepted command.
    pub enum Progress as ProgressKind {
        /// The maneuver runs, and the body is under way.
        Executing = 2;
        /// The maneuver runs, and the body holds the place from which it guards.
        InPosition = 3;
        /// It was finished.
        Completed = 4;
        /// It ended without success.
        Failed(why: Failure) = 5, "failed({why})";
        /// It was stopped by the fallback policy because contact with the leader was lost.
        SafeIdle = 6;
    }
}

impl Progress {
    /// True if the maneuver runs; every other progress is final for its command.
    #[must_use]
    pub const fn is_running(self) -> bool {
        matches!(self, Self::Executing | Self::InPosition)
    }

    /// True if this progress of a command is later than the `known` one, in a RAM whose echo is so much newer than all before.
    /// A place is left and taken again, so there the echo tells which was later. Where it cannot, the worse one counts.
    #[must_use]
    pub(crate) const fn is_news(self, known: Self, echo: Ordering) -> bool {
        match (known, self) {
            // R28: a place is taken by a newer echo alone, and left by any that is not older.
            (Self::Executing, Self::InPosition) => matches!(echo, Ordering::Greater),
            (Self::InPosition, Self::Executing) => !matches!(echo, Ordering::Less),
            (Self::Executing | Self::InPosition, _) => !self.is_running(),
            // The limit is the leader's own: the follower has gone on.
            (Self::Failed(Failure::ExecutionLimit), Self::SafeIdle) => true,
            (Self::Completed | Self::Failed(_) | Self::SafeIdle, _) => false,
        }
    }
}

words! {
    /// Why a maneuver ended without success.
    pub enum Failure as FailureKind #[derive(PartialOrd, Ord)] {
        /// The robot could not do it.
        Maneuver = 27;
        /// The robot became unavailable while it ran.
        Unavailable(why: Unavailability) = 7, "unavailable({why})";
        /// The leader's execution limit `T_exec` ran out. Never in a RAM.
        ExecutionLimit = 28;
    }
}

/// A session that a RAM names as over. A bare `helpStatus = none` ends nothing.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Farewell {
    /// The sender's own session of this number has ended.
    Ended(SessionNumber, Ending),
    /// The sender has no part in this session any more by this offer or an earlier one.
    Left(SessionId, OfferNumber),
}

impl Farewell {
    /// True if it takes this offer back.
    pub(crate) fn leaves(self, session: SessionId, offer: OfferNumber) -> bool {
        matches!(self, Self::Left(left, by) if left == session && offer <= by)
    }
}

words! {
    /// How a session ended.
    pub enum Ending #[derive(PartialOrd, Ord)] {
        /// The crossing is completed and the road is clear: followers are free.
        Completed = 0;
        /// Any other end: somebody may be on the road, so followers fall back by their tasks' policies.
        Aborted = 1;
    }
}

/// The content of a Robot Maneuver Coordination Message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[repr(u8)]
pub enum Rmcm {
    /// `LeaderManeuverContainer`.
    Command(Command),
    /// `FollowerManeuverContainer`.
    Answer(Answer),
}

/// A leader's command to one follower.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Command {
    /// The session, and with it the leader that commands.
    pub session: SessionId,
    /// `targetFollowerStationID`.
    pub to: StationId,
    /// `requestID`.
    pub request: RequestId,
    /// `taskType`.
    pub task: TaskType,
}

/// A follower's answer to one command.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Answer {
    /// The follower.
    pub from: StationId,
    /// The session of the command.
    pub session: SessionId,
    /// `jobAdviceID`: the `requestID` that is answered.
    pub request: RequestId,
    /// Acknowledgement or rejection.
    pub verdict: Verdict,
}

/// Acknowledgement or rejection of a command.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Verdict {
    /// The follower takes the command on.
    Accepted,
    /// It does not.
    Rejected(Rejection),
}

words! {
    /// Why a follower rejects a command.
    pub enum Rejection as RejectionKind #[derive(PartialOrd, Ord)] {
        /// It cannot do such a task.
        UnsupportedTask = 17;
        /// It is unavailable.
        Unavailable(why: Unavailability) = 7, "unavailable({why})";
        /// It has a duty on the road, of which its application has not said that it is over.
        OnDuty = 48;
    }
}
