"""Why something is as it is.

A reason that can be given in several places is one class: `SessionEnded` ends a follower's part as it
closes a corridor. Which reasons can stand where is said by the unions at the end.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TypeAlias

from ._wire import Positional, Variant

# <words>


class Unavailability(enum.Enum):
    """Why a robot takes no part in coordination."""

    LOW_BATTERY = "lowBattery"
    """The battery is below the robot's limit."""
    TELEOPERATED = "teleoperated"
    """A person steers the robot."""
    EMERGENCY_STOP = "emergencyStop"
    """The emergency stop is engaged."""
    LOCAL_FAULT = "localFault"
    """A fault of the robot."""
    NOT_SAFE = "notSafe"
    """The application holds it unsafe to act."""


@dataclass(frozen=True, slots=True)
class OwnStation(Variant):
    """The message carries this robot's own station id."""


@dataclass(frozen=True, slots=True)
class NotAddressed(Variant):
    """The message is meant for another station."""


@dataclass(frozen=True, slots=True)
class OtherSession(Variant):
    """The message names a session that this robot has no part in."""


@dataclass(frozen=True, slots=True)
class NothingNew(Variant):
    """The message repeats what is known."""


@dataclass(frozen=True, slots=True)
class AnsweringAnother(Variant):
    """The session is over, and this robot is naming another one as over or left."""


@dataclass(frozen=True, slots=True)
class OldHeartbeat(Variant):
    """The heartbeat is not newer than the newest one heard."""


@dataclass(frozen=True, slots=True)
class EchoFromFuture(Variant):
    """The echo names a heartbeat that was never sent."""


@dataclass(frozen=True, slots=True)
class OldCommand(Variant):
    """The command is older than the newest one of the session."""


@dataclass(frozen=True, slots=True)
class NotAFollower(Variant):
    """The sender is not a follower in this session."""


@dataclass(frozen=True, slots=True)
class RolesAlreadyAssigned(Variant):
    """The followers are already confirmed."""


@dataclass(frozen=True, slots=True)
class NotOutstanding(Variant):
    """The answer is not for the outstanding command."""


@dataclass(frozen=True, slots=True)
class LowerPrecedence(Variant):
    """The request or leader does not go before this robot's own."""


@dataclass(frozen=True, slots=True)
class FirstHeard(Variant):
    """The request or leader goes before, but is the first that was heard, and its heartbeat is not newer."""


@dataclass(frozen=True, slots=True)
class OtherPlace(Variant):
    """The request or leader is of another place."""


@dataclass(frozen=True, slots=True)
class Yielding(Variant):
    """The leader has yielded already."""


@dataclass(frozen=True, slots=True)
class OldOffer(Variant):
    """The offer is older than the one that stands, or the same RAM takes it back."""


@dataclass(frozen=True, slots=True)
class OtherOffer(Variant):
    """The farewell names an older offer than the one that was confirmed."""


@dataclass(frozen=True, slots=True)
class NeverOffered(Variant):
    """The list names an offer that this robot never made."""


@dataclass(frozen=True, slots=True)
class TimersDoNotFit(Variant):
    """The helper's `t_safety` is too short for this robot's lease."""


@dataclass(frozen=True, slots=True)
class OnDuty(Variant):
    """The robot has a duty on the road, of which its application has not said that it is over."""


@dataclass(frozen=True, slots=True)
class RoadOccupied(Variant):
    """People may be on the road, so no guard is taken off it and no session is renewed."""


@dataclass(frozen=True, slots=True)
class NotEnoughTime(Variant):
    """The identity lock or an execution limit leaves less time than `t_cross`."""


@dataclass(frozen=True, slots=True)
class InSession(Variant):
    """The robot has a part in a session already."""


@dataclass(frozen=True, slots=True)
class NotLeading(Variant):
    """The robot leads no session."""


@dataclass(frozen=True, slots=True)
class NotInSession(Variant):
    """The robot has no part in a session."""


@dataclass(frozen=True, slots=True)
class NotExecuting(Variant):
    """The robot executes no such maneuver."""


@dataclass(frozen=True, slots=True)
class Unavailable(Positional):
    """The robot is unavailable."""

    why: Unavailability


@dataclass(frozen=True, slots=True)
class UnsupportedTask(Variant):
    """The robot can do none of the tasks that are asked for."""


@dataclass(frozen=True, slots=True)
class ImpossibleRequest(Variant):
    """The number of followers is zero or above the limit, or no task is asked for."""


@dataclass(frozen=True, slots=True)
class NotJoined(Variant):
    """The follower has not taken its role yet."""


@dataclass(frozen=True, slots=True)
class CommandOutstanding(Variant):
    """The follower has not acknowledged the command before."""


@dataclass(frozen=True, slots=True)
class CorridorOpen(Variant):
    """The corridor is open already."""


@dataclass(frozen=True, slots=True)
class CorridorClosed(Variant):
    """The corridor is closed already."""


@dataclass(frozen=True, slots=True)
class NotEngaged(Positional):
    """The corridor cannot open because this follower is not engaged."""

    station: int
    why: Disengagement


@dataclass(frozen=True, slots=True)
class FollowerMissing(Variant):
    """The corridor cannot open because fewer followers are left than the task requires."""


@dataclass(frozen=True, slots=True)
class IdentityLocked(Variant):
    """The identity is locked."""


@dataclass(frozen=True, slots=True)
class IdentityLockLimit(Variant):
    """The identity has been locked for too long; it must be unlocked before the next session."""


