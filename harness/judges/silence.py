"""Who was silent though no robot could see them, by a few lines of another language.

Usage: python3 silence.py RESULTS SILENCES TRACES...

RESULTS is the output of `crossguard simulate cbr --json --silences SILENCES`, TRACES are the trace files of the same
preset. From the times at which devices were silent, and from where people and robots were by the traces, this
computes again, every 100 ms after the first 5 s:

- the share of devices' time in which they were silent, in every cell;
- the share in which they were so though no robot perceived them. A robot perceives who came within its radius until
  they are 1 m further away, unless it never perceives them (the share `unseen_share`);
- by the strict rule, where robots perceive everybody in their zone, that hardly any of the silence is wrong, and that most of the people who are perceived are silent;
- the verdicts on the paper's statements on channel load, from the cells.

Simulation and judge look at different moments within 100 ms, so shares may differ by 0.2 percentage points.
"""

import csv
import json
import math
import sys

from intervals import above, below, every, less, within
from traces import by_people, robots, ways

STEP_MS, SETTLING_MS, HYSTERESIS = 100, 5000, 1.0
TOLERANCE = 0.2
# Section III-B of the paper.
PEOPLE, LARGE, SMALL = (20, 50, 100), 15, 10


def perceived(way, sample_ms, end_ms, at, radius):
    """Whether any robot perceives this person, at every step."""
    seen, now = [False] * len(at), []
    for now_ms in range(0, end_ms, STEP_MS):
        index, rest = divmod(now_ms, sample_ms)
        (x, y), (u, v) = way[index], way[min(index + 1, len(way) - 1)]
        share = rest / sample_ms
        x, y = x + (u - x) * share, y + (v - y) * share
        for robot, (a, b) in enumerate(at):
            reach = radius + HYSTERESIS if seen[robot] else radius
            seen[robot] = math.hypot(x - a, y - b) <= reach
        now.append(any(seen))
    return now


def is_unseen(person, share):
    """Whether no robot ever perceives this person."""
    return math.floor((person + 1) * share + 1e-9) > math.floor(person * share + 1e-9)


