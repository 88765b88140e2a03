"""A robot of `crossguard run` in a ROS 2 system: joins topics, the action of maneuvers and diagnostics to its ports.

Nothing is decided here: what a robot does is decided by `crossguard run`, and what it may be told, too. Each turn of the
node takes in the lines that the ports have, and tells them; what comes from the graph goes out as lines at once.
"""

import json
import math
import os
import socket
import sys
import time

import rclpy
from action_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped
from rclpy.action import ActionClient
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Empty, String

from crossguard_msgs.action import Maneuver
from crossguard_msgs.msg import Corridor, Event, Follower, People, Session, Status

BODY_PORT_VERSION, OPERATOR_PORT_VERSION = 3, 1
TURN_S = 0.02
SHOWN_S = 0.3  # a corridor is shown no longer than this after its line
STATUS_S = 1.0
LEFT_S = 1.0  # how long a body port that refuses is left alone

TASKS = {
    # <named tasks>
    0: "initialPos",
    1: "move",
    2: "block",
    # </named tasks>
}


def task_of(number):
    """What a task is called."""
    return "" if number is None else TASKS.get(number, f"task{number}")


def perceived(person):
    """Somebody in a frame; what the source does not say is left out."""
    at, by = person.position, person.velocity
    said = {"class": person.kind, "error_m": person.error, "velocity_mps": person.has_velocity and [by.x, by.y]}
    return dict(id=person.id, position_m=[at.x, at.y], confidence=person.confidence,
                **{name: value for name, value in said.items() if value})


def is_visible(environment):
    """Whether others than this machine may be on the ROS graph, as far as its environment tells."""
    own = ["ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER", "FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE",
           "CYCLONEDDS_URI", "ZENOH_SESSION_CONFIG_URI", "ZENOH_CONFIG_OVERRIDE"]
    if any(environment.get(name) for name in own):
        return True
    if environment.get("ROS_LOCALHOST_ONLY") == "1":
        return False
    # Humble does not know this one.
    known = environment.get("ROS_DISTRO") != "humble"
    return not known or environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE") not in ("LOCALHOST", "OFF")


class Port:
    """Lines of JSON, from and to `crossguard run`."""

    def __init__(self, address, version):
        self.address, self.version, self.link, self.text, self.heard = address, version, None, b"", 0.0

    def connect(self, **more):
        """Whether it is connected now. It said hello, then."""
        link = socket.socket(socket.AF_UNIX)
        try:
            link.settimeout(0.1)
            link.connect(self.address.removeprefix("unix:"))
        except OSError:
            link.close()
            return False
        link.setblocking(False)
        self.link, self.text, self.heard = link, b"", time.monotonic()
        return self.say("hello", crossguard=self.version, **more)

    def close(self):
        if self.link:
            self.link.close()
        self.link = None

    def say(self, kind, **more):
        """Whether it was taken; who takes no line any more is not there."""
        line = (json.dumps({"type": kind, **more}) + "\n").encode()
        try:
            if self.link and self.link.send(line) == len(line):
                return True
        except OSError:
            pass
        self.close()
        return False

    def lines(self):
        """What has come. The port is closed after the last one if the other side has closed it."""
        while self.link:
            try:
                octets = self.link.recv(65536)
            except BlockingIOError:
                break
            except OSError:
                octets = b""
            if not octets:
                self.close()
            else:
                self.text, self.heard = self.text + octets, time.monotonic()
        *lines, self.text = self.text.split(b"\n")
        return [json.loads(line) for line in lines]


