"""Storm judges the Markov chains that `crossguard odds --export` writes.

    odds_judge.py FOLDER

It reads each chain with Storm, lets Storm work out what `figures.json` says of it, and compares to 1e-6.
"""

import json
import sys
from pathlib import Path

import stormpy

TOLERANCE = 1e-6


def check(model, formula):
    """What Storm says of the first state."""
    properties = stormpy.parse_properties(formula)
    result = stormpy.model_checking(model, properties[0])
    return float(result[model.initial_states[0]])


def questions(figures):
    """Formulas, with the answer as `crossguard` has it."""
    for it in figures["within"]:
        yield f'P=? [F<={it["steps"]} "{it["label"]}"]', it["probability"]


def judge(folder, figures):
    """How many answers agree, and the largest difference."""
    stage = folder / figures["stage"]
    model = stormpy.build_model_from_drn(str(stage.with_suffix(".drn")))
    size = (model.nr_states, model.nr_transitions)
    wanted = (figures["states"], figures["transitions"])
    assert size == wanted, f"{stage}: {size} and not {wanted}"
    largest, count = 0.0, 0
    for formula, said in questions(figures):
        value = check(model, formula)
        difference = abs(value - said)
        largest, count = max(largest, difference), count + 1
        assert difference <= TOLERANCE, f"{stage} {formula}: Storm has {value}, and not {said}"
    return count, largest


def main():
    folder = Path(sys.argv[1])
    for figures in json.loads((folder / "figures.json").read_text()):
        count, largest = judge(folder, figures)
        print(f'{figures["stage"]}: {figures["states"]} states, {count} answers of Storm agree, '
              f"the largest difference is {largest:.1e}")


main()
