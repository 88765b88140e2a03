"""Stands for rclpy and the messages that nav2_body.py uses, as far as it uses them. What it calls is done by
server.py, which NAV2_SERVER names: it plays Nav2. Names and signatures are those of the documentation of rclpy (Humble);
neither rclpy nor Nav2 was at hand.
"""
import itertools, json, os, socket, sys, time
from types import ModuleType, SimpleNamespace


class Future:
    def __init__(self):
        self.value, self.is_done, self.callbacks = None, False, []

    def done(self):
        return self.is_done

    def result(self):
        return self.value

    def add_done_callback(self, callback):
        self.callbacks.append(callback)

    def end(self, value):
        self.value, self.is_done = value, True
        for callback in self.callbacks:
            callback(self)


class Node:
    def __init__(self):
        host, _, port = os.environ["NAV2_SERVER"].rpartition(":")
        self.link = socket.create_connection((host, int(port)))
        self.text, self.waiting, self.poses, self.feedback = b"", {}, [], {}
        self.ids = (f"{os.getpid()}-{number}" for number in itertools.count())

    def ask(self, kind, op, **more):
        """The future of what comes as `kind`."""
        number, future = more.get("id") or next(self.ids), Future()
        self.waiting[kind, number] = future
        self.tell(op, **{**more, "id": number})
        return number, future

    def tell(self, op, **more):
        self.link.sendall((json.dumps({"op": op, **more}) + "\n").encode())

    def create_publisher(self, kind, topic, depth):
        assert (kind, topic) == (SpeedLimit, "speed_limit")
        return SimpleNamespace(publish=lambda it: self.tell("limit", speed=it.speed_limit))

    def create_subscription(self, kind, topic, callback, qos):
        assert (kind, topic) == (PoseWithCovarianceStamped, "amcl_pose")
        self.poses.append(callback)
        self.tell("subscribe")

    def create_client(self, kind, name):
        assert (kind, name) == (CancelGoal, "navigate_to_pose/_action/cancel_goal")
        return SimpleNamespace(
            wait_for_service=lambda timeout_sec: True,
            call_async=lambda request: self.ask("cancelled", "cancel", all=True)[1])

    def spin_once(self, timeout):
        self.link.settimeout(timeout)
        try:
            octets = self.link.recv(4096)
            if not octets:
                sys.exit("Nav2 is gone")
            self.text += octets
        except socket.timeout:
            return
        *lines, self.text = self.text.split(b"\n")
        for line in map(json.loads, lines):
            self.take(line)

    def take(self, line):
        kind, number = line["op"], line.get("id")
        if kind == "pose":
            for callback in self.poses:
                callback(SimpleNamespace(pose=SimpleNamespace(pose=pose(line))))
        elif kind == "feedback" and number in self.feedback:
            current = SimpleNamespace(current_pose=SimpleNamespace(pose=pose(line)))
            self.feedback[number](SimpleNamespace(feedback=current))
        elif (kind, number) in self.waiting:
            self.waiting.pop((kind, number)).end(self.value(kind, number, line))

    def value(self, kind, number, line):
        if kind != "response":
            return SimpleNamespace(status=line.get("status"))
        result = Future()
        self.waiting["result", number] = result
        return SimpleNamespace(
            accepted=line["accepted"], get_result_async=lambda: result,
            cancel_goal_async=lambda: self.ask("cancelled", "cancel", id=number, all=False)[1])


class ActionClient:
    def __init__(self, node, kind, name):
        assert (kind, name) == (NavigateToPose, "navigate_to_pose")
        self.node = node

    def wait_for_server(self, timeout_sec):
        return True

    def send_goal_async(self, goal, feedback_callback):
        place, frame = goal.pose.pose.position, goal.pose.header.frame_id
        number, future = self.node.ask("response", "goal", x=place.x, y=place.y, frame=frame)
        self.node.feedback[number] = feedback_callback
        return future


class SingleThreadedExecutor:
    def add_node(self, node):
        self.node = node

    def spin_once(self, timeout_sec):
        self.node.spin_once(timeout_sec)


def pose(line):
    orientation = SimpleNamespace(x=0.0, y=0.0, z=line["z"], w=line["w"])
    return SimpleNamespace(position=SimpleNamespace(x=line["x"], y=line["y"], z=0.0), orientation=orientation)


def init(signal_handler_options):
    assert signal_handler_options == "no"


def create_node(name):
    return Node()


class NavigateToPose:
    class Goal:
        def __init__(self):
            at = pose({"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0})
            self.pose = SimpleNamespace(header=SimpleNamespace(frame_id=""), pose=at)


class CancelGoal:
    Request = SimpleNamespace


SpeedLimit = type("SpeedLimit", (), {})
PoseWithCovarianceStamped = type("PoseWithCovarianceStamped", (), {})
MODULES = {
    "rclpy.action": {"ActionClient": ActionClient},
    "rclpy.executors": {"SingleThreadedExecutor": SingleThreadedExecutor},
    "rclpy.qos": {
        "DurabilityPolicy": SimpleNamespace(TRANSIENT_LOCAL=1),
        "ReliabilityPolicy": SimpleNamespace(RELIABLE=1),
        "QoSProfile": SimpleNamespace},
    "rclpy.signals": {"SignalHandlerOptions": SimpleNamespace(NO="no")},
    "action_msgs": {},
    "action_msgs.msg": {"GoalStatus": SimpleNamespace(STATUS_SUCCEEDED=4)},
    "action_msgs.srv": {"CancelGoal": CancelGoal},
    "geometry_msgs": {},
    "geometry_msgs.msg": {"PoseWithCovarianceStamped": PoseWithCovarianceStamped},
    "nav2_msgs": {},
    "nav2_msgs.action": {"NavigateToPose": NavigateToPose},
    "nav2_msgs.msg": {"SpeedLimit": SpeedLimit},
}
__path__ = []
for name, content in MODULES.items():
    sys.modules[name] = module = ModuleType(name)
    module.__dict__.update(content)
    if "." not in name:
        module.__path__ = []
