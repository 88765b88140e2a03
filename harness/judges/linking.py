"""Which pseudonyms are one robot, by every field of every layer.

Usage: python3 linking.py PACKETS.pcap TRUTH.json PAGE.md [TABLE.csv]

PACKETS and TRUTH are of `../robot/tests/hour.rs`: ten robots that change their pseudonyms for an
hour. tshark takes the packets apart, with its own dissectors for Ethernet, GeoNetworking, IEEE 1609.2 and BTP, and with
the kit's for RAM and RMCM. So the fields are the ones that Wireshark shows, and nobody has chosen them.

At each moment of change, this looks at the pseudonyms that end and at the ones that begin, and pairs them in three ways by
each field: by values that both have, the rarer the better; by the last value of one and the first of the other, the
nearer the better; and the same for values that only grow. Besides fields there are what an eavesdropper can reckon:
phases of transmission, the offset of the sender's clock, numbers of packets. By chance one of each moment's pairs is
right on average. A field by which more are right than once in a hundred thousand such hours must stand in the list
of the page, and what stands there must link.

The judge is judged as well: three fields are planted that link as the kit once did (a boot counter, a running count,
tickets that begin together), and it must find them.
"""

import collections
import fnmatch
import json
import math
import pathlib
import random
import re
import subprocess
import sys

LUA = pathlib.Path(__file__).parent / "../../codec/wireshark/crossguard.lua"
PERIOD_S = 60
FALSE_ALARM = 1e-5
PLANTED = ("planted boot counter", "planted running count", "planted start")


