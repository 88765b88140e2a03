"""Judges the node on a real ROS 2: crossing.py CROSSGUARD BIN [CASE...] runs robots of `crossguard run`, each with a node and a
body that are processes of rclpy, and looks at what the graph and the robots' logs tell. BIN has the programs of crossguard_ros."""

import contextlib
import json
import os
import random
import shlex
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import traceback
from pathlib import Path

CROSSGUARD, BIN = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
README = (Path(__file__).parent / "README.md").read_text()
os.environ |= {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_DOMAIN_ID": str(random.randint(1, 100))}
for name in ("ROS_STATIC_PEERS", "ROS_LOCALHOST_ONLY"):
    os.environ.pop(name, None)

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, Point32, Polygon, PoseStamped, Vector3
from rclpy.action import ActionServer, get_action_client_names_and_types_by_node
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import String

from crossguard_msgs.action import Maneuver
from crossguard_msgs.msg import Corridor, Event, People, Person, Status

# In seconds, for a machine that has other things to do.
PATIENCE = 60.0
SILENCE_S = 3.0

# In the log of a robot that was without its body.
SILENT = '"cause":"silent"'


def until(what, holds):
    """Waits for that; what it holds then."""
    deadline = time.monotonic() + PATIENCE
    while not (it := holds()):
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.02)
    return it


def free_ports():
    """Two free UDP ports below the ephemeral range."""
    while True:
        first = random.randrange(12000, 32000, 2)
        with contextlib.ExitStack() as stack, contextlib.suppress(OSError):
            for port in (first, first + 1):
                stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)).bind(("127.0.0.1", port))
            return [first, first + 1]


class Process:
    """A program that ends with its street. What it writes is in a file."""

    def __init__(self, stack, folder, name, command, **more):
        self.path = folder / f"{name}.out"
        self.out = stack.enter_context(self.path.open("a"))
        self.process = subprocess.Popen(
            [str(it) for it in command], stdout=self.out, stderr=self.out, start_new_session=True, **more)
        stack.callback(self.end)

    def end(self, how=signal.SIGKILL):
        with contextlib.suppress(ProcessLookupError):
            self.process.send_signal(how)
        return self.process.wait(PATIENCE)


class Heard:
    """What comes on a topic of a robot."""

    def __init__(self, street, kind, topic):
        self.topic, self.messages = topic, []
        street.node.create_subscription(kind, topic, self.messages.append, 100)

    def until(self, what, holds, since=0):
        """The first message since then for which this holds."""
        return until(f"{what} on {self.topic}", lambda: next((it for it in self.messages[since:] if holds(it)), None))


