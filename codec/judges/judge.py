"""What other encoders make of the messages of this kit.

Reads lines `TYPE HEX`. Each is decoded and encoded again by asn1tools from the kit's own modules, a CAM
also by pycrate from the module of release 1 that it brings along; what differs is an error. Then parts
of the decoded messages are exchanged, and the encodings of the results are printed in the same form,
for the kit to decode. RAM and RMCM also go through the C codec that asn1c makes of the modules, if
$CROSSGUARD_JUDGE_C names the folder with its converters. All of them run in processes of their own; no
code of them is part of the kit.

    asn1tools (MIT) 0.169.0, pycrate (LGPL-2.1) 0.8.1, asn1c (BSD-2-Clause) 0.9.28
"""

import copy
import os
import pathlib
import random
import subprocess
import sys
import tempfile

import asn1tools
from pycrate_asn1dir.ITS_CAM_2 import CAM_PDU_Descriptions

ASN1 = pathlib.Path(__file__).parent.parent / "asn1"
MODULES = ["CDD", "Common", "VAM", "RAM", "RMCM", "CAM", "CPM", "CDD211"]
RELEASE_1 = {"CAM": CAM_PDU_Descriptions.CAM}


def without_defaults(value):
    """asn1tools 0.169.0 writes a field that equals its DEFAULT where that is a named number."""
    if isinstance(value, dict):
        value = {name: without_defaults(part) for name, part in value.items()}
        defaults = {}
        if "deltaLatitude" in value and "altitudeConfidence" in value:
            defaults = {"deltaAltitude": 12800, "altitudeConfidence": "unavailable"}
        elif "transversalPosition" in value:
            defaults = {"laneType": 0, "direction": 0}
        elif "latitude" in value and "altitude" in value and not isinstance(value["altitude"], dict):
            defaults = {"altitude": 800001}
        return {n: part for n, part in value.items() if n not in defaults or part != defaults[n]}
    if isinstance(value, list):
        return [without_defaults(part) for part in value]
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], str):
        return (value[0], without_defaults(value[1]))
    return value


def mixed(one, other, chance):
    """A value with parts of another one of the same type."""
    if isinstance(one, dict) and isinstance(other, dict):
        result = {}
        for name in one.keys() | other.keys():
            if name in one and name in other:
                result[name] = mixed(one[name], other[name], chance)
            elif chance.random() < 0.5:
                result[name] = copy.deepcopy(one.get(name, other.get(name)))
        # What is in one of them only is OPTIONAL, so the result is a value of the type.
        return result
    return copy.deepcopy(one if chance.random() < 0.5 else other)


def by_c(converter, messages):
    """Messages, decoded and encoded again by a converter of asn1c."""
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, octets in enumerate(messages):
            files.append(pathlib.Path(folder, str(number)))
            files[-1].write_bytes(octets)
        command = [converter, "-iper", "-oper", *map(str, files)]
        return subprocess.run(command, capture_output=True, check=False).stdout


def judge_by_c(kind, messages, counts):
    converter = pathlib.Path(os.environ.get("CROSSGUARD_JUDGE_C", "/nonexistent"), kind)
    if not converter.exists():
        return
    if by_c(converter, messages) != b"".join(messages):
        for octets in messages:
            again = by_c(converter, [octets])
            if again != octets:
                sys.exit(f"asn1c disagrees on {kind} {octets.hex()}: {again.hex()}")
    counts[kind, "asn1c"] = len(messages)


def main():
    kit = asn1tools.compile_files([str(ASN1 / f"Crossguard-{name}.asn") for name in MODULES], "uper")
    names = {"CPM": "CollectivePerceptionMessage"}
    chance, values, counts, robots = random.Random(1), {}, {}, {"RAM": [], "RMCM": []}
    for line in sys.stdin:
        kind, digits = line.split()
        octets = bytes.fromhex(digits)
        value = kit.decode(names.get(kind, kind), octets)
        again = kit.encode(names.get(kind, kind), without_defaults(value))
        if again != octets:
            sys.exit(f"asn1tools disagrees on {kind} {digits}: {again.hex()}")
        counts[kind, "asn1tools"] = counts.get((kind, "asn1tools"), 0) + 1
        values.setdefault(kind, []).append(value)
        if kind in robots:
            robots[kind].append(octets)
        if kind in RELEASE_1:
            pdu = RELEASE_1[kind]
            pdu.from_uper(octets)
            pdu.set_val(pdu.get_val())
            if pdu.to_uper() != octets:
                sys.exit(f"pycrate disagrees on {kind} {digits}: {pdu.to_uper().hex()}")
            counts[kind, "pycrate"] = counts.get((kind, "pycrate"), 0) + 1
    for kind, messages in robots.items():
        judge_by_c(kind, messages, counts)
    for kind, known in values.items():
        for one in known:
            value = without_defaults(mixed(one, chance.choice(known), chance))
            print(kind, kit.encode(names.get(kind, kind), value).hex())
    for (kind, judge), count in sorted(counts.items()):
        print(f"{judge} agrees on {count} {kind}", file=sys.stderr)


if __name__ == "__main__":
    main()
