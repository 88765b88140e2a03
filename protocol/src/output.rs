//! Outputs of the transition function.

use crate::MAX_OUTPUTS;
use crate::id::{ManeuverId, SessionId, StationId};
use crate::list::List;
use crate::message::{Failure, Rejection, Rmcm};
use crate::task::{FallbackPolicy, TaskType, Unavailability};
use crate::time::Millis;
use crate::words::words;

words! {
    /// One output of the transition function.
    pub enum Output as OutputKind #[repr(u8)] {
        /// Send a RAM now, with `Robot::ram` of the state after this step.
        SendRam = 0, "send RAM";
        /// Send this RMCM now.
        SendRmcm(rmcm: Rmcm) = 12, "send {rmcm}";
        /// Start this maneuver. The acknowledgement stands before it in the list.
        StartManeuver(maneuver: Maneuver) = 1, "start {maneuver}";
        /// Stop this maneuver.
        StopManeuver(maneuver: Maneuver, why: StopReason) = 2, "stop {maneuver}: {why}";
        /// End this maneuver by the task's policy. The robot is on duty until the application says
        /// `RoadClear`.
        FallBack(maneuver: Maneuver, policy: FallbackPolicy) = 3, "fall back from {maneuver}: {policy}";
        /// The pedestrian may cross from now on, for this long. The sign must end by itself then, without this
        /// robot's help.
        CorridorOpened(left: Millis) = 4, "corridor opened for {left}";
        /// The pedestrian may go on crossing, for this long from now.
        CorridorExtended(left: Millis) = 5, "corridor open for another {left}";
        /// The pedestrian may not cross from now on. People may still be on the road.
        CorridorClosed(why: CorridorClosure) = 6, "corridor closed: {why}";
        /// Keep station id, certificate and link address from now on.
        LockIdentity = 7;
        /// Station id, certificate and link address may change again.
        UnlockIdentity = 8;
        /// Half of this boot counter's numbers are given out: persist a larger one, and then tell
        /// `EpochRenewed`.
        RenewEpoch = 9, "renew the boot counter";
        /// Tell the application.
        Notify(notice: Notice) = 10, "{notice}";
        /// The input changed nothing, for this reason.
        Ignored(why: Ignored) = 11, "ignored: {why}";
    }
}

/// A maneuver of this robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Maneuver {
    /// The command it belongs to.
    pub id: ManeuverId,
    /// Its task.
    pub task: TaskType,
}

words! {
    /// Why a maneuver is stopped.
    pub enum StopReason as StopReasonKind #[derive(PartialOrd, Ord)] {
        /// A newer command takes its place.
        Superseded = 1;
        /// The follower has no part in the session any more.
        Released(why: ReleaseReason) = 0, "released({why})";
        /// The robot became unavailable.
        Unavailable(why: Unavailability) = 7, "unavailable({why})";
    }
}

words! {
    /// Why the corridor closed.
    pub enum CorridorClosure as CorridorClosureKind #[derive(PartialOrd, Ord)] {
        /// A follower is not engaged any more.
        NotEngaged(station: StationId, why: Disengagement) = 0, "station {station} is {why}";
        /// Fewer followers are left than the task requires.
        FollowerMissing = 18;
        /// The session ended.
        SessionEnded = 2;
        /// The place is yielded to this leader.
        Yielded(station: StationId) = 19, "yielded to station {station}";
        /// The application asked for it.
        Application = 20;
    }
}

words! {
    /// Why a follower does not hold the corridor.
    pub enum Disengagement as DisengagementKind #[derive(PartialOrd, Ord)] {
        /// The leader has no lease on it.
        NoLease = 21, "out of contact";
        /// It has a command that it has not acknowledged.
        CommandOutstanding = 22, "yet to acknowledge a command";
        /// It has no acknowledged command, or has not reported progress on it yet.
        NotExecuting = 23, "not executing anything";
        /// Its task does not guard a pedestrian.
        NotGuarding = 24, "not guarding anybody";
        /// Its task guards from a place, and it has not reported that it is there.
        NotInPosition = 25, "not in position";
        /// It finished its task.
        Completed = 26, "done with its task";
        /// Its task failed.
        Failed(why: Failure) = 0, "unable to do its task: {why}";
        /// It fell back for lack of contact.
        SafeIdle = 29, "idle in safety";
    }
}

