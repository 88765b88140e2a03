"""Storm judges the Markov chains that `crossguard odds --export` writes.

    odds_judge.py FOLDER

It reads each chain's DRN with Storm, lets Storm work out what `figures.json` says of it, and compares to 1e-6. The
files for PRISM are put into Storm's own explicit form, which has another head, and judged in the same way.
"""

import json
import sys
import tempfile
from pathlib import Path

import stormpy

TOLERANCE = 1e-6


def check(model, formula):
    """What Storm says of the first state."""
    properties = stormpy.parse_properties(formula)
    result = stormpy.model_checking(model, properties[0])
    return float(result[model.initial_states[0]])


def questions(figures):
    """Formulas, with the bounds of the answer as `crossguard` has it."""
    for it in figures["within"]:
        value = it["probability"]
        formula = f'P=? [F<={it["steps"]} "{it["label"]}"]'
        yield formula, value, value
    for it in figures["ever"]:
        value = it["probability"]
        yield f'P=? [F "{it["label"]}"]', value["lower"], value["upper"]
    if "expected_steps" in figures:
        value = figures["expected_steps"]
        yield 'R{"steps"}=? [F "over"]', value["lower"], value["upper"]


def of_prism(stage):
    """The chain in the files for PRISM."""
    head, *labelled = stage.with_suffix(".lab").read_text().splitlines()
    names = dict(it.replace('"', "").split("=") for it in head.split())
    with tempfile.TemporaryDirectory() as folder:
        tra, lab = Path(folder, "chain.tra"), Path(folder, "chain.lab")
        transitions = stage.with_suffix(".tra").read_text().split("\n", 1)[1]
        tra.write_text("dtmc\n" + transitions)
        lines = ["#DECLARATION", " ".join(names.values()), "#END"]
        for line in labelled:
            state, labels = line.split(": ")
            lines.append(" ".join([state, *(names[label] for label in labels.split())]))
        lab.write_text("\n".join(lines) + "\n")
        return stormpy.build_model_from_explicit(str(tra), str(lab))


def judge(folder, figures):
    """How many answers agree, and the largest difference."""
    stage = folder / figures["stage"]
    drn = stormpy.build_model_from_drn(str(stage.with_suffix(".drn")))
    prism = of_prism(stage)
    for model in (drn, prism):
        size = (model.nr_states, model.nr_transitions)
        wanted = (figures["states"], figures["transitions"])
        assert size == wanted, f"{stage}: {size} and not {wanted}"
    largest, count = 0.0, 0
    for formula, lower, upper in questions(figures):
        models = [drn]
        if "R{" not in formula:
            # Storm's own explicit form has rewards without names.
            models.append(prism)
        for model in models:
            value = check(model, formula)
            difference = max(lower - value, value - upper, 0.0)
            largest, count = max(largest, difference), count + 1
            assert difference <= TOLERANCE, f"{stage} {formula}: Storm has {value}, and not {lower} to {upper}"
    return count, largest


def main():
    folder = Path(sys.argv[1])
    for figures in json.loads((folder / "figures.json").read_text()):
        count, largest = judge(folder, figures)
        print(f'{figures["stage"]}: {figures["states"]} states, {count} answers of Storm agree, '
              f"the largest difference is {largest:.1e}")


main()