class Body:
    """The body port: each act is a goal of the action `maneuver`, and poses are the heartbeat of the body."""

    def __init__(self, node, address, silence_s, error_m):
        self.node, self.port, self.silence_s = node, Port(address, BODY_PORT_VERSION), silence_s
        self.error = {"errorM": error_m} if error_m > 0.0 else {}  # where nobody knows it, nothing is said
        self.goal = None  # the newest one
        self.waits = None  # the one that goes on after a wait
        self.pose = self.place = None  # not said yet; where and when it was before
        self.cancelled = []  # goals that have not ended
        self.left = -math.inf  # when the port refused this node
        self.client = ActionClient(node, Maneuver, "~/maneuver")
        self.beat = node.create_publisher(Empty, "~/beat", 1)
        quality = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.poses = node.create_subscription(PoseStamped, "~/pose", self.moved, quality)

    def doubt(self, header):
        """Why a pose does not say where the body is now, if so: people step on the road by where it is."""
        if header.frame_id != "site":
            return f"a pose in frame '{header.frame_id}': it is wanted in frame 'site'"
        drivers = self.node.count_publishers(self.poses.topic_name)
        if drivers > 1:
            return f"{drivers} publish poses: one driver is wanted"
        stamp = Time.from_msg(header.stamp).nanoseconds / 1e9
        age = self.node.get_clock().now().nanoseconds / 1e9 - stamp
        if abs(age) > self.silence_s:
            return f"a pose of {age:.1f} s ago by the clock of this node: {self.silence_s} s are possible"
        # A clock that was put back leaves a time before that is in the future.
        if self.place and 0.0 <= self.place[1] - stamp <= self.silence_s:
            return "a pose that is not newer than the one before"

    def moved(self, message):
        if why := self.doubt(message.header):
            return self.node.refuse(why)
        place, at = (message.pose.position.x, message.pose.position.y), Time.from_msg(message.header.stamp).nanoseconds / 1e9
        before, self.place = self.place, (place, at)
        speed = math.dist(place, before[0]) / (at - before[1]) if before and at > before[1] else 0.0
        z, w = message.pose.orientation.z, message.pose.orientation.w
        heading = {"headingDeg": (90.0 - math.degrees(2 * math.atan2(z, w))) % 360.0} if z or w else {}
        self.pose = dict(eastM=place[0], northM=place[1], speedMps=speed, **heading, **self.error)

    def turn(self, late_s):
        if late_s > self.silence_s:  # it was held: what has come meanwhile is of no use any more
            self.port.close()
        # Nobody is a body before it says where it is, and it is one for as long as it does.
        is_left = time.monotonic() - self.left < LEFT_S
        if not self.port.link and not is_left and self.pose and self.client.server_is_ready():
            # The robot refuses the body of another one.
            robot = self.node.operator and self.node.operator.robot
            self.port.connect(**({"robot": robot["robot"]} if robot else {}))
        lines = self.port.lines()
        for line in lines:
            if line["type"] == "refused":
                self.left = time.monotonic()
                self.node.refuse(f"the body port refuses this node: {line['why']}")
        if not self.port.link:
            self.pose, self.cancelled = None, []
            return self.stand()
        for line in lines:
            self.act(line)
        if lines:
            self.beat.publish(Empty())
        self.watch_driver()
        if self.pose:
            self.port.say("pose", **self.pose)
            self.pose = None

    def watch_driver(self):
        """Ends a goal that the robot says nothing about, or its driver; a driver that lets go of none is a fault."""
        now, goal = time.monotonic(), self.goal or self.waits
        is_unanswered = goal and not goal["handle"] and now - goal["since"] > 2 * self.silence_s
        if goal and (is_unanswered or now - self.port.heard > self.silence_s):
            self.stand()
            goal["done"](False)
        if late := [it for it in self.cancelled if now - it["since"] > 2 * self.silence_s]:
            self.cancelled = [it for it in self.cancelled if it not in late]
            self.node.refuse("the driver did not end a goal that was cancelled")
            self.port.say("fault", text="the body may go on: its driver did not end a goal that was cancelled")

    def act(self, line):
        kind, to = line["type"], line.get("to")
        goal = Maneuver.Goal(has_target=bool(to))
        if to:
            goal.target.x, goal.target.y = to["eastM"], to["northM"]
            goal.latitude, goal.longitude = to["latitude"], to["longitude"]
        if kind == "start":
            report, maneuver = line["report"], line["id"]
            goal.task, goal.hold = line["task"], report == "in-position"
            goal.speed = line["speedMps"] or 0.0
            goal.pedestrian_distance = line["pedestrianDistanceM"] or 0.0
            goal.has_heading = line["headingDeg"] is not None
            goal.heading = math.radians(90.0 - (line["headingDeg"] or 0.0))
            self.begin(goal, lambda is_done: self.port.say(report if is_done else "failed", id=maneuver))
        elif kind == "fall-back":
            goal.policy, policy, maneuver = line["policy"], line["policy"], line["id"]
            self.begin(goal, lambda is_done: self.port.say("fallen-back", id=maneuver) if is_done else
                       self.port.say("fault", text=f"the body did not finish {policy}"))
        elif kind == "go":
            self.begin(goal, lambda is_done: None)
        elif kind == "wait" and self.goal:
            goal = self.goal
            self.stand()
            self.waits = goal
        elif kind == "go-on" and self.waits:
            self.waits["asked"].resumes = True
            self.begin(self.waits["asked"], self.waits["done"])
        elif kind in ("stop", "halt") or kind == "release" and self.holds():
            self.stand()

    def holds(self):
        return self.goal and self.goal["asked"].policy == Maneuver.Goal.HOLD_UNTIL_CLEAR

    def begin(self, asked, done):
        """Sends a goal; `done` hears whether the body did it, unless another one takes its place."""
        self.stand()
        goal = self.goal = {"asked": asked, "done": done, "handle": None, "since": time.monotonic()}

        def end(is_done):
            self.cancelled = [it for it in self.cancelled if it is not goal]
            if self.goal is goal:
                self.goal = None
                done(is_done)

        def told(feedback):
            if self.goal is goal and asked.hold and feedback.feedback.in_position and not goal.get("said"):
                goal["said"] = True
                done(True)

        def answered(future):
            handle = goal["handle"] = future.result()
            if not handle.accepted:
                return end(False)
            if self.goal is not goal:
                self.cancel(goal)
            # Who holds a place, and ends, has left it.
            handle.get_result_async().add_done_callback(
                lambda result: end(result.result().status == GoalStatus.STATUS_SUCCEEDED and not asked.hold))

        if self.client.server_is_ready():
            self.client.send_goal_async(asked, feedback_callback=told).add_done_callback(answered)
        else:
            end(False)

    def stand(self):
        goal, self.goal, self.waits = self.goal, None, None
        if goal and goal["handle"] and goal["handle"].accepted:
            self.cancel(goal)

    def cancel(self, goal):
        goal["since"] = time.monotonic()
        self.cancelled.append(goal)
        goal["handle"].cancel_goal_async()


