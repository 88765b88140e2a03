#!/usr/bin/env python3
"""Draws what `crossguard simulate obs`, `cbr` and `crossing` and `crossguard odds` print with --json.

    crossguard simulate obs --json > obs.json
    python3 -m venv venv && venv/bin/pip install matplotlib
    venv/bin/python harness/evaluation/plot.py obs.json coverage.svg

The name of the picture says its format. What the paper states is marked by dashes.
"""

import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# The paper's time from a command sent to the command received, in ms: mean and deviation.
PAPER_TIMES = {"paper: initialPos, 74 ± 15 ms": (74, 15), "paper: Move, 129 ± 102 ms": (129, 102)}


def bars(axes, cells, field, scale=1.0, stated=()):
    """A group for each number of people, a bar for each number of robots and radius; stated are ranges of the paper."""
    # Without robots there is one value, whatever the radius.
    values = {(c["robots"], c["radius_m"] if c["robots"] else 0, c["pedestrians"]): c[field] for c in cells}
    people = sorted({key[2] for key in values})
    kinds = sorted({key[:2] for key in values if key[0] or field == "mcbr"})
    width = 0.8 / len(kinds)
    for at, (robots, radius) in enumerate(kinds):
        found = [(group, values[robots, radius, it]) for group, it in enumerate(people) if (robots, radius, it) in values]
        x = [group + (at - (len(kinds) - 1) / 2) * width for group, _ in found]
        mean = [scale * value["mean"] for _, value in found]
        # Of one run there is no interval.
        half = [scale * ((value["ci95"][1] or value["mean"]) - value["mean"]) for _, value in found]
        drawn = axes.bar(x, mean, 0.9 * width, yerr=half, capsize=3, label=f"{robots} × robot, {radius:g} m" if robots else "no robot")
        axes.bar_label(drawn, fmt="%.1f", fontsize=7, padding=2)
        for robots_of, radius_of, people_of, band, words in stated:
            if (robots_of, radius_of) != (robots, radius):
                continue
            for left, group in zip(x, (group for group, _ in found)):
                if people_of in (None, people[group]):
                    size = (0.9 * width, max(band["most"] - band["least"], 0.05))
                    axes.add_patch(plt.Rectangle((left - 0.45 * width, band["least"]), *size, fill=False, ls="--", label=words))
                    words = None
    axes.axhline(0, color="black", lw=0.8)
    axes.set_xticks(range(len(people)), people)
    axes.set_xlabel("pedestrians")
    axes.margins(y=0.1)
    axes.autoscale_view()
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))


def evaluation(results):
    """The paper's figures: coverage, or channel load and its reduction."""
    cells, paper = results["cells"], results["paper"]
    far = paper["radii_m"][1]
    if "obs_percent" in cells[0]:
        figure, axes = plt.subplots(figsize=(10, 5))
        stated = [
            (1, far, None, paper["coverage_of_one_percent"], "paper: 5 to 6 % (1 robot, 15 m)"),
            (9, far, None, paper["coverage_of_nine_percent"], "paper: 17 to 18 % (9 robots, 15 m)"),
        ]
        bars(axes, cells, "obs_percent", stated=stated)
        axes.set(title="Observation coverage ratio", ylabel="coverage in %")
    else:
        figure, (load, reduction) = plt.subplots(2, figsize=(10, 9))
        bars(load, cells, "mcbr", scale=100)
        load.set(title="Mean channel busy ratio", ylabel="mCBR in %")
        words = "paper: up to 16.3 % (9 robots, 15 m, 100 people)"
        bars(reduction, cells, "reduction_percent", stated=[(9, far, 100, paper["reduction_most_percent"], words)])
        reduction.set(title="Reduction of the mean channel busy ratio", ylabel="reduction in %")
    seeds = results["parameters"]["seeds"]
    streets = f"preset {results['preset']}" if results["preset"] else "a net of SUMO"
    figure.suptitle(f"{streets}, {seeds} seeds; means and 95 % intervals", fontsize=9)
    return figure


def odds(results):
    """Loss rate against probabilities and times."""
    figure, (probability, time) = plt.subplots(2, figsize=(10, 9), sharex=True)
    middle = lambda bounds: (bounds["lower"] + bounds["upper"]) / 2
    curves = {}
    for at in sorted(results["losses"], key=lambda it: it["loss"]):
        curves.setdefault((probability, "crossing goes well"), []).append((at["loss"], middle(at["crossing"])))
        for it in at["milestones"]:
            name = it["milestone"]
            curves.setdefault((probability, name), []).append((at["loss"], middle(it["probability"])))
            if it.get("meanMs") and name in ("team", "received", "acknowledged"):
                curves.setdefault((time, f"{name}, mean"), []).append((at["loss"], middle(it["meanMs"])))
    for (axes, name), points in curves.items():
        axes.plot(*zip(*points), marker=".", label=name)
    for color, (words, (mean, deviation)) in zip(("gray", "tan"), PAPER_TIMES.items()):
        time.axhspan(mean - deviation, mean + deviation, alpha=0.3, color=color, label=words)
    probability.set(title=f"A crossing under loss, followers: {results['followers']}", ylabel="probability")
    time.set(xlabel="share of messages lost", ylabel="time in ms")
    for axes in (probability, time):
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    return figure


# What `simulate crossing` measures, by its name there.
MEASURES = {
    "people: time at the kerb, s": {"mean": "wait_s", "95th percentile": "wait_95_s"},
    "vehicles: delay, s": {"mean": "delay_s", "95th percentile": "delay_95_s"},
    "people, %": {"crossed at go": "at_sign_percent", "gave up": "gave_up_percent"},
    "per 100 people who crossed": {"TTC below 1.5 s": "ttc_per_100", "PET below 1.5 s": "pet_per_100", "hit": "hit_per_100"},
    "robots and vehicles at one place, per hour": {"": "robots_hit_per_hour"},
    "channel busy ratio, %": {"": "cbr_percent"},
}


def crossing(results):
    """A picture for each measure, against the number of robots."""
    cells = results["crossing"]
    figure, pictures = plt.subplots(2, 3, figsize=(13, 7))
    for axes, (title, fields) in zip(pictures.flat, MEASURES.items()):
        width = 0.8 / len(fields)
        for at, (label, field) in enumerate(fields.items()):
            x = [group + (at - (len(fields) - 1) / 2) * width for group in range(len(cells))]
            mean = [cell[field]["mean"] for cell in cells]
            half = [(cell[field]["ci95"][1] or value) - value for cell, value in zip(cells, mean)]
            # Nothing is below 0.
            below = [min(value, it) for value, it in zip(mean, half)]
            axes.bar(x, mean, 0.9 * width, yerr=[below, half], capsize=3, label=label)
        axes.set(title=title, xlabel="robots")
        axes.set_xticks(range(len(cells)), [cell["robots"] for cell in cells])
        if len(fields) > 1:
            axes.legend(fontsize=8)
    seeds = results["parameters"]["seeds"]
    figure.suptitle(f"A crossing, {seeds} seeds; means and 95 % intervals", fontsize=9)
    return figure


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        results = json.load(file)
    kinds = {"losses": odds, "crossing": crossing}
    draw = next((draw for name, draw in kinds.items() if name in results), evaluation)
    figure = draw(results)
    figure.tight_layout()
    figure.savefig(sys.argv[2])


if __name__ == "__main__":
    main()
