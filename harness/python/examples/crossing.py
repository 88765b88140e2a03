"""One robot of a crossing, in Python: what protocol/c/examples/crossing.cpp does.

Usage: crossing.py leader|follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]

It talks UDP on 127.0.0.1 with a peer that may be `crossguard run`. It ends with 0 when the crossing was
completed, with 1 when it was not, with 2 on wrong usage.
"""

from __future__ import annotations

import contextlib
import select
import socket
import sys
from collections import deque
from collections.abc import Callable

from crossguard import (
    Boot,
    BootError,
    Endpoint,
    HelpRequest,
    Measurement,
    Moment,
    Position,
    RobotState,
    State,
    TaskParameters,
    TaskSet,
    TaskType,
    events,
    notices,
    outputs,
    phases,
    reasons,
)
from crossguard.body import RobotCategory, ToPosition
from crossguard.types import Maneuver

MANEUVER_MS = 1_500
PATIENCE_MS = 60_000
# How often the application looks what there is to do.
PERIOD_MS = 20


class Application:
    """A robot with a simulated body, whose maneuvers take a while and always work."""

    category = RobotCategory.UNKNOWN

    def __init__(self, endpoint: Endpoint, send: Callable[[bytes], object], began_ms: int) -> None:
        self.endpoint = endpoint
        self.send = send
        self.began_ms = began_ms
        self.is_over = False
        self.is_completed = False
        self.is_corridor_open = False
        self.maneuver: Maneuver | None = None
        self.done_at_ms = 0
        # What is to be told, in this order.
        self.wishes: deque[tuple[events.Event, TaskParameters | None]] = deque()

    def receive(self, packet: bytes, at: Moment) -> None:
        """A packet came in."""
        self._carry_out(self.endpoint.receive(packet, at), at)
        self._fulfil(at)

    def advance(self, at: Moment) -> None:
        """Time has passed."""
        self._carry_out(self.endpoint.elapse(at), at)
        if self.maneuver is not None and at.now_ms >= self.done_at_ms:
            self.wish(events.ManeuverCompleted(self.maneuver.id))
            self.maneuver = None
        self.live(at)
        self._fulfil(at)

    def wish(self, event: events.Event, parameters: TaskParameters | None = None) -> None:
        """The application wants to tell an event."""
        self.wishes.append((event, parameters))

    def live(self, at: Moment) -> None:
        """What the application does by the clock."""

    def hear(self, notice: notices.Notice, at: Moment) -> None:
        """What the application makes of the news."""

    @property
    def is_at_rest(self) -> bool:
        """Whether its part is over, farewells included."""
        robot = self.endpoint.robot
        is_free = isinstance(robot.identity, phases.Unlocked)
        return self.is_over and robot.state is State.IDLE and is_free

    def _fulfil(self, at: Moment) -> None:
        while self.wishes:
            event, parameters = self.wishes.popleft()
            self._carry_out(self.endpoint.tell(event, at, parameters), at)

    def _carry_out(self, effects: list[outputs.Effect], at: Moment) -> None:
        for effect in effects:
            match effect:
                case outputs.Send(packet=packet):
                    self.send(packet)
                case outputs.StartManeuver(maneuver):
                    self.maneuver = maneuver
                    self.done_at_ms = at.now_ms + MANEUVER_MS
                    self.say(f"starts {maneuver.task.name} of request {maneuver.id.request}")
                case outputs.StopManeuver() | outputs.FallBack():
                    self.maneuver = None
                case outputs.CorridorOpened():
                    self.is_corridor_open = True
                    self.say("corridor open")
                case outputs.CorridorClosed(why):
                    self.is_corridor_open = False
                    self.say(f"corridor closed: {why}")
                case outputs.Dropped(cause):
                    self.say(f"dropped, {cause}")
                case outputs.Notify(notice):
                    self.hear(notice, at)

    def say(self, what: str) -> None:
        """Tells people."""
        print(what, flush=True)


class Follower(Application):
    """Helps, and does what it is told."""

    category = RobotCategory.QUADRUPED
    completed = 0

    def hear(self, notice: notices.Notice, at: Moment) -> None:
        if isinstance(notice, notices.Released):
            self.is_over = True
            self.is_completed = isinstance(notice.why, reasons.SessionEnded) and self.completed == 2

    def wish(self, event: events.Event, parameters: TaskParameters | None = None) -> None:
        super().wish(event, parameters)
        self.completed += isinstance(event, events.ManeuverCompleted)


