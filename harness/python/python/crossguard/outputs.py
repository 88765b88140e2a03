"""What a robot is to do, in this order.

`Robot.step` gives an `Output`: the state machine's own. `Endpoint` gives an `Effect`: the same with
packets in place of `SendRam` and `SendRmcm`, and with what it understood and what it dropped.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TypeAlias

from . import messages, reasons
from ._wire import Positional, Variant
from .body import TaskParameters
from .notices import Notice
from .types import FallbackPolicy, Maneuver

# <words>


@dataclass(frozen=True, slots=True)
class SendRam(Variant):
    """Send a RAM now, with `Robot::ram` of the state after this step."""


@dataclass(frozen=True, slots=True)
class SendRmcm(Positional):
    """Send this RMCM now."""

    rmcm: messages.Rmcm


@dataclass(frozen=True, slots=True)
class StartManeuver(Positional):
    """Start this maneuver. The acknowledgement stands before it in the list."""

    maneuver: Maneuver
    parameters: TaskParameters = TaskParameters()
    """Where and how, by the command that an endpoint heard; the state machine itself knows nothing of it."""


@dataclass(frozen=True, slots=True)
class StopManeuver(Positional):
    """Stop this maneuver."""

    maneuver: Maneuver
    why: reasons.StopReason


@dataclass(frozen=True, slots=True)
class FallBack(Positional):
    """End this maneuver by the task's policy. The robot is on duty until the application says `RoadClear`."""

    maneuver: Maneuver
    policy: FallbackPolicy


@dataclass(frozen=True, slots=True)
class CorridorOpened(Positional):
    """The pedestrian may cross from now on, for this long. The sign must end by itself then, without this
    robot's help."""

    open_ms: int


@dataclass(frozen=True, slots=True)
class CorridorExtended(Positional):
    """The pedestrian may go on crossing, for this long from now."""

    open_ms: int


@dataclass(frozen=True, slots=True)
class CorridorClosed(Positional):
    """The pedestrian may not cross from now on. People may still be on the road."""

    why: reasons.CorridorClosure


@dataclass(frozen=True, slots=True)
class LockIdentity(Variant):
    """Keep station id, certificate and link address from now on."""


@dataclass(frozen=True, slots=True)
class UnlockIdentity(Variant):
    """Station id, certificate and link address may change again."""


@dataclass(frozen=True, slots=True)
class RenewEpoch(Variant):
    """Half of this boot counter's numbers are given out: persist a larger one, and then tell
    `EpochRenewed`."""


@dataclass(frozen=True, slots=True)
class Notify(Positional):
    """Tell the application."""

    notice: Notice


@dataclass(frozen=True, slots=True)
class Ignored(Positional):
    """The input changed nothing, for this reason."""

    why: reasons.Ignored


Output: TypeAlias = (
    SendRam
    | SendRmcm
    | StartManeuver
    | StopManeuver
    | FallBack
    | CorridorOpened
    | CorridorExtended
    | CorridorClosed
    | LockIdentity
    | UnlockIdentity
    | RenewEpoch
    | Notify
    | Ignored
)
"""One output of the transition function."""


Act: TypeAlias = (
    StartManeuver
    | StopManeuver
    | FallBack
    | CorridorOpened
    | CorridorExtended
    | CorridorClosed
    | LockIdentity
    | UnlockIdentity
    | RenewEpoch
    | Notify
    | Ignored
)
"""An output that is no message."""


# </words>


class Service(enum.Enum):
    """The service that a message is of."""

    RAM = "RAM"
    RMCM = "RMCM"
    CAM = "CAM"
    DENM = "DENM"
    VAM = "VAM"
    CPM = "CPM"


class Trigger(enum.Enum):
    """Why a message goes out."""

    PROTOCOL = "protocol"
    FIRST = "first"
    ROLE = "role"
    HELP_STATUS = "helpStatus"
    TASK = "task"
    AVAILABILITY = "availability"
    HEARTBEAT = "heartbeat"
    INTERVAL = "interval"
    POSITION = "position"
    HEADING = "heading"
    SPEED = "speed"


@dataclass(frozen=True, slots=True)
class Send(Variant):
    """Send this packet."""

    service: Service
    """Which message is in it."""
    trigger: Trigger
    """Why it is sent."""
    packet: bytes
    """A whole GeoNetworking packet, unsecured: single-hop broadcast with BTP-B."""
    message: bytes
    """The message in it, for a station that makes packets itself."""


@dataclass(frozen=True, slots=True)
class Heard(Variant):
    """A message of a robot was understood."""

    service: Service
    """Which message."""
    station: int
    """Who sent it."""
    message: bytes
    """Its octets, for `crossguard.decode`."""


@dataclass(frozen=True, slots=True)
class Dropped(Variant):
    """A packet was dropped, or a message could not be sent."""

    layer: str
    """Where it was dropped, `packet` for example."""
    cause: str
    """Why; the two are what it is counted under in `Endpoint.counters`."""
    detail: str
    """What exactly."""


Effect: TypeAlias = Send | Act | Heard | Dropped
"""An output of an endpoint."""
