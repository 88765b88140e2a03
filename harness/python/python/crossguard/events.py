"""What happens in the robot itself: `robot.step(events.OpenCorridor())`, `endpoint.tell(…)`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ._wire import Positional, Variant
from .types import Availability, HelpRequest, ManeuverId, TaskType


@dataclass(frozen=True, slots=True)
class PedestrianDetected(Positional):
    """A pedestrian needs help that takes more robots than this one."""

    request: HelpRequest = HelpRequest()


@dataclass(frozen=True, slots=True)
class CommandManeuver(Variant):
    """The leader's application wants a follower to do a maneuver."""

    follower: int
    """Its station id."""
    task: TaskType
    """What it is to do."""


@dataclass(frozen=True, slots=True)
class ManeuverCompleted(Positional):
    """The maneuver that was started has been finished."""

    id: ManeuverId


@dataclass(frozen=True, slots=True)
class ManeuverFailed(Positional):
    """The maneuver that was started cannot be finished."""

    id: ManeuverId


@dataclass(frozen=True, slots=True)
class TaskCompleted(Variant):
    """The pedestrian has crossed; the session may end."""


@dataclass(frozen=True, slots=True)
class LeaveRequested(Variant):
    """The robot wants to leave whatever session it is in."""


@dataclass(frozen=True, slots=True)
class AvailabilityChanged(Positional):
    """The robot became available or unavailable."""

    availability: Availability


@dataclass(frozen=True, slots=True)
class OpenCorridor(Variant):
    """The leader's application wants to let the pedestrian cross."""


@dataclass(frozen=True, slots=True)
class CloseCorridor(Variant):
    """The leader's application wants to hold the pedestrian back again."""


@dataclass(frozen=True, slots=True)
class IdentityChanged(Positional):
    """The robot has changed its pseudonym; only possible while the identity is not locked."""

    station: int


Event: TypeAlias = (
    PedestrianDetected
    | CommandManeuver
    | ManeuverCompleted
    | ManeuverFailed
    | TaskCompleted
    | LeaveRequested
    | AvailabilityChanged
    | OpenCorridor
    | CloseCorridor
    | IdentityChanged
)
