//! What the transition function gives out.

use crate::MAX_OUTPUTS;
use crate::id::{ManeuverId, SessionId, StationId};
use crate::list::List;
use crate::message::{Failure, Rejection, Rmcm};
use crate::task::{FallbackPolicy, TaskType, Unavailability};
use crate::time::Millis;

/// One output of the transition function.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[repr(u8)]
pub enum Output {
    /// Send a RAM now, with [`Robot::ram`](crate::Robot::ram) of the state after this step.
    SendRam,
    /// Send this RMCM now.
    SendRmcm(Rmcm),
    /// Start this maneuver. The acknowledgement stands before it in the list.
    StartManeuver(Maneuver),
    /// Stop this maneuver.
    StopManeuver(Maneuver, StopReason),
    /// End this maneuver by the task's policy. The robot is on duty until the application says
    /// [`Event::RoadClear`](crate::Event::RoadClear).
    FallBack(Maneuver, FallbackPolicy),
    /// The pedestrian may cross from now on, for this long. What shows it must end by itself then, without
    /// this robot's help.
    CorridorOpened(Millis),
    /// The pedestrian may go on crossing, for this long from now.
    CorridorExtended(Millis),
    /// The pedestrian may not cross from now on.
    CorridorClosed(CorridorClosure),
    /// Keep station id, certificate and link address from now on.
    LockIdentity,
    /// Station id, certificate and link address may change again.
    UnlockIdentity,
    /// Half of this boot counter's numbers are given out: persist a larger one, and then tell
    /// [`Event::EpochRenewed`](crate::Event::EpochRenewed).
    RenewEpoch,
    /// Tell the application.
    Notify(Notice),
    /// The input changed nothing, for this reason.
    Ignored(Ignored),
}

/// A maneuver of this robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Maneuver {
    /// The command it belongs to.
    pub id: ManeuverId,
    /// What to do.
    pub task: TaskType,
}

/// Why a maneuver is stopped.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum StopReason {
    /// A newer command takes its place.
    Superseded,
    /// The follower has no part in the session any more.
    Released(ReleaseReason),
    /// The robot became unavailable.
    Unavailable(Unavailability),
}

/// Why the corridor closed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum CorridorClosure {
    /// A follower is not engaged any more.
    NotEngaged(StationId, Disengagement),
    /// Fewer followers are left than the task requires.
    FollowerMissing,
    /// The session ended.
    SessionEnded,
    /// The place is yielded to this leader.
    Yielded(StationId),
    /// The application asked for it.
    Application,
}

/// Why a follower does not hold the corridor.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Disengagement {
    /// The leader has no lease on it.
    NoLease,
    /// It has a command that it has not acknowledged.
    CommandOutstanding,
    /// It has no acknowledged command, or has not reported progress on it yet.
    NotExecuting,
    /// Its task does not guard a pedestrian.
    NotGuarding,
    /// Its task guards from a place, and it has not reported that it is there.
    NotInPosition,
    /// It finished its task.
    Completed,
    /// Its task failed.
    Failed(Failure),
    /// It fell back for lack of contact.
    SafeIdle,
}

