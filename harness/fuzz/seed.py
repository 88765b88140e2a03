"""Writes the seed corpus of the fuzz targets from the codec's golden vectors, to corpus/<target>/."""

import json
import pathlib

HERE = pathlib.Path(__file__).parent
GOLDEN = HERE.parent.parent / "codec/tests/golden"
PORTS = {240: 2998, 241: 2999, 1: 2002, 2: 2001, 14: 2009, 16: 2018}
# A basic header with 1 s, and the common header and position of a station.
FRONT = "11000501" + "20500280"
SOURCE = "3000020000000009bf0353e81d1103b105702107856d0384" + "00000000"


def vectors():
    for name in ["its.txt", "vam.txt", "packets.txt"]:
        for line in (GOLDEN / name).read_text().splitlines():
            if ": " in line and not line.startswith("#"):
                yield bytes.fromhex(line.split(": ")[1])
    for message in json.loads((GOLDEN / "messages.json").read_text()):
        yield bytes.fromhex(message["octets"])


def packet(message):
    head = FRONT + f"{len(message) + 4:04x}0100" + SOURCE + f"{PORTS[message[1]]:04x}0000"
    return bytes.fromhex(head) + message


def main():
    seeds = {"message": [], "packet": [], "envelope": [], "receive": []}
    for octets in vectors():
        whole = octets if octets[0] == 0x11 else packet(octets)
        if whole is not octets:
            seeds["message"].append(octets)
        seeds["packet"].append(whole)
        seeds["receive"].append(len(whole).to_bytes(2, "big") + whole)
        signed = bytes.fromhex("0381004003" + "80") + len(whole[4:]).to_bytes(1, "big") + whole[4:]
        if len(whole) < 132:
            seeds["envelope"].append(signed)
    for target, all_of_it in seeds.items():
        folder = HERE / "corpus" / target
        folder.mkdir(parents=True, exist_ok=True)
        for number, octets in enumerate(all_of_it):
            (folder / f"golden-{number:02}").write_bytes(octets)
        print(f"{target}: {len(all_of_it)} seeds")


main()