@dataclass(frozen=True, slots=True)
class NumbersExhausted(Variant):
    """This boot counter's numbers are used up; persist a larger one and tell `EpochRenewed`."""


@dataclass(frozen=True, slots=True)
class TimerNotArmed(Variant):
    """No such timer is armed."""


@dataclass(frozen=True, slots=True)
class Superseded(Variant):
    """A newer command takes its place."""


@dataclass(frozen=True, slots=True)
class Released(Positional):
    """The follower has no part in the session any more."""

    why: ReleaseReason


@dataclass(frozen=True, slots=True)
class TaskCompleted(Variant):
    """The leader named the session as ended: the crossing is completed."""


@dataclass(frozen=True, slots=True)
class SessionEnded(Variant):
    """The leader named the session as ended otherwise."""


@dataclass(frozen=True, slots=True)
class NotListed(Variant):
    """The leader does not list this robot."""


@dataclass(frozen=True, slots=True)
class ReservationExpired(Variant):
    """`T_offer` ran out."""


@dataclass(frozen=True, slots=True)
class ContactLost(Variant):
    """`T_leave` ran out without contact."""


@dataclass(frozen=True, slots=True)
class LeaveRequested(Variant):
    """The application asked to leave."""


@dataclass(frozen=True, slots=True)
class NoHelp(Variant):
    """`T_help` ran out before enough helpers were found."""


@dataclass(frozen=True, slots=True)
class Withdrawn(Positional):
    """The request of this station at the same place goes before, or it leads there already."""

    station: int


@dataclass(frozen=True, slots=True)
class NoFollowers(Variant):
    """No follower is left."""


@dataclass(frozen=True, slots=True)
class Renewed(Variant):
    """The request numbers are used up; a new session follows at once."""


class GoneReason(enum.Enum):
    """Why a leader has dropped a follower."""

    LEFT = "left"
    """It named the session as left."""
    NO_ACKNOWLEDGEMENT = "noAcknowledgement"
    """It did not acknowledge a command, however often it was repeated."""
    NO_CONTACT = "noContact"
    """It was without a lease for too long."""


@dataclass(frozen=True, slots=True)
class Yielded(Positional):
    """The place is yielded to this leader."""

    station: int


@dataclass(frozen=True, slots=True)
class Application(Variant):
    """The application asked for it."""


@dataclass(frozen=True, slots=True)
class NoLease(Variant):
    """The leader has no lease on it."""


@dataclass(frozen=True, slots=True)
class NotGuarding(Variant):
    """Its task does not guard a pedestrian."""


@dataclass(frozen=True, slots=True)
class NotInPosition(Variant):
    """Its task guards from a place, and it has not reported that it is there."""


@dataclass(frozen=True, slots=True)
class Completed(Variant):
    """It finished its task."""


@dataclass(frozen=True, slots=True)
class Failed(Positional):
    """Its task failed."""

    why: Failure


@dataclass(frozen=True, slots=True)
class SafeIdle(Variant):
    """It fell back for lack of contact."""


@dataclass(frozen=True, slots=True)
class Maneuver(Variant):
    """The robot could not do it."""


@dataclass(frozen=True, slots=True)
class ExecutionLimit(Variant):
    """The leader's execution limit `T_exec` ran out. Never in a RAM."""


Ignored: TypeAlias = (
    OwnStation
    | NotAddressed
    | OtherSession
    | NothingNew
    | AnsweringAnother
    | OldHeartbeat
    | EchoFromFuture
    | OldCommand
    | NotAFollower
    | RolesAlreadyAssigned
    | NotOutstanding
    | LowerPrecedence
    | FirstHeard
    | OtherPlace
    | Yielding
    | OldOffer
    | OtherOffer
    | NeverOffered
    | TimersDoNotFit
    | OnDuty
    | RoadOccupied
    | NotEnoughTime
    | InSession
    | NotLeading
    | NotInSession
    | NotExecuting
    | Unavailable
    | UnsupportedTask
    | ImpossibleRequest
    | NotJoined
    | CommandOutstanding
    | CorridorOpen
    | CorridorClosed
    | NotEngaged
    | FollowerMissing
    | IdentityLocked
    | IdentityLockLimit
    | NumbersExhausted
    | TimerNotArmed
)
"""Why an input changed nothing."""


StopReason: TypeAlias = Superseded | Released | Unavailable
"""Why a maneuver is stopped."""


ReleaseReason: TypeAlias = (
    TaskCompleted
    | SessionEnded
    | NotListed
    | ReservationExpired
    | ContactLost
    | LeaveRequested
    | Unavailable
    | IdentityLockLimit
)
"""Why a helper or follower has no part in a session any more."""


EndReason: TypeAlias = (
    TaskCompleted
    | NoHelp
    | Withdrawn
    | NoFollowers
    | LeaveRequested
    | Unavailable
    | IdentityLockLimit
    | Renewed
)
"""Why a session ended."""


CorridorClosure: TypeAlias = NotEngaged | FollowerMissing | SessionEnded | Yielded | Application
"""Why the corridor closed."""


Disengagement: TypeAlias = (
    NoLease | CommandOutstanding | NotExecuting | NotGuarding | NotInPosition | Completed | Failed | SafeIdle
)
"""Why a follower does not hold the corridor."""


Failure: TypeAlias = Maneuver | Unavailable | ExecutionLimit
"""Why a maneuver ended without success."""


Rejection: TypeAlias = UnsupportedTask | Unavailable | OnDuty
"""Why a follower rejects a command."""


# </words>