class Robot:
    """`crossguard run`, its node, and its body."""

    def __init__(self, street, name, station, build, place, link, pace, lines="", options=(), zone="", node=(), body=True,
                 is_ported=True):
        self.street, self.name, self.place, self.pace = street, name, place, pace
        folder, space = street.folder, f"/{name}/crossguard"
        tables = README.split("```toml\n")[1].split("```")[0].replace("go2", name)
        # All may lead, and most have no zone.
        people = "" if zone else "simulated_people = true\n"
        tables = tables.replace("[body]", f"[body]\n{people}silence_ms = {1000 * SILENCE_S:.0f}")
        self.log, config = folder / f"{name}.jsonl", folder / f"{name}.toml"
        config.write_text(
            f'{lines}\nname = "{name}"\nstation = {station}\nbuild = "{build}"\nboot_file = "{name}.boot"\n'
            f'plan_file = "crossing"\n\n[link]\naddress = "127.0.0.1:{link[0]}"\npeers = ["127.0.0.1:{link[1]}"]\n\n'
            + tables[0 if is_ported else tables.index("[operator]"):] + zone)
        self.corridor = Heard(street, Corridor, f"{space}/corridor")
        self.status = Heard(street, Status, f"{space}/status")
        self.events = Heard(street, Event, f"{space}/event")
        self.poses = Heard(street, PoseStamped, f"{space}/pose")
        self.commands = street.node.create_publisher(String, f"{space}/command", 10)
        # As detectors publish, mostly: a subscription that wants every message hears nothing of such a one.
        self.people = street.node.create_publisher(People, f"{space}/people", qos_profile_sensor_data)
        self.run = Process(street.stack, folder, name, [CROSSGUARD, "run", "--config", config, "--log", self.log, *options],
                           stdin=subprocess.PIPE)
        self.node, self.body = self.start_node(*node), self.start_body() if body else Driver(street, space)
        until(f"the node of {name}", lambda: self.commands.get_subscription_count() == 1)

    def start(self, program, *parameters):
        """By its line in the README, with more parameters."""
        [line] = [it for it in README.splitlines() if it.startswith(f"ros2 run crossguard_ros {program} ")]
        words = shlex.split(line.replace("go2", self.name), comments=True)[4:]
        parameters = [word for it in (*parameters, f"silence:={SILENCE_S}") for word in ("-p", it)]
        command, folder = [BIN / program, *words, *parameters], self.street.folder
        return Process(self.street.stack, folder, f"{self.name}-{program}", command, cwd=folder)

    def start_node(self, *parameters):
        return self.start("crossguard_node", *parameters)

    def start_body(self):
        return self.start("simulated_body", f"place:=[{self.place[0]}, {self.place[1]}]", f"pace:={self.pace}")

    def command(self, line):
        self.commands.publish(String(data=line))

    def look(self, people, age_s=0.0, covers=(), covers_all=False):
        """Has a source of its sensors say whom it saw so long ago."""
        stamp = (self.street.node.get_clock().now() - Duration(seconds=age_s)).to_msg()
        covers = Polygon(points=[Point32(x=x, y=y) for x, y in covers])
        self.people.publish(People(stamp=stamp, covers=covers, covers_all=covers_all, people=people))

    def until_refused(self, why, act=lambda: None):
        """Does that again and again until the node or the robot refuses it, and says why."""
        before = len(self.events.messages)

        def is_refused():
            act()
            time.sleep(0.1)
            return any(it.kind == Event.REFUSED and why in it.text for it in self.events.messages[before:])

        until(f"a refusal with {why!r}", is_refused)

    def said(self, what):
        """How often its log has this."""
        return self.log.read_text().replace(" ", "").count(what) if self.log.exists() else 0

    def until(self, what):
        until(f"{what} in the log of {self.name}", lambda: self.said(what))

    def until_available(self, wanted=Status.AVAILABLE, since=0):
        self.status.until(wanted, lambda it: it.availability == wanted, since)

    def until_ready(self):
        """Available for half a second. What stopped it while all started, on a busy machine, its operator takes back."""
        since, said = None, time.monotonic()

        def is_ready():
            nonlocal since, said
            newest = self.status.messages[-1].availability if self.status.messages else ""
            # The robot takes it once in three seconds, and not at once.
            if newest == Status.EMERGENCY_STOP and time.monotonic() - said > 4.0:
                said = time.monotonic()
                self.command("available")
            since = (since or time.monotonic()) if newest == Status.AVAILABLE else None
            return since and time.monotonic() - since > 0.5

        until(f"{self.name}, ready", is_ready)
        self.silences = self.said(SILENT)

    def stands(self):
        """Whether its body has not moved for half a second."""
        before = len(self.poses.messages)
        time.sleep(0.5)
        newest = [it.pose.position for it in self.poses.messages[before:]]
        return len(newest) > 3 and all(it == newest[0] for it in newest)


