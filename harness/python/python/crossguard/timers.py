"""The timers of a robot. A timer exists only in the state that needs it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ._wire import Positional, Variant

# <words>


@dataclass(frozen=True, slots=True)
class Safety(Variant):
    """Follower: `T_safety`, since the newest heartbeat or command."""


@dataclass(frozen=True, slots=True)
class Leave(Variant):
    """Follower: `T_leave`, since contact was lost."""


@dataclass(frozen=True, slots=True)
class Lease(Positional):
    """Leader: the lease on this follower."""

    follower: int


@dataclass(frozen=True, slots=True)
class Lost(Positional):
    """Leader: how long this follower is kept without a lease."""

    follower: int


@dataclass(frozen=True, slots=True)
class Execution(Positional):
    """Leader: `T_exec` of this follower's command."""

    follower: int


@dataclass(frozen=True, slots=True)
class Acknowledgement(Positional):
    """Leader: `T_ack` of this follower's outstanding command."""

    follower: int


@dataclass(frozen=True, slots=True)
class Help(Variant):
    """Requester: `T_help`."""


@dataclass(frozen=True, slots=True)
class Offer(Positional):
    """Requester: how long the offer of this helper stands without a newer echo."""

    helper: int


@dataclass(frozen=True, slots=True)
class Selection(Variant):
    """Requester: the time to gather offers."""


@dataclass(frozen=True, slots=True)
class Reservation(Variant):
    """Helper: `T_offer`."""


@dataclass(frozen=True, slots=True)
class IdentityLock(Variant):
    """The longest time for which the identity may stay locked."""


@dataclass(frozen=True, slots=True)
class Farewell(Variant):
    """How long an ended or left session is announced."""


@dataclass(frozen=True, slots=True)
class Ram(Variant):
    """The next periodic RAM."""


Timer: TypeAlias = (
    Safety
    | Leave
    | Lease
    | Lost
    | Execution
    | Acknowledgement
    | Help
    | Offer
    | Selection
    | Reservation
    | IdentityLock
    | Farewell
    | Ram
)
"""The timers of a robot. A timer exists only in the state that needs it."""


# </words>
