"""The model checker: scenarios, exhausted."""

from __future__ import annotations

import enum
import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from . import _crossguard, _wire


class Verdict(enum.Enum):
    """What was found about a property or its premise."""

    HOLDS = "holds"
    """The property holds of everything reachable."""
    REACHABLE = "reachable"
    """The premise is met somewhere."""
    VIOLATED = "violated"
    """The property is broken somewhere."""
    UNREACHABLE = "unreachable"
    """The premise is met nowhere: the property says nothing in this scenario."""
    INCOMPLETE = "incomplete"
    """The exploration was cut off before it could tell."""


@dataclass(frozen=True, slots=True)
class Property:
    """What was found about one property, or about its premise."""

    id: str
    """The property's id, `I1` for example; a premise has `-premise` behind it."""
    kind: str
    """`S` safety, `T` of steps, `L` liveness, or `premise`."""
    verdict: Verdict
    """What was found."""
    statement: str
    """What it says."""


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a check is."""

    checked: int
    """Distinct states that have been judged."""
    explored: int
    """Distinct states that the kit's own exploration has found, after that."""
    expected: int | None
    """How many there will be in the end, where the scenario's file says so."""


class Report:
    """What came of checking one scenario."""

    __slots__ = ("_json", "_native", "_properties")

    def __init__(self, native: _crossguard.Report) -> None:
        self._native = native
        self._json: dict[str, Any] = json.loads(native.json())
        read = _wire.reader(Property)
        self._properties: tuple[Property, ...] = tuple(map(read, self._json["properties"]))

    @property
    def name(self) -> str:
        """The scenario's name."""
        return str(self._json["name"])

    @property
    def summary(self) -> str:
        """What it is about, in one line."""
        return str(self._json["summary"])

    @property
    def properties(self) -> tuple[Property, ...]:
        """What was found about each property and each premise."""
        return self._properties

    @property
    def unique_states(self) -> int:
        """Distinct states, up to renaming of numbers."""
        return int(self._json["uniqueStates"])

    @property
    def transitions(self) -> int:
        """Transitions between distinct states."""
        return int(self._json["transitions"])

    @property
    def depth(self) -> int:
        """Steps from the initial state to the farthest state."""
        return int(self._json["depth"])

    @property
    def seconds(self) -> float:
        """Time that all of it took."""
        return float(self._json["seconds"])

    @property
    def is_exhaustive(self) -> bool:
        """Whether every reachable state was visited."""
        return bool(self._json["exhaustive"])

    @property
    def cut_off(self) -> str | None:
        """Why not: `state-limit`, `time-limit`, `found-broken` or `counts-differ`."""
        return self._json.get("cutOff")

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What the verdicts assume."""
        return tuple(self._json["assumptions"])

    @property
    def has_failed(self) -> bool:
        """Whether something was found that is wrong: a property is broken, a premise is met nowhere, or the
        state space has another size than the scenario's file expects. `paper-literal` has failed unless
        exactly what must be broken is."""
        return self._native.has_failed

    def verdict(self, id: str) -> Verdict:
        """The verdict on a property or premise. Raises `KeyError` if the scenario does not have it."""
        for property in self._properties:
            if property.id == id:
                return property.verdict
        raise KeyError(id)

    def chart(self, id: str, form: Literal["text", "mermaid"] = "text") -> str | None:
        """The run that breaks a property, as a sequence chart; `None` where nothing does."""
        return self._native.chart(id, form)

    def to_dict(self) -> dict[str, Any]:
        """All of it, as `crossguard check --json` has it."""
        copy: dict[str, Any] = json.loads(self._native.json())
        return copy

    def __repr__(self) -> str:
        found = "failed" if self.has_failed else "passed" if self.is_exhaustive else "incomplete"
        return f"<Report {self.name}: {found}, {self.unique_states} states>"


def scenarios() -> list[str]:
    """The names of the scenarios that come along, quick ones first, with `paper-literal` at the end: the
    paper's text as it stands, which must fail."""
    return _crossguard.scenarios()


def check(
    scenario: str | os.PathLike[str],
    *,
    threads: int | None = None,
    max_states: int | None = None,
    timeout_s: float | None = None,
    progress: Callable[[Progress], object] | None = None,
) -> Report:
    """Explores every state of a scenario: one that comes along, or a TOML file.

    It explores with as many `threads` as there are processors, and gives up after `max_states` states or
    `timeout_s` seconds, with verdicts `INCOMPLETE`. `progress` is called now and then. Other Python
    threads run meanwhile; KeyboardInterrupt, or an exception of `progress`, ends it.

    Raises `ScenarioError`, a `ValueError`, which names the line that makes no sense.
    """

    def tell(checked: int, explored: int, expected: int | None) -> None:
        if progress is not None:
            progress(Progress(checked, explored, expected))

    name = os.fspath(scenario)
    return Report(_crossguard.check(name, threads, max_states, timeout_s, tell))
