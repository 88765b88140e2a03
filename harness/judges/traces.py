"""Where people and robots are, by the trace files that come along and by SUMO's files, for the judges of the evaluation."""

import gzip
import json
import math
import xml.etree.ElementTree as xml


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


CLOCKWISE = ("south-west", "north-west", "north-east", "south-east")


def corners(parameters):
    """Where robots can be on a grid: at each intersection its first corner, then the opposite one, then those between."""
    grid, site = parameters["grid"], parameters["robot_site"]
    turns = (0, 2, 1, 3)[: parameters["robots_per_intersection"]]
    sites = [CLOCKWISE[(CLOCKWISE.index(site) + it) % 4] if site in CLOCKWISE else site for it in turns]
    by_site = [robots(grid, it, grid["nodes_per_side"] ** 2) for it in sites]
    return [place for node in zip(*by_site) for place in node]


def elements(path):
    """The elements of a file of SUMO, plain or packed."""
    with (gzip.open if path.endswith(".gz") else open)(path, "rb") as file:
        for _, element in xml.iterparse(file):
            yield element


def recorded(path):
    """Where everybody on foot is at every step of floating car data, with the number of the step."""
    places, steps = [], 0
    for element in elements(path):
        if element.tag == "timestep":
            people = element.findall("person")
            places += [(steps, float(it.get("x")), float(it.get("y"))) for it in people]
            steps += 1
            element.clear()
    return places


def intersections(path):
    """The intersections of a net, the one nearest to the middle first."""
    nodes, middle = [], None
    for it in elements(path):
        if it.tag == "location":
            west, south, east, north = map(float, it.get("convBoundary").split(","))
            middle = ((west + east) / 2, (south + north) / 2)
        elif it.tag == "junction" and it.get("type") not in ("internal", "dead_end"):
            nodes.append((float(it.get("x")), float(it.get("y"))))
    return sorted(nodes, key=lambda node: math.dist(node, middle))


def scheduled(at, time):
    """Where a robot with these times and places is."""
    before = max((it for it in at if it[0] <= time), key=lambda it: it[0], default=at[0])
    after = min((it for it in at if it[0] > time), key=lambda it: it[0], default=before)
    share = (time - before[0]) / (after[0] - before[0]) if after[0] > before[0] else 0
    return [a + (b - a) * max(share, 0) for a, b in zip(before[1], after[1])]
