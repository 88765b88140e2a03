"""A whole robot: the state machine with its packets, sending rules, counters and log."""

from __future__ import annotations

import json
import logging
import time
from dataclasses import dataclass
from typing import Protocol

from . import _crossguard, _wire
from .body import RobotState, TaskParameters
from .config import Config, Identifiers
from .events import CommandManeuver, Event
from .outputs import Effect
from .robot import Robot


class SupportsWrite(Protocol):
    """Where log lines go: a text file, for example."""

    def write(self, text: str, /) -> object:
        """Takes whole lines."""


@dataclass(frozen=True, slots=True)
class Moment:
    """What time it is."""

    now_ms: int
    """Milliseconds since any fixed moment, on a clock that never goes back."""
    unix_ms: int
    """Milliseconds since 1970 (UTC), for messages and packets."""

    @classmethod
    def now(cls) -> Moment:
        """The present one, by `time.monotonic` and `time.time`."""
        return cls(time.monotonic_ns() // 1_000_000, time.time_ns() // 1_000_000)


class Endpoint:
    """A whole robot without input and output: packets, events and the time go in, effects come out.

    It is the endpoint that `crossguard run` drives: it tells the state machine of elapsed time before
    everything else, makes and takes GeoNetworking packets, sends RAM by the generation rules outside of a
    session, counts what is dropped or ignored, and writes a log that `crossguard.validate` and
    `crossguard validate` read. Packets are not signed.

    `station` is its station id, 0..4294967295; `boot` its boot counter, 0..65535, see `Boot`; `name` what
    it is called in the log; `log` gets the log's lines, each with its newline; `at` is when it boots.

    Each of `receive`, `tell` and `elapse` returns what is to be done, in order. They raise `ValueError`
    for a number that is out of range, and nothing has happened then; what a packet does wrong is no
    error, but `outputs.Dropped`, and counted. A log that cannot be written ends, and costs no effect:
    `log_error` says why.
    """

    __slots__ = ("_body", "_config", "_log", "_log_error", "_native")

    def __init__(
        self,
        station: int,
        boot: int,
        config: Config | None = None,
        *,
        name: str,
        at: Moment,
        body: RobotState | None = None,
        identifiers: Identifiers | None = None,
        log: SupportsWrite | None = None,
    ) -> None:
        self._config = Config() if config is None else config
        self._log = log
        self._log_error: Exception | None = None
        identifiers = Identifiers() if identifiers is None else identifiers
        self._native = _crossguard.Endpoint(
            name,
            station,
            boot,
            self._config._settings(),
            _wire.dumps(identifiers),
            at.now_ms,
            at.unix_ms,
        )
        self.body = RobotState() if body is None else body
        self._write_log()

    def receive(self, packet: bytes, at: Moment, arrived_ms: int | None = None) -> list[Effect]:
        """Takes in a GeoNetworking packet, of at most 1500 octets. It arrived at `arrived_ms` on the clock of
        `Moment.now_ms`: at this moment if nothing is said. A packet that has waited for longer than
        `Config.delay_max_ms` is dropped."""
        arrived = at.now_ms if arrived_ms is None else arrived_ms
        return self._effects(self._native.receive(packet, arrived, at.now_ms, at.unix_ms))

    def tell(self, event: Event, at: Moment, parameters: TaskParameters | None = None) -> list[Effect]:
        """Tells what happened in the robot at this moment; `parameters` are those of a `CommandManeuver`."""
        if isinstance(event, CommandManeuver):
            given = TaskParameters() if parameters is None else parameters
            of_command: str | None = _wire.dumps(given)
        elif parameters is not None:
            raise TypeError("only a CommandManeuver has parameters")
        else:
            of_command = None
        told = self._native.tell(_wire.dumps(event), of_command, at.now_ms, at.unix_ms)
        return self._effects(told)

    def elapse(self, at: Moment) -> list[Effect]:
        """Nothing but that time has passed: at `next_wakeup_ms`, at the latest `Config.delay_max_ms` after
        it."""
        return self._effects(self._native.elapse(at.now_ms, at.unix_ms))

    def stop(self, at: Moment) -> None:
        """Ends the log in order, with the counters."""
        self._native.stop(at.now_ms)
        self._write_log()

    @property
    def body(self) -> RobotState:
        """What the robot knows of its body. Set it before each call, or when it changes."""
        return self._body

    @body.setter
    def body(self, body: RobotState) -> None:
        self._native.set_body(_wire.dumps(body))
        self._body = body

    @property
    def robot(self) -> Robot:
        """A copy of its state machine: steps of it are steps of nobody."""
        return Robot._of(self._native.robot(), self._config)

    @property
    def name(self) -> str:
        """What it is called in the log."""
        return self._native.name

    @property
    def log_error(self) -> Exception | None:
        """Why its log has ended, if it has: a full disk, for example. The robot goes on without."""
        return self._log_error

    @property
    def next_wakeup_ms(self) -> int:
        """When it must be told that time has passed, on the clock of `Moment.now_ms`."""
        return self._native.next_wakeup_ms

    @property
    def counters(self) -> dict[str, dict[str, int]]:
        """How often each cause occurred, by layer and cause, as in logs: `{"packet": {"duplicate": 3}}`."""
        counters: dict[str, dict[str, int]] = json.loads(self._native.counters())
        return counters

    def _effects(self, effects: str) -> list[Effect]:
        self._write_log()
        read = _wire.reader(Effect)
        return [read(effect) for effect in json.loads(effects)]

    def _write_log(self) -> None:
        lines = self._native.take_log()
        if self._log is None:
            return
        try:
            self._log.write(lines)
        except Exception as error:
            # The robot has taken its step: its effects, a fallback perhaps, must reach the body all the same.
            self._log, self._log_error = None, error
            logging.getLogger("crossguard").error("%s goes on, and its log ends here: %s", self.name, error)

    def __repr__(self) -> str:
        return f"<Endpoint {self.name}: {self._native.robot().describe()}>"