def packets(path):
    """Each packet as its time and its fields: pairs of name and value, as often as they occur."""
    command = ["tshark", "-r", path, "-X", f"lua_script:{LUA}", "-T", "ek"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as tshark:
        for line in tshark.stdout:
            if line.startswith('{"timestamp"'):
                yield list(leaves(json.loads(line, object_pairs_hook=list)))
    if tshark.returncode:
        sys.exit("tshark fails")


def leaves(tree, name=""):
    """Names and values at the ends of a tree of pairs."""
    if isinstance(tree, list):
        for item in tree:
            if isinstance(item, tuple):
                yield from leaves(item[1], item[0])
            else:
                yield from leaves(item, name)
    elif tree is not None:
        yield name, str(tree)


def number(text):
    """A value as a number, if it is one: decimal, hexadecimal, or octets."""
    try:
        return float(text)
    except ValueError:
        pass
    digits = text.replace(":", "").removeprefix("0x")
    return int(digits, 16) if re.fullmatch("[0-9a-fA-F]{1,64}", digits) else None


class Pseudonym:
    """What was heard under one station id."""

    def __init__(self):
        self.times = []
        self.values = collections.defaultdict(set)
        self.first, self.last = {}, {}

    def hear(self, time, fields):
        self.times.append(time)
        for name, value in fields:
            self.say(name, value)

    def say(self, name, value):
        self.values[name].add(value)
        self.first.setdefault(name, value)
        self.last[name] = value


def station(fields):
    """The station id by the address of the source, where all of a robot's packets have it."""
    return next(int(value.replace(":", "")[4:], 16) for name, value in fields if name == "eth_eth_src")


def reckoned(time, fields):
    """What an eavesdropper can reckon from one packet."""
    named = dict(fields)
    yield "phase in 100 ms", f"{time % 0.1:.4f}"
    yield "phase in 1 s", f"{time % 1:.4f}"
    if generated := named.get("ieee1609dot2_ieee1609dot2_generationTime"):
        yield "clock offset", f"{int(generated) / 1e6 - time:.6f}"
        yield "microseconds of the clock", str(int(generated) % 1000)


def listen(path):
    """All pseudonyms by station id."""
    heard = collections.defaultdict(Pseudonym)
    for fields in packets(path):
        time = float(dict(fields)["frame_frame_time_epoch"])
        # What depends on all packets of the file, or on none, is no field of the sender.
        own = [(name, value) for name, value in fields if not name.startswith("frame_frame_time_delta")]
        heard[station(fields)].hear(time, own + list(reckoned(time, fields)))
    for one in heard.values():
        one.say("number of packets", str(len(one.times)))
        gaps = [b - a for a, b in zip(one.times, one.times[1:])]
        one.say("mean gap", f"{sum(gaps) / max(len(gaps), 1):.5f}")
    return heard


def plant(heard, truth):
    """Fields that link as the kit once did."""
    draws = random.Random(18)
    for stations in truth.values():
        boot, start, count = draws.randrange(1, 200), draws.randrange(1_000_000), 0
        for one in stations:
            count += draws.randrange(3)
            for name, value in zip(PLANTED, (boot, count, start)):
                heard[one].say(name, str(value))


def changes(heard, truth):
    """The pairs of each moment: pseudonyms that end there, and the ones that follow them."""
    moments = collections.defaultdict(list)
    for stations in truth.values():
        for before, after in zip(stations, stations[1:]):
            if before in heard and after in heard:
                moments[int(heard[after].times[0] // PERIOD_S)].append((before, after))
    return [pairs for _, pairs in sorted(moments.items()) if len(pairs) > 1]


def by_shared(name, befores, afters, heard):
    """How rare the values are that both have."""
    common = collections.Counter(value for one in befores + afters for value in heard[one].values[name])
    for before in befores:
        mine = heard[before].values[name]
        for after in afters:
            yield before, after, sum(1 / common[it] for it in sorted(mine & heard[after].values[name]))


def by_distance(name, befores, afters, heard, grows):
    """How near the first value is to the last one, where values that grow do not become less."""
    for before in befores:
        last = number(heard[before].last.get(name, "-"))
        for after in afters:
            first = number(heard[after].first.get(name, "-"))
            if last is not None and first is not None and (first >= last or not grows):
                yield before, after, -abs(first - last)


def right(scores, pairs, draws):
    """How many pairs are right that are made best first, ties and the rest by chance."""
    befores, afters = map(list, zip(*pairs))
    scores = list(scores)
    draws.shuffle(scores)
    scores.sort(key=lambda it: -it[2])
    guess = {}
    for before, after, _ in scores:
        if before not in guess and after not in guess.values():
            guess[before] = after
    left = [it for it in afters if it not in guess.values()]
    draws.shuffle(left)
    for before in befores:
        if before not in guess:
            guess[before] = left.pop()
    return sum(guess[before] == after for before, after in pairs)


def most_by_chance(mean, chance):
    """How many right pairs are exceeded with less than this probability (Poisson)."""
    term = total = math.exp(-mean)
    count = 0
    while 1 - total > chance:
        count += 1
        term *= mean / count
        total += term
    return count


def listed(page):
    """The fields of which the page says that they link: patterns."""
    text = pathlib.Path(page).read_text()
    block = re.search(r"<!-- fields that link -->\n```text\n(.*?)```", text, re.S)
    if not block:
        sys.exit(f"{page} has no list of fields that link")
    return [line for line in block[1].splitlines() if line]


def main():
    path, truth, page, *table = sys.argv[1:]
    truth = json.load(open(truth))
    heard = listen(path)
    plant(heard, truth)
    moments = changes(heard, truth)
    count = sum(map(len, moments))
    names = sorted({name for one in heard.values() for name in one.values})
    limit = most_by_chance(len(moments), FALSE_ALARM / (3 * len(names)))
    print(f"{len(heard)} pseudonyms, {len(moments)} moments, {count} pairs, {len(names)} fields;"
          f" by chance {len(moments)} pairs are right, and at most {limit}")
    draws = random.Random(81)
    ways = {
        "shared": by_shared,
        "near": lambda *these: by_distance(*these, grows=False),
        "grows": lambda *these: by_distance(*these, grows=True),
    }
    found, rows = {}, []
    for name in names:
        for way, score in ways.items():
            hits = 0
            for pairs in moments:
                befores, afters = map(list, zip(*pairs))
                # In no order that tells which belong together.
                draws.shuffle(afters)
                hits += right(score(name, befores, afters, heard), pairs, draws)
            rows.append((hits, name, way))
            if hits > limit:
                found[name] = max(found.get(name, (0, "")), (hits, way))
    for name, (hits, way) in sorted(found.items(), key=lambda it: (-it[1][0], it[0])):
        print(f"{hits:5} of {count} right by {name} ({way})")
    rows.sort(reverse=True)
    if table:
        with open(table[0], "w") as file:
            file.writelines(f"{hits},{name},{way}\n" for hits, name, way in rows)
    best = next(row for row in rows if row[1] not in found)
    print(f"{best[0]:5} of {count} right by the best of the others, {best[1]} ({best[2]})")
    patterns = listed(page)
    missed = [name for name in PLANTED if name not in found]
    unlisted = [name for name in found if name not in PLANTED
                and not any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)]
    idle = [pattern for pattern in patterns if not fnmatch.filter(found, pattern)]
    if missed:
        sys.exit(f"the judge does not find {', '.join(missed)}")
    if unlisted:
        sys.exit(f"pseudonyms are linked by {', '.join(unlisted)}, of which {page} says nothing")
    if idle:
        sys.exit(f"{page} says that {', '.join(idle)} link, and they do not")
    print("no pseudonyms are linked but by what the page lists")


main()
