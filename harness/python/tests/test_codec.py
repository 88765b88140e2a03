"""Messages and packets as dictionaries."""

from __future__ import annotations

import json
import subprocess

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from conftest import REPOSITORY
from crossguard import DecodeError, EncodeError, Endpoint, Moment, decode, encode, events, outputs

GOLDEN = REPOSITORY / "codec" / "tests" / "golden"
MESSAGES = json.loads((GOLDEN / "messages.json").read_text())
AT = Moment(1_000, 1_795_305_600_000)


def golden(file: str) -> dict[str, bytes]:
    """Named octets of a golden file."""
    lines = (GOLDEN / file).read_text().splitlines()
    named = [line.split(": ") for line in lines if ": " in line and not line.startswith("#")]
    return {name: bytes.fromhex(digits) for name, digits in named}


@pytest.mark.parametrize("vector", MESSAGES, ids=[vector["name"] for vector in MESSAGES])
def test_golden_messages(vector: dict[str, object]) -> None:
    octets = bytes.fromhex(str(vector["octets"]))
    assert decode(octets)["message"] == vector["message"]
    assert encode(vector["message"]) == octets  # type: ignore[arg-type]


def test_golden_packet() -> None:
    packet = golden("packets.txt")["G1"]
    decoded = decode(packet)
    assert decoded["octets"] == len(packet)
    assert "cam" in decoded["message"]
    assert encode(decoded) == packet


def test_what_is_no_message_names_the_field_and_the_cause() -> None:
    octets = bytes.fromhex(MESSAGES[0]["octets"])
    with pytest.raises(DecodeError, match="too few for the header") as short:
        decode(octets[:3])
    assert short.value.cause == "too short"
    with pytest.raises(DecodeError, match=r"bit \d+") as cut:
        decode(octets[:-4])
    assert cut.value.cause == "truncated"
    with pytest.raises(ValueError, match=r"no dictionary '3'"):
        decode(octets, dictionary="3")


def test_what_has_no_octets_says_what_is_wrong() -> None:
    with pytest.raises(EncodeError, match="not a message: unknown variant `ramm`"):
        encode({"ramm": {}})
    with pytest.raises(EncodeError, match="missing field"):
        encode({"ram": {"header": {}}})
    packet = decode(golden("packets.txt")["G1"])
    packet["packet"] = {"basic": 1}
    with pytest.raises(EncodeError, match="not the headers of a packet"):
        encode(packet)


def test_a_robots_packet_is_taken_apart() -> None:
    endpoint = Endpoint(7, 3, name="Seven", at=AT)
    effects = endpoint.tell(events.PedestrianDetected(), AT)
    (sent,) = [effect for effect in effects if isinstance(effect, outputs.Send)]
    decoded = decode(sent.packet)
    assert decoded["message"]["ram"]["header"]["stationId"] == 7
    assert decode(sent.message)["message"] == decoded["message"]
    assert encode(decoded) == sent.packet
    assert encode(decoded["message"]) == sent.message


def test_it_is_what_the_command_prints(crossguard_command: str) -> None:
    packet = golden("packets.txt")["G1"]
    command = [crossguard_command, "codec", "decode", "--hex", packet.hex()]
    printed = subprocess.run(command, check=True, capture_output=True).stdout
    assert json.loads(printed) == decode(packet)


@settings(deadline=None)
@given(st.binary(max_size=300))
def test_any_octets_are_a_message_of_their_own_or_an_error(octets: bytes) -> None:
    try:
        decoded = decode(octets)
    except DecodeError as error:
        assert error.cause
    else:
        assert encode(decoded) == octets or "extended" in decoded or "canonical" in decoded


@settings(deadline=None)
@given(st.sampled_from(MESSAGES), st.data())
def test_flipped_bits_are_another_message_or_an_error(vector: dict[str, str], data: st.DataObject) -> None:
    octets = bytearray.fromhex(vector["octets"])
    bit = data.draw(st.integers(0, 8 * len(octets) - 1))
    octets[bit // 8] ^= 1 << bit % 8
    try:
        decoded = decode(bytes(octets))
    except DecodeError:
        return
    if "extended" not in decoded and "canonical" not in decoded:
        assert decoded["message"] != vector["message"]
        assert encode(decoded) == bytes(octets)
