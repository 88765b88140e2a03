"""A body for `crossguard run` that drives by Nav2: each maneuver is a goal of the action NavigateToPose.

    python3 nav2_body.py ADDRESS [--site-in-map X Y YAW_DEG]

ADDRESS is `listen` of the robot file, like unix:go2.sock or 127.0.0.1:47600. It wants rclpy and nav2_msgs (Humble or
newer) and a Nav2 that is localised. `--site-in-map` says where the origin of the site lies in the frame `map`, and how
far its east is turned from the x axis, counter-clockwise.

Four things in it keep people safe; when you copy it, keep them:

1. What counts is the newest act alone: the end of a goal that was replaced or cancelled reports nothing.
2. When the kit is silent for half a second, or this process was held for as long, the goal is cancelled.
3. Nav2 goes on driving when its client dies. So a second process watches this one, and cancels every goal of the
   action when this one ends or hangs. It cancels goals of others as well: nobody else should have any.
4. A Nav2 that says nothing of a goal for a second, or does not end one in two that was cancelled, is a fault: its
   robot takes no part until a person says so.
"""
import argparse, json, math, os, select, signal, socket, subprocess, sys, time

import rclpy
from action_msgs.msg import GoalStatus
from action_msgs.srv import CancelGoal
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav2_msgs.action import NavigateToPose
from nav2_msgs.msg import SpeedLimit
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions

ACTION = "navigate_to_pose"
SILENCE_S = 0.5  # the kit, or this process, was not heard for so long: stand still
NAV2_SILENCE_S = 1.0  # Nav2 said nothing of a goal for so long: a fault
NAV2_STOPS_S = 2.0  # Nav2 did not end a goal for so long that was cancelled: a fault
POSE_PERIOD_S = 0.1


def begin_ros(name):
    """A node and what spins it. Signals are this program's: a goal is cancelled before it ends."""
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node, executor = rclpy.create_node(name), SingleThreadedExecutor()
    executor.add_node(node)
    return node, executor


class Goal:
    """One goal of the action, from its request to its result."""

    def __init__(self, place, done):
        self.place, self.done = place, done
        self.handle, self.is_unwanted, self.heard = None, False, time.monotonic()


class Navigator:
    """Nav2, as a body needs it. Places are (east, north) on the site, in metres."""

    def __init__(self, node, executor, site_in_map):
        self.executor, (self.x, self.y, yaw) = executor, site_in_map
        self.yaw = math.radians(yaw)
        self.client = ActionClient(node, NavigateToPose, ACTION)
        self.limit = node.create_publisher(SpeedLimit, "speed_limit", 10)
        latched = QoSProfile(
            depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, reliability=ReliabilityPolicy.RELIABLE)
        node.create_subscription(
            PoseWithCovarianceStamped, "amcl_pose", lambda it: self.localised(it.pose.pose), latched)
        self.goals, self.pose, self.moved, self.speed = [], None, 0.0, 0.0

    def spin(self):
        for _ in range(8):
            self.executor.spin_once(timeout_sec=0.002)

    def drive(self, place, heading_deg, speed_mps, done):
        """Goes there, and then calls `done` with whether it came there."""
        here = self.pose[0] if self.pose else place
        north_of_east = place[1] - here[1], place[0] - here[0]
        yaw = math.atan2(*north_of_east) if heading_deg is None else math.radians(90.0 - heading_deg)
        goal, to = Goal(place, done), NavigateToPose.Goal()
        to.pose.header.frame_id = "map"
        to.pose.pose.position.x, to.pose.pose.position.y = self.in_map(place)
        to.pose.pose.orientation.z = math.sin((yaw + self.yaw) / 2)
        to.pose.pose.orientation.w = math.cos((yaw + self.yaw) / 2)
        limit = SpeedLimit()
        limit.percentage, limit.speed_limit = False, speed_mps or 0.0  # 0 is no limit
        self.limit.publish(limit)
        # Nav2 replaces the goal that runs by this one. What comes of it is of no interest any more.
        for older in self.goals:
            older.done = None
        self.goals.append(goal)
        sent = self.client.send_goal_async(to, feedback_callback=lambda it: self.progress(goal, it.feedback))
        sent.add_done_callback(lambda future: self.answered(goal, future.result()))

    def stand(self):
        """Cancels whatever runs. It stands when `goals` is empty."""
        for goal in self.goals:
            goal.done = None
            if not goal.is_unwanted:
                goal.is_unwanted, goal.heard = True, time.monotonic()
                if goal.handle:
                    goal.handle.cancel_goal_async()

    def is_lost(self):
        """Whether nothing was heard of a goal for too long, or a cancelled one does not end."""
        now = time.monotonic()
        return any(now - it.heard > (NAV2_STOPS_S if it.is_unwanted else NAV2_SILENCE_S) for it in self.goals)

    def give_up(self):
        """Cancels what runs and waits for no end of it. Where the body is, nobody knows before Nav2 says it again."""
        self.stand()
        self.goals, self.pose = [], None

    def answered(self, goal, handle):
        goal.handle = handle
        if not handle.accepted:
            self.end(goal, False)
            self.stand()  # the goal before goes on otherwise
            return
        handle.get_result_async().add_done_callback(
            lambda future: self.end(goal, future.result().status == GoalStatus.STATUS_SUCCEEDED))
        if goal.is_unwanted:
            handle.cancel_goal_async()

    def progress(self, goal, feedback):
        if not goal.is_unwanted:
            goal.heard = time.monotonic()
        self.localised(feedback.current_pose.pose)

    def end(self, goal, is_there):
        self.goals = [other for other in self.goals if other is not goal]
        if not self.goals:
            self.speed = 0.0
        done, goal.done = goal.done, None
        if done:
            done(is_there)

    def localised(self, pose):
        now, place = time.monotonic(), self.on_site(pose.position.x, pose.position.y)
        z, w = pose.orientation.z, pose.orientation.w
        heading = 90.0 - math.degrees(2 * math.atan2(z, w) - self.yaw)
        if self.pose and self.goals and now - self.moved > 0.01:
            self.speed = math.dist(place, self.pose[0]) / (now - self.moved)
        self.pose, self.moved = (place, heading % 360.0), now

    def in_map(self, place):
        east, north = place
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        return self.x + cosine * east - sine * north, self.y + sine * east + cosine * north

    def on_site(self, x, y):
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        x, y = x - self.x, y - self.y
        return cosine * x + sine * y, cosine * y - sine * x


