"""An application of the node on DDS that moves a body: body.py DOMAIN NAMESPACE EAST NORTH TIMES_FASTER. It walks where
events say, tells by poses where it is, and stands still when the node is silent."""
import math
import sys
import time

from ros import Command, Corridor, Event, PoseStamped, Ros, Task

domain, space, east, north, faster = int(sys.argv[1]), sys.argv[2], *map(float, sys.argv[3:])
ros, node = Ros(domain), f"{space}/crossguard"
events, beats = ros.hear(Event, f"{node}/event"), ros.hear(Corridor, f"{node}/corridor")
poses, commands = ros.publisher(PoseStamped, f"{node}/pose"), ros.publisher(Command, f"{node}/command")
place, begin, target, speed, done = (east, north), (east, north), None, 0.0, None
last = heard = time.monotonic()
while True:
    for event in events.new():
        target_of_event = (event.target.x, event.target.y) if event.has_target else place
        end = Command.of(session=event.session, request=event.request)
        if event.kind == Event.START_MANEUVER:
            begin, target, speed = place, target_of_event, event.maximum_speed or 0.5
            end.kind = Command.IN_POSITION if event.task.type == Task.BLOCK else Command.DONE
            done = end
        elif event.kind == Event.STOP_MANEUVER:
            target = done = None
        elif event.kind == Event.FALL_BACK:
            ends = [begin, target or place] if event.policy == Event.POLICY_ESCORT_TO_KERB else [place]
            # Nobody is on this road.
            target, done = min(ends, key=lambda it: math.dist(it, place)), Command.of(kind=Command.ROAD_CLEAR)
    now = time.monotonic()
    heard = now if beats.new() else heard
    if now - heard > 0.5:  # nobody commands it any more
        target = done = None
    if target:
        step, way = (now - last) * speed * faster, math.dist(place, target)
        place = target if way <= step else tuple(a + (b - a) * step / way for a, b in zip(place, target))
    last = now
    pose = PoseStamped.of()
    pose.header.frame_id = "site"
    pose.pose.position.x, pose.pose.position.y = place
    pose.pose.orientation.w = 1.0
    poses.write(pose)
    if target == place:
        if done:
            commands.write(done)
        target = done = None
    time.sleep(0.03)