/// News for the application.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Notice {
    /// Leader: the followers are confirmed; the session has its roles.
    RolesEstablished(SessionId),
    /// Leader: this follower has taken its role.
    FollowerJoined(StationId),
    /// Leader: this follower has no part in the session any more.
    FollowerGone(StationId, GoneReason),
    /// Leader: this follower's lease stands.
    LeaseGranted(StationId),
    /// Leader: this follower's lease has run out.
    LeaseExpired(StationId),
    /// Leader: this follower acknowledged this command.
    CommandAcknowledged(StationId, ManeuverId),
    /// Leader: this follower rejected this command.
    CommandRejected(StationId, ManeuverId, Rejection),
    /// Leader: this follower reports that it executes this command.
    ManeuverReported(StationId, ManeuverId),
    /// Leader: this follower reports that it guards from its place.
    ManeuverInPosition(StationId, ManeuverId),
    /// Leader: this follower finished this command.
    ManeuverCompleted(StationId, ManeuverId),
    /// Leader: this command failed.
    ManeuverFailed(StationId, ManeuverId, Failure),
    /// Leader: this follower fell back; it is idle in safety.
    FollowerSafeIdle(StationId, ManeuverId),
    /// Requester: the offer of this helper has lapsed.
    OfferLapsed(StationId),
    /// Leader: yields the place to this leader. The session ends once the road is clear.
    Yielded(StationId),
    /// Requester or leader: the session is over.
    SessionEnded(SessionId, EndReason),
    /// Helper: offers to take part in this session.
    Offering(SessionId),
    /// Follower: takes part in this session.
    Joined(SessionId),
    /// Helper or follower: has no part in this session any more.
    Released(SessionId, ReleaseReason),
    /// Follower: contact with the leader is lost.
    ContactLost(SessionId),
    /// Follower: contact with the leader is back.
    ContactRegained(SessionId),
}

/// Why a session ended.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum EndReason {
    /// The application said that the task is done.
    TaskCompleted,
    /// `T_help` ran out before enough helpers were found.
    NoHelp,
    /// The request of this station at the same place goes before, or it leads there already.
    Withdrawn(StationId),
    /// No follower is left.
    NoFollowers,
    /// The application asked to leave.
    LeaveRequested,
    /// The leader became unavailable.
    Unavailable(Unavailability),
    /// The identity must be unlocked.
    IdentityLockLimit,
    /// The request numbers are used up; a new session follows at once.
    Renewed,
}

/// Why a helper or follower has no part in a session any more.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum ReleaseReason {
    /// The leader named the session as ended: the crossing is completed.
    TaskCompleted,
    /// The leader named the session as ended otherwise.
    SessionEnded,
    /// The leader does not list this robot.
    NotListed,
    /// `T_offer` ran out.
    ReservationExpired,
    /// `T_leave` ran out without contact.
    ContactLost,
    /// The application asked to leave.
    LeaveRequested,
    /// The robot became unavailable.
    Unavailable(Unavailability),
    /// The identity must be unlocked.
    IdentityLockLimit,
}

/// Why a leader has dropped a follower.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum GoneReason {
    /// It named the session as left.
    Left,
    /// It did not acknowledge a command, however often it was repeated.
    NoAcknowledgement,
    /// It was without a lease for too long.
    NoContact,
}