class Body:
    """The body port: acts of the kit come in, poses and reports go out."""

    def __init__(self, address, navigator):
        host, _, port = address.rpartition(":")
        self.link = socket.socket(socket.AF_UNIX if host == "unix" else socket.AF_INET)
        self.link.connect(port if host == "unix" else (host, int(port)))
        self.link.setblocking(False)
        self.nav, self.text, self.heard, self.said = navigator, b"", time.monotonic(), 0.0
        self.begin = self.target = None
        self.safe = navigator.pose and navigator.pose[0]
        self.when_standing = None
        self.say("hello", crossguard=1)

    def say(self, kind, **more):
        line = (json.dumps({"type": kind, **more}) + "\n").encode()
        try:
            if self.link.send(line) == len(line):
                return
        except OSError:
            pass
        sys.exit("the robot takes no lines any more")

    def turn(self, since):
        """Takes in what came, says where the body is; once in some hundredths of a second, the last time `since`."""
        try:
            while True:
                octets = self.link.recv(4096)
                if not octets:
                    sys.exit("the robot has closed the port")
                self.text, self.heard = self.text + octets, time.monotonic()
        except BlockingIOError:
            pass
        except OSError as error:
            sys.exit(f"the port: {error}")
        if time.monotonic() - since > SILENCE_S:
            sys.exit("this process was held: what has come meanwhile is of no use any more")
        *lines, self.text = self.text.split(b"\n")
        for line in lines:
            self.act(json.loads(line))
        if time.monotonic() - self.heard > SILENCE_S:
            self.stand()
        if self.nav.is_lost():
            self.nav.give_up()
            self.when_standing = None
            self.say("fault", text="Nav2 says nothing of its goal, or does not end it")
        if self.when_standing and not self.nav.goals:
            then, self.when_standing = self.when_standing, None
            then()
        if time.monotonic() - self.said >= POSE_PERIOD_S:
            self.said = time.monotonic()
            # A body that drives is where the newest feedback says; one that stands stays where it stopped.
            is_known = self.nav.pose and (not self.nav.goals or self.said - self.nav.moved < NAV2_SILENCE_S)
            if is_known:
                (east, north), heading = self.nav.pose
                self.say("pose", east_m=east, north_m=north, heading_deg=heading, speed_mps=self.nav.speed)
            else:
                self.say("beat")

    def stand(self, then=None):
        self.nav.stand()
        self.when_standing = then

    def act(self, line):
        kind, to = line["type"], line.get("to")
        place = to and (to["east_m"], to["north_m"])
        if kind == "start":
            self.start(line, place)
        elif kind == "go":
            self.drive(place, None, None, lambda is_there: None)
        elif kind in ("stop", "halt"):
            self.stand()
        elif kind == "fall-back":
            self.fall_back(line["policy"])
        elif kind == "refused":
            sys.exit(f"refused: {line['why']}")

    def drive(self, place, heading_deg, speed_mps, done):
        self.when_standing = None
        self.nav.drive(place, heading_deg, speed_mps, done)

    def start(self, line, place):
        here = self.nav.pose and self.nav.pose[0]
        self.begin, self.target = here, place or here
        report = lambda is_there: self.say(line["report"] if is_there else "failed", id=line["id"])
        if place:
            self.drive(place, line["heading_deg"], line["speed_mps"], report)
        else:
            self.stand(lambda: report(here is not None))

    def fall_back(self, policy):
        here = self.nav.pose and self.nav.pose[0]
        ends = {"escort-to-kerb": [self.begin, self.target], "go-to-safe-position": [self.safe]}.get(policy, [])
        ends = [end for end in ends if end]
        if not ends or not here:
            self.stand(lambda: self.say("fallen-back"))
            return

        def done(is_there):
            if is_there:
                self.say("fallen-back")
            else:  # it stands somewhere else: a person has to look
                self.say("fault", text=f"Nav2 did not finish {policy}")

        # Nobody is hurried to the kerb, and nobody is left behind: half a metre per second.
        self.drive(min(ends, key=lambda end: math.dist(end, here)), None, 0.5, done)


