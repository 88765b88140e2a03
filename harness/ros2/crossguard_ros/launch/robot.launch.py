"""One robot: `crossguard run`, its node, and a body that is simulated. Put the driver of yours in its place.

    ros2 launch crossguard_ros robot.launch.py config:=go2.toml name:=go2 body:=unix:go2.sock operator:=unix:go2-operator.sock
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, SetEnvironmentVariable
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    config, name, body, operator = (LaunchConfiguration(it) for it in ("config", "name", "body", "operator"))
    return LaunchDescription([
        *(DeclareLaunchArgument(it) for it in ("config", "name", "body", "operator")),
        DeclareLaunchArgument("place", default_value="[0.0, 0.0]"),
        SetEnvironmentVariable("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"),
        ExecuteProcess(cmd=["crossguard", "run", "--config", config], output="screen"),
        Node(package="crossguard_ros", executable="crossguard_node", namespace=name, respawn=True, output="screen",
             parameters=[{"body": body, "operator": operator}]),
        Node(package="crossguard_ros", executable="simulated_body", namespace=name, respawn=True,
             parameters=[{"place": LaunchConfiguration("place")}]),
    ])
