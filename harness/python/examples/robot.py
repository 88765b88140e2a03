"""One robot of a crossing, in Python: what harness/c/examples/robot.c does.

Usage: robot.py leader|follower STATION PORT PEER_PORT BOOT_FILE [LOG_FILE]

Four things in it keep people alive; when you copy it, keep them and put your own robot behind them:

1. The sign ends go by itself, also when this program hangs: `Sign`.
2. `InPosition` is told when the body is there, and not before: `Application.move_body`.
3. `RoadClear` is told when the fallback is finished and the road was seen to be clear:
   `Application.finish_duty`.
4. `TaskCompleted` is told when nobody is on the road any more: `Leader.live`.

It is an example of the protocol alone, and no robot for a road. It leaves these rules of
protocol/doc/integration.md to you: it asks `OpenCorridor` without a look at vehicles (27) and at the places
of its guards (28); its body has no sensors (24), waits for no vehicle (27) and as escort for nobody (29),
and does not look before it leaves the road after a boot (30).

It talks UDP on 127.0.0.1 with a peer that may be `crossguard run`. It ends with 0 when the crossing was
completed, with 1 when it was not, with 2 on wrong usage.
"""

from __future__ import annotations

import contextlib
import enum
import select
import signal
import socket
import subprocess
import sys
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

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
from crossguard.body import RobotCategory, Target, ToPosition
from crossguard.types import Maneuver

MANEUVER_MS = 1_500
# Longer than people of harness/examples/ari.toml are on the road: an escort stays until they are off it.
ESCORT_MS = 8_000
PATIENCE_MS = 60_000
# How often the application looks what there is to do.
PERIOD_MS = 20


# The program of a sign. What it reads is until when it may show go, on the clock of `time.monotonic`.
SIGN = """
import os, select, time
until_ms, shows_go, rest = 0, False, b""
def say(sign):
    os.write(1, f"sign shows {sign}\\n".encode())
while True:
    left_ms = until_ms - time.monotonic_ns() // 1_000_000
    if (left_ms > 0) is not shows_go:
        shows_go = left_ms > 0
        say("go" if shows_go else "stop")
    if select.select([0], [], [], left_ms / 1_000 if shows_go else None)[0]:
        octets = os.read(0, 4096)
        if not octets:
            break
        *orders, rest = (rest + octets).split(b"\\n")
        until_ms = int(orders[-1]) if orders else until_ms
if shows_go:
    say("stop")
"""


class ShowsGo(Protocol):
    """What a sign takes."""

    def go_until(self, until_ms: int) -> None:
        """Show go until this moment of `Moment.now_ms`, and then stop by itself. 0 is stop, at once."""


class Sign:
    """The sign. It is a process of its own, as it is a device of its own on your robot, because it ends go by
    itself: when its time is over, and when the program that renews it hangs or is gone. What it is told is
    the moment until which it may show go, so an order that comes late makes nothing longer."""

    def __init__(self) -> None:
        self._process = subprocess.Popen([sys.executable, "-c", SIGN], stdin=subprocess.PIPE, text=True)

    def go_until(self, until_ms: int) -> None:
        # A sign that does not take the order shows stop when its time is over.
        orders = self._process.stdin
        assert orders is not None
        with contextlib.suppress(BrokenPipeError):
            print(until_ms, file=orders, flush=True)

    def close(self) -> None:
        """Ends it, showing stop."""
        self._process.communicate()


class NoSign:
    """The sign of a robot that nobody looks at."""

    def go_until(self, until_ms: int) -> None:
        """There is nothing to be seen."""


class Doing(enum.Enum):
    """What the simulated body does."""

    STANDS = enum.auto()
    UNDER_WAY = enum.auto()
    HOLDS_PLACE = enum.auto()
    FALLS_BACK = enum.auto()