/// Why an input changed nothing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Ignored {
    /// The message carries this robot's own station id.
    OwnStation,
    /// The message is meant for another station.
    NotAddressed,
    /// The message names a session that this robot has no part in.
    OtherSession,
    /// The message repeats what is known.
    NothingNew,
    /// The session is over, and this robot is naming another one as over or left.
    AnsweringAnother,
    /// The heartbeat is not newer than the newest one heard.
    OldHeartbeat,
    /// The echo names a heartbeat that was never sent.
    EchoFromFuture,
    /// The command is older than the newest one of the session.
    OldCommand,
    /// The sender is not a follower in this session.
    NotAFollower,
    /// The followers are already confirmed.
    RolesAlreadyAssigned,
    /// The answer is not for the outstanding command.
    NotOutstanding,
    /// The request or leader does not go before this robot's own.
    LowerPrecedence,
    /// The request or leader goes before, but does not count yet: it was not heard before with an older
    /// heartbeat, or another one was noted less than a period ago.
    FirstHeard,
    /// The request or leader is of another place.
    OtherPlace,
    /// The leader has yielded already.
    Yielding,
    /// The offer is older than the one that stands, or the same RAM takes it back.
    OldOffer,
    /// The farewell names an older offer than the one that was confirmed.
    OtherOffer,
    /// The list names an offer that this robot never made.
    NeverOffered,
    /// The helper's `t_safety` is too short for this robot's lease.
    TimersDoNotFit,
    /// The robot has a duty on the road, of which its application has not said that it is over.
    OnDuty,
    /// People may be on the road, so no guard is taken off it and no session is renewed.
    RoadOccupied,
    /// The identity lock or an execution limit leaves less time than `t_cross`.
    NotEnoughTime,
    /// The robot has a part in a session already.
    InSession,
    /// The robot leads no session.
    NotLeading,
    /// The robot has no part in a session.
    NotInSession,
    /// The robot executes no such maneuver.
    NotExecuting,
    /// The robot is unavailable.
    Unavailable(Unavailability),
    /// The robot can do none of the tasks that are asked for.
    UnsupportedTask,
    /// The number of followers is zero or above the limit, or no task is asked for.
    ImpossibleRequest,
    /// The follower has not taken its role yet.
    NotJoined,
    /// The follower has not acknowledged the command before.
    CommandOutstanding,
    /// The corridor is open already.
    CorridorOpen,
    /// The corridor is closed already.
    CorridorClosed,
    /// The corridor cannot open because this follower is not engaged.
    NotEngaged(StationId, Disengagement),
    /// The corridor cannot open because fewer followers are left than the task requires.
    FollowerMissing,
    /// The identity is locked.
    IdentityLocked,
    /// The identity has been locked for too long; it must be unlocked before the next session.
    IdentityLockLimit,
    /// This boot counter's numbers are used up; persist a larger one.
    NumbersExhausted,
    /// No such timer is armed.
    TimerNotArmed,
}

/// The outputs of one step, in the order in which they must be carried out.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Outputs(List<Output, MAX_OUTPUTS>);

impl FromIterator<Output> for Outputs {
    /// The first [`MAX_OUTPUTS`] outputs.
    fn from_iter<I: IntoIterator<Item = Output>>(outputs: I) -> Self {
        Self(outputs.into_iter().collect())
    }
}

/// Where the outputs of a step go: into a list, or to one who checks them as they come.
pub(crate) trait Sink {
    /// Adds `output`. A second [`Output::SendRam`] would say the same and is left out.
    fn push(&mut self, output: Output);

    /// Tells the application.
    fn notify(&mut self, notice: Notice) {
        self.push(Output::Notify(notice));
    }
}

impl Sink for Outputs {
    /// The capacity is proved to suffice for every step; see the crate's `valid` module.
    fn push(&mut self, output: Output) {
        let says_all = |output: &Output| matches!(output, Output::SendRam);
        if says_all(&output) && self.iter().any(says_all) {
            return;
        }
        let pushed = self.0.push(output);
        debug_assert!(
            pushed.is_ok(),
            "more than {MAX_OUTPUTS} outputs in one step"
        );
    }
}

impl Outputs {
    /// The outputs in order.
    pub fn iter(&self) -> impl Iterator<Item = &Output> + Clone {
        self.0.iter()
    }

    /// How many outputs there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is no output.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Why the input changed nothing, if so.
    #[must_use]
    pub fn ignored(&self) -> Option<Ignored> {
        self.iter().find_map(|output| match output {
            Output::Ignored(reason) => Some(*reason),
            _ => None,
        })
    }

    /// The notices among the outputs.
    pub fn notices(&self) -> impl Iterator<Item = Notice> {
        self.iter().filter_map(|output| match output {
            Output::Notify(notice) => Some(*notice),
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_are_counted_and_one_ram_says_it_all() {
        let mut outputs = Outputs::default();
        assert_eq!((outputs.len(), outputs.is_empty()), (0, true));
        for output in [Output::SendRam, Output::LockIdentity, Output::SendRam] {
            outputs.push(output);
        }
        assert_eq!((outputs.len(), outputs.is_empty()), (2, false));
        assert!(outputs.iter().eq(&[Output::SendRam, Output::LockIdentity]));
        let listed: Outputs = outputs.iter().copied().collect();
        assert_eq!(listed, outputs);
    }
}
