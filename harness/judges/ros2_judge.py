"""What an independent implementation of the wire format of rmw_zenoh makes of the nodes of this kit.

    python ros2_judge.py BINARY

starts two robots with BINARY (crossguard-ros2) in a ROS domain of their own, at a zenoh router as ROS 2 has
one, and meets them with zenoh-ros2-sdk, which knows them by what is on the wire only: it finds topics and
services by their liveliness tokens, computes the hashes of their types from .msg files by its own code (those
of ROS by the definitions of Jazzy that rosbags has), takes them through their lifecycle by services, has them
help a pedestrian across by a message, and decodes what they tell by the CDR of rosbags. What it saw is held
against the robots' logs. Ends with exit code 0 when it agrees.

    zenoh-ros2-sdk (Apache-2.0), eclipse-zenoh (EPL-2.0 or Apache-2.0), rosbags (Apache-2.0)
"""

import contextlib
import json
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import zenoh
from rosbags.typesys import Stores, get_typestore
from zenoh_ros2_sdk import ROS2Publisher, ROS2ServiceClient, ROS2Subscriber, discovery, message_registry
from zenoh_ros2_sdk.attachment import Attachment
from zenoh_ros2_sdk.session import ZenohSession
from zenoh_ros2_sdk.utils import get_type_hash, load_dependencies_recursive

DOMAIN = 42
PATIENCE_S = 40
MESSAGES = pathlib.Path(__file__).parent.parent / "ros2" / "crossguard_msgs" / "msg"

ROBOT = """\
name = "{name}"
station = {station}
build = "{build}"
boot_file = "{name}.boot"
speed = 40.0
autopilot = true

[link]
address = "127.0.0.1:{port}"
peers = ["127.0.0.1:{peer}"]
"""

# What a request without fields has instead.
EMPTY = "uint8 structure_needs_at_least_one_member"


def free_port(kind):
    with socket.socket(socket.AF_INET, kind) as it:
        it.bind(("127.0.0.1", 0))
        return it.getsockname()[1]


def definitions(folder):
    """The definitions of all messages, where the SDK looks for them: ours, and those of ROS 2 Jazzy."""
    registry = message_registry.get_registry()
    registry.messages_dir = folder
    store = get_typestore(Stores.ROS2_JAZZY)
    texts = {f"crossguard_msgs/msg/{path.stem}": path.read_text() for path in MESSAGES.glob("*.msg")}
    for name in store.types:
        # The first part is the message itself, those it is made of follow.
        texts.setdefault(name, store.generate_msgdef(name, ros_version=2)[0].split("=" * 80)[0])
    for name, text in texts.items():
        package, kind, message = name.split("/")
        if kind == "msg":
            path = folder / package / kind / f"{message}.msg"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
    return texts


def soon(what, ask):
    """The first answer that is one: peers that find each other come and go in the graph."""
    deadline = time.monotonic() + PATIENCE_S
    while not (answer := ask()):
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.1)
    return answer


class Topic:
    """What comes on a topic, in order."""

    def __init__(self, name, kind, port):
        self.name, self.messages, self.news = name, [], threading.Condition()
        self.subscriber = ROS2Subscriber(name, kind, self.take, domain_id=DOMAIN, router_port=port)

    def take(self, message):
        with self.news:
            self.messages.append(message)
            self.news.notify_all()

    def until(self, what, wanted):
        with self.news:
            found = self.news.wait_for(lambda: any(map(wanted, self.messages)), PATIENCE_S)
        assert found, f"{self.name}: waited in vain for {what}"
        return next(filter(wanted, self.messages))


class Lifecycle:
    """The lifecycle of a node, by its services."""

    def __init__(self, node, port):
        def client(name, kind, request, response):
            return ROS2ServiceClient(
                f"{node}/{name}", f"lifecycle_msgs/srv/{kind}", request, response,
                domain_id=DOMAIN, router_port=port, timeout=15.0)
        self.change = client("change_state", "ChangeState",
                             "lifecycle_msgs/Transition transition", "bool success")
        self.get = client("get_state", "GetState", EMPTY, "lifecycle_msgs/State current_state")

    def set(self, label):
        transition = self.change.session_mgr.store.types["lifecycle_msgs/msg/Transition"]
        answer = self.change.call(transition=transition(id=0, label=label))
        assert answer is not None, f"no answer to {label}"
        return answer.success

    def state(self):
        answer = self.get.call(structure_needs_at_least_one_member=0)
        assert answer is not None, "no answer to get_state"
        return answer.current_state.label


@contextlib.contextmanager
def router(port):
    """What all nodes of rmw_zenoh meet at."""
    config = zenoh.Config()
    for key, value in (("mode", "router"), ("listen/endpoints", [f"tcp/127.0.0.1:{port}"]),
                       ("scouting/multicast/enabled", False)):
        config.insert_json5(key, json.dumps(value))
    with zenoh.open(config):
        yield