class Driver:
    """A driver that is the judge: it stands where it began, takes every goal, and lets go of none."""

    def __init__(self, street, space):
        self.node, self.publisher = street.node, street.node.create_publisher(PoseStamped, f"{space}/pose", 1)
        self.stands_still, self.stamp, self.goals = False, None, []
        self.server = ActionServer(
            street.node, Maneuver, f"{space}/maneuver", lambda _: Maneuver.Result(), handle_accepted_callback=self.goals.append)
        self.timer = street.node.create_timer(0.05, self.say)

    def say(self):
        if not (self.stands_still and self.stamp):
            self.stamp = self.node.get_clock().now().to_msg()
        pose = PoseStamped()
        pose.header.stamp, pose.header.frame_id = self.stamp, "site"
        self.publisher.publish(pose)


class Graph:
    """What the judge hears of the graph."""

    def __init__(self, stack):
        self.stack = stack
        self.folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="crossguard-ros-")))
        self.node = rclpy.create_node("judge")
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.diagnostics = Heard(self, DiagnosticArray, "/diagnostics")
        thread = threading.Thread(target=self.executor.spin, daemon=True)
        thread.start()
        stack.callback(lambda: (self.executor.shutdown(), thread.join(), self.node.destroy_node()))


class Street(Graph):
    """ARI, who leads, and Go2 on a street."""

    def __init__(self, stack, pace, **of_go2):
        super().__init__(stack)
        ports = free_ports()
        self.ari = Robot(self, "ari", 1, "humanoid", (0.0, -1.5), ports, pace)
        self.go2 = Robot(self, "go2", 2, "quadruped", (1.0, -1.11), ports[::-1], pace, **of_go2)
        self.robots = [self.ari, self.go2]
        for robot in self.robots:
            robot.until_ready()

    def open_the_corridor(self):
        self.ari.command("detect")
        return self.ari.corridor.until("an open corridor", lambda it: it.open)

    def end(self):
        """Everybody ends in order, and the logs are what the protocol allows. How often each was without its body."""
        for robot in self.robots:
            robot.command("quit")
        for robot in self.robots:
            assert robot.run.process.wait(PATIENCE) == 0, robot.name
            robot.events.until("its end", lambda it: it.kind == Event.STOPPED)
        judged = subprocess.run([CROSSGUARD, "validate", *(it.log for it in self.robots)], capture_output=True, text=True)
        assert judged.returncode == 0, judged.stdout + judged.stderr
        for robot in self.robots:
            counters = json.loads(robot.log.read_text().splitlines()[-1])["counters"].get("body", {})
            assert counters.get("not understood", 0) == 0, counters
        return [robot.said(SILENT) - robot.silences for robot in self.robots]


def a_whole_crossing_is_done_by_two_bodies_of_rclpy(stack):
    # People walk as fast as they do: an escort that ran ahead would leave its person alone, and this one has no sensors.
    street = Street(stack, pace=1.0)
    ari, go2 = street.robots
    is_open = street.open_the_corridor()
    assert is_open.road_occupied and is_open.station == 1, is_open
    assert is_open.valid_for.sec == 0 and 0 < is_open.valid_for.nanosec <= 300_000_000, is_open
    ended = ari.events.until("the end", lambda it: it.kind == Event.SESSION_ENDED)
    assert ended.reason == "taskCompleted" and ended.session.leader == 1, ended
    if began := os.environ.get("CROSSGUARD_TRY_BEGAN"):
        print(f"{time.time() - float(began):.0f} s from the beginning of pip install to task completed")
    go2.events.until("its release", lambda it: it.kind == Event.RELEASED)
    starts = [it for it in go2.events.messages if it.kind == Event.START_MANEUVER]
    assert [it.task for it in starts] == [Maneuver.Goal.INITIAL_POS, Maneuver.Goal.MOVE], starts
    status = go2.status.until("the escort", lambda it: it.task == Maneuver.Goal.MOVE)
    assert (status.role, status.station, status.robot) == (Status.ROLE_FOLLOWER, 2, "go2"), status
    status = ari.status.until("a follower", lambda it: it.followers)
    assert status.followers[0].station == 2 and status.session.leader == 1, status
    ari.corridor.until("a clear road", lambda it: not it.road_occupied, ari.corridor.messages.index(is_open))
    the_readme_has_the_graph(street)
    ari.command("opne")
    ari.events.until("a refusal", lambda it: it.kind == Event.REFUSED and "opne" in it.text)
    assert street.end() == [0, 0]
    assert ari.said('"corridorOpened"') == 1


