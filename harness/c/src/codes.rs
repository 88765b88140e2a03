//! What the codes that cross the boundary mean. Those of the protocol's words are written from its table.

/// What became of a call.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u32)]
pub enum CrossguardStatus {
    /// It did what it is for.
    Ok = 0,
    /// A pointer that must point to something is null.
    Null = 1,
    /// A buffer is too short; nothing has happened.
    ShortBuffer = 2,
    /// Header and library are of different versions, or the robot was made by another version.
    WrongVersion = 3,
    /// The robot was never initialised, or its memory has been overwritten.
    NotInitialised = 4,
    /// The robot was finished.
    Finished = 5,
    /// A pointer is not aligned as its type demands.
    Misaligned = 6,
    /// A code is none of its enumeration, or a number is out of range; nothing has happened.
    BadArgument = 7,
    /// The settings break an inequality; `crossguard_config_check` says which.
    BrokenSettings = 8,
    /// There is no more.
    End = 9,
    /// The library was built without this.
    Unsupported = 10,
}

/// Task types that have names; a robot may give meaning to the others, up to 15.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardTask {
    // <named tasks>
    /// Go to the place where the maneuver starts.
    InitialPos = 0,
    /// Escort: move along with the pedestrian.
    Move = 1,
    /// Hold back one direction of traffic.
    Block = 2,
    // </named tasks>
}

/// A duty on the road that outlives its command or its session. It ends with an event `RoadClear`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardDuty {
    /// None.
    None = 0,
    /// The body carries out the fallback of a maneuver.
    FallingBack = 1,
    /// The robot led a session that ended while people may have been on the road.
    Crossing = 2,
}

/// A message of robots.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardMessage {
    /// None.
    None = 0,
    /// Robot awareness message.
    Ram = 1,
    /// Robot maneuver coordination message.
    Rmcm = 2,
}

// <words>

/// The state of the paper's finite-state model.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardState {
    /// Stages 1 and 5: no part in a session.
    Idle = 0,
    /// Stage 2: asks for help, or offers it.
    HelpRequested = 1,
    /// Stage 3: has a role; nothing is executed.
    RoleEstablished = 2,
    /// Stage 4: a maneuver is executed.
    ManeuverExecuting = 3,
}

/// A robot's role in a session.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardRole {
    /// No part in a session.
    None = 0,
    /// Asks for help.
    Requester = 1,
    /// Offers help.
    Helper = 2,
    /// Leads.
    Leader = 3,
    /// Follows.
    Follower = 4,
}

/// How urgent a request for help is, lowest first.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardUrgency {
    /// Nobody waits at the kerb yet.
    Low = 0,
    /// A pedestrian waits.
    Medium = 1,
    /// A pedestrian who needs more help than others waits.
    High = 2,
    /// A pedestrian is on the road.
    Emergency = 3,
}

/// What a follower does with a running maneuver at every end but a completed crossing: contact lost, session aborted, left, or not listed any more.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardFallback {
    /// Stop where it stands.
    StopInPlace = 0,
    /// Leave the carriageway for the safe position that the application knows.
    GoToSafePosition = 1,
    /// Stay at the side of the escorted person to the nearer kerb, then stop.
    EscortToKerb = 2,
    /// Hold the position and the traffic until the carriageway is clear, then stop.
    HoldUntilClear = 3,
}

/// The corridor of a leader.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardCorridor {
    /// Nobody may cross, and nobody is on the road.
    Clear = 0,
    /// The pedestrian may cross.
    Open = 1,
    /// Nobody may cross any more, and people may still be on the road.
    Clearing = 2,
}

/// An event of the robot's own application.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardEventKind {
    /// A pedestrian needs help that takes more robots than this one. With `urgency`, `followers`, `tasks`, `place`.
    PedestrianDetected = 0,
    /// The leader's application wants a follower to do a maneuver. With `station`, `task`, `parameters`.
    CommandManeuver = 1,
    /// The body holds the place from which the maneuver that was started guards. To be told only when the body is there: the leader lets people on the road by it. With `session`, `request`.
    InPosition = 2,
    /// The maneuver that was started has been finished. With `session`, `request`.
    ManeuverCompleted = 3,
    /// The maneuver that was started cannot be finished. With `session`, `request`.
    ManeuverFailed = 4,
    /// The pedestrian has crossed and nobody is on the road; the session may end. It takes the guards off the road.
    TaskCompleted = 5,
    /// The people that this robot guarded are off the road, and its body has finished its fallback. To be told only when both are so: it ends the robot's duty.
    RoadClear = 6,
    /// The requester knows of no robot nearby that has not answered its request.
    AllAnswered = 7,
    /// The robot wants to leave whatever session it is in.
    LeaveRequested = 8,
    /// The robot became available or unavailable. With `unavailability`.
    AvailabilityChanged = 9,
    /// The leader's application wants to let the pedestrian cross.
    OpenCorridor = 10,
    /// The leader's application wants to hold the pedestrian back again.
    CloseCorridor = 11,
    /// The robot has changed its pseudonym; only possible while the identity is not locked. Where a number is given, those of its sessions and offers begin anew there, so that they do not tell that the two pseudonyms are one robot. Under this station id, no number from there on may have been given out before. With `station`, `session.number`.
    IdentityChanged = 12,
    /// A larger boot counter has been persisted, as the output `RenewEpoch` asked. With `boot`.
    EpochRenewed = 13,
    /// The body does not hold the place any more from which the maneuver guards. To be told as soon as it may be so: the leader lets nobody on the road any more. With `session`, `request`.
    OutOfPosition = 14,
    /// Somebody is on the road, seen by this follower itself. Until it tells `RoadClear` it stays, however its leader ends the session.
    PersonOnRoad = 15,
}