class Operator:
    """The operator port: commands and people go in; corridor, status and events come out."""

    def __init__(self, node, address):
        self.node, self.port = node, Port(address, OPERATOR_PORT_VERSION)
        self.robot = self.said = self.offset = None
        self.told = self.asked = 0.0
        self.drops = {}
        self.corridor = node.create_publisher(Corridor, "~/corridor", 1)
        self.status = node.create_publisher(Status, "~/status", 1)
        self.events = node.create_publisher(Event, "~/event", 100)
        node.create_subscription(String, "~/command", self.command, 10)
        # As most detectors publish: a subscription that wants every message would hear nothing of them.
        quality = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        node.create_subscription(People, "~/people", self.look, quality)
        node.create_subscription(BatteryState, "~/battery", self.charge, quality)

    def trusts(self):
        return bool(self.robot and self.robot["trustsRosGraph"])

    def say(self, kind, **more):
        if not self.robot:
            self.node.refuse("the robot is not there")
        elif not self.trusts():
            self.node.refuse("the robot takes signed packets only, and its file does not say trust_ros_graph")
        else:
            self.port.say(kind, **more)

    def command(self, message):
        # What was true of the road when it was said may not be true any more.
        if self.node.was_held():
            self.node.refuse(f"'{message.data}' may have waited, since this node was held: say it again")
        else:
            self.say("command", line=message.data)

    def look(self, frame):
        covers = {} if frame.covers_all else {"covers_m": [[it.x, it.y] for it in frame.covers.points]}
        self.say("frame", source=frame.source, unix_s=frame.stamp.sec + frame.stamp.nanosec / 1e9,
                 people=[perceived(it) for it in frame.people], **covers)

    def charge(self, battery):
        if math.isfinite(battery.percentage):
            is_charging = battery.power_supply_status == BatteryState.POWER_SUPPLY_STATUS_CHARGING
            self.say("command", line=f"battery {100 * battery.percentage:.0f}{' charging' if is_charging else ''}")

    def turn(self):
        if not self.port.link and time.monotonic() - self.asked > 10 * TURN_S:
            self.asked = time.monotonic()
            self.port.connect()
        lines = self.port.lines()
        states = [line for line in lines if line["type"] == "state"]
        for line in lines:
            self.hear(line, is_newest=line is states[-1] if states else False)
        if not self.port.link and self.robot:
            self.robot = self.said = self.offset = None

    def hear(self, line, is_newest):
        kind = line["type"]
        if kind == "hello":
            self.robot = line
        elif kind == "state" and self.robot:
            self.tell(line, is_newest)
        elif kind in ("act", "notice", "ignored", "refused", "dropped", "hindered", "stopped"):
            if kind == "dropped":
                cause = f"{line['layer']}: {line['cause']}"
                self.drops[cause] = self.drops.get(cause, 0) + line.get("count", 1)
            self.event(line.get("output") or line.get("notice") or kind, line)

    def event(self, kind, line):
        text = line.get("text") or line.get("why") or line.get("detail", "")
        what = line.get("event") or line.get("cause")
        event = Event(kind=kind, text=f"{what}: {text}" if what else text, station=line.get("station", 0),
                      request=line.get("request", 0), task=task_of(line.get("task")),
                      reason=line.get("reason", ""), unavailability=line.get("unavailability", ""))
        event.header.stamp = self.node.now()
        event.in_session, event.session = self.session(line.get("session"))
        self.events.publish(event)

    def session(self, of):
        return bool(of), Session(**of) if of else Session()

    def tell(self, line, is_newest):
        """Tells a state: its corridor if no newer one is known, and the rest when it changes or a second is over."""
        now = time.monotonic()
        # A line that waited, here or in the socket, is older than the quickest one would be.
        passed = now - line["atUs"] / 1e6
        self.offset = passed if self.offset is None else min(passed, self.offset)
        left = min(line.get("openMs", 0) / 1e3, SHOWN_S) - (passed - self.offset)
        if is_newest:
            # A display would take the go of one robot for that of the other.
            nodes = self.node.count_publishers(self.corridor.topic_name)
            if nodes > 1:
                self.node.refuse(f"{nodes} nodes publish {self.corridor.topic_name}: no go is told, each wants a namespace")
            corridor = Corridor(station=line["station"], open=left > 0 and nodes <= 1, road_occupied=line["roadOccupied"],
                                valid_for=Duration(seconds=max(left, 0.0)).to_msg())
            corridor.header.stamp = self.node.now()
            self.corridor.publish(corridor)
        what = {name: value for name, value in line.items() if name not in ("atUs", "openMs")}
        if what == self.said and now - self.told < STATUS_S:
            return
        self.said, self.told = what, now
        executes = line.get("executes", {})
        status = Status(robot=self.robot["robot"], corridor=line.get("corridor", Status.CORRIDOR_CLEAR),
                        task=task_of(executes.get("task")), request=executes.get("request", 0),
                        yields_to=line.get("yieldsTo", 0), duty=line.get("duty", ""),
                        duty_request=line.get("dutyRequest", 0))
        for name in ("station", "boot", "state", "role", "availability"):
            setattr(status, name, line[name])
        status.header.stamp = self.node.now()
        status.in_session, status.session = self.session(line.get("session"))
        _, status.duty_session = self.session(line.get("dutySession"))
        status.followers = [
            Follower(station=it["station"], has_joined=it["hasJoined"], task=task_of(it.get("task")),
                     progress=it.get("progress", ""), has_lease=it["hasLease"]) for it in line.get("followers", [])]
        self.status.publish(status)


