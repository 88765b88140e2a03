"""What an independent reader makes of the MCAP files of this kit.

    python mcap_judge.py LOG FILE

reads FILE by the reader of its inventors (PyPI mcap) and holds it against LOG, the JSON lines that it was
made of by harness/judge/foxglove.py: those with Foxglove's names must be messages of Foxglove's own definitions, times must not go back, and what is in the file must be what the
log says, no more and no less. Ends with exit code 0 when it agrees.

    mcap (MIT), foxglove-schemas-protobuf (MIT), protobuf (BSD-3-Clause)
"""

import collections
import importlib
import json
import sys

from mcap.reader import make_reader


def token(robot):
    return "".join(c if c.isascii() and c.isalnum() else "_" for c in robot)


def expected(path):
    """What the log says, by topic: for each message, what can be compared."""
    topics = collections.defaultdict(list)
    counters = collections.defaultdict(collections.Counter)
    began = {}
    for line in open(path, encoding="utf-8"):
        record = json.loads(line)
        robot, entry, at_us = record["robot"], record["entry"], record["atUs"]
        topic = f"/{token(robot)}"
        if entry == "started":
            began.setdefault("us", record["unixMs"] * 1000 - at_us)
            counters[robot].clear()
            topics[topic + "/boots"].append(((began["us"] + at_us) * 1000, record["boot"]))
            topics[topic + "/role"].append(((began["us"] + at_us) * 1000, "none"))
        at_ns = (began["us"] + at_us) * 1000
        if entry == "step":
            outputs = record["outputs"]
            if "elapsed" not in record["input"] or outputs:
                topics[topic + "/step"].append((at_ns, len(outputs)))
            ignored = [o["ignored"] for o in outputs if isinstance(o, dict) and "ignored" in o]
            counters[robot]["ignored"] += bool(ignored)
            phase = record["state"]["phase"]
            phase = phase if isinstance(phase, str) else next(iter(phase))
            roles = {"idle": "none", "requesting": "requester", "offering": "helper",
                     "leading": "leader", "following": "follower"}
            topics[topic + "/role"].append((at_ns, roles[phase]))
        elif entry in ("sent", "heard"):
            topics[topic + "/message"].append((at_ns, entry, record["octets"]))
            if entry == "sent" and record["message"].upper() == "RAM":
                topics[topic + "/location"].append((at_ns,))
                topics["/tf"].append((at_ns, token(robot)))
                topics["/robots"].append((at_ns, token(robot)))
        elif entry == "dropped":
            counters[robot][(record["layer"], record["cause"])] += 1
            if record["layer"] == "simulated":
                topics[topic + "/message"].append((at_ns, "lost", record["octets"]))
        elif entry == "people":
            people = record["people"]
            waiting = sum(it["conduct"] == "waiting" for it in people)
            topics[topic + "/people"].append((at_ns, len(people), waiting))
        elif entry == "around":
            kinds = [(it["count"], round(it["oldestMs"] / 1000, 6)) for it in record["kinds"]]
            topics[topic + "/around"].append((at_ns, kinds))
        elif entry == "stopped":
            counts = record["counters"].items()
            topics[topic + "/stopped"] = {
                (layer, cause): count for layer, causes in counts for cause, count in causes.items()}
    # Robots that share a log write it from threads of their own, and one may be a moment late.
    for messages in topics.values():
        if isinstance(messages, list):
            messages.sort(key=lambda message: message[0])
    for robot, counts in counters.items():
        topics[f"/{token(robot)}/counts"] = counts
    return topics


def foxglove_type(name):
    kind = name.removeprefix("foxglove.")
    module = importlib.import_module(f"foxglove_schemas_protobuf.{kind}_pb2")
    return getattr(module, kind)


