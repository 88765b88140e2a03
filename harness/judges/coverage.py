"""Coverage by a few lines of another language, from the trace files that come along.

Usage: python3 coverage.py TRACES... < results of `crossguard simulate obs --json`

Every cell of the results has to agree within 0.1 percentage points with what is computed here from the
trace file with the same number of people, the share of the covered time at intersections as well. Robots stand where the results' parameters say. The paper's
robots, that is: one per intersection, which stand.
"""

import json
import sys

from traces import by_people, robots, ways

TOLERANCE = 0.1


def coverage(run, grid, at, radius):
    """Percent of the samples of all people that are within the radius of a robot; and of these, of those
    within 20 m of an intersection along both streets."""
    nodes = [index * grid["segment_m"] for index in range(grid["nodes_per_side"])]
    near = lambda metres: any(abs(metres - node) <= 20 for node in nodes)
    seen = seen_there = samples = 0
    for way in ways(run):
        for x, y in way:
            samples += 1
            if any((x - a) ** 2 + (y - b) ** 2 <= radius**2 for a, b in at):
                seen += 1
                seen_there += near(x) and near(y)
    return 100 * seen / samples, 100 * seen_there / max(seen, 1)


def main():
    results = json.load(sys.stdin)
    site, worst, compared = results["parameters"]["robot_site"], 0, 0
    files = by_people(sys.argv[1:])
    for cell in results["cells"]:
        if cell["robots"] == 0:
            continue
        file = files[cell["pedestrians"]]
        at = robots(file["grid"], site, cell["robots"])
        runs = [coverage(run, file["grid"], at, cell["radius_m"]) for run in file["runs"]]
        compared += 1
        for name, shares in zip(("obs_percent", "covered_at_intersections_percent"), zip(*runs)):
            found, expected = cell[name]["mean"], sum(shares) / len(shares)
            worst = max(worst, abs(found - expected))
            if not abs(found - expected) <= TOLERANCE:
                sys.exit(f"{cell}: {name} is {expected:.3f} by coverage.py")
    if not compared:
        sys.exit("there is nothing to compare")
    print(f"{compared} cells agree, the worst within {worst:.6f} percentage points")


main()
