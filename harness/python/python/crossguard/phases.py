"""A robot's part in a session, in full: `Robot.phase`. A timer is the time that it has left, in
milliseconds, or `None` where it is not armed."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TypeAlias

from ._wire import Positional, Variant
from .messages import Progress
from .reasons import Rejection
from .types import HelpRequest, Maneuver, SessionId, TaskSet, TaskType, UniqueNumber


@dataclass(frozen=True, slots=True)
class Idle(Variant):
    """No part in a session."""


@dataclass(frozen=True, slots=True)
class Rival:
    """A request or a leader at the same place that goes before this robot's own. One message may be late: the
    next newer message of it counts, and so does one of any other that goes before."""

    session: SessionId
    """Its session."""
    heartbeat: int
    """The heartbeat that was heard of it."""


@dataclass(frozen=True, slots=True)
class Offer:
    """An offer as a requester has heard it."""

    station: int
    """The helper."""
    number: UniqueNumber
    """Number of the offer."""
    capabilities: TaskSet
    """What the helper can do."""
    distance_dm: int
    """How far away the helper is, in decimetres; 65535 if that is not known."""
    echo: int
    """Newest heartbeat that it echoed."""
    standing_ms: int | None
    """How long the offer stands without a newer echo: until then the helper is still reserved."""


@dataclass(frozen=True, slots=True)
class Requesting(Variant):
    """Has opened a session and asks for help."""

    number: UniqueNumber
    """Number of the session."""
    request: HelpRequest
    """What it asks for."""
    heartbeat: int
    """Newest heartbeat."""
    rival: Rival | None
    """A request or leader at the same place that goes before, as heard first."""
    offers: tuple[Offer, ...]
    """The offers it has heard, best first."""
    help_ms: int | None
    """`T_help`."""
    selection_ms: int | None
    """Time left to gather offers; armed from the first offer on."""


@dataclass(frozen=True, slots=True)
class Offering(Variant):
    """Is reserved for a requester."""

    session: SessionId
    """The session it offers to."""
    number: UniqueNumber
    """Number of the offer."""
    capabilities: TaskSet
    """What it can do of what is asked for."""
    heard: int
    """Newest heartbeat of the request that it heard."""
    t_safety_ms: int
    """Its `t_safety`, as the offer tells it."""
    reservation_ms: int | None
    """`T_offer`, since the newest heartbeat."""


@dataclass(frozen=True, slots=True)
class Stands(Positional):
    """The lease stands for this long: until then the follower cannot have fallen back."""

    left_ms: int | None


@dataclass(frozen=True, slots=True)
class Expired(Positional):
    """There is no lease; the follower is kept for this long."""

    left_ms: int | None


Lease: TypeAlias = Stands | Expired
"""A leader's lease on a follower."""


@dataclass(frozen=True, slots=True)
class Outstanding:
    """A command that is not acknowledged yet."""

    request: int
    """Its number."""
    task: TaskType
    """Its task."""
    repeats: int
    """How often it was repeated."""
    acknowledgement_ms: int | None
    """`T_ack`."""


@dataclass(frozen=True, slots=True)
class Order:
    """A command that is acknowledged."""

    request: int
    """Its number."""
    task: TaskType
    """Its task."""
    progress: Progress | None
    """What the follower reported; `None` before its first report."""
    execution_ms: int | None
    """`T_exec`; armed until the progress is final."""


@dataclass(frozen=True, slots=True)
class Member:
    """A leader's record of one follower."""

    station: int
    """The follower."""
    offer: UniqueNumber
    """The offer that was confirmed."""
    echoed: int | None
    """Newest heartbeat that it echoed; `None` until it has taken its role."""
    lease: Lease
    """The lease on it."""
    next_request: int
    """Number of the next command."""
    outstanding: Outstanding | None
    """The command that it has not acknowledged yet."""
    order: Order | None
    """The newest command that it acknowledged."""


class Corridor(enum.Enum):
    """The corridor of a leader."""

    CLEAR = "clear"
    """Nobody may cross, and nobody is on the road."""
    OPEN = "open"
    """The pedestrian may cross."""
    CLEARING = "clearing"
    """Nobody may cross any more, and people may still be on the road."""


@dataclass(frozen=True, slots=True)
class Leading(Variant):
    """Leads a session."""

    number: UniqueNumber
    """Number of the session."""
    request: HelpRequest
    """What was asked for."""
    heartbeat: int
    """Newest heartbeat."""
    members: tuple[Member, ...]
    """The followers."""
    corridor: Corridor
    """Whether the pedestrian may cross, and whether the road is known to be clear."""
    rival: Rival | None
    """A leader at the same place that goes before, as heard first."""
    yields_to: int | None
    """The leader that it has yielded the place to. It lets nobody cross any more, keeps its followers until
    the road is clear, and ends."""


@dataclass(frozen=True, slots=True)
class Fresh(Positional):
    """`T_safety` runs."""

    left_ms: int | None


@dataclass(frozen=True, slots=True)
class Lost(Positional):
    """`T_safety` ran out; `T_leave` runs."""

    left_ms: int | None


Contact: TypeAlias = Fresh | Lost
"""A follower's contact with its leader."""


@dataclass(frozen=True, slots=True)
class Job:
    """A command that a follower accepted."""

    request: int
    """Its number."""
    task: TaskType
    """Its task."""
    progress: Progress
    """How far it is."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """A command that a follower rejected."""

    request: int
    """Its number."""
    reason: Rejection
    """Why."""


@dataclass(frozen=True, slots=True)
class Following(Variant):
    """Follows in a session."""

    session: SessionId
    """The session."""
    offer: UniqueNumber
    """The offer that was confirmed."""
    heard: int
    """Newest heartbeat that it heard."""
    contact: Contact
    """Contact with the leader."""
    job: Job | None
    """Newest command that it accepted."""
    refused: Refusal | None
    """Newest command that it rejected, where that is newer than the job."""
    sees_people: bool
    """Whether it has seen somebody on the road itself, and has not said since then that the road is clear."""


Phase: TypeAlias = Idle | Requesting | Offering | Leading | Following


@dataclass(frozen=True, slots=True)
class Unlocked(Variant):
    """The pseudonym may change."""


@dataclass(frozen=True, slots=True)
class Locked(Positional):
    """It may not: the robot has a part in a session or says farewell to one."""

    left_ms: int | None


@dataclass(frozen=True, slots=True)
class Expiring(Variant):
    """The lock has lasted as long as it may. The robot still says farewell, and takes part in no session
    before the identity has been unlocked."""


Identity: TypeAlias = Unlocked | Locked | Expiring
"""Whether the pseudonym may change."""


@dataclass(frozen=True, slots=True)
class FallingBack(Positional):
    """The body carries out the fallback of this maneuver."""

    maneuver: Maneuver


@dataclass(frozen=True, slots=True)
class Crossing(Positional):
    """The robot led this session, which ended while people may have been on the road."""

    session: SessionId


Duty: TypeAlias = FallingBack | Crossing
"""A duty on the road that outlives its command or its session, until `events.RoadClear`."""
