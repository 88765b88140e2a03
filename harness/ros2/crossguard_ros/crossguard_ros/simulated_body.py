"""A body that walks in a straight line: what a driver of a real one has to do, and what `harness/ros2/try` runs.

    simulated_body --ros-args -r __ns:=/go2 -p place:="[1.0, -1.11]" -p pace:=1.0
"""

import math
import time

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty

from crossguard_msgs.action import Maneuver

STEP_S = 0.05


class Walker(Node):
    def __init__(self):
        super().__init__("body")
        self.place = tuple(self.declare_parameter("place", [0.0, 0.0]).value)
        self.pace = self.declare_parameter("pace", 1.0).value
        self.silence_s = self.declare_parameter("silence", 0.5).value
        self.begin = self.target = self.place
        self.current, self.heard = None, 0.0
        group = ReentrantCallbackGroup()
        self.poses = self.create_publisher(PoseStamped, "crossguard/pose", 1)
        self.create_subscription(Empty, "crossguard/beat", self.hear, 1, callback_group=group)
        self.server = ActionServer(
            self, Maneuver, "crossguard/maneuver", self.walk, callback_group=group, handle_accepted_callback=self.take,
            cancel_callback=lambda _: CancelResponse.ACCEPT)
        # It walks by a clock that no simulation stops.
        self.create_timer(STEP_S, self.say, callback_group=group, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def hear(self, _):
        self.heard = time.monotonic()

    def say(self):
        """Poses are its heartbeat."""
        pose = PoseStamped()
        pose.header.stamp, pose.header.frame_id = self.get_clock().now().to_msg(), "site"
        pose.pose.position.x, pose.pose.position.y = self.place
        self.poses.publish(pose)

    def take(self, handle):
        """A new goal takes the place of the one before."""
        self.current, self.heard = handle, time.monotonic()
        handle.execute()

    def walk(self, handle):
        goal, result = handle.request, Maneuver.Result()
        target = (goal.target.x, goal.target.y) if goal.has_target else self.place
        if goal.policy:
            # To the nearer kerb with the escorted person; else it stands.
            ends = [self.begin, self.target] if goal.policy == Maneuver.Goal.ESCORT_TO_KERB else [self.place]
            target = min(ends, key=lambda end: math.dist(end, self.place))
        elif not goal.resumes:
            self.begin, self.target = self.place, target
        speed, last = (goal.speed or 0.5) * self.pace, time.monotonic()
        while self.current is handle and rclpy.ok():
            if handle.is_cancel_requested:
                handle.canceled()
                return result
            now = time.monotonic()
            if now - self.heard > self.silence_s:  # nobody commands it any more
                result.text = "nobody commands this body any more"
                break
            step, way = (now - last) * speed, math.dist(self.place, target)
            last = now
            if way > step:
                self.place = tuple(a + (b - a) * step / way for a, b in zip(self.place, target))
            else:
                self.place = target
                if goal.hold:
                    handle.publish_feedback(Maneuver.Feedback(in_position=True))
                elif goal.policy != Maneuver.Goal.HOLD_UNTIL_CLEAR:
                    handle.succeed()
                    return result
            time.sleep(STEP_S)
        handle.abort()
        return result


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    executor.add_node(Walker())
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
