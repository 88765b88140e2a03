//! What the transition function takes in.

use crate::id::{ManeuverId, StationId, UniqueNumber};
use crate::message::{Ram, Rmcm};
use crate::task::{Availability, HelpRequest, TaskType};
use crate::time::Millis;

/// One input of the transition function.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[repr(u8)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is no heap, and room for sixteen followers is in one variant"
)]
pub enum Input {
    /// A RAM was received.
    Ram {
        /// The message.
        ram: Ram,
        /// Distance between the sender's reference position and this robot.
        distance: Decimetres,
    },
    /// An RMCM was received. One that commands several followers is one input per follower.
    Rmcm(Rmcm),
    /// Time has passed. Timers that run out fire in a fixed order, each once.
    ///
    /// An endpoint tells the robot of elapsed time before every other input, and at the latest
    /// [`delay_max`](crate::Settings::delay_max) after [`Robot::next_due`](crate::Robot::next_due).
    Elapsed(Millis),
    /// One armed timer expires now, whatever time it has left.
    ///
    /// This is time for models that abstract from durations; an endpoint uses
    /// [`Elapsed`](Self::Elapsed).
    Expired(Timer),
    /// Something happened in the robot itself.
    Local(Event),
}

/// A distance in decimetres; [`u16::MAX`] when it is unknown or longer than 6.5 km.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Decimetres(pub u16);

impl Decimetres {
    /// Not known, or out of range.
    pub const UNKNOWN: Self = Self(u16::MAX);
}

/// An event of the robot's own application.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[repr(u8)]
pub enum Event {
    /// A pedestrian needs help that takes more robots than this one.
    PedestrianDetected(HelpRequest),
    /// The leader's application wants a follower to do a maneuver.
    CommandManeuver {
        /// The follower.
        follower: StationId,
        /// The maneuver.
        task: TaskType,
    },
    /// The body holds the place from which the maneuver that was started guards.
    InPosition(ManeuverId),
    /// The maneuver that was started has been finished.
    ManeuverCompleted(ManeuverId),
    /// The maneuver that was started cannot be finished.
    ManeuverFailed(ManeuverId),
    /// The pedestrian has crossed and nobody is on the road; the session may end.
    TaskCompleted,
    /// The people that this robot guarded are off the road, and its body has finished its fallback.
    RoadClear,
    /// The requester knows of no robot nearby that has not answered its request.
    AllAnswered,
    /// The robot wants to leave whatever session it is in.
    LeaveRequested,
    /// The robot became available or unavailable.
    AvailabilityChanged(Availability),
    /// The leader's application wants to let the pedestrian cross.
    OpenCorridor,
    /// The leader's application wants to hold the pedestrian back again.
    CloseCorridor,
    /// The robot has changed its pseudonym; only possible while the identity is not locked.
    ///
    /// Where a number is given, those of its sessions and offers begin anew there, so that they do not tell that the
    /// two pseudonyms are one robot. Under this station id, no number from there on may have been given out before.
    IdentityChanged(StationId, Option<UniqueNumber>),
    /// A larger boot counter has been persisted, as [`Output::RenewEpoch`](crate::Output::RenewEpoch) asked.
    EpochRenewed(u16),
}

/// The timers of a robot. A timer exists only in the state that needs it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Timer {
    /// Follower: `T_safety`, since the newest heartbeat or command.
    Safety,
    /// Follower: `T_leave`, since contact was lost.
    Leave,
    /// Leader: the lease on this follower.
    Lease(StationId),
    /// Leader: how long this follower is kept without a lease.
    Lost(StationId),
    /// Leader: `T_exec` of this follower's command.
    Execution(StationId),
    /// Leader: `T_ack` of this follower's outstanding command.
    Acknowledgement(StationId),
    /// Requester: `T_help`.
    Help,
    /// Requester: how long the offer of this helper stands without a newer echo.
    Offer(StationId),
    /// Requester: the time to gather offers.
    Selection,
    /// Helper: `T_offer`.
    Reservation,
    /// The longest time for which the identity may stay locked.
    IdentityLock,
    /// How long an ended or left session is announced.
    Farewell,
    /// The next periodic RAM.
    Ram,
}
