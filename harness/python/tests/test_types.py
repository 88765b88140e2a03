"""The classes of the package have the shapes of the Rust types, name for name."""

from __future__ import annotations

import dataclasses
import enum
import json
import typing
from typing import Any

import pytest

from crossguard import (
    _crossguard,
    _wire,
    body,
    config,
    events,
    inputs,
    messages,
    notices,
    outputs,
    phases,
    reasons,
    timers,
    types,
)

SHAPES: dict[str, Any] = json.loads(_crossguard.shapes())

# The class or union of the package for each type that crosses.
MIRRORS: dict[str, Any] = {
    "Answer": messages.Answer,
    "Availability": types.Availability,
    "Battery": body.Battery,
    "Command": messages.Command,
    "ConfidenceEllipse": body.ConfidenceEllipse,
    "Confirmation": messages.Confirmation,
    "Contact": phases.Contact,
    "ControlMode": body.ControlMode,
    "Coordination": messages.Coordination,
    "Corridor": phases.Corridor,
    "CorridorClosure": reasons.CorridorClosure,
    "Dimensions": body.Dimensions,
    "Disengagement": reasons.Disengagement,
    "DriveDirection": body.DriveDirection,
    "Duty": phases.Duty,
    "EndReason": reasons.EndReason,
    "Ending": messages.Ending,
    "Event": events.Event,
    "Failure": reasons.Failure,
    "FallbackPolicy": types.FallbackPolicy,
    "Farewell": messages.Farewell,
    "Following": phases.Following,
    "GoneReason": reasons.GoneReason,
    "HelpRequest": types.HelpRequest,
    "Identifiers": config.Identifiers,
    "Identity": phases.Identity,
    "Ignored": reasons.Ignored,
    "Input": inputs.Input,
    "Job": phases.Job,
    "Leading": phases.Leading,
    "Lease": phases.Lease,
    "Maneuver": types.Maneuver,
    "ManeuverId": types.ManeuverId,
    "MapPlace": body.MapPlace,
    "Measurement": body.Measurement,
    "Member": phases.Member,
    "MessageIdentifiers": config.MessageIdentifiers,
    "Notice": notices.Notice,
    "Offer": phases.Offer,
    "Offering": phases.Offering,
    "OperationalJobRole": body.JobRole,
    "Order": phases.Order,
    "Output": outputs.Output,
    "Outstanding": phases.Outstanding,
    "PastPosition": body.PastPosition,
    "Phase": phases.Phase,
    "Position": body.Position,
    "Progress": messages.Progress,
    "PublicSignal": body.PublicSignal,
    "Ram": messages.Ram,
    "Refusal": phases.Refusal,
    "Rejection": reasons.Rejection,
    "ReleaseReason": reasons.ReleaseReason,
    "Report": messages.Report,
    "Requesting": phases.Requesting,
    "Rmcm": messages.Rmcm,
    "Rival": phases.Rival,
    "RobotCategory": body.RobotCategory,
    "RobotState": body.RobotState,
    "Role": types.Role,
    "Service": outputs.Service,
    "SessionId": types.SessionId,
    "Settings": config.Config,
    "SignalsShown": body.SignalsShown,
    "SlowState": body.SlowState,
    "State": types.State,
    "StopReason": reasons.StopReason,
    "Target": body.Target,
    "TaskParameters": body.TaskParameters,
    "TaskProgression": body.TaskProgression,
    "Timer": timers.Timer,
    "Trigger": outputs.Trigger,
    "Unavailability": reasons.Unavailability,
    "UniqueNumber": types.UniqueNumber,
    "Urgency": types.Urgency,
    "Verdict": messages.Verdict,
}

# Settings for models that explore what happens at the wrap; robots have no use for them.
FOR_MODELS = {"firstRequest", "firstHeartbeat"}
# Types that cross as what is in them.
TRANSPARENT = {"Countdown", "Dictionary"}


def test_every_type_that_crosses_has_a_mirror() -> None:
    assert set(SHAPES) - TRANSPARENT == set(MIRRORS)


@pytest.mark.parametrize("name", sorted(MIRRORS))
def test_mirror_has_the_same_shape(name: str) -> None:
    ((form, shape),) = SHAPES[name].items()
    mirror = MIRRORS[name]
    if form == "STRUCT":
        assert field_names(mirror) == [named for field in shape if (named := only(field)) not in FOR_MODELS]
    elif form == "ENUM" and isinstance(mirror, type) and issubclass(mirror, enum.Enum):
        assert [member.value for member in mirror] == [only(shape[i]) for i in sorted(shape, key=int)]
    else:
        assert form == "ENUM"
        variants = [next(iter(shape[i].items())) for i in sorted(shape, key=int)]
        arms = typing.get_args(mirror)
        assert [arm._name for arm in arms] == [variant for variant, _ in variants]
        for arm, (_, held) in zip(arms, variants, strict=True):
            assert_holds(arm, held)


def assert_holds(arm: type[_wire.Variant], held: Any) -> None:
    """A variant class has the fields of the variant."""
    required = [
        field
        for field in dataclasses.fields(arm)  # type: ignore[arg-type]
        if field.default is dataclasses.MISSING or not issubclass(arm, _wire.Positional)
    ]
    positional = issubclass(arm, _wire.Positional)
    if held == "UNIT":
        assert not required
        return
    ((form, inner),) = held.items()
    if form == "NEWTYPE" and not positional:
        # Its fields are those of the structure in it.
        assert field_names(arm) == [only(field) for field in SHAPES[inner["TYPENAME"]]["STRUCT"]]
    elif form == "NEWTYPE":
        assert len(dataclasses.fields(arm)) - len(required) <= 1  # type: ignore[arg-type]
    elif form == "TUPLE":
        # What may be missing may be left out.
        optional = sum("OPTION" in element for element in inner)
        assert positional and len(inner) - optional <= len(required) <= len(inner)
    else:
        assert form == "STRUCT" and not positional
        assert field_names(arm) == [only(field) for field in inner]


def only(field: dict[str, Any]) -> str:
    (name,) = field
    return name


def field_names(mirror: Any) -> list[str]:
    return [_wire.name_of(field.name) for field in dataclasses.fields(mirror)]


def test_every_reason_can_stand_where_its_union_says() -> None:
    """What Rust names, the classes read; the other way is tested by every step of `test_robot`."""
    for name, mirror in MIRRORS.items():
        ((form, shape),) = SHAPES[name].items()
        if form == "ENUM" and not (isinstance(mirror, type) and issubclass(mirror, enum.Enum)):
            for variant in shape.values():
                ((member, held),) = variant.items()
                if held == "UNIT":
                    value = _wire.reader(mirror)(member)
                    assert _wire.plain(value) == member


def test_a_value_that_is_none_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="no value of crossguard"):
        _wire.dumps(object())
