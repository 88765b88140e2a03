"""What RAM and RMCM say about coordination: what the transition function reads and writes.

Positions, sizes and everything else that no rule of the protocol depends on is in the whole message,
which `crossguard.decode` gives as a dictionary.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from ._wire import Positional, Variant
from .reasons import Completed, Failed, Rejection, SafeIdle
from .types import HelpRequest, SessionId, TaskSet, TaskType, UniqueNumber, Urgency


@dataclass(frozen=True, slots=True)
class NoPart(Variant):
    """`helpStatus = none`: no part in a session. It releases nobody from anything."""

    _name: ClassVar[str] = "none"


@dataclass(frozen=True, slots=True)
class NeedHelp(Variant):
    """`helpStatus = needHelp`: opens a session of its own and asks for followers."""

    number: UniqueNumber
    """Number of the session."""
    heartbeat: int
    """Newest heartbeat, 0..65535: it tells a request that stands from a late message."""
    request: HelpRequest
    """What it asks for."""


@dataclass(frozen=True, slots=True)
class OfferHelp(Variant):
    """`helpStatus = offerHelp`: reserved for one requester."""

    session: SessionId
    """The session that the offer is for."""
    offer: UniqueNumber
    """Number of the offer; the confirmation repeats it."""
    capabilities: TaskSet
    """The maneuvers that the helper can do."""
    echo: int
    """Newest heartbeat of the request that it heard, 0..65535."""
    t_safety_ms: int
    """Its own `t_safety`, which the leader's lease must fit."""


@dataclass(frozen=True, slots=True)
class Confirmation:
    """A confirmed follower."""

    station: int
    """Its station id."""
    offer: UniqueNumber
    """The offer that is confirmed."""


@dataclass(frozen=True, slots=True)
class Leader(Variant):
    """`RoleConfirmed`: leads a session and names its followers."""

    number: UniqueNumber
    """Number of the session."""
    heartbeat: int
    """Newest heartbeat, 0..65535."""
    followers: tuple[Confirmation, ...]
    """The followers, 4 at most; any other robot has no part in the session."""
    urgency: Urgency
    """Urgency of the request; the first key in the order of leaders at one place."""
    place: int
    """The crossing of the session."""
    yields: bool
    """Whether it has yielded the place to another leader and lets nobody cross any more."""


@dataclass(frozen=True, slots=True)
class Executing(Variant):
    """The maneuver runs, and the body is under way."""


@dataclass(frozen=True, slots=True)
class InPosition(Variant):
    """The maneuver runs, and the body holds the place from which it guards."""


Progress: TypeAlias = Executing | InPosition | Completed | Failed | SafeIdle
"""Progress of an accepted command."""


@dataclass(frozen=True, slots=True)
class Report:
    """How far a follower is with its newest accepted command."""

    request: int
    """`requestID` of the command."""
    progress: Progress
    """How far it is."""


@dataclass(frozen=True, slots=True)
class Follower(Variant):
    """Follows the leader of a session."""

    session: SessionId
    """The session it follows in."""
    echo: int
    """Newest heartbeat that it heard, 0..65535."""
    last: Report | None
    """Newest command that it accepted, and how far it is."""


Coordination: TypeAlias = NoPart | NeedHelp | OfferHelp | Leader | Follower
"""A robot's part in a session, as its RAM tells."""


class Ending(enum.Enum):
    """How a session ended."""

    COMPLETED = "completed"
    """The crossing is completed and the road is clear: followers are free."""
    ABORTED = "aborted"
    """Any other end: somebody may be on the road, so followers fall back by their tasks' policies."""


@dataclass(frozen=True, slots=True)
class Ended(Positional):
    """The sender's own session of this number has ended."""

    number: UniqueNumber
    how: Ending


@dataclass(frozen=True, slots=True)
class Left(Positional):
    """The sender has no part in this session any more by this offer or an earlier one."""

    session: SessionId
    offer: UniqueNumber


Farewell: TypeAlias = Ended | Left
"""A session that a RAM names as over."""


@dataclass(frozen=True, slots=True)
class Ram:
    """What a robot awareness message says about coordination."""

    station: int
    """The station that sent it."""
    coordination: Coordination
    """Its part in a session."""
    farewell: Farewell | None = None
    """A session that it names as over."""
    on_duty: bool = False
    """Whether it still has a duty on the road from a maneuver or session that ended early."""


@dataclass(frozen=True, slots=True)
class Command(Variant):
    """`LeaderManeuverContainer` of an RMCM: a leader's command to one follower."""

    session: SessionId
    """The session, and with it the leader that commands."""
    to: int
    """`targetFollowerStationID`."""
    request: int
    """`requestID`, 0..255."""
    task: TaskType
    """`taskType`."""


@dataclass(frozen=True, slots=True)
class Accepted(Variant):
    """The follower takes the command on."""


@dataclass(frozen=True, slots=True)
class Rejected(Positional):
    """The follower does not take the command on."""

    why: Rejection


Verdict: TypeAlias = Accepted | Rejected
"""Acknowledgement or rejection of a command."""


@dataclass(frozen=True, slots=True)
class Answer(Variant):
    """`FollowerManeuverContainer` of an RMCM: a follower's answer to one command."""

    from_: int
    """The follower's station id."""
    session: SessionId
    """The session of the command."""
    request: int
    """`jobAdviceID`: the `requestID` that is answered, 0..255."""
    verdict: Verdict
    """What it says."""


Rmcm: TypeAlias = Command | Answer
"""What a robot maneuver coordination message says."""