class Application:
    """A robot with a simulated body, whose maneuvers take a while and always work."""

    category = RobotCategory.UNKNOWN

    def __init__(
        self,
        endpoint: Endpoint,
        send: Callable[[bytes], object],
        began_ms: int,
        sign: ShowsGo | None = None,
        boot: Boot | None = None,
    ) -> None:
        self.endpoint = endpoint
        self.send = send
        self.began_ms = began_ms
        self.sign: ShowsGo = NoSign() if sign is None else sign
        self.boot = boot
        self.is_over = False
        self.is_completed = False
        self.is_corridor_open = False
        self.doing = Doing.STANDS
        self.maneuver: Maneuver | None = None
        self.target: Target | None = None
        self.arrives_ms = 0
        self.road_was_seen_clear = False
        # What is to be told, in this order.
        self.wishes: deque[tuple[events.Event, TaskParameters | None]] = deque()

    def receive(self, packet: bytes, at: Moment) -> None:
        """A packet came in."""
        self._carry_out(self.endpoint.receive(packet, at), at)
        self._fulfil(at)

    def advance(self, at: Moment) -> None:
        """Time has passed."""
        self._carry_out(self.endpoint.elapse(at), at)
        self.move_body(at)
        self.finish_duty(at)
        self.live(at)
        self._fulfil(at)

    def wish(self, event: events.Event, parameters: TaskParameters | None = None) -> None:
        """The application wants to tell an event."""
        self.wishes.append((event, parameters))

    def road_is_clear(self) -> bool:
        """STANDS FOR YOUR PERCEPTION: whether nobody is on the carriageway. It is to be seen; no clock and no
        message says it. Here an operator says it: kill -USR1. What was seen before the last go or the
        beginning of a fallback does not count."""
        return self.road_was_seen_clear

    def look_again(self) -> None:
        """Something has begun, so what was seen before does not count."""
        self.road_was_seen_clear = False

    def move_body(self, at: Moment) -> None:
        """The simulated body arrives. A guard that holds traffic says so and stays, until it is told to
        stop."""
        if self.maneuver is None or self.doing is not Doing.UNDER_WAY or at.now_ms < self.arrives_ms:
            return
        self.stand_where_sent()
        if self.maneuver.task is TaskType.BLOCK:
            self.doing = Doing.HOLDS_PLACE
            self.wish(events.InPosition(self.maneuver.id))
        else:
            self.doing = Doing.STANDS
            self.wish(events.ManeuverCompleted(self.maneuver.id))

    def stand_where_sent(self) -> None:
        """The next RAM says where the body is: a leader does not believe a follower that is elsewhere than it
        was sent."""
        match self.target:
            case ToPosition(latitude_deg, longitude_deg):
                place = Position(latitude_deg=latitude_deg, longitude_deg=longitude_deg)
                self.endpoint.body = replace(self.endpoint.body, position=place)

    def finish_duty(self, at: Moment) -> None:
        """`RoadClear`, once the body has finished its fallback and the road is seen to be clear."""
        has_arrived = at.now_ms >= self.arrives_ms
        if self.doing is Doing.FALLS_BACK and has_arrived and self.road_is_clear():
            self.doing = Doing.STANDS
        if self.doing is Doing.STANDS and self.road_is_clear() and self.is_bound:
            self.wish(events.RoadClear())

    @property
    def is_bound(self) -> bool:
        """Whether this robot is responsible for somebody who may be on the road."""
        robot = self.endpoint.robot
        match robot.phase:
            case phases.Leading(corridor=phases.Corridor.CLEARING):
                return True
        return robot.duty is not None

    def live(self, at: Moment) -> None:
        """What the application does by the clock."""

    def hear(self, notice: notices.Notice, at: Moment) -> None:
        """What the application makes of the news."""

    @property
    def is_at_rest(self) -> bool:
        """Whether its part is over, farewells included."""
        robot = self.endpoint.robot
        is_free = isinstance(robot.identity, phases.Unlocked)
        return self.is_over and robot.state is State.IDLE and is_free and robot.duty is None

    def _fulfil(self, at: Moment) -> None:
        while self.wishes:
            event, parameters = self.wishes.popleft()
            self._carry_out(self.endpoint.tell(event, at, parameters), at)

    def _carry_out(self, effects: list[outputs.Effect], at: Moment) -> None:
        for effect in effects:
            match effect:
                case outputs.Send(packet=packet):
                    self.send(packet)
                case outputs.StartManeuver(maneuver, parameters):
                    self.maneuver = maneuver
                    self.target = parameters.target
                    self.doing = Doing.UNDER_WAY
                    is_escort = maneuver.task is TaskType.MOVE
                    self.arrives_ms = at.now_ms + (ESCORT_MS if is_escort else MANEUVER_MS)
                    self.say(f"starts {maneuver.task.name} of request {maneuver.id.request}")
                case outputs.StopManeuver():
                    self.doing = Doing.STANDS
                case outputs.FallBack(_, policy):
                    # It stays at its person's side to the kerb, or holds the traffic. Never just stop.
                    self.doing = Doing.FALLS_BACK
                    self.arrives_ms = at.now_ms + MANEUVER_MS
                    self.look_again()
                    self.say(f"falls back: {policy.name}")
                case outputs.CorridorOpened(open_ms):
                    self.is_corridor_open = True
                    self.look_again()
                    self.sign.go_until(at.now_ms + open_ms)
                    self.say("corridor open")
                case outputs.CorridorExtended(open_ms):
                    self.sign.go_until(at.now_ms + open_ms)
                case outputs.CorridorClosed(why):
                    self.is_corridor_open = False
                    self.sign.go_until(0)
                    self.say(f"corridor closed: {why}")
                case outputs.RenewEpoch():
                    self.renew_epoch()
                case outputs.Dropped(cause):
                    self.say(f"dropped, {cause}")
                case outputs.Notify(notice):
                    self.hear(notice, at)

    def renew_epoch(self) -> None:
        """A larger boot counter, on the disk before it is told. The disk may be slow: do it beside your
        loop."""
        if self.boot is not None:
            with contextlib.suppress(BootError):
                self.wish(events.EpochRenewed(self.boot.renew()))

    def say(self, what: str) -> None:
        """Tells people. A line is one write: the sign, a process of its own, writes to the same place."""
        print(f"{what}\n", end="", flush=True)


