"""Whether codec/doc/departures.md has every choice of IEEE 1609.2: each alternative of each CHOICE and ENUMERATED type
that a secured packet can reach, and each extension of a header and of a certificate. And whether another decoder reads
each packet of codec/tests/golden/security.json that is to be taken.

The types are those of the modules that pycrate (LGPL-2.1) 0.8.1 brings along. A row names its type in the first cell
and its alternatives in the second; `all of TYPE` names all alternatives of a type that is not looked into.
"""

import json
import pathlib
import re
import sys

from pycrate_asn1dir.ITS_IEEE1609_2 import Ieee1609Dot2, Ieee1609Dot2BaseTypes

CODEC = pathlib.Path(__file__).parent.parent
TABLE = CODEC / "doc" / "departures.md"
VECTORS = CODEC / "tests" / "golden" / "security.json"
# Of these SEQUENCE types the fields that may be there are choices as well.
SEQUENCES = {"HeaderInfo": 1, "ToBeSignedCertificate": 5, "SignedDataPayload": 0}
# They are in every certificate of its kind, and checked as security.md says.
IN_ALL = {"appPermissions", "certIssuePermissions", "encryptionKey", "verifyKeyIndicator"}


def choices():
    for module in (Ieee1609Dot2, Ieee1609Dot2BaseTypes):
        for it in module._all_:
            if it._name[0].islower() or it._name == "_item_":
                continue
            if it.TYPE in ("CHOICE", "ENUMERATED"):
                yield it._name, [name for name in it._cont if name != "reserved"]
            elif it._name in SEQUENCES:
                fields = list(it._cont)[SEQUENCES[it._name] :]
                yield it._name, [name for name in fields if it._name == "HeaderInfo" or name not in IN_ALL]


def main():
    rows, whole = {}, set()
    for line in TABLE.read_text().splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) == 7:
            words = set(re.findall(r"[\w-]+", cells[2]))
            rows.setdefault(cells[1].split(" ")[0], set()).update(words)
            if " all of " in cells[2]:
                whole.update(re.findall(r"\b[A-Z]\w+", cells[2].split(" all of ")[1]))
            if cells[2] == "all":
                whole.add(cells[1])
    missing, found = [], 0
    for kind, alternatives in choices():
        for name in alternatives:
            found += 1
            if kind not in whole and name not in rows.get(kind, ()):
                missing.append(f"{kind}.{name}")
    if missing or found < 80:
        sys.exit(f"departures.md says nothing of {', '.join(missing) or 'so few'}")
    vectors = json.loads(VECTORS.read_text())["vectors"]
    taken = [packet["octets"] for it in vectors for packet in it["packets"] if packet["refused"] is None]
    for octets in taken:
        # Behind the basic header; what cannot be decoded raises an error.
        Ieee1609Dot2.Ieee1609Dot2Data.from_coer(bytes.fromhex(octets)[4:])
    print(f"choices.py: departures.md has all {found} choices, and pycrate reads {len(taken)} packets that are taken")


if __name__ == "__main__":
    main()