class Leader(Application):
    """Sees a pedestrian, asks for help, and has a follower escort the pedestrian across."""

    category = RobotCategory.HUMANOID

    def __init__(self, endpoint: Endpoint, send: Callable[[bytes], object], began_ms: int) -> None:
        super().__init__(endpoint, send, began_ms)
        self.stage = "waits"
        self.asked_ms = 0
        self.corridor_was_open = False

    def live(self, at: Moment) -> None:
        if self.stage == "waits" and at.now_ms - self.began_ms > 300:
            self.stage = "asks"
            request = HelpRequest(followers=1, tasks=TaskSet.INITIAL_POS | TaskSet.MOVE)
            self.wish(events.PedestrianDetected(request))
        if self.is_corridor_open:
            self.corridor_was_open = True
        elif self.stage == "escorts" and not self.is_over and at.now_ms - self.asked_ms > 200:
            self.open_corridor(at)

    def hear(self, notice: notices.Notice, at: Moment) -> None:
        match notice:
            case notices.FollowerJoined(station):
                self.stage = "positions"
                self.command(station, TaskType.INITIAL_POS, latitude_deg=49.010091)
            case notices.ManeuverReported() if self.stage == "escorts":
                self.open_corridor(at)
            case notices.ManeuverCompleted(station) if self.stage == "positions":
                self.stage = "escorts"
                self.command(station, TaskType.MOVE, latitude_deg=49.010172)
            case notices.ManeuverCompleted():
                self.stage = "done"
                self.wish(events.TaskCompleted())
            case notices.SessionEnded(_, why):
                self.is_over = True
                self.is_completed = isinstance(why, reasons.TaskCompleted) and self.corridor_was_open

    def command(self, follower: int, task: TaskType, latitude_deg: float) -> None:
        """Commands the follower to a place."""
        target = ToPosition(latitude_deg, 8.4124137)
        parameters = TaskParameters(target=target, maximum_speed_mps=1.4)
        self.wish(events.CommandManeuver(follower, task), parameters)

    def open_corridor(self, at: Moment) -> None:
        """Asks to let the pedestrian cross; each refusal has a reason, and it may be asked again."""
        self.asked_ms = at.now_ms
        self.wish(events.OpenCorridor())


def at_the_kerb(category: RobotCategory) -> RobotState:
    """The body of a robot that stands at the crossing."""
    place = Position(latitude_deg=49.0101, longitude_deg=8.4124)
    return RobotState(position=place, speed_mps=Measurement(0.0), category=category)


def run(application: Application, link: socket.socket) -> bool:
    """Drives the application by the clock and the socket. Whether the crossing was completed."""
    while not application.is_at_rest and Moment.now().now_ms - application.began_ms < PATIENCE_MS:
        now_ms = Moment.now().now_ms
        due_ms = max(0, min(application.endpoint.next_wakeup_ms - now_ms, PERIOD_MS))
        readable, _, _ = select.select([link], [], [], due_ms / 1_000)
        if readable:
            # A peer that is not there yet is no reason to stop.
            with contextlib.suppress(ConnectionError):
                application.receive(link.recv(2_048), Moment.now())
        application.advance(Moment.now())
    application.endpoint.stop(Moment.now())
    return application.is_completed


def main(arguments: list[str]) -> int:
    """A robot, by the arguments of the command line."""
    roles = {"leader": Leader, "follower": Follower}
    if len(arguments) not in (5, 6) or arguments[0] not in roles:
        print(__doc__, file=sys.stderr)
        return 2
    role = roles[arguments[0]]
    station, port, peer = (int(number) for number in arguments[1:4])
    with contextlib.ExitStack() as stack:
        try:
            boot = stack.enter_context(Boot.take(arguments[4]))
        except BootError as error:
            print(error, file=sys.stderr)
            return 2
        link = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        link.bind(("127.0.0.1", port))

        def send(packet: bytes) -> None:
            # A packet that the link does not take is as lost as one on the air.
            with contextlib.suppress(OSError):
                link.sendto(packet, ("127.0.0.1", peer))

        log = stack.enter_context(open(arguments[5], "w")) if len(arguments) == 6 else None
        began = Moment.now()
        endpoint = Endpoint(
            station,
            boot.counter,
            name=f"Py{station}",
            at=began,
            body=at_the_kerb(role.category),
            log=log,
        )
        completed = run(role(endpoint, send, began.now_ms), link)
    print("crossing completed" if completed else "crossing not completed")
    return 0 if completed else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