class Follower(Application):
    """Helps, and does what it is told."""

    category = RobotCategory.QUADRUPED

    def hear(self, notice: notices.Notice, at: Moment) -> None:
        if isinstance(notice, notices.Released):
            self.is_over = True
            self.is_completed = isinstance(notice.why, reasons.TaskCompleted)


class Leader(Application):
    """Sees a pedestrian, asks for help, and has a follower escort the pedestrian across."""

    category = RobotCategory.HUMANOID

    stage = "waits"
    asked_ms = 0
    corridor_was_open = False
    # The simulated pedestrian is across when its escort has arrived.
    is_across = False

    def road_is_clear(self) -> bool:
        return self.is_across or super().road_is_clear()

    def look_again(self) -> None:
        super().look_again()
        self.is_across = False

    def live(self, at: Moment) -> None:
        if self.stage == "waits" and at.now_ms - self.began_ms > 300:
            self.stage = "asks"
            request = HelpRequest(followers=1, tasks=TaskSet.INITIAL_POS | TaskSet.MOVE)
            self.wish(events.PedestrianDetected(request))
        elif self.stage == "arrived" and self.road_is_clear():
            self.stage = "done"
            self.wish(events.TaskCompleted())
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
                self.stage = "arrived"
                self.is_across = True
            case notices.ManeuverFailed() | notices.FollowerSafeIdle():
                # It gives up. If the corridor was open, its duty lasts until the road is seen to be clear.
                self.stage = "done"
                self.wish(events.LeaveRequested())
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
        sign = Sign()
        stack.callback(sign.close)

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
        application = role(endpoint, send, began.now_ms, sign, boot)

        def see_road_clear(*_: object) -> None:
            application.road_was_seen_clear = True

        signal.signal(signal.SIGUSR1, see_road_clear)
        completed = run(application, link)
    print("crossing completed" if completed else "crossing not completed")
    return 0 if completed else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
