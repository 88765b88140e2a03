//! Inputs of the transition function.

use crate::display::NumbersFrom;
use crate::id::{ManeuverId, StationId, UniqueNumber};
use crate::message::{Ram, Rmcm};
use crate::task::{Availability, HelpRequest, TaskType};
use crate::time::Millis;
use crate::words::words;

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

words! {
    /// An event of the robot's own application.
    pub enum Event as EventKind #[repr(u8)] {
        /// A pedestrian needs help that takes more robots than this one.
        PedestrianDetected(request: HelpRequest) = 0, "pedestrian detected ({request})";
        /// The leader's application wants a follower to do a maneuver.
        CommandManeuver {
            /// The follower.
            follower: StationId,
            /// The maneuver.
            task: TaskType
        } = 1, "command station {follower}: {task}";
        /// The body holds the place from which the maneuver that was started guards. To be told only when the body is
        /// there: the leader lets people on the road by it.
        InPosition(id: ManeuverId) = 2, "in position for {id}";
        /// The maneuver that was started has been finished.
        ManeuverCompleted(id: ManeuverId) = 3, "completed {id}";
        /// The maneuver that was started cannot be finished.
        ManeuverFailed(id: ManeuverId) = 4, "failed {id}";
        /// The pedestrian has crossed and nobody is on the road; the session may end. It takes the guards off the road.
        TaskCompleted = 5;
        /// The people that this robot guarded are off the road, and its body has finished its fallback. To be told only
        /// when both are so: it ends the robot's duty.
        RoadClear = 6;
        /// The requester knows of no robot nearby that has not answered its request.
        AllAnswered = 7, "all have answered";
        /// The robot wants to leave whatever session it is in.
        LeaveRequested = 8;
        /// The robot became available or unavailable.
        AvailabilityChanged(availability: Availability) = 9, "now {availability}";
        /// The leader's application wants to let the pedestrian cross.
        OpenCorridor = 10;
        /// The leader's application wants to hold the pedestrian back again.
        CloseCorridor = 11;
        /// The robot has changed its pseudonym; only possible while the identity is not locked.
        ///
        /// Where a number is given, those of its sessions and offers begin anew there, so that they do not tell that the
        /// two pseudonyms are one robot. Under this station id, no number from there on may have been given out before.
        IdentityChanged(station: StationId, next: Option<UniqueNumber>) = 12,
            "identity changed to station {station}{}", NumbersFrom(*next);
        /// A larger boot counter has been persisted, as the output `RenewEpoch` asked.
        EpochRenewed(boot: u16) = 13, "boot counter renewed to {boot}";
        /// The body does not hold the place any more from which the maneuver guards. To be told as soon as it may be so:
        /// the leader lets nobody on the road any more.
        OutOfPosition(id: ManeuverId) = 14, "out of position for {id}";
        /// Somebody is on the road, seen by this follower itself. Until it tells `RoadClear` it stays, however its leader
        /// ends the session.
        PersonOnRoad = 15;
    }
}

words! {
    /// The timers of a robot. A timer exists only in the state that needs it.
    pub enum Timer as TimerKind #[derive(PartialOrd, Ord)] {
        /// Follower: `T_safety`, since the newest heartbeat or command.
        Safety = 0;
        /// Follower: `T_leave`, since contact was lost.
        Leave = 1;
        /// Leader: the lease on this follower.
        Lease(follower: StationId) = 2, "lease of station {follower}";
        /// Leader: how long this follower is kept without a lease.
        Lost(follower: StationId) = 3, "lost station {follower}";
        /// Leader: `T_exec` of this follower's command.
        Execution(follower: StationId) = 4, "execution of station {follower}";
        /// Leader: `T_ack` of this follower's outstanding command.
        Acknowledgement(follower: StationId) = 5, "acknowledgement of station {follower}";
        /// Requester: `T_help`.
        Help = 6;
        /// Requester: how long the offer of this helper stands without a newer echo.
        Offer(helper: StationId) = 7, "offer of station {helper}";
        /// Requester: the time to gather offers.
        Selection = 8;
        /// Helper: `T_offer`.
        Reservation = 9;
        /// The longest time for which the identity may stay locked.
        IdentityLock = 10;
        /// How long an ended or left session is announced.
        Farewell = 11;
        /// The next periodic RAM.
        Ram = 12;
    }
}
