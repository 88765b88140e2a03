"""A whole crossing in one program: a leader, a follower, and a radio between them that loses nothing.

Usage: crossing.py [LOG_FILE]
"""

from __future__ import annotations

import sys
from collections import deque

from crossguard import Endpoint, HelpRequest, Moment, TaskSet, TaskType, events, notices, outputs, reasons
from crossguard.types import ManeuverId

log = open(sys.argv[1], "w") if len(sys.argv) > 1 else None  # noqa: SIM115


def moment(ms: int) -> Moment:
    return Moment(ms, 1_795_305_600_000 + ms)


# Their boot counters are counted up, and on the disk before anything else: see `crossguard.Boot`.
robots = [Endpoint(i + 1, 1, name=name, at=moment(0), log=log) for i, name in enumerate(["ARI", "Go2"])]
queue: deque[tuple[int, events.Event | bytes]] = deque()  # who it is for, and what happens then
under_way: list[ManeuverId] = []
ended: list[reasons.EndReason] = []


def carry_out(who: int, effects: list[outputs.Effect]) -> None:
    for effect in effects:
        match effect:
            case outputs.Send(packet=packet):
                queue.append((1 - who, packet))
            case outputs.StartManeuver(maneuver):
                under_way.append(maneuver.id)  # the body goes
            case outputs.CorridorOpened():  # people cross, and then their escort is done
                queue.append((1, events.ManeuverCompleted(under_way.pop())))
            case outputs.Notify(notices.FollowerJoined(station)):
                queue.append((0, events.CommandManeuver(station, TaskType.MOVE)))
            case outputs.Notify(notices.ManeuverReported()):
                queue.append((0, events.OpenCorridor()))
            case outputs.Notify(notices.ManeuverCompleted()):
                queue.append((0, events.TaskCompleted()))  # only when nobody is on the road any more
            case outputs.Notify(notices.SessionEnded(_, why)):
                ended.append(why)


queue.append((0, events.PedestrianDetected(HelpRequest(followers=1, tasks=TaskSet.MOVE))))
for at in map(moment, range(0, 5_000, 20)):
    for who, robot in enumerate(robots):  # time first, then what happened in it
        carry_out(who, robot.elapse(at))
    while queue:
        who, what = queue.popleft()
        robot = robots[who]
        carry_out(who, robot.receive(what, at) if isinstance(what, bytes) else robot.tell(what, at))
for robot in robots:
    robot.stop(moment(5_000))
assert ended == [reasons.TaskCompleted()], ended
