"""The state machine: one transition function, without clock, input and output."""

from __future__ import annotations

import json

from . import _crossguard, _wire
from .config import Config
from .events import Event
from .inputs import Input, Local
from .messages import Farewell, Ram
from .outputs import Output
from .phases import Duty, Identity, Phase
from .types import Availability, Role, SessionId, State


class Robot:
    """The state machine of one robot that has just booted.

    `station` is its station id, 0..4294967295; `boot` its boot counter, 0..65535, which must be larger
    than at any boot before: see `Boot`. It reads no clock and does no input or output: its driver
    tells it what was received, what happened and how much time has passed, and carries out what comes
    back, in order. The rules that a driver keeps are in the integrator's guide.

    Raises `OverflowError` where station or boot counter is out of range.
    """

    __slots__ = ("_config", "_native")

    def __init__(self, station: int, boot: int, config: Config | None = None) -> None:
        self._config = Config() if config is None else config
        self._native = _crossguard.Robot(station, boot, self._config._settings())

    @classmethod
    def _of(cls, native: _crossguard.Robot, config: Config) -> Robot:
        robot = cls.__new__(cls)
        robot._native, robot._config = native, config
        return robot

    def step(self, input: Input | Event) -> list[Output]:
        """Takes one input in; what is to be done, in order.

        It is total: an input that changes nothing yields `outputs.Ignored` with the reason. Raises
        `ValueError` for a number that is out of range, and nothing has happened then.
        """
        if isinstance(input, Event):
            input = Local(input)
        outputs = self._native.step(_wire.dumps(input))
        read = _wire.reader(Output)
        return [read(output) for output in json.loads(outputs)]

    def ram(self) -> Ram:
        """What a RAM says in this state."""
        ram: Ram = _wire.loads(Ram, self._native.ram())
        return ram

    @property
    def config(self) -> Config:
        """What it was started with."""
        return self._config

    @property
    def station(self) -> int:
        """Its station id."""
        return self._native.station

    @property
    def boot(self) -> int:
        """The boot counter that it was started with, or was told by `events.EpochRenewed` since."""
        return self._native.boot

    @property
    def state(self) -> State:
        """The state of the paper's finite-state model."""
        return State(json.loads(self._native.state()))

    @property
    def role(self) -> Role:
        """Its role in a session."""
        return Role(json.loads(self._native.role()))

    @property
    def session(self) -> SessionId | None:
        """The session that it has a part in."""
        session: SessionId | None = _wire.loads(SessionId | None, self._native.session())
        return session

    @property
    def phase(self) -> Phase:
        """Its part in a session, in full."""
        phase: Phase = _wire.loads(Phase, self._native.phase())
        return phase

    @property
    def availability(self) -> Availability:
        """Whether it takes part in coordination."""
        availability: Availability = _wire.loads(Availability, self._native.availability())
        return availability

    @property
    def identity(self) -> Identity:
        """Whether its pseudonym may change."""
        identity: Identity = _wire.loads(Identity, self._native.identity())
        return identity

    @property
    def duty(self) -> Duty | None:
        """What it still does on the road from a maneuver or session that ended early. Until it is told
        `events.RoadClear`, it takes part in nothing new."""
        duty: Duty | None = _wire.loads(Duty | None, self._native.duty())
        return duty

    @property
    def farewell(self) -> Farewell | None:
        """The session that it names as over."""
        farewell: Farewell | None = _wire.loads(Farewell | None, self._native.farewell())
        return farewell

    @property
    def next_due_ms(self) -> int | None:
        """Milliseconds until it must be told that time has passed, and `Config.delay_max_ms` later at the
        latest; `None` if no timer is armed."""
        return self._native.next_due_ms

    @property
    def next_ram_ms(self) -> int | None:
        """Milliseconds until its next periodic RAM; `None` outside of a session, where the application
        announces the robot, once a second at least."""
        return self._native.next_ram_ms

    @property
    def is_valid(self) -> bool:
        """Whether the state is one that `step` can produce under its configuration (property I13). It
        always is."""
        return self._native.is_valid

    def __copy__(self) -> Robot:
        return Robot._of(self._native.copy(), self._config)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Robot):
            return NotImplemented
        return self._native.equals(other._native) and self._config == other._config

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<Robot {self.station}: {self._native.describe()}>"
