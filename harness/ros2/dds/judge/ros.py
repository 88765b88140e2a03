"""ROS 2 as its nodes are on DDS, by PyPI's cyclonedds: types made from .msg files, topics with the prefix rt/.

The types are made here once more, and not from the IDL that the node is built with: names, order and types of fields on
the wire are judged by that.
"""
import re
import time
from pathlib import Path

from cyclonedds.domain import Domain, DomainParticipant
from cyclonedds.idl import make_idl_struct, types
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

MSGS = Path(__file__).parents[2] / "crossguard_msgs" / "msg"
CONFIGURATION = (Path(__file__).parents[1] / "loopback.xml").read_text()
PATIENCE = 60.0
# The standard messages, as common_interfaces has them.
STANDARD = {
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
    "builtin_interfaces/Duration": "int32 sec\nuint32 nanosec",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    "geometry_msgs/Pose": "Point position\nQuaternion orientation",
    "geometry_msgs/PoseStamped": "std_msgs/Header header\nPose pose",
    "diagnostic_msgs/KeyValue": "string key\nstring value",
    "diagnostic_msgs/DiagnosticStatus": "byte level\nstring name\nstring message\nstring hardware_id\nKeyValue[] values",
    "diagnostic_msgs/DiagnosticArray": "std_msgs/Header header\nDiagnosticStatus[] status",
}
PRIMITIVES = {
    "bool": (bool, False), "byte": (types.byte, 0), "uint8": (types.uint8, 0), "uint16": (types.uint16, 0),
    "uint32": (types.uint32, 0), "int32": (types.int32, 0), "float64": (types.float64, 0.0), "string": (str, ""),
}
MADE = {}


def message(name):
    """The type of package/Name, whose fields all have a default: `of` makes one with some of them set."""
    if name in MADE:
        return MADE[name]
    package, simple = name.split("/")
    text = STANDARD[name] if name in STANDARD else (MSGS / f"{simple}.msg").read_text()
    fields, defaults, constants = {}, {}, {}
    for line in text.splitlines():
        line = line.split("#")[0].strip()
        if constant := re.fullmatch(r"uint8 ([A-Z_]+)=(\d+)", line):
            constants[constant[1]] = int(constant[2])
        elif line:
            kind, field = line.split()
            kind, many = kind.removesuffix("[]"), kind.endswith("[]")
            if kind in PRIMITIVES:
                inner, default = PRIMITIVES[kind]
                make = lambda default=default: default
            else:
                inner = message(kind if "/" in kind else f"{package}/{kind}")
                make = inner.of
            fields[field] = types.sequence[inner] if many else inner
            defaults[field] = list if many else make
    made = make_idl_struct(simple, f"{package}::msg::dds_::{simple}_", fields)
    made.of = classmethod(lambda cls, **some: cls(**{**{k: make() for k, make in defaults.items()}, **some}))
    for constant, value in constants.items():
        setattr(made, constant, value)
    MADE[name] = made
    return made


Command, Corridor, Event, Session, Status, Task = (
    message(f"crossguard_msgs/{name}") for name in ("Command", "Corridor", "Event", "Session", "Status", "Task"))
DiagnosticArray, PoseStamped = message("diagnostic_msgs/DiagnosticArray"), message("geometry_msgs/PoseStamped")

# The defaults of rmw: reliable, volatile, the newest ten.
DEFAULT = Qos(
    Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.Volatile, Policy.History.KeepLast(10),
    Policy.DataRepresentation(use_cdrv0_representation=True))
# What was said is all there when it is asked for.
ALL = Qos(
    Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.Volatile, Policy.History.KeepAll,
    Policy.DataRepresentation(use_cdrv0_representation=True))


class Heard:
    """What comes on a topic."""

    def __init__(self, reader, topic):
        self.reader, self.topic, self.messages = reader, topic, []

    def new(self):
        """What has come since."""
        return [it for it in self.reader.take(1000) if not hasattr(it, "sample_info") or it.sample_info.valid_data]

    def until(self, what, holds):
        """Waits until a message comes for which this holds; all that came until then, it last."""
        deadline, came = time.monotonic() + PATIENCE, []
        while time.monotonic() < deadline:
            if not self.messages:
                self.messages = self.new()
                time.sleep(0.005)
            while self.messages:
                came.append(self.messages.pop(0))
                if holds(came[-1]):
                    return came
        raise AssertionError(f"{self.topic}: waited in vain for {what}; newest: {came[-3:]}")


class Ros:
    """A participant."""

    def __init__(self, domain):
        # Of a process, the first one configures its domain.
        if domain not in Ros.domains:
            Ros.domains[domain] = Domain(domain, CONFIGURATION)
        self.participant = DomainParticipant(domain)

    domains = {}

    def hear(self, kind, topic, qos=ALL):
        return Heard(DataReader(self.participant, Topic(self.participant, f"rt{topic}", kind), qos=qos), topic)

    def publisher(self, kind, topic, qos=DEFAULT):
        return DataWriter(self.participant, Topic(self.participant, f"rt{topic}", kind), qos=qos)


def matched(writer):
    """Waits until somebody hears it."""
    deadline = time.monotonic() + PATIENCE
    while not writer.get_matched_subscriptions():
        assert time.monotonic() < deadline, "nobody hears"
        time.sleep(0.01)
    return writer
