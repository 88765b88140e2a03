"""What the transition function takes in: messages, time, timers and events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from . import messages, timers
from ._wire import Positional, Variant
from .events import Event

UNKNOWN_DM = 65_535
"""A distance that is not known, or longer than 6.5 km."""


@dataclass(frozen=True, slots=True)
class Ram(Variant):
    """A RAM was received."""

    ram: messages.Ram
    """The message."""
    distance_dm: int = UNKNOWN_DM
    """Distance between the sender's reference position and this robot in decimetres, 0..65534."""


@dataclass(frozen=True, slots=True)
class Rmcm(Positional):
    """An RMCM was received. One that commands several followers is one input for each."""

    rmcm: messages.Rmcm


@dataclass(frozen=True, slots=True)
class Elapsed(Positional):
    """Time has passed: before every other input, and no later than `delay_max_ms` after
    `Robot.next_due_ms`. Timers that run out fire in a fixed order, each once."""

    elapsed_ms: int


@dataclass(frozen=True, slots=True)
class Expired(Positional):
    """One armed timer expires now, whatever time it has left. For models that abstract from durations;
    a robot uses `Elapsed`."""

    timer: timers.Timer


@dataclass(frozen=True, slots=True)
class Local(Positional):
    """Something happened in the robot itself. `Robot.step` takes the event alone as well."""

    event: Event


Input: TypeAlias = Ram | Rmcm | Elapsed | Expired | Local