words! {
    /// News for the application.
    pub enum Notice as NoticeKind {
        /// Leader: the followers are confirmed; the session has its roles.
        RolesEstablished(session: SessionId) = 1, "roles established in {session}";
        /// Leader: this follower has taken its role.
        FollowerJoined(station: StationId) = 2, "station {station} joined";
        /// Leader: this follower has no part in the session any more.
        FollowerGone(station: StationId, why: GoneReason) = 3, "station {station} gone: {why}";
        /// Leader: this follower's lease stands.
        LeaseGranted(station: StationId) = 4, "lease on station {station} granted";
        /// Leader: this follower's lease has run out.
        LeaseExpired(station: StationId) = 5, "lease on station {station} expired";
        /// Leader: this follower acknowledged this command.
        CommandAcknowledged(station: StationId, id: ManeuverId) = 6, "station {station} acknowledged {id}";
        /// Leader: this follower rejected this command.
        CommandRejected(station: StationId, id: ManeuverId, why: Rejection) = 7, "station {station} rejected {id}: {why}";
        /// Leader: this follower reports that it executes this command.
        ManeuverReported(station: StationId, id: ManeuverId) = 8, "station {station} executes {id}";
        /// Leader: this follower reports that it guards from its place.
        ManeuverInPosition(station: StationId, id: ManeuverId) = 9, "station {station} in position for {id}";
        /// Leader: this follower finished this command.
        ManeuverCompleted(station: StationId, id: ManeuverId) = 10, "station {station} completed {id}";
        /// Leader: this command failed.
        ManeuverFailed(station: StationId, id: ManeuverId, why: Failure) = 11, "station {station} failed {id}: {why}";
        /// Leader: this follower fell back; it is idle in safety.
        FollowerSafeIdle(station: StationId, id: ManeuverId) = 12, "station {station} fell back from {id}";
        /// Requester: the offer of this helper has lapsed.
        OfferLapsed(station: StationId) = 13, "the offer of station {station} has lapsed";
        /// Leader: yields the place to this leader. The session ends once the road is clear.
        Yielded(station: StationId) = 14, "place yielded to station {station}";
        /// Requester or leader: the session is over.
        SessionEnded(session: SessionId, why: EndReason) = 15, "{session} ended: {why}";
        /// Helper: offers to take part in this session.
        Offering(session: SessionId) = 16, "offering to {session}";
        /// Follower: takes part in this session.
        Joined(session: SessionId) = 17, "joined {session}";
        /// Helper or follower: has no part in this session any more.
        Released(session: SessionId, why: ReleaseReason) = 18, "released from {session}: {why}";
        /// Follower: contact with the leader is lost.
        ContactLost(session: SessionId) = 19, "contact lost in {session}";
        /// Follower: contact with the leader is back.
        ContactRegained(session: SessionId) = 20, "contact regained in {session}";
    }
}

words! {
    /// Why a session ended.
    pub enum EndReason as EndReasonKind #[derive(PartialOrd, Ord)] {
        /// The application said that the task is done.
        TaskCompleted = 9;
        /// `T_help` ran out before enough helpers were found.
        NoHelp = 10;
        /// The request of this station at the same place goes before, or it leads there already.
        Withdrawn(station: StationId) = 11, "withdrawn for station {station}";
        /// No follower is left.
        NoFollowers = 12;
        /// The application asked to leave.
        LeaveRequested = 6;
        /// The leader became unavailable.
        Unavailable(why: Unavailability) = 7, "unavailable({why})";
        /// The identity must be unlocked.
        IdentityLockLimit = 8;
        /// The request numbers are used up; a new session follows at once.
        Renewed = 13;
    }
}

