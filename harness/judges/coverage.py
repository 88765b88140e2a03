"""Coverage by a few lines of another language, from the trace files that come along.

Usage: python3 coverage.py TRACES... < results of `crossguard simulate obs --json`

Every cell of the results has to agree within 0.1 percentage points with what is computed here from the
trace file with the same number of people. Robots stand where the results' parameters say. The paper's
robots, that is: one per intersection, which stand.
"""

import gzip
import json
import sys

TOLERANCE = 0.1


def places(changes):
    """Metres from centimetres that were differenced twice."""
    at, step = changes[0], 0
    yield at / 100
    for change in changes[1:]:
        step += change
        at += step
        yield at / 100


def robots(grid, site, count):
    """Where robots stand: nearest to the middle of the grid first."""
    side, segment = range(grid["nodes_per_side"]), grid["segment_m"]
    middle = (grid["nodes_per_side"] - 1) * segment / 2
    corner = grid["lanes"] * 3.2 + grid["sidewalk_m"] / 2
    east = {"east": corner, "west": -corner}.get(site.split("-")[-1], 0)
    north = {"north": corner, "south": -corner}.get(site.split("-")[0], 0)
    nodes = sorted(
        ((x * segment, y * segment) for x in side for y in side),
        key=lambda node: (node[0] - middle) ** 2 + (node[1] - middle) ** 2,
    )
    return [(x + east, y + north) for x, y in nodes[:count]]


def coverage(run, at, radius):
    """Percent of the samples of all people that are within the radius of a robot."""
    seen = samples = 0
    for east, north in run["pedestrians"]:
        for x, y in zip(places(east), places(north)):
            samples += 1
            seen += any((x - a) ** 2 + (y - b) ** 2 <= radius**2 for a, b in at)
    return 100 * seen / samples


def main():
    results = json.load(sys.stdin)
    site, worst, compared = results["parameters"]["robot_site"], 0, 0
    files = [json.load(gzip.open(path)) for path in sys.argv[1:]]
    by_people = {len(file["runs"][0]["pedestrians"]): file for file in files}
    for cell in results["cells"]:
        if cell["robots"] == 0:
            continue
        file = by_people[cell["pedestrians"]]
        at = robots(file["grid"], site, cell["robots"])
        ratios = [coverage(run, at, cell["radius_m"]) for run in file["runs"]]
        found, expected = cell["obs_percent"]["mean"], sum(ratios) / len(ratios)
        worst, compared = max(worst, abs(found - expected)), compared + 1
        if not abs(found - expected) <= TOLERANCE:
            sys.exit(f"{cell}: {expected:.3f} % by coverage.py")
    if not compared:
        sys.exit("there is nothing to compare")
    print(f"{compared} cells agree, the worst within {worst:.6f} percentage points")


main()