def the_readme_has_the_graph(street):
    """The table of the README is what the node has on the graph."""
    node, at = street.node, ("crossguard", "/go2")
    told = {
        "out": node.get_publisher_names_and_types_by_node(*at), "in": node.get_subscriber_names_and_types_by_node(*at),
        "client": get_action_client_names_and_types_by_node(node, *at)}
    found = {(name.replace("/go2/crossguard", "~"), kind, way) for way, rows in told.items() for name, [kind] in rows}
    found = {it for it in found if not it[0].startswith(("/rosout", "/parameter_events", "~/_")) and "/_action/" not in it[0]}
    rows = (line.split("|") for line in README.splitlines())
    rows = ([cell.strip(" `") for cell in row[1:4]] for row in rows if len(row) == 6)
    page = {tuple(row) for row in rows if row[0].startswith(("~/", "/"))}
    assert page == found, (page - found, found - page)


def lose(stack, which):
    street = Street(stack, pace=1.5)
    ari, go2 = street.robots
    street.open_the_corridor()
    told, shown = len(go2.status.messages), len(ari.corridor.messages)
    getattr(go2, which).end()
    go2.until('"unavailable":"emergencyStop"')
    closed = ari.corridor.until("a closed corridor", lambda it: not it.open, shown)
    assert closed.road_occupied, closed
    if which == "node":
        until("a body that stands", go2.stands)
        go2.node = go2.start_node()
    else:
        go2.body = go2.start_body()
    # It is heard again, and the stop stands until a person says otherwise.
    go2.until_available(Status.EMERGENCY_STOP, told)
    street.diagnostics.until("its body", lambda it: any(
        status.name == "/go2/crossguard: body" and status.message == "connected" for status in it.status),
        len(street.diagnostics.messages))
    assert go2.status.messages[-1].availability == Status.EMERGENCY_STOP
    told = len(go2.status.messages)
    until("somebody who hears commands", lambda: go2.commands.get_subscription_count() == 1)
    time.sleep(4.0)  # a stop is not ended sooner
    go2.command("available")
    go2.until_available(since=told)
    for robot in street.robots:
        robot.command("clear")
    assert street.end() == [0, 1]


def a_node_that_is_killed_is_an_emergency_stop(stack):
    lose(stack, "node")


def a_body_that_is_killed_is_an_emergency_stop(stack):
    lose(stack, "body")


def a_body_stands_when_its_robot_is_killed(stack):
    street = Street(stack, pace=1.0)
    street.open_the_corridor()
    street.go2.run.end()
    until("a body that stands", street.go2.stands)


def a_node_that_was_held_says_nothing_old(stack):
    street = Street(stack, pace=1.0)
    street.open_the_corridor()
    street.ari.node.process.send_signal(signal.SIGSTOP)
    street.ari.until('"corridorClosed"')
    time.sleep(3.0)  # the corridor closes when its place is not known any more; then its body is silent, too
    before = len(street.ari.corridor.messages)
    street.ari.node.process.send_signal(signal.SIGCONT)
    street.ari.until_available(Status.EMERGENCY_STOP)
    assert not any(it.open for it in street.ari.corridor.messages[before:])