class Crossguard(Node):
    """The node."""

    def __init__(self):
        super().__init__("crossguard")
        trusts = self.declare_parameter("trust_ros_graph", False).value
        body = self.declare_parameter("body", "").value
        operator = self.declare_parameter("operator", "").value
        self.silence_s = self.declare_parameter("silence", 0.5).value
        error_m = self.declare_parameter("pose_error", 0.0).value
        if is_visible(os.environ) and not trusts:
            sys.exit("others than this machine may be on the ROS graph, and who is on it moves and commands the robot: set "
                     "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST (Humble: ROS_LOCALHOST_ONLY=1), and no other peers, "
                     "discovery server or profile; or the parameter trust_ros_graph")
        if not body and not operator:
            sys.exit("the parameters body and operator name ports of the robot's file, like unix:go2.sock: set one or both")
        self.operator = Operator(self, operator) if operator else None
        self.body = Body(self, body, self.silence_s, error_m) if body else None
        self.bodiless = 0  # for how many seconds the robot has taken part without its body
        self.refused, self.turned, self.held = 0, time.monotonic(), -math.inf
        self.diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
        # Not the ROS clock: a simulation that stands still would stop the heartbeats, and nobody would be told.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(TURN_S, self.turn, clock=steady)
        self.create_timer(STATUS_S, self.diagnose, clock=steady)

    def now(self):
        return self.get_clock().now().to_msg()

    def turn(self):
        now = time.monotonic()
        late_s, self.turned = now - self.turned, now
        if late_s > self.silence_s:
            self.held = now
        if self.operator:
            self.operator.turn()
        # A robot that does not trust the graph is moved by nobody on it.
        if self.body and (self.body.port.link or not self.operator or self.operator.trusts()):
            self.body.turn(late_s)

    def was_held(self):
        """Whether messages may have waited for the node: it was held until just now."""
        now = time.monotonic()
        return now - self.turned > self.silence_s or now - self.held < self.silence_s

    def refuse(self, why):
        self.refused += 1
        self.get_logger().warning(f"refused: {why}", throttle_duration_sec=1.0)
        if self.operator:
            self.operator.event(Event.REFUSED, {"text": why})

    def watch_body(self):
        """A robot that takes part without this body has another one, perhaps a simulated one: people would rely on a guard
        that does not move."""
        has_part = self.operator and self.operator.trusts() and self.operator.said
        is_bodiless = has_part and self.operator.said["availability"] == Status.AVAILABLE and not self.body.port.link
        self.bodiless = self.bodiless + 1 if is_bodiless else 0
        if self.bodiless > 2:
            self.refuse("the robot takes part without the body of this node: is there a [body] in its file?")
            self.operator.say("command", line="unavailable local-fault")

    def diagnose(self):
        if self.body:
            self.watch_body()
        message = DiagnosticArray()
        message.header.stamp = self.now()
        for name, end in (("body", self.body), ("operator", self.operator)):
            if end:
                is_there = bool(end.port.link)
                level = DiagnosticStatus.OK if is_there else DiagnosticStatus.ERROR
                said = "connected" if is_there else "not connected"
                message.status.append(self.status(name, level, said, {"address": end.port.address}))
        if self.operator and self.operator.said:
            availability = self.operator.said["availability"]
            is_fine = availability == Status.AVAILABLE
            level = DiagnosticStatus.OK if is_fine else DiagnosticStatus.WARN
            drops = {"refused": self.refused, **self.operator.drops}
            message.status.append(self.status("robot", level, availability, drops))
        self.diagnostics.publish(message)

    def status(self, name, level, said, values):
        values = [KeyValue(key=key, value=str(value)) for key, value in values.items()]
        return DiagnosticStatus(
            name=f"{self.get_fully_qualified_name()}: {name}", level=level, message=said, values=values)


def main():
    rclpy.init()
    try:
        rclpy.spin(Crossguard())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