words! {
    /// Why a helper or follower has no part in a session any more.
    pub enum ReleaseReason as ReleaseReasonKind #[derive(PartialOrd, Ord)] {
        /// The leader named the session as ended: the crossing is completed.
        TaskCompleted = 9;
        /// The leader named the session as ended otherwise.
        SessionEnded = 2;
        /// The leader does not list this robot.
        NotListed = 3;
        /// `T_offer` ran out.
        ReservationExpired = 4;
        /// `T_leave` ran out without contact.
        ContactLost = 5;
        /// The application asked to leave.
        LeaveRequested = 6;
        /// The robot became unavailable.
        Unavailable(why: Unavailability) = 7, "unavailable({why})";
        /// The identity must be unlocked.
        IdentityLockLimit = 8;
    }
}

words! {
    /// Why a leader has dropped a follower.
    pub enum GoneReason #[derive(PartialOrd, Ord)] {
        /// It named the session as left.
        Left = 14;
        /// It did not acknowledge a command, however often it was repeated.
        NoAcknowledgement = 15;
        /// It was without a lease for too long.
        NoContact = 16;
    }
}

words! {
    /// Why an input changed nothing.
    pub enum Ignored as IgnoredKind #[derive(PartialOrd, Ord)] {
        /// The message carries this robot's own station id.
        OwnStation = 30;
        /// The message is meant for another station.
        NotAddressed = 31;
        /// The message names a session that this robot has no part in.
        OtherSession = 32;
        /// The message repeats what is known.
        NothingNew = 33;
        /// The session is over, and this robot is naming another one as over or left.
        AnsweringAnother = 61;
        /// The heartbeat is not newer than the newest one heard.
        OldHeartbeat = 34;
        /// The echo names a heartbeat that was never sent.
        EchoFromFuture = 35;
        /// The command is older than the newest one of the session.
        OldCommand = 36;
        /// The sender is not a follower in this session.
        NotAFollower = 37;
        /// The followers are already confirmed.
        RolesAlreadyAssigned = 38;
        /// The answer is not for the outstanding command.
        NotOutstanding = 39;
        /// The request or leader does not go before this robot's own.
        LowerPrecedence = 40;
        /// The request or leader goes before, but is the first that was heard, and its heartbeat is not newer.
        FirstHeard = 41;
        /// The request or leader is of another place.
        OtherPlace = 42;
        /// The leader has yielded already.
        Yielding = 43;
        /// The offer is older than the one that stands, or the same RAM takes it back.
        OldOffer = 44;
        /// The farewell names an older offer than the one that was confirmed.
        OtherOffer = 45;
        /// The list names an offer that this robot never made.
        NeverOffered = 46;
        /// The helper's `t_safety` is too short for this robot's lease.
        TimersDoNotFit = 47;
        /// The robot has a duty on the road, of which its application has not said that it is over.
        OnDuty = 48;
        /// People may be on the road, so no guard is taken off it and no session is renewed.
        RoadOccupied = 49;
        /// The identity lock or an execution limit leaves less time than `t_cross`.
        NotEnoughTime = 50;
        /// The robot has a part in a session already.
        InSession = 51;
        /// The robot leads no session.
        NotLeading = 52;
        /// The robot has no part in a session.
        NotInSession = 53;
        /// The robot executes no such maneuver.
        NotExecuting = 23;
        /// The robot is unavailable.
        Unavailable(why: Unavailability) = 7, "unavailable, {why}";
        /// The robot can do none of the tasks that are asked for.
        UnsupportedTask = 17;
        /// The number of followers is zero or above the limit, or no task is asked for.
        ImpossibleRequest = 54;
        /// The follower has not taken its role yet.
        NotJoined = 55;
        /// The follower has not acknowledged the command before.
        CommandOutstanding = 22;
        /// The corridor is open already.
        CorridorOpen = 56;
        /// The corridor is closed already.
        CorridorClosed = 57;
        /// The corridor cannot open because this follower is not engaged.
        NotEngaged(station: StationId, why: Disengagement) = 0, "station {station} is {why}";
        /// The corridor cannot open because fewer followers are left than the task requires.
        FollowerMissing = 18;
        /// The identity is locked.
        IdentityLocked = 58;
        /// The identity has been locked for too long; it must be unlocked before the next session.
        IdentityLockLimit = 8;
        /// This boot counter's numbers are used up; persist a larger one and tell `EpochRenewed`.
        NumbersExhausted = 59;
        /// No such timer is armed.
        TimerNotArmed = 60;
    }
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

    /// True if there is no output.
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