def a_robot_that_takes_signed_packets_only_takes_nothing_from_the_graph(stack):
    graph = Graph(stack)
    pki = graph.folder / "pki"
    subprocess.run([CROSSGUARD, "pki", "init", pki], check=True, capture_output=True)
    options = ["--security", "enforce", "--pki", pki / "robots/ARI"]
    for lines in ("", "trust_ros_graph = true"):
        name = "trusting" if lines else "enforcing"
        robot = Robot(graph, name, 1, "humanoid", (0.0, -1.5), free_ports(), 1.0, lines, options)
        robot.status.until("a status", lambda _: True)
        if lines:
            robot.until_available()
            robot.command("detect")
            robot.status.until("a request", lambda it: it.state == Status.STATE_HELP_REQUESTED)
        else:
            robot.command("detect")
            robot.events.until("a refusal", lambda it: it.kind == Event.REFUSED and "trust_ros_graph" in it.text)
            graph.diagnostics.until("the count", lambda it: any(
                (value.key, value.value) == ("refused", "1") for status in it.status for value in status.values))
            # Its body is not moved by the graph, either.
            assert robot.status.messages[-1].availability == Status.LOCAL_FAULT
            assert {it.state for it in robot.status.messages} == {Status.STATE_IDLE}


def a_frame_of_people_reaches_the_robot(stack):
    graph = Graph(stack)
    robot = Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0, zone="\n[zone]\npavement_m = 2.5\n")
    robot.status.until("a status", lambda _: True)
    until("a node that hears of people", lambda: robot.people.get_subscription_count() == 1)
    somebody = Person(id=7, position=Point(x=1.0, y=3.0), velocity=Vector3(y=1.5), has_velocity=True, kind="wheelchairUser",
                      confidence=0.9)
    car = Person(id=8, position=Point(x=-40.0, y=3.0), kind="vehicle", confidence=0.9)
    robot.until_refused("nobody knows", lambda: robot.look([Person(kind="nobody knows")], covers_all=True))
    robot.until_refused("unix_s", lambda: robot.look([somebody], age_s=-5.0, covers_all=True))
    # What a careless detector leaves out is not known: an empty road, and a car that stands, are not said by that.
    robot.until_refused("covers_m", lambda: robot.look([]))
    robot.until_refused("velocity_mps", lambda: robot.look([car], covers_all=True))
    assert not robot.said('"wheelchairUser"')

    def is_seen():
        robot.look([somebody], covers=[(-3.0, 0.0), (5.0, 0.0), (5.0, 7.0), (-3.0, 7.0)])
        time.sleep(0.1)
        return robot.said('"wheelchairUser"')

    until("a person on the road", is_seen)
    seen = [it for it in map(json.loads, robot.log.read_text().splitlines()[:-1]) if it["entry"] == "people"]
    assert any(person["conduct"] == "onRoad" for it in seen for person in it["people"]), seen


def a_pose_that_is_old_is_none(stack):
    graph = Graph(stack)
    robot = Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0, body=False)
    robot.until_ready()
    # Its localisation hangs, and the driver says the last pose again and again.
    robot.body.stands_still = True
    robot.until_available(Status.EMERGENCY_STOP, len(robot.status.messages))
    robot.events.until("a refusal", lambda it: it.kind == Event.REFUSED and "not newer" in it.text)


def a_second_driver_is_an_emergency_stop(stack):
    graph = Graph(stack)
    robot = Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0, body=False)
    robot.until_ready()
    # The simulated body of the launch file, beside the driver of the real one: it says that it is where the other one is not.
    robot.start_body()
    robot.until_available(Status.EMERGENCY_STOP, len(robot.status.messages))
    robot.until_refused("2 publish")


def a_robot_without_a_body_port_takes_no_part(stack):
    graph = Graph(stack)
    # Its file lacks [body]: a simulated body would say that it is in position, and the real one has not moved.
    robot = Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0, is_ported=False)
    robot.until_refused("without the body of this node")
    robot.until_available(Status.LOCAL_FAULT)


def two_nodes_of_one_name_show_no_go(stack):
    graph = Graph(stack)
    robot = Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0)
    robot.until_ready()
    # The node of another robot in the same namespace, or a display would take the go of one robot for that of the other.
    robot.start_node()
    robot.until_refused("2 nodes publish")


