"""Values of the Rust core and values of this package: one shape for both.

The core speaks JSON in the form that its logs have. The classes of this package mirror its types name
for name, and the functions here turn one into the other by the annotations of those classes alone:

- a structure is a dataclass, and its fields have the core's names in snake_case, with the unit behind them
  (`t_ack_ms` is `tAck`) and an underscore where the name is a keyword of Python (`from_`);
- an enumeration whose members hold nothing is an `enum.Enum` whose values are the core's names;
- any other is a union of `Variant` classes, one for each member, with the core's names. Members whose
  fields have no names there are `Positional`.

`tests/test_types.py` holds every class against the core.
"""

from __future__ import annotations

import dataclasses
import enum
import json
import types
import typing
from collections.abc import Callable
from functools import cache
from typing import Any, ClassVar

#: What may stand behind the core's name of a field: its unit.
UNITS = ("_ms", "_s", "_dm", "_m", "_deg", "_dps", "_mps", "_mps2", "_per_m", "_percent")


class Variant:
    """A member of an enumeration that holds something beside its name, or has siblings that do."""

    __slots__ = ()
    #: The name of the member in the core.
    _name: ClassVar[str]

    def __init_subclass__(cls) -> None:
        if "_name" not in cls.__dict__:
            cls._name = cls.__name__[0].lower() + cls.__name__[1:]


class Positional(Variant):
    """A member whose fields have no names in the core."""

    __slots__ = ()


def camel(name: str) -> str:
    """A name in camelCase."""
    first, *rest = name.split("_")
    return first + "".join(map(str.capitalize, rest))


def name_of(field: str) -> str:
    """The core's name of a field."""
    field = field.removesuffix("_")
    for unit in sorted(UNITS, key=len, reverse=True):
        if field.endswith(unit):
            return camel(field.removesuffix(unit))
    return camel(field)


def dumps(value: object) -> str:
    """The JSON of a value."""
    try:
        return json.dumps(plain(value), allow_nan=False)
    except ValueError:
        why = "a number is NaN or infinite: None stands for what is not known"
        raise ValueError(why) from None


def loads(kind: Any, text: str) -> Any:
    """The value of a type that JSON stands for."""
    return reader(kind)(json.loads(text))


def plain(value: object) -> Any:
    """What `json` takes: dictionaries, lists, texts and numbers."""
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, enum.Enum):
        return value.value
    if isinstance(value, Variant):
        return _plain_variant(value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return _plain_fields(value)
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (int, float)):
        return value
    raise TypeError(f"{value!r} is no value of crossguard")


def _plain_fields(value: Any) -> dict[str, Any]:
    kind: Any = type(value)
    names = _field_names(kind)
    return {name: plain(getattr(value, field)) for field, name in names}


def _plain_variant(value: Any) -> Any:
    kind: Any = type(value)
    names = _field_names(kind)
    if not names:
        return value._name
    if isinstance(value, Positional):
        items = [plain(getattr(value, field)) for field, _ in names]
        return {value._name: items[0] if len(items) == 1 else items}
    return {value._name: _plain_fields(value)}


@cache
def _field_names(kind: Any) -> list[tuple[str, str]]:
    """The fields of a dataclass, with the core's names."""
    fields = dataclasses.fields(kind)
    return [(field.name, name_of(field.name)) for field in fields]


@cache
def reader(kind: Any) -> Callable[[Any], Any]:
    """What makes a value of a type out of JSON."""
    origin = typing.get_origin(kind)
    if origin in (typing.Union, types.UnionType):
        return _union_reader([arm for arm in typing.get_args(kind)])
    if origin is tuple:
        item = reader(typing.get_args(kind)[0])
        return lambda items: tuple(item(each) for each in items)
    if origin is dict:
        return lambda items: dict(items)
    if kind is bytes:
        return bytes.fromhex
    if isinstance(kind, type):
        if issubclass(kind, enum.Enum):
            return kind
        if issubclass(kind, Variant):
            return _union_reader([kind])
        if dataclasses.is_dataclass(kind):
            return _struct_reader(kind)
    return lambda value: value


def _union_reader(arms: list[Any]) -> Callable[[Any], Any]:
    some = [arm for arm in arms if arm is not type(None)]
    if len(some) < len(arms):
        inner = reader(some[0]) if len(some) == 1 else _union_reader(some)
        return lambda value: None if value is None else inner(value)
    makers = {arm._name: _maker(arm) for arm in some}

    def read(value: Any) -> Any:
        if isinstance(value, str):
            return makers[value](None)
        ((name, held),) = value.items()
        return makers[name](held)

    return read


def _maker(kind: type[Variant]) -> Callable[[Any], Any]:
    """What makes a variant out of what it holds."""
    fields = _field_readers(kind)
    if not fields:
        return lambda _: kind()
    if issubclass(kind, Positional):
        return _positional_maker(kind, [read for _, _, read, _ in fields])
    return _struct_reader(kind)


def _positional_maker(kind: Any, readers: list[Callable[[Any], Any]]) -> Callable[[Any], Any]:
    def make(held: Any) -> Any:
        # One that is alone is not in a list; what may follow it has a default then.
        items = held if isinstance(held, list) else [held]
        return kind(*(read(item) for read, item in zip(readers, items, strict=False)))

    return make


def _struct_reader(kind: Any) -> Callable[[Any], Any]:
    fields = _field_readers(kind)

    def read(value: Any) -> Any:
        given = {
            # Reports of the command have their units in the names; the protocol's values have none.
            field: read(value[name] if name in value else value[camel(field)])
            for field, name, read, is_optional in fields
            if not is_optional or name in value
        }
        return kind(**given)

    return read


def _field_readers(kind: Any) -> list[tuple[str, str, Callable[[Any], Any], bool]]:
    """Of each field: its name, the core's name, what reads it, and whether it may be left out."""
    hints = typing.get_type_hints(kind)
    missing = dataclasses.MISSING
    return [
        (
            field.name,
            name_of(field.name),
            reader(hints[field.name]),
            field.default is not missing or field.default_factory is not missing,
        )
        for field in dataclasses.fields(kind)
    ]
