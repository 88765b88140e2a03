"""Where people and robots are by the trace files that come along, for the judges of the evaluation."""

import gzip
import json


def by_people(paths):
    """The trace files by how many people are in them."""
    files = [json.load(gzip.open(path)) for path in paths]
    return {len(file["runs"][0]["pedestrians"]): file for file in files}


def places(changes):
    """Metres from centimetres that were differenced twice."""
    at, step = changes[0], 0
    yield at / 100
    for change in changes[1:]:
        step += change
        at += step
        yield at / 100


def ways(run):
    """Where everybody is at every sample."""
    return [list(zip(places(east), places(north))) for east, north in run["pedestrians"]]


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