/// Why a robot takes no part in coordination.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardUnavailability {
    /// It takes part.
    None = 0,
    /// The battery is below the robot's limit.
    LowBattery = 1,
    /// A person steers the robot.
    Teleoperated = 2,
    /// The emergency stop is engaged.
    EmergencyStop = 3,
    /// A fault of the robot.
    LocalFault = 4,
    /// The application holds it unsafe to act.
    NotSafe = 5,
}

/// How far a command is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardProgress {
    /// There is none, or it was not acknowledged.
    None = 0,
    /// It is acknowledged, and nothing is reported yet.
    Acknowledged = 1,
    /// The maneuver runs, and the body is under way.
    Executing = 2,
    /// The maneuver runs, and the body holds the place from which it guards.
    InPosition = 3,
    /// It was finished.
    Completed = 4,
    /// It ended without success.
    Failed = 5,
    /// It was stopped by the fallback policy because contact with the leader was lost.
    SafeIdle = 6,
}

/// News for the application.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardNotice {
    /// None.
    None = 0,
    /// Leader: the followers are confirmed; the session has its roles. With `session`.
    RolesEstablished = 1,
    /// Leader: this follower has taken its role. With `station`.
    FollowerJoined = 2,
    /// Leader: this follower has no part in the session any more. With `station`, `reason`.
    FollowerGone = 3,
    /// Leader: this follower's lease stands. With `station`.
    LeaseGranted = 4,
    /// Leader: this follower's lease has run out. With `station`.
    LeaseExpired = 5,
    /// Leader: this follower acknowledged this command. With `station`, `session`, `request`.
    CommandAcknowledged = 6,
    /// Leader: this follower rejected this command. With `station`, `session`, `request`, `reason`.
    CommandRejected = 7,
    /// Leader: this follower reports that it executes this command. With `station`, `session`, `request`.
    ManeuverReported = 8,
    /// Leader: this follower reports that it guards from its place. With `station`, `session`, `request`.
    ManeuverInPosition = 9,
    /// Leader: this follower finished this command. With `station`, `session`, `request`.
    ManeuverCompleted = 10,
    /// Leader: this command failed. With `station`, `session`, `request`, `reason`.
    ManeuverFailed = 11,
    /// Leader: this follower fell back; it is idle in safety. With `station`, `session`, `request`.
    FollowerSafeIdle = 12,
    /// Requester: the offer of this helper has lapsed. With `station`.
    OfferLapsed = 13,
    /// Leader: yields the place to this leader. The session ends once the road is clear. With `station`.
    Yielded = 14,
    /// Requester or leader: the session is over. With `session`, `reason`, `station`.
    SessionEnded = 15,
    /// Helper: offers to take part in this session. With `session`.
    Offering = 16,
    /// Follower: takes part in this session. With `session`.
    Joined = 17,
    /// Helper or follower: has no part in this session any more. With `session`, `reason`.
    Released = 18,
    /// Follower: contact with the leader is lost. With `session`.
    ContactLost = 19,
    /// Follower: contact with the leader is back. With `session`.
    ContactRegained = 20,
}

/// What the robot is to do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardOutputKind {
    /// Send a packet: `message`, and where packet and message are among the packets of the turn.
    Send = 0,
    /// Start this maneuver. The acknowledgement stands before it in the list. With `session`, `request`, `task`.
    StartManeuver = 1,
    /// Stop this maneuver. With `session`, `request`, `task`, `reason`.
    StopManeuver = 2,
    /// End this maneuver by the task's policy. The robot is on duty until the application says `RoadClear`. With `session`, `request`, `task`, `policy`.
    FallBack = 3,
    /// The pedestrian may cross from now on, for this long. What shows it must end by itself then, without this robot's help. With `open_ms`.
    CorridorOpened = 4,
    /// The pedestrian may go on crossing, for this long from now. With `open_ms`.
    CorridorExtended = 5,
    /// The pedestrian may not cross from now on. People may still be on the road. With `reason`, `station`.
    CorridorClosed = 6,
    /// Keep station id, certificate and link address from now on.
    LockIdentity = 7,
    /// Station id, certificate and link address may change again.
    UnlockIdentity = 8,
    /// Half of this boot counter's numbers are given out: persist a larger one, and then tell `EpochRenewed`.
    RenewEpoch = 9,
    /// Tell the application. With `notice`.
    Notice = 10,
    /// The input changed nothing, for this reason. With `reason`, `station`.
    Ignored = 11,
}

