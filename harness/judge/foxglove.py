#!/usr/bin/env python3
"""Writes what logs tell as an MCAP file, for Foxglove and for tools of ROS 2.

    crossguard export ari.jsonl go2.jsonl --facts facts.jsonl
    python3 foxglove.py facts.jsonl crossing.mcap

It takes mcap, mcap-protobuf-support and foxglove-schemas-protobuf from PyPI.

| topic | content |
|---|---|
| /ARI/state, /ARI/step, /ARI/message, /ARI/counted, /ARI/corridor, /ARI/people, /ARI/around | facts, as JSON |
| /ARI/location | foxglove.LocationFix: each of its RAM |
| /ARI/places | foxglove.SceneUpdate: where its followers go, hold and escort |
| /ARI/crossing | foxglove.SceneUpdate: its zone, people and clusters |
| /robots | foxglove.SceneUpdate: boxes with name and state |
| /tf | foxglove.FrameTransform: each robot's frame in the frame "street" |
| /log | foxglove.Log: what a sequence chart notes |

The frame "street" is in metres to the east and to the north of where the first robot was first; each robot has a frame of
its own, which looks ahead along x (REP 103).
"""

import json
import math
import sys

from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform
from foxglove_schemas_protobuf.LocationFix_pb2 import LocationFix
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.Point3_pb2 import Point3
from foxglove_schemas_protobuf.Pose_pb2 import Pose
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
from foxglove_schemas_protobuf.SceneEntityDeletion_pb2 import SceneEntityDeletion
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
from mcap.writer import Writer
from mcap_protobuf.schema import build_file_descriptor_set

METRES_PER_DEGREE = 111_195.0
# Those of Okabe and Ito, which people who do not see all colours can tell apart.
COLORS = [Color(r=r, g=g, b=b, a=1) for r, g, b in (
    (0.0, 0.447, 0.698), (0.835, 0.369, 0.0), (0.0, 0.62, 0.451), (0.8, 0.475, 0.655), (0.902, 0.624, 0.0), (0.337, 0.706, 0.914))]
OPEN, CLOSED = Color(g=0.62, b=0.451, a=0.5), Color(r=0.5, g=0.5, b=0.5, a=0.35)
ZONE, ROAD, CLUSTER = COLORS[4], Color(r=0.5, g=0.5, b=0.5, a=0.8), COLORS[3]
CONDUCTS = {"waiting": ZONE, "onRoad": COLORS[1], "across": COLORS[2]}
# How wide the way is along which a pedestrian is escorted, in metres.
CORRIDOR = 1.5
AS_JSON = {"state", "step", "message", "counted", "corridor", "people", "around"}


def token(robot):
    return "".join(c if c.isascii() and c.isalnum() else "_" for c in robot)


def turned(heading):
    """A turn by degrees clockwise from north, of something that looks to the east."""
    half = math.radians(90 - heading) / 2
    return Quaternion(z=math.sin(half), w=math.cos(half))


def pose(x=0.0, y=0.0, z=0.0, turn=None):
    return Pose(position=Vector3(x=x, y=y, z=z), orientation=turn or Quaternion(w=1))


def covariance(ellipse):
    """In m², east, north and up. Half axes of 95 % are 2.45 standard deviations of a normal distribution in the plane."""
    major, minor = (ellipse[axis] / 2.44775 for axis in ("semiMajor", "semiMinor"))
    turn = math.radians(ellipse["orientation"])
    sin, cos = math.sin(turn), math.cos(turn)
    both = (major**2 - minor**2) * sin * cos
    return [(major * sin) ** 2 + (minor * cos) ** 2, both, 0, both, (major * cos) ** 2 + (minor * sin) ** 2, 0, 0, 0, 0]


