#!/usr/bin/env python3
"""SUMO itself on the school street: makes the arrivals that come along, and tells how people and vehicles fare in it.

    pip install eclipse-sumo==1.28.0
    python3 harness/judges/school_street.py FOLDER_WITH_SUMO [--write]

SUMO's base case has no robots: vehicles follow each other by Krauss and yield to nobody, people wait for a gap by SUMO's own rule.
Nothing here is of the kit: the same figures of `crossguard simulate crossing --robots 0 --set yielding_share=0` stand beside these in
harness/doc/school-street.md. With --write the floating car data of the arrivals is written anew.
"""

import gzip
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

PLACE = Path(__file__).resolve().parent.parent / "evaluation/places/school-street"
# Where people and vehicles come from, and the crossing with its kerbs.
SHOWN = ["from-west", "from-east", "path-homes", "path-school", ":crossing_c0", ":crossing_w0", ":crossing_w1"]
# The middle of the road, and its half width.
MIDDLE_M, HALF_M = 20.0, 3.5
# 97.5 % quantile of Student's t for 19 degrees of freedom.
T19 = 2.093


def run(programs, seed, net, folder):
    fcd, trips, shown = folder / "fcd.xml", folder / "trips.xml", folder / "shown.txt"
    shown.write_text("".join(f"edge:{it}\n" for it in SHOWN))
    command = [programs / "sumo", "-n", net, "-r", PLACE / "demand.xml", "--seed", str(seed), "--end", "900", "--step-length", "0.1"]
    command += ["--fcd-output", fcd, "--fcd-output.filter-edges.input-file", shown, "--device.fcd.period", "1"]
    command += ["--fcd-output.attributes", "x,y", "--precision", "1", "--tripinfo-output", trips, "--no-step-log"]
    subprocess.run([str(it) for it in command], check=True)
    return fcd.read_text(), ElementTree.parse(trips).getroot()


def waits(fcd):
    """How long each person is at the kerb: from within a metre of it until on the road."""
    came, went = {}, {}
    for step in ElementTree.fromstring(fcd):
        for person in step.iter("person"):
            away = abs(float(person.get("y")) - MIDDLE_M)
            name, at = person.get("id"), float(step.get("time"))
            if away < HALF_M + 1.0:
                came.setdefault(name, at)
            if away < HALF_M and name not in went:
                went[name] = at
    # Steps are a second apart; a person who does not stop needs one for the last metre.
    return [max(0.0, went[it] - came[it] - 1.0) for it in went]


def told(name, values):
    mean = sum(values) / len(values)
    sd = math.sqrt(sum((it - mean) ** 2 for it in values) / (len(values) - 1))
    print(f"{name}: {mean:.2f} ± {T19 * sd / math.sqrt(len(values)):.2f} (95 %, {len(values)} seeds)")


def main():
    programs, writes = Path(sys.argv[1]), "--write" in sys.argv
    delays, kerb, standing, ninety_five = [], [], [], []
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        net = folder / "net.xml"
        plain = ["-n", PLACE / "nodes.xml", "-e", PLACE / "edges.xml", "-x", PLACE / "connections.xml"]
        command = [programs / "netconvert", *plain, "--walkingareas", "--no-turnarounds", "-o", net]
        subprocess.run([str(it) for it in command], check=True, stdout=subprocess.DEVNULL)
        for seed in range(1, 21):
            fcd, trips = run(programs, seed, net, folder)
            if writes:
                bare = re.sub(r"<!--.*?-->\s*", "", fcd, flags=re.DOTALL)
                (PLACE / f"{seed}.xml.gz").write_bytes(gzip.compress(bare.encode(), 9, mtime=0))
            lost = [float(it.get("timeLoss")) for it in trips.iter("tripinfo")]
            delays.append(sum(lost) / len(lost))
            stood = [float(it.get("waitingTime")) for it in trips.iter("walk")]
            standing.append(sum(stood) / len(stood))
            waited = sorted(waits(fcd))
            kerb.append(sum(waited) / len(waited))
            ninety_five.append(waited[round(0.95 * (len(waited) - 1))])
        if writes:
            bare = re.sub(r"<!--.*?-->\s*", "", net.read_text(), flags=re.DOTALL)
            (PLACE / "net.xml.gz").write_bytes(gzip.compress(bare.encode(), 9, mtime=0))
    told("delay of vehicles, s", delays)
    told("people at the kerb, mean, s", kerb)
    told("people at the kerb, 95th percentile, s", ninety_five)
    told("people who stand (below 0.1 m/s), mean, s", standing)


if __name__ == "__main__":
    main()
