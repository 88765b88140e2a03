from setuptools import setup

setup(
    name="crossguard_ros",
    version="0.1.0",
    packages=["crossguard_ros"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/crossguard_ros"]),
        ("share/crossguard_ros", ["package.xml"]),
        ("share/crossguard_ros/launch", ["launch/robot.launch.py"]),
    ],
    description="A node that joins a robot of crossguard run to a ROS 2 system, by its ports",
    license="MIT OR Apache-2.0",
    zip_safe=True,
    entry_points={"console_scripts": [
        "crossguard_node = crossguard_ros.node:main",
        "simulated_body = crossguard_ros.simulated_body:main",
    ]},
)
