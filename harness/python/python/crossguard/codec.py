"""Messages and packets as octets and as dictionaries.

A dictionary is the JSON that `crossguard codec decode` prints: `message` with the name of the message and
its fields in the spelling of ASN.1 and in the units of the wire, `packet` with the headers of the
GeoNetworking packet if there is one, `standard`, and `octets`, their number.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from . import _crossguard


def decode(octets: bytes, *, dictionary: str = "2.4.1") -> dict[str, Any]:
    """What octets say: a RAM, RMCM, CAM, VAM or CPM, or a GeoNetworking packet with one.

    `dictionary` is the version of the common data dictionary that VAM and CPM are built on, `2.4.1` or
    `2.1.1`: no header tells. The signature of a packet is not verified.

    Raises `DecodeError`, a `ValueError`, which names the field and its bit; its `cause` is the name that
    counters have for it.
    """
    decoded: dict[str, Any] = json.loads(_crossguard.decode(octets, dictionary))
    return decoded


def encode(message: Mapping[str, Any]) -> bytes:
    """The octets of a message or packet: what `decode` gave, or the message in it alone.

    Raises `EncodeError`, a `ValueError`, which names what is missing, unknown or out of range.
    """
    return _crossguard.encode(json.dumps(message))
