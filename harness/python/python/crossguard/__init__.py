"""Coordination of robots that work as crossing guards in V2X traffic: a verified state machine.

- `Robot` is the state machine alone: `robot.step(input)` gives what is to be done, in order.
- `Endpoint` is a whole robot: with its packets, sending rules, counters and log.
- `decode` and `encode` turn messages and packets into dictionaries and back.
- `validate` tells whether logs are of something that could have happened.

`inputs`, `events`, `outputs`, `notices`, `reasons`, `messages`, `phases`, `timers`, `types` and `body`
have what goes in and comes out, as frozen dataclasses that `match` takes apart. All rules are in Rust;
there is none in Python.
"""

from . import body, events, inputs, messages, notices, outputs, phases, reasons, timers, types
from ._crossguard import Boot, __version__
from .body import Measurement, Position, RobotState, TaskParameters
from .codec import decode, encode
from .config import Config, Identifiers, MessageIdentifiers
from .endpoint import Endpoint, Moment
from .errors import (
    BootError,
    BrokenInequality,
    DecodeError,
    EncodeError,
    UnreadableLog,
)
from .robot import Robot
from .types import FallbackPolicy, HelpRequest, Role, State, TaskSet, TaskType, Urgency
from .validation import Fault, Late, Validated, Validation, validate

__all__ = [
    "Boot",
    "BootError",
    "BrokenInequality",
    "Config",
    "DecodeError",
    "EncodeError",
    "Endpoint",
    "FallbackPolicy",
    "Fault",
    "HelpRequest",
    "Identifiers",
    "Late",
    "Measurement",
    "MessageIdentifiers",
    "Moment",
    "Position",
    "Robot",
    "RobotState",
    "Role",
    "State",
    "TaskParameters",
    "TaskSet",
    "TaskType",
    "UnreadableLog",
    "Urgency",
    "Validated",
    "Validation",
    "__version__",
    "body",
    "decode",
    "encode",
    "events",
    "inputs",
    "messages",
    "notices",
    "outputs",
    "phases",
    "reasons",
    "timers",
    "types",
    "validate",
]
