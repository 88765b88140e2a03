"""Timers, limits and capabilities of a robot."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import _crossguard, _wire
from .types import FallbackPolicy, TaskSet, TaskType

_DEFAULTS: dict[str, Any] = json.loads(_crossguard.default_settings())

_T_EXEC_MS: Mapping[TaskType, int] = dict(zip(TaskType, _DEFAULTS["tExec"], strict=True))
_FALLBACK: Mapping[TaskType, FallbackPolicy] = dict(
    zip(TaskType, map(FallbackPolicy, _DEFAULTS["fallback"]), strict=True)
)


@dataclass(frozen=True, kw_only=True)
class Config:
    """Timers, limits and capabilities, checked. Drift and `delay_max_ms` are the same in a whole team.

    Times are in milliseconds, 1..86400000. What is not given has the default of the Rust crate, which is
    named at each field.

    Raises `BrokenInequality`, a `ValueError`, which names the first inequality between them that does not
    hold and has its formula; and `ValueError` for a value that is out of range by itself.
    """

    ram_period_ms: int = _DEFAULTS["ramPeriod"]
    """Interval of RAM in a session; a leader bumps its heartbeat at the same pace. 100 ms."""
    t_select_ms: int = _DEFAULTS["tSelect"]
    """How long a requester gathers offers, counted from the first. It selects sooner when every robot that it
    heard in the last second has answered. 300 ms."""
    t_offer_ms: int = _DEFAULTS["tOffer"]
    """How long a helper stays reserved after the newest heartbeat of its requester. 3000 ms."""
    t_help_ms: int = _DEFAULTS["tHelp"]
    """How long a request for help stands. 10000 ms."""
    t_ack_ms: int = _DEFAULTS["tAck"]
    """How long a leader waits for an acknowledgement before it repeats the command. 600 ms."""
    n_ack: int = _DEFAULTS["nAck"]
    """How often a leader repeats a command, 1..15. 3."""
    t_safety_ms: int = _DEFAULTS["tSafety"]
    """How long a follower goes on without a newer heartbeat or command. 2000 ms."""
    t_lease_ms: int = _DEFAULTS["tLease"]
    """How long a leader's lease stands after it sent the newest echoed heartbeat. 1900 ms."""
    t_leave_ms: int = _DEFAULTS["tLeave"]
    """How long a follower stays in the session after `t_safety_ms` ran out. 5000 ms."""
    t_farewell_ms: int = _DEFAULTS["tFarewell"]
    """How long a robot names a session as over. 1000 ms."""
    t_lock_ms: int = _DEFAULTS["tLock"]
    """How long the identity may stay locked, farewells included. 300000 ms."""
    t_cross_ms: int = _DEFAULTS["tCross"]
    """How long a pedestrian needs to cross at most. A corridor opens only where the identity lock and the
    execution limits leave so much time. 30000 ms."""
    t_exec_ms: Mapping[TaskType, int] = dataclasses.field(default_factory=dict, hash=False)
    """`T_exec` by task type: how long a maneuver may run. 5000 ms for `INITIAL_POS`, else 60000 ms. Task
    types that are not given keep their default."""
    drift_ppm: int = _DEFAULTS["driftPpm"]
    """Largest error of a robot's clock rate, in parts per million, 0..99999. 1000."""
    delay_max_ms: int = _DEFAULTS["delayMax"]
    """Longest time by which the robot is told late that time has passed. 50 ms."""
    capabilities: TaskSet = TaskSet(_DEFAULTS["capabilities"])
    """The maneuvers that this robot can do. The three that have names."""
    guarding: TaskSet = TaskSet(_DEFAULTS["guarding"])
    """The maneuvers under which a pedestrian may cross. `MOVE` and `BLOCK`."""
    holding: TaskSet = TaskSet(_DEFAULTS["holding"])
    """The maneuvers that guard from a place: the corridor opens only once the follower has reported that it
    is in position. `BLOCK`."""
    fallback: Mapping[TaskType, FallbackPolicy] = dataclasses.field(default_factory=dict, hash=False)
    """Fallback policy by task type. `MOVE` escorts to the nearer kerb, `BLOCK` holds until clear, the
    others stop in place. Task types that are not given keep their default."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "t_exec_ms", _merged(_T_EXEC_MS, self.t_exec_ms))
        object.__setattr__(self, "fallback", _merged(_FALLBACK, self.fallback))
        _crossguard.check_settings(self._settings())

    def _settings(self) -> str:
        """The settings in the form of the core."""
        fields = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        fields["t_exec_ms"] = list(self.t_exec_ms.values())
        fields["fallback"] = list(self.fallback.values())
        return json.dumps({_wire.name_of(name): _wire.plain(it) for name, it in fields.items()})


def _merged(defaults: Mapping[TaskType, Any], given: Mapping[TaskType, Any]) -> dict[TaskType, Any]:
    return {**defaults, **{TaskType(task): value for task, value in given.items()}}


@dataclass(frozen=True, slots=True)
class MessageIdentifiers:
    """The identifiers of one message, which no standard has assigned."""

    protocol_version: int
    """`protocolVersion` of the header, 0..255."""
    message_id: int
    """`messageId` of the header, 22..255."""
    btp_port: int
    """Destination port of BTP, 2027..65535."""
    its_aid: int
    """ITS-AID (PSID)."""


_IDENTIFIERS: dict[str, Any] = json.loads(_crossguard.default_identifiers())


@dataclass(frozen=True, kw_only=True)
class Identifiers:
    """What no standard has assigned; all stations on a channel agree on it.

    Raises `ValueError` where RAM and RMCM cannot be told from each other or from the messages of ETSI.
    """

    ram: MessageIdentifiers = _wire.reader(MessageIdentifiers)(_IDENTIFIERS["ram"])
    """Those of RAM."""
    rmcm: MessageIdentifiers = _wire.reader(MessageIdentifiers)(_IDENTIFIERS["rmcm"])
    """Those of RMCM."""
    robot_station_type: int = _IDENTIFIERS["robotStationType"]
    """Station type in basic container and address, 0..255; 12, `lightVruVehicle`, by default."""
    dictionary: str = _IDENTIFIERS["dictionary"]
    """Version of the common data dictionary that VAM and CPM are built on: `2.4.1` or `2.1.1`."""

    def __post_init__(self) -> None:
        _crossguard.check_identifiers(_wire.dumps(self))