class Recording:
    def __init__(self, file):
        self.writer = Writer(file)
        self.writer.start(library="crossguard")
        self.channels, self.robots, self.origin = {}, {}, None

    def write(self, topic, at_us, message):
        is_json = isinstance(message, dict)
        if topic not in self.channels:
            if is_json:
                name, schema = "crossguard." + topic.rsplit("/", 1)[-1], ("jsonschema", b'{"type": "object"}')
            else:
                descriptor = build_file_descriptor_set(type(message)).SerializeToString()
                name, schema = message.DESCRIPTOR.full_name, ("protobuf", descriptor)
            schema_id = self.writer.register_schema(name, *schema)
            self.channels[topic] = self.writer.register_channel(topic, "json" if is_json else "protobuf", schema_id)
        data = json.dumps(message).encode() if is_json else message.SerializeToString()
        self.writer.add_message(self.channels[topic], at_us * 1000, data, at_us * 1000)

    def metres(self, place):
        north, east = self.origin
        return ((place[1] - east) * METRES_PER_DEGREE * math.cos(math.radians(north)), (place[0] - north) * METRES_PER_DEGREE)

    def take(self, line):
        at_us, name, fact, of = line["atUs"], line["robot"], line["fact"], line.get("of")
        robot = self.robots.setdefault(name, {"number": len(self.robots), "clusters": {}, "areas": [], "open": False})
        topic = "/" + token(name)
        if fact in AS_JSON:
            self.write(f"{topic}/{fact}", at_us, {"robot": name, **of})
        if fact == "note":
            log = Log(level=3 if of["isWarning"] else 2, message=of["text"], name=name)
            log.timestamp.FromMicroseconds(at_us)
            self.write("/log", at_us, log)
        elif fact == "place":
            self.place(at_us, name, robot, of)
        elif fact in ("areas", "corridor"):
            robot["areas" if fact == "areas" else "open"] = of if fact == "areas" else of["isOpen"]
            self.areas(at_us, name, robot)
        elif fact in ("state", "zone", "people"):
            robot[fact] = of
        elif fact == "cluster":
            robot["clusters"] = {**robot["clusters"], of["id"]: of} if of else {}
        if fact in ("zone", "people", "cluster") or fact == "place" and "zone" in robot and "drawn" not in robot:
            self.crossing(at_us, topic, robot)

    def place(self, at_us, name, robot, of):
        frame = token(name)
        self.origin = self.origin or (of["latitude"], of["longitude"])
        fix = LocationFix(frame_id=frame, latitude=of["latitude"], longitude=of["longitude"], altitude=of["altitude"] or 0)
        if of["ellipse"]:
            fix.position_covariance.extend(covariance(of["ellipse"]))
            fix.position_covariance_type = 1
        x, y = self.metres((of["latitude"], of["longitude"]))
        transform = FrameTransform(parent_frame_id="street", child_frame_id=frame)
        transform.translation.CopyFrom(Vector3(x=x, y=y))
        transform.rotation.CopyFrom(turned(of["heading"] or 0))
        for message in (fix, transform):
            message.timestamp.FromMicroseconds(at_us)
        self.write(f"/{frame}/location", at_us, fix)
        self.write("/tf", at_us, transform)
        box = of["dimensions"]
        length, width, height = box.get("length") or 0.6, box.get("width") or 0.6, box.get("height") or 1.0
        scene, state = SceneUpdate(), robot.get("state")
        entity = self.entity(scene, at_us, frame, name)
        entity.cubes.add(pose=pose(z=height / 2), size=Vector3(x=length, y=width, z=height), color=COLORS[robot["number"] % 6])
        text = f"{name}\n{state['state']} ({state['role']})" if state else name
        entity.texts.add(pose=pose(z=height + 0.3), billboard=True, font_size=14, scale_invariant=True, text=text,
                         color=Color(r=1, g=1, b=1, a=1))
        self.write("/robots", at_us, scene)

    def entity(self, scene, at_us, frame, name):
        entity = scene.entities.add(frame_id=frame, id=name, frame_locked=True)
        entity.timestamp.FromMicroseconds(at_us)
        return entity

    def areas(self, at_us, name, robot):
        """The way of an escort as a strip, other places as discs."""
        if not self.origin:
            return
        scene = SceneUpdate()
        if not robot["areas"]:
            scene.deletions.add(type=SceneEntityDeletion.ALL).timestamp.FromMicroseconds(at_us)
        for area in robot["areas"]:
            entity = self.entity(scene, at_us, "street", f"{name}: place of station {area['follower']}")
            color = OPEN if robot["open"] and area["guards"] else CLOSED
            x, y = self.metres(area["to"])
            if area["task"] == "move" and area["from"]:
                x0, y0 = self.metres(area["from"])
                turn = turned(math.degrees(math.atan2(x - x0, y - y0)))
                size = Vector3(x=math.hypot(x - x0, y - y0), y=CORRIDOR, z=0.02)
                entity.cubes.add(pose=pose((x + x0) / 2, (y + y0) / 2, 0.01, turn), size=size, color=color)
            else:
                size = Vector3(x=CORRIDOR, y=CORRIDOR, z=0.02)
                entity.cylinders.add(pose=pose(x, y, 0.01), size=size, bottom_scale=1, top_scale=1, color=color)
        self.write(f"/{token(name)}/places", at_us, scene)

    def crossing(self, at_us, topic, robot):
        """Zone, people and clusters of a robot, once it is known where the street is."""
        if not self.origin:
            return
        robot["drawn"] = True
        scene = SceneUpdate()
        zone = robot.get("zone") or {"waiting": [], "road": []}
        clusters = [(it["corners"], CLUSTER) for it in robot["clusters"].values()]
        for name, outlines in (("crossing zone", [(zone["waiting"], ZONE), (zone["road"], ROAD)]), ("clusters", clusters)):
            entity = self.entity(scene, at_us, "street", name)
            for corners, color in outlines:
                points = [Point3(x=x, y=y, z=0.02) for x, y in map(self.metres, corners)]
                if points:
                    entity.lines.add(type=1, pose=pose(), thickness=0.08, points=points, color=color)
        people = self.entity(scene, at_us, "street", "people")
        for it in robot.get("people", {}).get("people", []):
            x, y = self.metres(it["place"])
            people.cylinders.add(pose=pose(x, y, 0.85), size=Vector3(x=0.4, y=0.4, z=1.7), bottom_scale=1, top_scale=0.6,
                                 color=CONDUCTS.get(it["conduct"], ROAD))
        self.write(f"{topic}/crossing", at_us, scene)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as facts, open(sys.argv[2], "wb") as file:
        recording = Recording(file)
        for line in facts:
            recording.take(json.loads(line))
        recording.writer.finish()


if __name__ == "__main__":
    main()
