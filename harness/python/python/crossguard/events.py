"""What happens in the robot itself: `robot.step(events.OpenCorridor())`, `endpoint.tell(…)`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ._wire import Positional, Variant
from .types import Availability, HelpRequest, ManeuverId, TaskType, UniqueNumber

# <words>


@dataclass(frozen=True, slots=True)
class PedestrianDetected(Positional):
    """A pedestrian needs help that takes more robots than this one."""

    request: HelpRequest = HelpRequest()


@dataclass(frozen=True, slots=True)
class CommandManeuver(Variant):
    """The leader's application wants a follower to do a maneuver."""

    follower: int
    task: TaskType


@dataclass(frozen=True, slots=True)
class InPosition(Positional):
    """The body holds the place from which the maneuver that was started guards. To be told only when the body
    is there: the leader lets people on the road by it."""

    id: ManeuverId


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
    """The pedestrian has crossed and nobody is on the road; the session may end. It takes the guards off the
    road."""


@dataclass(frozen=True, slots=True)
class RoadClear(Variant):
    """The people that this robot guarded are off the road, and its body has finished its fallback. To be told
    only when both are so: it ends the robot's duty."""


@dataclass(frozen=True, slots=True)
class AllAnswered(Variant):
    """The requester knows of no robot nearby that has not answered its request."""


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
    """The robot has changed its pseudonym; only possible while the identity is not locked. Where a number is
    given, those of its sessions and offers begin anew there, so that they do not tell that the two pseudonyms
    are one robot. Under this station id, no number from there on may have been given out before."""

    station: int
    next: UniqueNumber | None = None


@dataclass(frozen=True, slots=True)
class EpochRenewed(Positional):
    """A larger boot counter has been persisted, as the output `RenewEpoch` asked."""

    boot: int


@dataclass(frozen=True, slots=True)
class OutOfPosition(Positional):
    """The body does not hold the place any more from which the maneuver guards. To be told as soon as it may
    be so: the leader lets nobody on the road any more."""

    id: ManeuverId


@dataclass(frozen=True, slots=True)
class PersonOnRoad(Variant):
    """Somebody is on the road, seen by this follower itself. Until it tells `RoadClear` it stays, however its
    leader ends the session."""


Event: TypeAlias = (
    PedestrianDetected
    | CommandManeuver
    | InPosition
    | ManeuverCompleted
    | ManeuverFailed
    | TaskCompleted
    | RoadClear
    | AllAnswered
    | LeaveRequested
    | AvailabilityChanged
    | OpenCorridor
    | CloseCorridor
    | IdentityChanged
    | EpochRenewed
    | OutOfPosition
    | PersonOnRoad
)
"""An event of the robot's own application."""


# </words>