@contextlib.contextmanager
def robots(binary, folder, port):
    """Two nodes, which end in order."""
    links = [free_port(socket.SOCK_DGRAM) for _ in range(2)]
    children = []
    for station, (name, build) in enumerate([("ARI", "humanoid"), ("Go2", "quadruped")], 1):
        config = folder / f"{name}.toml"
        own, peer = links if station == 1 else reversed(links)
        config.write_text(ROBOT.format(name=name, station=station, build=build, port=own, peer=peer))
        child = subprocess.Popen(
            [binary, "--config", config, "--domain", str(DOMAIN), "--namespace", f"/{name.lower()}",
             "--log", folder / f"{name}.jsonl", "--zenoh-connect", f"tcp/127.0.0.1:{port}"], stdout=subprocess.PIPE, text=True)
        children.append(child)
        assert "The node is there" in child.stdout.readline()
    try:
        yield
        for child in children:
            child.send_signal(signal.SIGTERM)
        for child in children:
            assert child.wait(20) == 0, child.returncode
    finally:
        for child in children:
            child.kill()


def judge_graph(port):
    """The graph has what it should, with the hashes that the SDK computes itself."""
    expected = {
        "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
        **{f"/{robot}/crossguard/{topic}": kind for robot in ("ari", "go2") for topic, kind in {
            "battery": "sensor_msgs/msg/BatteryState",
            "command": "crossguard_msgs/msg/Command",
            "corridor": "crossguard_msgs/msg/Corridor",
            "event": "crossguard_msgs/msg/Event",
            "perceived": "crossguard_msgs/msg/Person",
            "pose": "geometry_msgs/msg/PoseStamped",
            "status": "crossguard_msgs/msg/Status",
            "transition_event": "lifecycle_msgs/msg/TransitionEvent",
        }.items()},
    }
    listed = {name: [kind] for name, kind in expected.items()}
    soon("all topics", lambda: listed == dict(
        discovery.get_topic_names_and_types(DOMAIN, router_port=port, timeout=2.0)))
    registry = message_registry.get_registry()
    for name, kind in expected.items():
        info = soon(name, lambda: discovery.get_topic_info(
            name, DOMAIN, router_port=port, timeout=2.0, verbose=True))
        text = registry.get_msg_file_path(kind).read_text()
        own = get_type_hash(kind, text, load_dependencies_recursive(kind, text, registry))
        for end in info.publishers + info.subscribers:
            assert end.type_hash == own, (name, end.type_hash, own)
            assert end.node_name == "crossguard", end
    for service in ("change_state", "get_state", "get_available_states",
                    "get_available_transitions", "get_transition_graph"):
        name = f"/ari/crossguard/{service}"
        info = soon(name, lambda: discovery.get_service_info(
            name, DOMAIN, router_port=port, timeout=2.0))
        assert info.server_count == 1, info
    return len(expected)


def judge_attachment(session, key):
    """What is attached to a publication is what the SDK would attach."""
    came = []
    news = threading.Event()

    def take(sample):
        came.append(Attachment.from_bytes(sample.attachment.to_bytes()))
        if len(came) >= 3:
            news.set()

    subscriber = session.declare_subscriber(key, take)
    assert news.wait(PATIENCE_S), "nothing is attached"
    subscriber.undeclare()
    assert [it.sequence_id - came[0].sequence_id for it in came[:3]] == [0, 1, 2]
    assert len({it.gid for it in came}) == 1 and len(came[0].gid) == 16
    assert all(abs(it.timestamp_ns - time.time_ns()) < 60e9 for it in came)


def constants(kind):
    """The constants of a message, by their values within what they begin with."""
    lines = (line.split("#")[0].split() for line in (MESSAGES / f"{kind}.msg").read_text().splitlines())
    named = (it[1].split("=") for it in lines if len(it) == 2 and "=" in it[1])
    return {name: int(value) for name, value in named}