def watch():
    """Cancels every goal of the action when the body's process, at the other end of stdin, ends or hangs."""
    node, executor = begin_ros("crossguard_body_watchdog")
    cancel = node.create_client(CancelGoal, f"{ACTION}/_action/cancel_goal")
    if not cancel.wait_for_service(timeout_sec=30.0):
        sys.exit(f"nobody cancels goals of the action {ACTION}")

    def cancel_all():
        # No id and no time: all goals (design of ROS 2 actions, CancelGoal).
        asked, until = cancel.call_async(CancelGoal.Request()), time.monotonic() + SILENCE_S
        while not asked.done() and time.monotonic() < until:
            executor.spin_once(timeout_sec=0.01)
        return asked.done()

    print("ready", flush=True)
    while True:
        heard, _, _ = select.select([sys.stdin], [], [], SILENCE_S)
        if not heard:
            cancel_all()
        elif not os.read(0, 4096):
            break
    # A goal that was sent at the last moment is not taken yet: more than once.
    for _ in range(5):
        cancel_all()
        time.sleep(0.1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("address")
    parser.add_argument("--site-in-map", nargs=3, type=float, default=[0.0, 0.0, 0.0], metavar=("X", "Y", "YAW_DEG"))
    options = parser.parse_args()
    for ending in (signal.SIGTERM, signal.SIGINT):
        signal.signal(ending, lambda number, _: sys.exit(f"ended by {signal.Signals(number).name}"))
    node, executor = begin_ros("crossguard_body")
    navigator = Navigator(node, executor, options.site_in_map)
    if not navigator.client.wait_for_server(timeout_sec=30.0):
        sys.exit(f"no Nav2: nobody serves the action {ACTION}")
    until = time.monotonic() + 30.0
    while not navigator.pose and time.monotonic() < until:
        navigator.spin()
    if not navigator.pose:
        sys.exit("no pose on amcl_pose: is Nav2 localised?")
    watchdog = subprocess.Popen(
        [sys.executable, __file__, "--watch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0,
        start_new_session=True)
    if watchdog.stdout.readline() != b"ready\n":
        sys.exit("the watchdog does not begin")
    body, turned = Body(options.address, navigator), time.monotonic()
    try:
        while watchdog.poll() is None:
            watchdog.stdin.write(b".")
            navigator.spin()
            since, turned = turned, time.monotonic()
            body.turn(since)
        sys.exit("the watchdog is gone")
    finally:
        navigator.stand()
        until = time.monotonic() + NAV2_SILENCE_S
        while navigator.goals and time.monotonic() < until:
            navigator.spin()


if __name__ == "__main__":
    watch() if sys.argv[1:] == ["--watch"] else main()