def shares(file, cell, parameters, silences):
    """Percent of devices' time: silent, silent though not perceived, perceived."""
    behaviour = parameters["behaviour"]
    at = robots(file["grid"], parameters["robot_site"], cell["robots"])
    silent = wrong = covered = steps = 0
    for run in file["runs"][: parameters["seeds"]]:
        end_ms = (len(run["pedestrians"][0][0]) - 1) * file["sample_ms"]
        for person, way in enumerate(ways(run)):
            sees = perceived(way, file["sample_ms"], end_ms, at, cell["radius_m"])
            if is_unseen(person, behaviour["unseen_share"]):
                sees = [False] * len(sees)
            quiet = [False] * len(sees)
            for from_ms, to_ms in silences.get((run["seed"], person), ()):
                for index in range(-(-from_ms // STEP_MS), -(-to_ms // STEP_MS)):
                    if index < len(quiet):
                        quiet[index] = True
            first = SETTLING_MS // STEP_MS
            steps += len(sees) - first
            covered += sum(sees[first:])
            silent += sum(quiet[first:])
            wrong += sum(q and not s for q, s in zip(quiet[first:], sees[first:]))
    return [100 * it / steps for it in (silent, wrong, covered)]


def read_silences(path):
    """By cell, then by run and person."""
    silences = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            cell = (int(row["robots"]), int(row["pedestrians"]), float(row["radius_m"]))
            who = (int(row["seed"]), int(row["person"]))
            times = (int(row["from_ms"]), int(row["to_ms"]))
            silences.setdefault(cell, {}).setdefault(who, []).append(times)
    return silences


def verdicts(cells):
    """What a reader of the paper finds in the cells, where they have everything that it is about."""
    by = {(c["robots"], c["pedestrians"], c["radius_m"]): c for c in cells}
    if not all((r, n, m) in by for r in (0, 1, 9) for n in PEOPLE for m in (SMALL, LARGE)):
        return {}
    of = lambda name: {key: cell[name]["by_seed"] for key, cell in by.items()}
    load, cut = of("mcbr"), of("reduction_percent")
    silent, wrong = of("passive_percent"), of("wrongly_silent_percent")
    ram = {key: cell["messages_per_s"][2]["by_seed"] for key, cell in by.items()}
    guarded = [key for key in by if key[0]]
    more = lambda many, few: above(less(many, 1, few))
    pairs = [((robots, n, SMALL), (robots, n, LARGE)) for robots in (1, 9) for n in PEOPLE]
    grows = [[cut[robots, people, LARGE] for people in PEOPLE] for robots in (1, 9)]
    most = (9, 100, LARGE)
    # "Diminishing": once to nine times as much by nine robots.
    of_both = [(cut[1, n, LARGE], cut[9, n, LARGE]) for n in PEOPLE]
    factors = [it for one, nine in of_both for it in (more(nine, one), below(less(nine, 9, one)))]
    return {
        "lowLoad": every(below(load[key], 0.3) for key in by),
        "consistentReduction": every(above(cut[key]) for key in guarded),
        "growsWithDensity": every(more(b, a) for it in grows for a, b in zip(it, it[1:])),
        "largestReduction": every(
            [more(cut[most], cut[key]) for key in by if key != most]
            + [within(cut[most], 16.25, 16.35)]
        ),
        "smallerRadius": every(
            it for a, b in pairs for it in (above(cut[a]), more(cut[b], cut[a]))
        ),
        "diminishingGain": every(factors),
        "largerRadiusStandsForMore": every(more(silent[b], silent[a]) for a, b in pairs),
        "smallerRadiusSendsLess": every(more(ram[b], ram[a]) for a, b in pairs),
        "conservativeSilence": every(below(less(wrong[key], 0.05, silent[key])) for key in guarded),
    }


def main():
    with open(sys.argv[1]) as results:
        results = json.load(results)
    silences = read_silences(sys.argv[2])
    parameters = results["parameters"]
    behaviour = parameters["behaviour"]
    # Somebody who walks in step beside one who is perceived takes itself for them.
    all_seen = behaviour["suppression"] == "strict" and behaviour["unseen_share"] == 0
    files = by_people(sys.argv[3:])
    worst = compared = 0
    for cell in results["cells"]:
        if cell["robots"] == 0:
            continue
        key = (cell["robots"], cell["pedestrians"], cell["radius_m"])
        file = files[cell["pedestrians"]]
        silent, wrong, covered = shares(file, cell, parameters, silences.get(key, {}))
        for name, share in (("passive_percent", silent), ("wrongly_silent_percent", wrong)):
            found = cell[name]["mean"]
            worst = max(worst, abs(found - share))
            if not abs(found - share) <= TOLERANCE:
                sys.exit(f"{key} {name}: {found:.3f}, {share:.3f} by silence.py")
        if all_seen and not wrong <= 0.03 * silent:
            sys.exit(f"{key}: {wrong:.2f} of {silent:.2f} % silent are wrongly so")
        if all_seen and not 0.85 * covered <= silent - wrong <= covered:
            sys.exit(f"{key}: {covered:.2f} % are perceived, {silent - wrong:.2f} % silent")
        compared += 1
    if not compared:
        sys.exit("there is nothing to compare")
    stated = {it["statement"]: it["outcome"] for it in results["statements"]}
    own = verdicts(results["cells"])
    for statement, outcome in own.items():
        if stated[statement] != outcome:
            sys.exit(f"{statement} is {stated[statement]}, but {outcome} by silence.py")
    print(
        f"{compared} cells and {len(own)} statements agree,"
        f" the worst share within {worst:.3f} percentage points"
    )


main()