def a_driver_that_goes_on_after_a_cancel_is_a_fault(stack):
    street = Street(stack, pace=1.0, body=False)
    street.ari.command("detect")
    until("a goal", lambda: street.go2.body.goals)
    street.go2.command("leave")
    street.go2.until('"cause":"fault"')
    street.go2.until_available(Status.LOCAL_FAULT)


def a_command_that_waited_in_the_node_is_refused(stack):
    graph = Graph(stack)
    robot = Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0)
    robot.until_ready()
    robot.node.process.send_signal(signal.SIGSTOP)
    robot.command("detect")
    time.sleep(SILENCE_S + 1.0)
    robot.node.process.send_signal(signal.SIGCONT)
    robot.until_refused("was held")
    assert not robot.said('"pedestrianDetected"')


def a_node_with_a_clock_that_stands_still_goes_on(stack):
    graph = Graph(stack)
    robot = Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0, node=["use_sim_time:=true"])
    robot.status.until("a status", lambda _: True)
    # Poses of the wall clock are none of that time.
    robot.until_refused("by the clock of this node")


def the_body_of_another_robot_is_refused(stack):
    graph = Graph(stack)
    Robot(graph, "ari", 1, "humanoid", (0.0, -1.5), free_ports(), 1.0, body=False).node.end()
    robot = Robot(graph, "go2", 2, "quadruped", (1.0, -1.11), free_ports(), 1.0, node=["body:=unix:ari.sock"])
    robot.until_refused("this is the body port of ari")
    robot.until_available(Status.LOCAL_FAULT, len(robot.status.messages))
    assert {it.availability for it in robot.status.messages} == {Status.LOCAL_FAULT}


def a_graph_that_others_can_reach_is_refused(_):
    for name, value in [("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"), ("ROS_STATIC_PEERS", "192.0.2.1")]:
        command = [BIN / "crossguard_node", "--ros-args", "-p", "body:=unix:nowhere.sock"]
        ended = subprocess.run(command, env=os.environ | {name: value}, capture_output=True, text=True, timeout=PATIENCE)
        assert ended.returncode == 1 and "trust_ros_graph" in ended.stderr, ended


CASES = [
    a_whole_crossing_is_done_by_two_bodies_of_rclpy, a_node_that_is_killed_is_an_emergency_stop,
    a_body_that_is_killed_is_an_emergency_stop, a_body_stands_when_its_robot_is_killed,
    a_node_that_was_held_says_nothing_old, a_robot_that_takes_signed_packets_only_takes_nothing_from_the_graph,
    a_frame_of_people_reaches_the_robot, a_robot_without_a_body_port_takes_no_part, a_pose_that_is_old_is_none,
    a_second_driver_is_an_emergency_stop, two_nodes_of_one_name_show_no_go,
    a_driver_that_goes_on_after_a_cancel_is_a_fault, a_command_that_waited_in_the_node_is_refused,
    a_node_with_a_clock_that_stands_still_goes_on, the_body_of_another_robot_is_refused,
    a_graph_that_others_can_reach_is_refused]


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    failed = 0
    cases = [it for it in CASES if not sys.argv[3:] or it.__name__ in sys.argv[3:]]
    for case in cases:
        began = time.monotonic()
        with contextlib.ExitStack() as stack:
            try:
                case(stack)
                print(f"ok {case.__name__} ({time.monotonic() - began:.0f} s)", flush=True)
            except Exception:
                failed += 1
                print(f"FAILED {case.__name__}\n{traceback.format_exc()}", flush=True)
                for path in Path(tempfile.gettempdir()).glob("crossguard-ros-*/*.out"):
                    print(f"--- {path}\n{path.read_text()[-2000:]}")
    print(f"{len(cases) - failed} passed, {failed} failed", flush=True)
    sys.exit(1 if failed else 0)


main()
