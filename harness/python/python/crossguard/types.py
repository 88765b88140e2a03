"""States, roles, tasks and ids: what inputs, outputs and messages are made of.

A station id is an `int`, 0..4294967295 (`StationId` of ETSI TS 102 894-2); a `requestID` is an `int`,
0..255; times are `int` in milliseconds and their names end with `_ms`.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TypeAlias

from . import reasons
from ._wire import Variant

# <words>


class State(enum.Enum):
    """The state of the paper's finite-state model."""

    IDLE = "Idle"
    """Stages 1 and 5: no part in a session."""
    HELP_REQUESTED = "HelpRequested"
    """Stage 2: asks for help, or offers it."""
    ROLE_ESTABLISHED = "RoleEstablished"
    """Stage 3: has a role; nothing is executed."""
    MANEUVER_EXECUTING = "ManeuverExecuting"
    """Stage 4: a maneuver is executed."""


class Role(enum.Enum):
    """A robot's role in a session."""

    NONE = "none"
    """No part in a session."""
    REQUESTER = "requester"
    """Asks for help."""
    HELPER = "helper"
    """Offers help."""
    LEADER = "leader"
    """Leads."""
    FOLLOWER = "follower"
    """Follows."""


class Urgency(enum.Enum):
    """How urgent a request for help is, lowest first."""

    LOW = "low"
    """Nobody waits at the kerb yet."""
    MEDIUM = "medium"
    """A pedestrian waits."""
    HIGH = "high"
    """A pedestrian who needs more help than others waits."""
    EMERGENCY = "emergency"
    """A pedestrian is on the road."""


class FallbackPolicy(enum.Enum):
    """A follower's act with a running maneuver at every end but a completed crossing: contact lost, session
    aborted, left, or not listed any more."""

    STOP_IN_PLACE = "stopInPlace"
    """Stop where it stands."""
    GO_TO_SAFE_POSITION = "goToSafePosition"
    """Leave the carriageway for the safe position that the application knows."""
    ESCORT_TO_KERB = "escortToKerb"
    """Stay at the side of the escorted person to the nearer kerb, then stop."""
    HOLD_UNTIL_CLEAR = "holdUntilClear"
    """Hold the position and the traffic until the carriageway is clear, then stop."""


# </words>


class TaskType(enum.IntEnum):
    """The kind of a maneuver, `taskType` of the paper. Those with a description have names; a robot may
    give meaning to the others."""

    # <named tasks>
    INITIAL_POS = 0
    """Go to the place where the maneuver starts."""
    MOVE = 1
    """Escort: move along with the pedestrian."""
    BLOCK = 2
    """Hold back one direction of traffic."""
    TASK3 = 3
    TASK4 = 4
    TASK5 = 5
    TASK6 = 6
    TASK7 = 7
    TASK8 = 8
    TASK9 = 9
    TASK10 = 10
    TASK11 = 11
    TASK12 = 12
    TASK13 = 13
    TASK14 = 14
    TASK15 = 15
    # </named tasks>


class TaskSet(enum.IntFlag):
    """A set of task types: bit *n* stands for task type *n*. `TaskSet.MOVE | TaskSet.BLOCK`."""

    NONE = 0
    # <task bits>
    INITIAL_POS = 1 << 0
    MOVE = 1 << 1
    BLOCK = 1 << 2
    TASK3 = 1 << 3
    TASK4 = 1 << 4
    TASK5 = 1 << 5
    TASK6 = 1 << 6
    TASK7 = 1 << 7
    TASK8 = 1 << 8
    TASK9 = 1 << 9
    TASK10 = 1 << 10
    TASK11 = 1 << 11
    TASK12 = 1 << 12
    TASK13 = 1 << 13
    TASK14 = 1 << 14
    TASK15 = 1 << 15
    # </task bits>


@dataclass(frozen=True, slots=True)
class UniqueNumber:
    """A number that its station never gives out twice."""

    boot: int
    """Boot counter of the station that gave the number out, 0..65535."""
    count: int
    """Count since that boot, from 0, 0..65535."""

    def __str__(self) -> str:
        return f"{self.boot}.{self.count}"


@dataclass(frozen=True, slots=True)
class SessionId:
    """A coordination session: who leads it, and its number there."""

    leader: int
    """Station id of the leader."""
    number: UniqueNumber
    """Its number for the session."""

    def __str__(self) -> str:
        return f"{self.leader}#{self.number}"


@dataclass(frozen=True, slots=True)
class ManeuverId:
    """One accepted command."""

    session: SessionId
    """The session in which the command was given."""
    request: int
    """`requestID` of the command, 0..255."""

    def __str__(self) -> str:
        return f"{self.session}/{self.request}"


@dataclass(frozen=True, slots=True)
class Maneuver:
    """A maneuver of this robot."""

    id: ManeuverId
    """The command it belongs to."""
    task: TaskType
    """What to do."""


@dataclass(frozen=True, slots=True)
class HelpRequest:
    """What a leader asks for when it has detected a pedestrian."""

    urgency: Urgency = Urgency.MEDIUM
    """How urgent it is; the first key in the order of requests."""
    followers: int = 1
    """How many followers the task needs, 1..4."""
    tasks: TaskSet = TaskSet.INITIAL_POS | TaskSet.MOVE
    """The maneuvers that the followers will be asked for."""
    place: int = 0
    """The crossing that the help is for, as `IntersectionReferenceID` of ISO/TS 19091: road regulator in
    the upper 16 bits, intersection in the lower. Requests of one place compete. 0 is not known, and may be
    any place."""


@dataclass(frozen=True, slots=True)
class Available(Variant):
    """The robot takes part in coordination."""


Availability: TypeAlias = Available | reasons.Unavailable
