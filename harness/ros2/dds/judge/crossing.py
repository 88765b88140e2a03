"""Judges the node on DDS: crossing.py CROSSGUARD_DDS CROSSGUARD. An independent DDS reader sees what a ROS 2 system would;
the other robot of each crossing is `crossguard run`."""
import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from cyclonedds.builtin import BuiltinDataReader, BuiltinTopicDcpsPublication, BuiltinTopicDcpsSubscription
from cyclonedds.qos import Policy, Qos
from cyclonedds.util import duration
from ros import (ALL, DEFAULT, PATIENCE, Command, Corridor, DiagnosticArray, Event, PoseStamped, Ros, Session, Status, Task,
                 matched)

NODE, CROSSGUARD = (str(Path(it).resolve()) for it in sys.argv[1:3])
DOMAIN = 40 + os.getpid() % 60
BODY = Path(__file__).with_name("body.py")
ORIGIN = ["49.0101", "8.4124"]


def free_ports():
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
    for it in sockets:
        it.bind(("127.0.0.1", 0))
    ports = [it.getsockname()[1] for it in sockets]
    for it in sockets:
        it.close()
    return ports


def until(what, holds):
    deadline = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.01)


class Street:
    """A node on DDS and `crossguard run`, and what is heard of the node."""

    def __init__(self, stack, leads, faster=10.0):
        self.folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        self.stack, self.space = stack, "/ari" if leads else "/go2"
        self.node_log, self.robot_log = self.folder / "node.log", self.folder / "robot.log"
        own, other = free_ports()
        self.ros = Ros(DOMAIN)
        topic = f"{self.space}/crossguard"
        self.corridor = self.ros.hear(Corridor, f"{topic}/corridor")
        self.status = self.ros.hear(Status, f"{topic}/status")
        self.events = self.ros.hear(Event, f"{topic}/event")
        self.diagnostics = self.ros.hear(DiagnosticArray, "/diagnostics")
        self.commands = self.ros.publisher(Command, f"{topic}/command")
        self.poses = self.ros.publisher(PoseStamped, f"{topic}/pose")
        names = ["ARI", "Go2"] if leads else ["Go2", "ARI"]
        stations = [1, 2] if leads else [2, 1]
        self.node = self.start(
            NODE, "--station", stations[0], "--name", names[0], "--boot-file", self.folder / "boot", "--link",
            f"127.0.0.1:{own}", "--peer", f"127.0.0.1:{other}", "--origin", *ORIGIN, "--namespace", self.space,
            "--domain", DOMAIN, "--log", self.node_log, "--build", "humanoid" if leads else "quadruped")
        config = self.folder / "robot.toml"
        build = "quadruped" if leads else "humanoid"
        config.write_text(
            f'name = "{names[1]}"\nstation = {stations[1]}\nbuild = "{build}"\nboot_file = "robot.boot"\n'
            f'speed = {4.0 * faster}\nautopilot = true\n\n[link]\naddress = "127.0.0.1:{other}"\n'
            f'peers = ["127.0.0.1:{own}"]\n')
        self.robot = self.start(
            CROSSGUARD, "run", "--config", config, "--log", self.robot_log, stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL)
        matched(self.commands)
        self.status.until("no body", lambda it: it.availability == Status.LOCAL_FAULT)
        self.body = self.walk(0.0 if leads else 1.0, -1.5 if leads else -1.11, faster)
        self.status.until("its body", lambda it: it.availability == Status.AVAILABLE)

    def start(self, *command, **more):
        process = subprocess.Popen([str(it) for it in command], **more)
        self.stack.callback(lambda: (process.kill(), process.wait()))
        return process

    def walk(self, east, north, faster):
        return self.start(sys.executable, BODY, DOMAIN, self.space, east, north, faster)

    def type(self, line):
        self.robot.stdin.write(line.encode())
        self.robot.stdin.flush()

    def robot_says(self, what, since=0):
        """Waits until the other robot's log has this; how long the log is then."""
        until(what, lambda: what in self.robot_log.read_text()[since:])
        return len(self.robot_log.read_text())

    def command(self, kind, **fields):
        self.commands.write(Command.of(kind=kind, **fields))

    def order(self, task, x, y):
        command = Command.of(kind=Command.ORDER, follower=2, task=Task(type=task), has_target=True, maximum_speed=1.4)
        command.target.x, command.target.y = x, y
        self.commands.write(command)

    def open_corridor(self):
        """Asks again, as an application does, until it is open."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            self.command(Command.OPEN_CORRIDOR)
            with contextlib.suppress(AssertionError):
                return self.corridor_within(0.3)
        raise AssertionError("the corridor does not open")

    def corridor_within(self, seconds):
        came, deadline = [], time.monotonic() + seconds
        while time.monotonic() < deadline:
            came += self.corridor.new()
            if came and came[-1].open:
                return came[-1]
            time.sleep(0.005)
        raise AssertionError

    def lead_to_the_road(self):
        """Asks for help, and has the follower walk with the corridor open."""
        self.command(Command.DETECT, followers=1, urgency=Command.URGENCY_MEDIUM)
        joined = self.events.until("a follower", lambda it: it.kind == Event.FOLLOWER_JOINED)
        assert joined[-1].station == 2, joined
        self.order(Task.INITIAL_POS, 1.0, -1.0)
        self.events.until("it in place", lambda it: it.kind == Event.MANEUVER_COMPLETED)
        self.order(Task.MOVE, 1.0, 8.0)
        self.events.until("it on its way", lambda it: it.kind == Event.MANEUVER_REPORTED)
        return self.open_corridor()

    def end(self, code=0):
        """Both end in order, and their logs are what the protocol allows."""
        self.node.send_signal(signal.SIGTERM)
        came = self.corridor.until("no robot", lambda it: it.reason == Corridor.REASON_INACTIVE)
        assert not came[-1].open
        assert self.node.wait(PATIENCE) == code, self.node.returncode
        self.type("quit\n")
        assert self.robot.wait(PATIENCE) == 0
        subprocess.run([CROSSGUARD, "validate", self.node_log, self.robot_log], check=True, stdout=subprocess.DEVNULL)


def a_follower_on_dds_helps_a_pedestrian_across(stack):
    street = Street(stack, leads=False)
    street.type("wait 1.5\ndetect\n")
    street.robot_says("taskCompleted")
    told = street.events.until("its release", lambda it: it.kind == Event.RELEASED)
    starts = [it for it in told if it.kind == Event.START_MANEUVER]
    assert [it.task.type for it in starts] == [Task.INITIAL_POS, Task.MOVE], told
    for start, (x, y) in zip(starts, [(1.0, -1.0), (1.0, 8.0)]):
        assert start.has_target and abs(start.target.x - x) < 0.05 and abs(start.target.y - y) < 0.05, start
        assert start.session.leader == start.station == 1 and start.header.frame_id == "site", start
        assert abs(start.header.stamp.sec - time.time()) < PATIENCE, start
        # The numbers are those of the log.
        assert f'"request":{start.request}' in street.node_log.read_text().replace(" ", ""), start
    status = street.status.until("the escort", lambda it: it.executes.type == Task.MOVE)
    assert status[-1].role == Status.ROLE_FOLLOWER and status[-1].in_session, status[-1]
    status += street.status.until("the end", lambda it: it.state == Status.STATE_IDLE and not it.in_session)
    assert {(it.station, it.boot, it.robot) for it in status} == {(2, 1, "Go2")}
    street.end()


def a_leader_on_dds_is_commanded_by_its_application(stack):
    street = Street(stack, leads=True)
    is_open = street.lead_to_the_road()
    assert 0 < is_open.valid_for.nanosec <= 300_000_000 and is_open.valid_for.sec == 0, is_open
    assert is_open.road_occupied and is_open.in_session and is_open.session.leader == 1, is_open
    assert is_open.reason == Corridor.REASON_NONE and is_open.station == 1
    closed = street.corridor.until("a closed corridor", lambda it: not it.open)[-1]
    assert (closed.reason, closed.follower) == (Corridor.REASON_NOT_ENGAGED, 2), closed
    assert closed.road_occupied, closed
    street.events.until("the crossing", lambda it: it.kind == Event.MANEUVER_COMPLETED)
    street.command(Command.TASK_COMPLETED)
    street.events.until("the end", lambda it: it.kind == Event.SESSION_ENDED)
    street.status.until("idle", lambda it: it.state == Status.STATE_IDLE)
    clear = street.corridor.until("a clear road", lambda it: not it.road_occupied)[-1]
    assert clear.reason == Corridor.REASON_NOT_LEADING
    text = street.robot_log.read_text()
    assert '"taskCompleted"' in text
    street.end()


def lose_the_body_of_a_follower(stack, how):
    street = Street(stack, leads=False, faster=1.5)
    street.type("wait 1.5\ndetect\n")
    opened = street.robot_says('"corridorOpened"')
    street.body.send_signal(how)
    street.status.until("an emergency stop", lambda it: it.availability == Status.EMERGENCY_STOP)
    street.robot_says('"corridorClosed"', opened)
    street.robot_says("sessionEnded", opened)
    street.diagnostics.until("the count", lambda it: counted(it, "body: silent") == 1)
    if how == signal.SIGKILL:
        # Whatever anybody says.
        street.command(Command.SET_AVAILABILITY, availability=Status.AVAILABLE)
        word = '"availabilityChanged":"available"'  # the first was said when the body came
        until("its word", lambda: street.node_log.read_text().replace(" ", "").count(word) == 2)
        street.status.until("the stop again", lambda it: it.availability == Status.EMERGENCY_STOP)
        street.body = street.walk(1.0, 3.0, 10.0)
    else:
        street.body.send_signal(signal.SIGCONT)
    # The body is heard, and the stop stands until a person says otherwise.
    walk = street.ros.hear(PoseStamped, "/go2/crossguard/pose")
    walk.until("poses", lambda it: True)
    street.status.messages = []
    street.status.new()
    # Of the next two seconds.
    later = [street.status.until("a status", lambda it: True)[-1].availability for _ in range(3)]
    assert set(later) == {Status.EMERGENCY_STOP}, later
    street.command(Command.SET_AVAILABILITY, availability=Status.AVAILABLE)
    street.status.until("available", lambda it: it.availability == Status.AVAILABLE)
    time.sleep(1.0)  # longer than a silence: a stop would come again by now
    assert {it.availability for it in street.status.new()} <= {Status.AVAILABLE}
    street.command(Command.ROAD_CLEAR)
    street.end()


def a_body_that_is_killed_is_an_emergency_stop(stack):
    lose_the_body_of_a_follower(stack, signal.SIGKILL)


def a_body_that_hangs_is_an_emergency_stop(stack):
    lose_the_body_of_a_follower(stack, signal.SIGSTOP)


def the_corridor_closes_when_the_leaders_application_is_killed(stack):
    street = Street(stack, leads=True, faster=1.5)
    street.lead_to_the_road()
    street.body.kill()
    closed = street.corridor.until("a closed corridor", lambda it: not it.open)[-1]
    assert closed.road_occupied, closed
    street.status.until("an emergency stop", lambda it: it.availability == Status.EMERGENCY_STOP)
    street.events.until("the end", lambda it: it.kind == Event.SESSION_ENDED)
    status = street.status.until("its duty", lambda it: it.duty == Status.DUTY_CROSSING)
    assert status[-1].state == Status.STATE_IDLE
    street.command(Command.ROAD_CLEAR)
    street.status.until("its end", lambda it: it.duty == Status.DUTY_NONE)
    street.end()


def a_node_that_was_held_says_nothing_old(stack):
    street = Street(stack, leads=True, faster=0.25)
    street.lead_to_the_road()
    street.node.send_signal(signal.SIGSTOP)
    time.sleep(0.5)
    street.corridor.messages = []
    street.corridor.new()
    time.sleep(2.5)  # longer than every lease
    assert not street.corridor.new(), "a process that is held speaks"
    street.node.send_signal(signal.SIGCONT)
    first = street.corridor.until("anything", lambda it: True)[-1]
    assert not first.open and first.road_occupied, first
    street.command(Command.ROAD_CLEAR)
    street.end()


def a_body_stands_when_the_node_is_killed(stack):
    street = Street(stack, leads=False, faster=0.25)
    street.type("wait 1.5\ndetect\n")
    street.events.until("its way", lambda it: it.kind == Event.START_MANEUVER)
    poses = street.ros.hear(PoseStamped, "/go2/crossguard/pose")
    walk = poses.until("a pose", lambda it: True)
    poses.until("a step", lambda it: it.pose.position != walk[-1].pose.position)
    street.node.kill()
    last = []

    def stands():
        last.extend(it.pose.position for it in poses.new())
        # Nine poses in a row: a quarter of a second.
        return len(last) > 9 and all(it == last[-1] for it in last[-9:])

    until("the body to stand", stands)
    # It stopped on its way.
    assert abs(last[-1].y - 8.0) > 1.0, last[-1]


def is_heard(street, commands):
    """Whether the node hears this writer already: it matches later than the writer does."""
    commands.write(Command.of(kind=98))
    time.sleep(0.1)
    return any("kind 98" in it.text for it in street.events.new())


def counted(diagnostics, cause):
    for status in diagnostics.status:
        for it in status.values:
            if it.key == cause:
                return int(it.value)
    return 0


def what_is_wrong_is_refused_in_words_and_counted(stack):
    street = Street(stack, leads=False)
    session, nan = Session.of(), float("nan")
    wrong = [
        (Command.of(kind=99), "kind 99 is no command"),
        (Command.of(kind=Command.DETECT, followers=0), "0 followers: 1 to 16 are possible"),
        (Command.of(kind=Command.DETECT, followers=1, urgency=7), "urgency 7"),
        (Command.of(kind=Command.DETECT, followers=1, tasks=[Task(type=200)]), "task 200"),
        (Command.of(kind=Command.ORDER, follower=2, maximum_speed=nan), "maximum_speed"),
        (Command.of(kind=Command.ORDER, follower=2, map_place="road 3"), "map_place is 'road 3'"),
        (Command.of(kind=Command.SET_AVAILABILITY, availability=9), "availability 9"),
        (Command.of(kind=Command.SHOW, to_pedestrians=Command.SIGNAL_GO), "go is not shown"),
        (Command.of(kind=Command.SHOW, to_vehicles=9), "signal 9"),
        (Command.of(kind=Command.JOB, job_role=7), "job_role 7"),
        (Command.of(kind=Command.SERVE, map_place="road 3"), "map_place is 'road 3'"),
    ]
    far = Command.of(kind=Command.ORDER, follower=2, has_target=True)
    far.target.x = nan
    wrong.append((far, "target is no place"))
    for command, text in wrong:
        street.commands.write(command)
        came = street.events.until(text, lambda it: it.kind == Event.COMMAND_REFUSED)[-1]
        assert text in came.text, came
    # None of many in one breath is lost, as when a team is ordered about.
    many = street.ros.publisher(Command, "/go2/crossguard/command", ALL)
    matched(many)
    until("the node's match", lambda: is_heard(street, many))
    for kind in range(100, 140):
        many.write(Command.of(kind=kind))
    missing = {f"kind {kind} is no command" for kind in range(100, 140)}
    until("all", lambda: missing.difference_update(it.text for it in street.events.new()) or not missing)
    # What changes nothing is said, too.
    street.diagnostics.until("counts", lambda it: counted(it, "ros: impossible command") >= len(wrong) + 40)
    street.commands.write(Command.of(kind=Command.DONE, session=session, request=3))
    street.events.until("a reason", lambda it: it.kind == Event.COMMAND_IGNORED and "reason" in it.text)
    # A second body, while there is one; here it is this process, which hears events.
    pose = PoseStamped.of()
    pose.pose.orientation.w = 1.0
    street.poses.write(pose)
    street.diagnostics.until("another body", lambda it: counted(it, "ros: other body") == 1)
    street.body.kill()
    street.status.until("an emergency stop", lambda it: it.availability == Status.EMERGENCY_STOP)
    for field, value in [("frame", "map"), ("w", 0.0), ("w", nan), ("x", 1e9)]:
        pose = PoseStamped.of()
        pose.pose.orientation.w = 1.0 if field != "w" else value
        pose.pose.position.x = value if field == "x" else 0.0
        pose.header.frame_id = value if field == "frame" else "site"
        street.poses.write(pose)
    # One that does not hear what it is told to do is no body.
    deaf = Ros(DOMAIN)
    poses = matched(deaf.publisher(PoseStamped, f"{street.space}/crossguard/pose"))
    came = street.diagnostics.until("impossible poses", lambda it: counted(it, "ros: impossible pose") == 4)
    assert came[-1].status[0].hardware_id == "Go2" and came[-1].status[0].name == "/go2/crossguard: robot"
    pose = PoseStamped.of()
    pose.pose.orientation.w = 1.0

    def is_noticed():
        poses.write(pose)
        return any(counted(it, "ros: body hears no events") for it in street.diagnostics.new())

    until("a deaf body", is_noticed)
    assert {it.availability for it in street.status.new()} == {Status.EMERGENCY_STOP}
    # A reader that wants corridors more often than they are promised hears none; one that wants them as often does.
    often = Qos(Policy.Deadline(duration(milliseconds=300)), base=DEFAULT)
    promised = street.ros.hear(Corridor, "/go2/crossguard/corridor", often)
    promised.until("a corridor", lambda it: not it.open)
    street.end()


def names_types_and_qualities_are_those_of_ros(stack):
    street = Street(stack, leads=False)
    topic, msgs = "rt/go2/crossguard", "crossguard_msgs::msg::dds_"
    wanted = {
        f"{topic}/corridor": (f"{msgs}::Corridor_", 300), f"{topic}/status": (f"{msgs}::Status_", 2000),
        f"{topic}/event": (f"{msgs}::Event_", None), "rt/diagnostics": ("diagnostic_msgs::msg::dds_::DiagnosticArray_", None)}
    heard = {f"{topic}/command": f"{msgs}::Command_", f"{topic}/pose": "geometry_msgs::msg::dds_::PoseStamped_"}
    own = street.ros.participant.guid
    writers = BuiltinDataReader(street.ros.participant, BuiltinTopicDcpsPublication)
    readers = BuiltinDataReader(street.ros.participant, BuiltinTopicDcpsSubscription)
    found, hears = {}, {}

    def look():
        for it in writers.take(200):
            if it.participant_key != own and it.topic_name in wanted:
                found[it.topic_name] = it
        for it in readers.take(200):
            if it.participant_key != own and it.topic_name in heard:
                hears[it.topic_name] = it.type_name
        return len(found) == len(wanted) and len(hears) == len(heard)

    until("its endpoints", look)
    assert hears == heard, hears
    for name, (kind, deadline) in wanted.items():
        it = found[name]
        assert it.type_name == kind, it.type_name
        assert isinstance(it.qos[Policy.Reliability], Policy.Reliability.Reliable), name
        assert it.qos[Policy.Durability] == Policy.Durability.Volatile, name
        offered = it.qos[Policy.Deadline]
        is_promised = offered is not None and offered.deadline == duration(milliseconds=deadline) if deadline else True
        assert is_promised, (name, offered)
    street.end()


def options_that_are_wrong_are_refused_in_words(stack):
    good = {"--station": "1", "--name": "ARI", "--boot-file": "none/boot", "--link": f"127.0.0.1:{free_ports()[0]}", "--peer": "127.0.0.1:9"}
    for option, value, text in [
        ("--station", "0", "a number from 1 to"), ("--station", "x", "a number"), ("--peer", "nobody", "IPv4"),
        ("--namespace", "go2", "a name of ROS 2"), ("--node", "a/b", "a name of ROS 2"), ("--build", "fish", "no such"),
        ("--silence-ms", "5", "200 to 5000"), ("--domain", "999", "0 to 232"), ("--mystery", "1", "no such option"),
        ("--name", "", "are wanted"), ("--link", "127.0.0.1:0", "IPv4"), ("--build", "other", "no boot counter"),
    ]:
        said = [word for pair in {**good, option: value}.items() for word in pair]
        done = subprocess.run([NODE, *said, "--origin", *ORIGIN], capture_output=True, text=True, timeout=PATIENCE)
        assert done.returncode == 2 and text in done.stderr, (option, value, done)


def main():
    tests = [
        options_that_are_wrong_are_refused_in_words,
        names_types_and_qualities_are_those_of_ros,
        a_follower_on_dds_helps_a_pedestrian_across,
        a_leader_on_dds_is_commanded_by_its_application,
        a_body_that_is_killed_is_an_emergency_stop,
        a_body_that_hangs_is_an_emergency_stop,
        the_corridor_closes_when_the_leaders_application_is_killed,
        a_node_that_was_held_says_nothing_old,
        a_body_stands_when_the_node_is_killed,
        what_is_wrong_is_refused_in_words_and_counted,
    ]
    wanted = sys.argv[3:]
    for test in tests:
        if wanted and test.__name__ not in wanted:
            continue
        began = time.monotonic()
        with contextlib.ExitStack() as stack:
            test(stack)
        print(f"{test.__name__}: ok, {time.monotonic() - began:.1f} s", flush=True)


if __name__ == "__main__":
    main()