class Found:
    """What is in the file, in the form of `expected`."""

    def __init__(self, path):
        self.topics = collections.defaultdict(list)
        self.names = {}
        before_ns = 0
        reader = make_reader(open(path, "rb"), validate_crcs=True)
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            if schema.name.startswith("foxglove."):
                assert (schema.encoding, channel.message_encoding) == ("protobuf", "protobuf"), channel
                value = foxglove_type(schema.name)()
                value.ParseFromString(message.data)
            else:
                assert (schema.encoding, channel.message_encoding) == ("jsonschema", "json"), channel
                value = json.loads(message.data)
            assert message.log_time >= before_ns, "the times go back"
            before_ns = message.log_time
            self.names[channel.topic] = schema.name
            self.topics[channel.topic].append((message.log_time, value))
        statistics = reader.get_summary().statistics
        assert statistics.message_count == sum(map(len, self.topics.values()))


def same(topic, found, expected):
    for number, (one, other) in enumerate(zip(found, expected)):
        assert one == other, f"{topic}, message {number}: the file has {one}, the log {other}"
    assert len(found) == len(expected), f"{topic}: {len(found)} and {len(expected)} in the log"


def changes(values):
    """The items that differ from the one before."""
    return [it for i, it in enumerate(values) if i == 0 or values[i - 1][1] != it[1]]


def judge_robot(topic, found, log):
    messages = found.topics[topic + "/message"]
    for (at_ns, value), (log_ns, direction, octets) in zip(messages, log[topic + "/message"]):
        assert (at_ns, value["direction"]) == (log_ns, direction), (topic, at_ns)
        # What was lost is in the log as a packet, of which the message is a part.
        assert value["octets"] == octets or direction == "lost" and value["octets"] in octets
    assert len(messages) == len(log[topic + "/message"]), topic
    steps = [(at_ns, len(value["outputs"])) for at_ns, value in found.topics[topic + "/step"]]
    same(topic + "/step", steps, log[topic + "/step"])
    same(topic + "/location", [(at_ns,) for at_ns, _ in found.topics[topic + "/location"]],
         log[topic + "/location"])
    waiting = lambda people: sum(it["conduct"] == "waiting" for it in people)
    people = [(at_ns, len(value["people"]), waiting(value["people"]))
              for at_ns, value in found.topics.get(topic + "/people", [])]
    same(topic + "/people", people, log[topic + "/people"])
    around = [(at_ns, [(it["count"], round(it["oldestMs"] / 1000, 6)) for it in value["kinds"]])
              for at_ns, value in found.topics.get(topic + "/around", [])]
    same(topic + "/around", around, log[topic + "/around"])
    roles = [(at_ns, value["role"]) for at_ns, value in found.topics[topic + "/state"]]
    same(topic + "/state", changes(roles), changes(log[topic + "/role"]))
    if topic + "/counted" in found.topics:
        # Counts begin anew when a robot boots again.
        last, boots = {}, [at_ns for at_ns, _ in log[topic + "/boots"]]
        for at_ns, it in found.topics[topic + "/counted"]:
            while boots and boots[0] < at_ns:
                boots.pop(0)
                last = {}
            last[it["layer"], it["cause"]] = it["count"]
        stopped = log.get(topic + "/stopped")
        if stopped is not None:
            assert last == stopped, (topic, last, stopped)
        else:
            of_log = log[topic + "/counts"]
            ignored = sum(count for (layer, _), count in last.items() if layer == "protocol")
            assert ignored == of_log["ignored"], (topic, ignored, of_log)


def main():
    log_path, file_path = sys.argv[1:]
    log, found = expected(log_path), Found(file_path)
    robots = sorted({topic.rsplit("/", 1)[0] for topic in found.topics if topic.count("/") == 2})
    for robot in robots:
        judge_robot(robot, found, log)
    frames = [(at_ns, value.child_frame_id) for at_ns, value in found.topics["/tf"]]
    same("/tf", frames, log["/tf"])
    for topic, name in sorted(found.names.items()):
        messages = found.topics[topic]
        print(f"{topic}: {len(messages)} {name}", file=sys.stderr)


main()