def judge_log(path, status, corridor, event):
    """What was told is what the log says."""
    of_status, of_event = constants("Status"), constants("Event")
    records = [json.loads(line) for line in path.read_text().splitlines()]
    steps = [it for it in records if it["entry"] == "step"]
    outputs = [output for step in steps for output in step["outputs"]]

    def names(wanted):
        return [name for name in (it if isinstance(it, str) else next(iter(it)) for it in outputs)
                if name in wanted]

    opened = names({"corridorOpened", "corridorClosed"})
    told, is_open = [], False
    for message in corridor:
        if message.open != is_open:
            is_open = message.open
            told.append("corridorOpened" if is_open else "corridorClosed")
    assert told == opened, (told, opened)
    kinds = {of_event[name]: output for name, output in (
        ("START_MANEUVER", "startManeuver"), ("STOP_MANEUVER", "stopManeuver"),
        ("FALL_BACK", "fallBack"), ("LOCK_IDENTITY", "lockIdentity"),
        ("UNLOCK_IDENTITY", "unlockIdentity"))}
    notices = {of_event[name.upper()]: name for name in (
        "roles_established", "follower_joined", "follower_gone", "lease_granted", "lease_expired",
        "command_acknowledged", "command_rejected", "maneuver_reported", "maneuver_in_position",
        "maneuver_completed", "offer_lapsed", "yielded",
        "maneuver_failed", "follower_safe_idle", "session_ended", "offering", "joined", "released",
        "contact_lost", "contact_regained")}

    def camel(name):
        first, *rest = name.split("_")
        return first + "".join(map(str.capitalize, rest))

    expected = []
    for output in outputs:
        name = output if isinstance(output, str) else next(iter(output))
        if name in kinds.values():
            expected.append(name)
        elif name == "notify":
            expected.append(next(iter(output["notify"])))
    found = [kinds.get(it.kind) or camel(notices[it.kind])
             for it in event if it.kind in kinds or it.kind in notices]
    assert found == expected, (found, expected)
    for message in event:
        if message.kind == of_event["START_MANEUVER"]:
            start = next(it["startManeuver"] for it in outputs if "startManeuver" in it
                         and it["startManeuver"]["id"]["request"] == message.request)
            session = start["id"]["session"]
            assert message.task.type == start["task"]
            assert (message.session.leader, message.session.boot, message.session.count) == (
                session["leader"], session["number"]["boot"], session["number"]["count"]), message
    roles = {of_status[f"ROLE_{name.upper()}"]: phase for name, phase in (
        ("none", "idle"), ("requester", "requesting"), ("helper", "offering"),
        ("leader", "leading"), ("follower", "following"))}
    phases = [it["state"]["phase"] for it in steps]
    phases = [it if isinstance(it, str) else next(iter(it)) for it in phases]
    there = [roles[it.role] for it in status if it.state != of_status["STATE_INACTIVE"]]
    assert changes(there) == changes(["idle", *phases]), (changes(there), changes(phases))
    return len(records), len(found)


def changes(values):
    """The items that differ from the one before."""
    return [it for i, it in enumerate(values) if i == 0 or values[i - 1] != it]


def main():
    binary = sys.argv[1]
    port = free_port(socket.SOCK_STREAM)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        definitions(folder / "messages")
        with router(port), robots(binary, folder, port):
            session = ZenohSession.get_instance("127.0.0.1", port)
            for name in ("lifecycle_msgs/msg/State", "lifecycle_msgs/msg/Transition"):
                assert message_registry.get_registry().load_message_type(name)
            topics = judge_graph(port)
            names = [(robot, topic) for robot in ("ari", "go2") for topic in ("status", "corridor", "event")]
            heard = {(robot, topic): Topic(f"/{robot}/crossguard/{topic}",
                                           f"crossguard_msgs/msg/{topic.capitalize()}", port)
                     for robot, topic in names}
            diagnostics = Topic("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", port)
            command = ROS2Publisher("/ari/crossguard/command", "crossguard_msgs/msg/Command",
                                    domain_id=DOMAIN, router_port=port)
            cycles = [Lifecycle(f"/{robot}/crossguard", port) for robot in ("ari", "go2")]
            for cycle in cycles:
                assert cycle.state() == "unconfigured"
                assert not cycle.set("activate"), "it is not configured"
                assert cycle.set("configure") and cycle.set("activate")
                assert cycle.state() == "active"
            judge_attachment(session.session, heard["ari", "corridor"].subscriber.keyexpr)
            idle = constants("Status")["STATE_IDLE"]
            heard["ari", "status"].until("an idle robot", lambda it: it.state == idle)
            types = session.store.types
            vector = types["geometry_msgs/msg/Point"]
            task = types["crossguard_msgs/msg/Task"]
            number = types["crossguard_msgs/msg/Session"](leader=0, boot=0, count=0)
            command.publish(
                kind=constants("Command")["DETECT"], followers=1, urgency=1, place=0, tasks=[], follower=0,
                task=task(type=255), has_target=False, target=vector(x=0.0, y=0.0, z=0.0),
                maximum_speed=0.0, map_place="", session=number, request=0, availability=0, to_vehicles=0,
                to_pedestrians=0, signal_means=0, job_role=0)
            heard["ari", "corridor"].until("an open corridor", lambda it: it.open)
            ended = constants("Event")["SESSION_ENDED"]
            heard["ari", "event"].until("the end", lambda it: it.kind == ended)
            released = constants("Event")["RELEASED"]
            heard["go2", "event"].until("its release", lambda it: it.kind == released)
            diagnostics.until("counters", lambda it: any(
                value.key == "messages sent" and int(value.value) > 0
                for status in it.status for value in status.values))
            for cycle in cycles:
                assert cycle.set("deactivate")
            inactive = constants("Status")["STATE_INACTIVE"]
            for robot in ("ari", "go2"):
                messages = heard[robot, "status"]
                messages.until("no robot", lambda it: it.state == inactive and it.robot)
        for name in ("ARI", "Go2"):
            parts = [heard[name.lower(), topic].messages for topic in ("status", "corridor", "event")]
            records, events = judge_log(folder / f"{name}.jsonl", *parts)
            print(f"{name}: {len(parts[0])} status, {len(parts[1])} corridor, {events} events agree with "
                  f"{records} records", file=sys.stderr)
        print(f"{topics} topics have the hashes that zenoh-ros2-sdk computes", file=sys.stderr)
        ZenohSession.get_instance().close()


main()