/// Why something is as it is. With `Unavailable`, the output's `unavailability` says more.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardReason {
    /// None is given.
    None = 0,
    /// A newer command takes its place.
    Superseded = 1,
    /// The leader named the session as ended otherwise.
    SessionEnded = 2,
    /// The leader does not list this robot.
    NotListed = 3,
    /// `T_offer` ran out.
    ReservationExpired = 4,
    /// `T_leave` ran out without contact.
    ContactLost = 5,
    /// The application asked to leave.
    LeaveRequested = 6,
    /// The robot is unavailable.
    Unavailable = 7,
    /// The identity has been locked for too long; it must be unlocked before the next session.
    IdentityLockLimit = 8,
    /// The leader named the session as ended: the crossing is completed.
    TaskCompleted = 9,
    /// `T_help` ran out before enough helpers were found.
    NoHelp = 10,
    /// The request of this station at the same place goes before, or it leads there already.
    Withdrawn = 11,
    /// No follower is left.
    NoFollowers = 12,
    /// The request numbers are used up; a new session follows at once.
    Renewed = 13,
    /// It named the session as left.
    Left = 14,
    /// It did not acknowledge a command, however often it was repeated.
    NoAcknowledgement = 15,
    /// It was without a lease for too long.
    NoContact = 16,
    /// The robot can do none of the tasks that are asked for.
    UnsupportedTask = 17,
    /// The corridor cannot open because fewer followers are left than the task requires.
    FollowerMissing = 18,
    /// The place is yielded to this leader.
    Yielded = 19,
    /// The application asked for it.
    Application = 20,
    /// The leader has no lease on it.
    NoLease = 21,
    /// The follower has not acknowledged the command before.
    CommandOutstanding = 22,
    /// The robot executes no such maneuver.
    NotExecuting = 23,
    /// Its task does not guard a pedestrian.
    NotGuarding = 24,
    /// Its task guards from a place, and it has not reported that it is there.
    NotInPosition = 25,
    /// It finished its task.
    Completed = 26,
    /// The robot could not do it.
    ManeuverFailed = 27,
    /// The leader's execution limit `T_exec` ran out. Never in a RAM.
    ExecutionLimit = 28,
    /// It fell back for lack of contact.
    SafeIdle = 29,
    /// The message carries this robot's own station id.
    OwnStation = 30,
    /// The message is meant for another station.
    NotAddressed = 31,
    /// The message names a session that this robot has no part in.
    OtherSession = 32,
    /// The message repeats what is known.
    NothingNew = 33,
    /// The heartbeat is not newer than the newest one heard.
    OldHeartbeat = 34,
    /// The echo names a heartbeat that was never sent.
    EchoFromFuture = 35,
    /// The command is older than the newest one of the session.
    OldCommand = 36,
    /// The sender is not a follower in this session.
    NotAFollower = 37,
    /// The followers are already confirmed.
    RolesAlreadyAssigned = 38,
    /// The answer is not for the outstanding command.
    NotOutstanding = 39,
    /// The request or leader does not go before this robot's own.
    LowerPrecedence = 40,
    /// The request or leader goes before, but is the first that was heard, and its heartbeat is not newer.
    FirstHeard = 41,
    /// The request or leader is of another place.
    OtherPlace = 42,
    /// The leader has yielded already.
    Yielding = 43,
    /// The offer is older than the one that stands, or the same RAM takes it back.
    OldOffer = 44,
    /// The farewell names an older offer than the one that was confirmed.
    OtherOffer = 45,
    /// The list names an offer that this robot never made.
    NeverOffered = 46,
    /// The helper's `t_safety` is too short for this robot's lease.
    TimersDoNotFit = 47,
    /// The robot has a duty on the road, of which its application has not said that it is over.
    OnDuty = 48,
    /// People may be on the road, so no guard is taken off it and no session is renewed.
    RoadOccupied = 49,
    /// The identity lock or an execution limit leaves less time than `t_cross`.
    NotEnoughTime = 50,
    /// The robot has a part in a session already.
    InSession = 51,
    /// The robot leads no session.
    NotLeading = 52,
    /// The robot has no part in a session.
    NotInSession = 53,
    /// The number of followers is zero or above the limit, or no task is asked for.
    ImpossibleRequest = 54,
    /// The follower has not taken its role yet.
    NotJoined = 55,
    /// The corridor is open already.
    CorridorOpen = 56,
    /// The corridor is closed already.
    CorridorClosed = 57,
    /// The identity is locked.
    IdentityLocked = 58,
    /// This boot counter's numbers are used up; persist a larger one and tell `EpochRenewed`.
    NumbersExhausted = 59,
    /// No such timer is armed.
    TimerNotArmed = 60,
    /// The session is over, and this robot is naming another one as over or left.
    AnsweringAnother = 61,
}
// </words>
