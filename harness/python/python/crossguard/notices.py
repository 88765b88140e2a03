"""News for the application, in `outputs.Notify`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from . import reasons
from ._wire import Positional
from .types import ManeuverId, SessionId

# <words>


@dataclass(frozen=True, slots=True)
class RolesEstablished(Positional):
    """Leader: the followers are confirmed; the session has its roles."""

    session: SessionId


@dataclass(frozen=True, slots=True)
class FollowerJoined(Positional):
    """Leader: this follower has taken its role."""

    station: int


@dataclass(frozen=True, slots=True)
class FollowerGone(Positional):
    """Leader: this follower has no part in the session any more."""

    station: int
    why: reasons.GoneReason


@dataclass(frozen=True, slots=True)
class LeaseGranted(Positional):
    """Leader: this follower's lease stands."""

    station: int


@dataclass(frozen=True, slots=True)
class LeaseExpired(Positional):
    """Leader: this follower's lease has run out."""

    station: int


@dataclass(frozen=True, slots=True)
class CommandAcknowledged(Positional):
    """Leader: this follower acknowledged this command."""

    station: int
    id: ManeuverId


@dataclass(frozen=True, slots=True)
class CommandRejected(Positional):
    """Leader: this follower rejected this command."""

    station: int
    id: ManeuverId
    why: reasons.Rejection


@dataclass(frozen=True, slots=True)
class ManeuverReported(Positional):
    """Leader: this follower reports that it executes this command."""

    station: int
    id: ManeuverId


@dataclass(frozen=True, slots=True)
class ManeuverInPosition(Positional):
    """Leader: this follower reports that it guards from its place."""

    station: int
    id: ManeuverId


@dataclass(frozen=True, slots=True)
class ManeuverCompleted(Positional):
    """Leader: this follower finished this command."""

    station: int
    id: ManeuverId


@dataclass(frozen=True, slots=True)
class ManeuverFailed(Positional):
    """Leader: this command failed."""

    station: int
    id: ManeuverId
    why: reasons.Failure


@dataclass(frozen=True, slots=True)
class FollowerSafeIdle(Positional):
    """Leader: this follower fell back; it is idle in safety."""

    station: int
    id: ManeuverId


@dataclass(frozen=True, slots=True)
class OfferLapsed(Positional):
    """Requester: the offer of this helper has lapsed."""

    station: int


@dataclass(frozen=True, slots=True)
class Yielded(Positional):
    """Leader: yields the place to this leader. The session ends once the road is clear."""

    station: int


@dataclass(frozen=True, slots=True)
class SessionEnded(Positional):
    """Requester or leader: the session is over."""

    session: SessionId
    why: reasons.EndReason


@dataclass(frozen=True, slots=True)
class Offering(Positional):
    """Helper: offers to take part in this session."""

    session: SessionId


@dataclass(frozen=True, slots=True)
class Joined(Positional):
    """Follower: takes part in this session."""

    session: SessionId


@dataclass(frozen=True, slots=True)
class Released(Positional):
    """Helper or follower: has no part in this session any more."""

    session: SessionId
    why: reasons.ReleaseReason


@dataclass(frozen=True, slots=True)
class ContactLost(Positional):
    """Follower: contact with the leader is lost."""

    session: SessionId


@dataclass(frozen=True, slots=True)
class ContactRegained(Positional):
    """Follower: contact with the leader is back."""

    session: SessionId


Notice: TypeAlias = (
    RolesEstablished
    | FollowerJoined
    | FollowerGone
    | LeaseGranted
    | LeaseExpired
    | CommandAcknowledged
    | CommandRejected
    | ManeuverReported
    | ManeuverInPosition
    | ManeuverCompleted
    | ManeuverFailed
    | FollowerSafeIdle
    | OfferLapsed
    | Yielded
    | SessionEnded
    | Offering
    | Joined
    | Released
    | ContactLost
    | ContactRegained
)
"""News for the application."""


# </words>
