"""Coverage by a few lines of another language, from the trace files that come along or from SUMO's own files.

Usage: python3 coverage.py TRACES... < results of `crossguard simulate obs --json`
       python3 coverage.py NET.xml FCD.xml... < results of the same with --net and --fcd

Every cell of the results has to agree within 0.00001 percentage points with what is computed here from the
trace file with the same number of people, the share of the covered time at intersections as well. Robots stand where the results' parameters say: at
the corners of the grid's intersections, on a net at its intersections, or where --robots-at had them. With dispatch_interval_s they go from there to
where dispatch.py sends them. Robots on patrol are not judged. Confidence intervals, and the verdicts on coverage, are computed anew as well.
"""

import json
import sys

from dispatch import dispatched
from intervals import above, below, every, interval, less, within
from traces import by_people, corners, intersections, recorded, scheduled, ways

TOLERANCE = 0.00001
# Section III-B of the paper.
PEOPLE, LARGE, SMALL = (20, 50, 100), 15, 10


def coverage(run, parameters, cell):
    """Percent of the samples of all people that are within the radius of a robot; and of these, of those
    within 20 m of an intersection along both streets."""
    grid, radius, places = parameters["grid"], cell["radius_m"], corners(parameters)
    steps = [list(enumerate(there)) for there in zip(*ways(run))]
    if "dispatch_interval_s" in parameters:
        at = list(dispatched(parameters, cell, steps, places))
    else:
        at = [places[: cell["robots"]]] * len(steps)
    nodes = [index * grid["segment_m"] for index in range(grid["nodes_per_side"])]
    near = lambda metres: any(abs(metres - node) <= 20 for node in nodes)
    seen = seen_there = samples = 0
    for robots, people in zip(at, steps):
        for _, (x, y) in people:
            samples += 1
            if any((x - a) ** 2 + (y - b) ** 2 <= radius**2 for a, b in robots):
                seen += 1
                seen_there += near(x) and near(y)
    return 100 * seen / samples, 100 * seen_there / max(seen, 1)


def on_a_net(parameters, cell, net, people):
    """Percent of the samples of a recording that are within the radius of a robot."""
    nodes, by_file = intersections(net), parameters.get("robots_at")
    step_s, seen, sent = parameters["sample_ms"] / 1000, 0, []
    if by_file:
        nodes = [it["at"][0][1] for it in by_file]
    if "dispatch_interval_s" in parameters:
        # Who it is matters only where some people are hidden or have no device.
        steps = [[] for _ in range(people[-1][0] + 1)]
        for step, x, y in people:
            steps[step].append((0, (x, y)))
        sent = list(dispatched(parameters, cell, steps, nodes))
    for step, x, y in people:
        if sent:
            at = sent[step]
        elif by_file:
            at = [scheduled(it["at"], step * step_s) for it in by_file[: cell["robots"]]]
        else:
            at = nodes[: cell["robots"]]
        seen += any((x - a) ** 2 + (y - b) ** 2 <= cell["radius_m"] ** 2 for a, b in at)
    return 100 * seen / len(people)


def verdicts(cells):
    """What the coverage of these cells says of the paper's statements, where they have all that it is about."""
    by = {(c["robots"], c["pedestrians"], c["radius_m"]): c["obs_percent"]["by_seed"] for c in cells}
    if not all((r, n, m) in by for r in (0, 1, 9) for n in PEOPLE for m in (SMALL, LARGE)):
        return {}
    pairs = [(by[r, n, SMALL], by[r, n, LARGE]) for r in (1, 9) for n in PEOPLE]
    more = [(by[1, n, m], by[9, n, m]) for n in PEOPLE for m in (SMALL, LARGE)]
    return {
        "coverageOfOne": every(within(by[1, n, LARGE], 4.5, 6.5) for n in PEOPLE),
        "coverageOfNine": every(within(by[9, n, LARGE], 16.5, 18.5) for n in PEOPLE),
        "severalAreBetter": every(above(less(nine, 1, one)) for one, nine in more),
        "proportionalDecrease": every(
            outcome
            for small, large in pairs
            for outcome in (above(less(small, 1.6 / 3, large)), below(less(small, 2.4 / 3, large)))
        ),
    }


def main():
    results = json.load(sys.stdin)
    for cell in results["cells"]:
        found = [it for it in cell["obs_percent"]["ci95"] if it is not None]
        expected = [it for it in interval(cell["obs_percent"]["by_seed"]) if abs(it) < 1e9]
        if len(found) != len(expected) or any(abs(a - b) > 0.01 for a, b in zip(found, expected)):
            sys.exit(f"{cell}: the interval is {expected} by coverage.py")
    if "net" in results["parameters"]:
        net, *recordings = sys.argv[1:]
        people = [recorded(path) for path in recordings]
        worst = 0
        for cell in results["cells"]:
            for it, found in zip(people, cell["obs_percent"]["by_seed"], strict=True):
                expected = on_a_net(results["parameters"], cell, net, it)
                worst = max(worst, abs(found - expected))
                if not abs(found - expected) <= TOLERANCE:
                    sys.exit(f"{cell}: {found:.3f} is {expected:.3f} by coverage.py")
        print(f"{len(results['cells'])} cells agree, the worst within {worst:.6f} percentage points")
        return
    stated = {it["statement"]: it["outcome"] for it in results["statements"]}
    for statement, outcome in verdicts(results["cells"]).items():
        if stated[statement] != outcome:
            sys.exit(f"{statement} is {stated[statement]}, but {outcome} by coverage.py")
    worst, compared = 0, 0
    files = by_people(sys.argv[1:])
    for cell in results["cells"]:
        if cell["robots"] == 0:
            continue
        file = files[cell["pedestrians"]]
        runs = [it for it in file["runs"] if it["seed"] in cell["seeds"]]
        runs = [coverage(run, results["parameters"], cell) for run in runs]
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
