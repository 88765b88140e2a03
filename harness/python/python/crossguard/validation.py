"""Whether logs tell what could have happened."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

from . import _crossguard, _wire


class SupportsRead(Protocol):
    """A log that is open: a text file, `io.StringIO`."""

    def read(self) -> str:
        """The rest of it."""


@dataclass(frozen=True, slots=True)
class Fault:
    """The first record that does not fit."""

    log: str
    """The log."""
    line: int
    """The line in it, counted from 1."""
    robot: str | None
    """The robot, where the line says one."""
    what: str
    """What does not fit; it reads on after the robot's name."""

    def __str__(self) -> str:
        robot = "" if self.robot is None else f"{self.robot} "
        return f"{self.log}, line {self.line}: {robot}{self.what}"


@dataclass(frozen=True, slots=True)
class Late:
    """Steps that came later than the rules of the integrator allow: a process may hang."""

    steps: int
    """How many."""
    longest_ms: int
    """By how much the latest of them came after it was due."""


@dataclass(frozen=True, slots=True)
class Validated:
    """What valid logs hold."""

    robots: int
    """How many robots."""
    records: int
    """How many records."""
    steps: int
    """How many steps of the transition function."""
    sent: int
    """How many messages were sent."""
    heard: int
    """How many receptions were matched with their transmissions."""
    from_strangers: int
    """How many were heard from stations that none of the logs is of."""
    beyond_logs: int
    """How many were heard from robots after the end of their logs."""
    of_unknown_age: int
    """How many messages were taken in of which the logs do not say how long they had waited."""
    late: Late
    """Steps that came later than the rules of the integrator allow."""
    missing: int
    """How many records the robots themselves say are missing, because the log was full."""
    cut_off: tuple[str, ...]
    """The robots whose logs end in the middle of a run, because they lost power or were killed."""
    properties: tuple[str, ...]
    """The properties that had something to say, and were kept."""
    not_judged: tuple[str, ...]
    """What was not judged, and why."""


@dataclass(frozen=True, slots=True)
class Validation:
    """What came of it; true where the logs are valid."""

    validated: Validated | None = None
    """What the logs hold, where they are valid."""
    fault: Fault | None = None
    """What does not fit, where they are not."""

    @property
    def is_valid(self) -> bool:
        """Whether every step is one of the transition function, every reception has its transmission, and no
        property is broken."""
        return self.fault is None

    def __bool__(self) -> bool:
        return self.is_valid


def validate(logs: Iterable[str | os.PathLike[str] | SupportsRead]) -> Validation:
    """Replays the logs of one or several robots that were together, as `crossguard validate` does.

    Each log is a path, or a text file that is open. Other Python threads run meanwhile. Raises
    `OSError` for a file that cannot be opened, and `UnreadableLog`, a `ValueError`, for one that is empty
    or has a line that is no record.
    """
    if isinstance(logs, (str, os.PathLike)):
        raise TypeError("validate wants a list of logs")
    opened = [_opened(i, log) for i, log in enumerate(logs)]
    validation: Validation = _wire.loads(Validation, _crossguard.validate(opened))
    return validation


def _opened(i: int, log: str | os.PathLike[str] | SupportsRead) -> tuple[str, str | None]:
    """The name of a log, and its text where it is no file of that name."""
    if isinstance(log, (str, os.PathLike)):
        return os.fspath(log), None
    return str(getattr(log, "name", f"log {i + 1}")), log.read()
