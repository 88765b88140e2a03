"""Judges the node on a real ROS 2: crossing.py CROSSGUARD BIN runs robots of `crossguard run`, each with a node and a body
that are processes of rclpy, and looks at what the graph and the robots' logs tell. BIN has the programs of crossguard_ros."""

import contextlib
import json
import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import traceback
from pathlib import Path

CROSSGUARD, BIN = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
os.environ |= {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_DOMAIN_ID": str(random.randint(1, 100))}
for name in ("ROS_STATIC_PEERS", "ROS_LOCALHOST_ONLY"):
    os.environ.pop(name, None)

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

# In seconds, for a machine that has other things to do.
PATIENCE = 60.0
SILENCE_S = 1.5


def until(what, holds):
    """Waits for that; what it holds then."""
    deadline = time.monotonic() + PATIENCE
    while not (it := holds()):
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.02)
    return it


def free_ports():
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) for _ in range(2)]
        for it in sockets:
            it.bind(("127.0.0.1", 0))
        return [it.getsockname()[1] for it in sockets]


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

    def __init__(self, street, name, station, build, place, link, pace):
        self.street, self.name, self.place, self.pace = street, name, place, pace
        folder, space = street.folder, f"/{name}/crossguard"
        self.log, config = folder / f"{name}.jsonl", folder / f"{name}.toml"
        config.write_text(
            f'name = "{name}"\nstation = {station}\nbuild = "{build}"\nboot_file = "{name}.boot"\n'
            f'autopilot = true\n\n[link]\naddress = "127.0.0.1:{link[0]}"\npeers = ["127.0.0.1:{link[1]}"]\n\n'
            f'[body]\nlisten = "unix:{name}.sock"\nsilence_ms = {1000 * SILENCE_S:.0f}\n')
        self.poses = Heard(street, PoseStamped, f"{space}/pose")
        self.run = Process(street.stack, folder, name, [CROSSGUARD, "run", "--config", config, "--log", self.log],
                           stdin=subprocess.PIPE)
        self.node, self.body = self.start_node(), self.start_body()

    def start(self, program, *parameters):
        parameters = [word for it in (*parameters, f"silence:={SILENCE_S}") for word in ("-p", it)]
        command = [BIN / program, "--ros-args", "-r", f"__ns:=/{self.name}", *parameters]
        return Process(self.street.stack, self.street.folder, f"{self.name}-{program}", command)

    def start_node(self):
        return self.start("crossguard_node", f"body:=unix:{self.street.folder / self.name}.sock")

    def start_body(self):
        return self.start("simulated_body", f"place:=[{self.place[0]}, {self.place[1]}]", f"pace:={self.pace}")

    def command(self, line):
        self.run.process.stdin.write(f"{line}\n".encode())
        self.run.process.stdin.flush()

    def said(self, what):
        """How often its log has this."""
        return self.log.read_text().replace(" ", "").count(what) if self.log.exists() else 0

    def until(self, what, times=1):
        until(f"{what} of {self.name}, {times} times", lambda: self.said(what) >= times)

    def stands(self):
        """Whether its body has not moved for half a second."""
        before = len(self.poses.messages)
        time.sleep(0.5)
        newest = [it.pose.position for it in self.poses.messages[before:]]
        return len(newest) > 3 and all(it == newest[0] for it in newest)


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

    def __init__(self, stack, pace):
        super().__init__(stack)
        ports = free_ports()
        self.ari = Robot(self, "ari", 1, "humanoid", (0.0, -1.5), ports, pace)
        self.go2 = Robot(self, "go2", 2, "quadruped", (1.0, -1.11), ports[::-1], pace)
        self.robots = [self.ari, self.go2]
        for robot in self.robots:
            robot.until('"availabilityChanged":"available"')

    def open_the_corridor(self):
        self.ari.command("detect")
        self.ari.until('"corridorOpened"')

    def end(self):
        """Everybody ends in order, and the logs are what the protocol allows."""
        for robot in self.robots:
            robot.command("quit")
        for robot in self.robots:
            assert robot.run.process.wait(PATIENCE) == 0, robot.name
        judged = subprocess.run([CROSSGUARD, "validate", *(it.log for it in self.robots)], capture_output=True, text=True)
        assert judged.returncode == 0, judged.stdout + judged.stderr
        return [json.loads(it.log.read_text().splitlines()[-1])["counters"].get("body", {}) for it in self.robots]


def a_whole_crossing_is_done_by_two_bodies_of_rclpy(stack):
    street = Street(stack, pace=10.0)
    street.open_the_corridor()
    street.ari.until('"taskCompleted"')
    if began := os.environ.get("CROSSGUARD_TRY_BEGAN"):
        print(f"{time.time() - float(began):.0f} s from the beginning of pip install to task completed")
    street.go2.until('"released"')
    for counters in street.end():
        assert counters.get("silent", 0) == counters.get("not understood", 0) == 0, counters
    assert street.ari.said('"corridorOpened"') == 1
    assert street.go2.said('"startManeuver"') == 2


def lose(stack, which):
    street = Street(stack, pace=1.5)
    ari, go2 = street.robots
    street.open_the_corridor()
    getattr(go2, which).end()
    go2.until('"unavailable":"emergencyStop"')
    ari.until('"corridorClosed"')
    if which == "node":
        until("a body that stands", go2.stands)
        go2.node = go2.start_node()
    else:
        go2.body = go2.start_body()
    # It is heard again, and the stop stands until a person says otherwise.
    street.diagnostics.until("its body", lambda it: any(
        status.name == "/go2/crossguard: body" and status.message == "connected" for status in it.status),
        len(street.diagnostics.messages))
    before = go2.said('"availabilityChanged":"available"')
    go2.command("available")
    go2.until('"availabilityChanged":"available"', before + 1)
    for robot in street.robots:
        robot.command("clear")
    counters = street.end()
    assert counters[1]["silent"] == 1, counters


def a_node_that_is_killed_is_an_emergency_stop(stack):
    lose(stack, "node")


def a_body_that_is_killed_is_an_emergency_stop(stack):
    lose(stack, "body")


def a_graph_that_others_can_reach_is_refused(_):
    for name, value in [("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"), ("ROS_STATIC_PEERS", "192.0.2.1")]:
        command = [BIN / "crossguard_node", "--ros-args", "-p", "body:=unix:nowhere.sock"]
        ended = subprocess.run(command, env=os.environ | {name: value}, capture_output=True, text=True, timeout=PATIENCE)
        assert ended.returncode == 1 and "trust_ros_graph" in ended.stderr, ended


CASES = [
    a_whole_crossing_is_done_by_two_bodies_of_rclpy, a_node_that_is_killed_is_an_emergency_stop,
    a_body_that_is_killed_is_an_emergency_stop, a_graph_that_others_can_reach_is_refused]


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    failed = 0
    for case in CASES:
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
    print(f"{len(CASES) - failed} passed, {failed} failed", flush=True)
    sys.exit(1 if failed else 0)


main()
