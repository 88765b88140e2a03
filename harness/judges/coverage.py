"""Coverage by a few lines of another language, from the trace files that come along.

Usage: python3 coverage.py TRACES... < results of `crossguard simulate obs --json`

Every cell of the results has to agree within 0.1 percentage points with what is computed here from the
trace file with the same number of people. Robots stand where the results' parameters say. The paper's
robots, that is: one per intersection, which stand.
"""

import json
import sys

from traces import by_people, robots, ways

TOLERANCE = 0.1


def coverage(run, at, radius):
    """Percent of the samples of all people that are within the radius of a robot."""
    seen = samples = 0
    for way in ways(run):
        for x, y in way:
            samples += 1
            seen += any((x - a) ** 2 + (y - b) ** 2 <= radius**2 for a, b in at)
    return 100 * seen / samples


def main():
    results = json.load(sys.stdin)
    site, worst, compared = results["parameters"]["robot_site"], 0, 0
    files = by_people(sys.argv[1:])
    for cell in results["cells"]:
        if cell["robots"] == 0:
            continue
        file = files[cell["pedestrians"]]
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
