"""Where robots are that are dispatched by demand: moved step by step, by the people that they see or hear at that step."""

import math
from collections import Counter


def walked(at, legs, metres):
    """Where somebody is after so many metres along these legs; the legs that are done are taken away."""
    while legs:
        left = math.dist(at, legs[0])
        if left > metres + 1e-9:
            return tuple(a + (b - a) * metres / left for a, b in zip(at, legs[0]))
        at, metres = legs.pop(0), metres - left
    return at


def assigned(at, goals, places, recent):
    """The place of each robot, by the places that saw each of the people known lately."""
    way = lambda robot, place: round(1000 * sum(abs(a - b) for a, b in zip(at[robot], places[place])))
    new, wanted, free = list(goals), [], list(range(len(at)))
    while free and (tally := Counter(it for near in recent if not near & set(wanted) for it in near)):
        place = min(tally, key=lambda it: (-tally[it], it))
        nearest = min(free, key=lambda it: (way(it, place), it))
        wanted.append(place)
        free.remove(nearest)
        new[nearest] = place
    for robot in free:
        if new[robot] in wanted:
            left = set(range(len(places))) - set(new)
            new[robot] = min(left, key=lambda it: (way(robot, it), it))
    return new


def dispatched(parameters, cell, people, places):
    """Where robots are at every step. `people` are their numbers and places at every step."""
    count, radius, behaviour = cell["robots"], cell["radius_m"], parameters["behaviour"]
    radio, unseen = behaviour["radio"], behaviour["unseen_share"]
    loss = radio["power_dbm"] - radio["sense_dbm"] - radio["loss_at_1_m_db"]
    heard = 10 ** (loss / (10 * radio["exponent"]))
    devices = behaviour["v2x_share"] * len({number for there in people for number, _ in there}) - 0.5
    hidden = lambda number: math.floor((number + 1) * unseen + 1e-9) > math.floor(number * unseen + 1e-9)
    interval, metres = parameters["dispatch_interval_s"], parameters["patrol_mps"] * parameters["sample_ms"] / 1000
    at, goals, legs, recent = places[:count], list(range(count)), [[] for _ in range(count)], []
    for step, there in enumerate(people):
        at = [walked(*it, metres if step else 0) for it in zip(at, legs)]
        for number, place in there:
            away = min((math.dist(it, place) for it in at), default=math.inf)
            if away <= radius and not hidden(number) or away <= heard and number < devices:
                recent.append({index for index, it in enumerate(places) if math.dist(it, place) <= radius})
        if step and step * parameters["sample_ms"] % (1000 * interval) == 0:
            new = assigned(at, goals, places, recent)
            for robot in range(count):
                if goals[robot] != new[robot]:
                    x, y = places[new[robot]]
                    legs[robot] = [(x, at[robot][1]), (x, y)]
            goals, recent = new, []
        yield list(at)
