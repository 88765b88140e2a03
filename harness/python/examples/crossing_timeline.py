"""A crossing in virtual time, and its timeline as a picture. For a notebook: each `# %%` begins a cell.

Usage: crossing_timeline.py [PICTURE]          writes crossing.svg if nothing is said

Two robots, whole with codec and packets, meet in one process over a radio that loses every eighth packet.
The application is the one of crossing.py. Nothing waits: six seconds take a moment.
"""

# %% The robots and a radio between them, with a clock of our own.
from __future__ import annotations

import io
import random
import sys
from dataclasses import dataclass, field
from functools import partial

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from crossguard import Endpoint, Moment, State, TaskType, decode, validate
from crossing import Application, Follower, Leader, at_the_kerb

# Any day: 2026-11-22.
BEGAN_UNIX_MS = 1_795_305_600_000
TICK_MS = 5
LOSS = 1 / 8
DELAY_MS = (5, 30)


@dataclass
class Packet:
    """A packet on its way."""

    sender: int
    sent_ms: int
    arrives_ms: int
    octets: bytes
    is_lost: bool


@dataclass
class Record:
    """What is drawn."""

    names: list[str]
    packets: list[Packet] = field(default_factory=list)
    # Of each robot, since when it has been in which state.
    states: list[list[tuple[int, State]]] = field(default_factory=list)
    # From when to when the corridor was open.
    corridor: list[tuple[int, int]] = field(default_factory=list)
    end_ms: int = 0


def moment(now_ms: int) -> Moment:
    """A moment of virtual time."""
    return Moment(now_ms, BEGAN_UNIX_MS + now_ms)


def cross(seed: int, log: io.StringIO) -> Record:
    """Lets two robots do a crossing. Both write to the same log."""
    chance = random.Random(seed)
    record = Record(names=["ARI (leads)", "Go2 (follows)"])
    robots: list[Application] = []
    now_ms = 0

    def radio(sender: int, octets: bytes) -> None:
        arrives_ms = now_ms + chance.randint(*DELAY_MS)
        is_lost = chance.random() < LOSS
        record.packets.append(Packet(sender, now_ms, arrives_ms, octets, is_lost))

    for i, (role, name) in enumerate([(Leader, "ARI"), (Follower, "Go2")]):
        body = at_the_kerb(role.category)
        endpoint = Endpoint(i + 1, 1, name=name, at=moment(0), body=body, log=log)
        robots.append(role(endpoint, partial(radio, i), 0))
        record.states.append([(0, State.IDLE)])

    leader = robots[0]
    while now_ms < 60_000 and not all(robot.is_at_rest for robot in robots):
        now_ms += TICK_MS
        arriving = [p for p in record.packets if now_ms - TICK_MS < p.arrives_ms <= now_ms and not p.is_lost]
        for packet in arriving:
            robots[1 - packet.sender].receive(packet.octets, moment(now_ms))
        for robot, states in zip(robots, record.states, strict=True):
            robot.advance(moment(now_ms))
            state = robot.endpoint.robot.state
            if state is not states[-1][1]:
                states.append((now_ms, state))
        was_open = bool(record.corridor) and record.corridor[-1][1] == now_ms - TICK_MS
        if leader.is_corridor_open:
            since_ms = record.corridor.pop()[0] if was_open else now_ms
            record.corridor.append((since_ms, now_ms))
    for robot in robots:
        robot.endpoint.stop(moment(now_ms))
        assert robot.is_completed, f"{robot.endpoint!r}, {robot.endpoint.counters}"
    record.end_ms = now_ms
    return record


# %% What a packet says, in a few words, by the codec.
TASKS = {TaskType.INITIAL_POS: "initialPos", TaskType.MOVE: "move"}


def words(octets: bytes) -> tuple[str, str]:
    """The name of the message, and what to write beside it; RAM come too often for that."""
    message = decode(octets)["message"]
    if "ram" in message:
        return "RAM", ""
    container = message["rmcm"]["rmcm"]["rmcmParameters"]["maneuverContainer"]
    if "leaderManeuverContainer" in container:
        (command,) = container["leaderManeuverContainer"]["commands"]
        return "RMCM", f"command {command['requestID']}: {TASKS[command['taskType']]}"
    return "RMCM", f"ack {container['followerManeuverContainer']['jobAdviceID']}"


# %% The picture.
COLOURS = {
    State.IDLE: "#d9d9d9",
    State.HELP_REQUESTED: "#f0b429",
    State.ROLE_ESTABLISHED: "#7fb2e5",
    State.MANEUVER_EXECUTING: "#2f6db5",
}
WORDS = {
    State.IDLE: "idle",
    State.HELP_REQUESTED: "help requested",
    State.ROLE_ESTABLISHED: "role established",
    State.MANEUVER_EXECUTING: "maneuver executing",
}
RAM, RMCM, LOST, OPEN = "#9aa5b1", "#1f2933", "#c0392b", "#bfe3c0"
# The leader above, the follower below; bars are this high.
ROWS, HEIGHT = (1.0, 0.0), 0.22


def draw(record: Record, title: str) -> Figure:
    """The timeline: states as bars, messages between them, the open corridor behind."""
    figure, axes = plt.subplots(figsize=(12, 4.6), layout="constrained")
    for since_ms, until_ms in record.corridor:
        axes.axvspan(since_ms / 1_000, until_ms / 1_000, color=OPEN, zorder=0)
        middle_s = (since_ms + until_ms) / 2_000
        axes.text(middle_s, 1.27, "corridor open", ha="center", color="#2e7d32", fontsize=10)
    for row, states in zip(ROWS, record.states, strict=True):
        draw_states(axes, row, states, record.end_ms)
    for packet in record.packets:
        draw_packet(axes, packet)
    axes.set_yticks(ROWS, record.names, fontsize=11)
    axes.set_ylim(-0.3, 1.42)
    axes.set_xlim(0, record.end_ms / 1_000)
    axes.set_xlabel("time since the robots were switched on [s]")
    axes.set_title(title, loc="left", fontsize=12)
    axes.spines[["top", "right", "left"]].set_visible(False)
    axes.tick_params(axis="y", length=0)
    figure.legend(handles=legend(), loc="outside lower center", ncols=7, frameon=False, fontsize=9)
    return figure


def draw_states(axes: Axes, row: float, states: list[tuple[int, State]], end_ms: int) -> None:
    """One robot's states over time."""
    ends = [since_ms for since_ms, _ in states[1:]] + [end_ms]
    for (since_ms, state), until_ms in zip(states, ends, strict=True):
        span = [(since_ms / 1_000, (until_ms - since_ms) / 1_000)]
        colour = COLOURS[state]
        axes.broken_barh(span, (row - HEIGHT / 2, HEIGHT), facecolors=colour, edgecolor="white", zorder=3)
        if until_ms - since_ms > 700:
            dark = state is State.MANEUVER_EXECUTING
            at_s = (since_ms + until_ms) / 2_000
            axes.text(
                at_s,
                row,
                WORDS[state],
                ha="center",
                va="center",
                fontsize=9,
                color="white" if dark else "black",
                zorder=4,
            )


def draw_packet(axes: Axes, packet: Packet) -> None:
    """A message on its way, from the sender's bar to the other's; a lost one ends on the way."""
    kind, what = words(packet.octets)
    is_from_leader = packet.sender == 0
    down = -1 if is_from_leader else 1
    start, end = (ROWS[row] - (1, -1)[row] * HEIGHT / 2 for row in (packet.sender, 1 - packet.sender))
    sent_s, arrives_s = packet.sent_ms / 1_000, packet.arrives_ms / 1_000
    colour, marker = RMCM if kind == "RMCM" else RAM, "v" if is_from_leader else "^"
    if packet.is_lost:
        arrives_s, end = (sent_s + arrives_s) / 2, start + (end - start) / 3
        colour, marker, what = LOST, "x", f"{what} (lost)" if what else ""
    width = 1.6 if kind == "RMCM" else 0.7
    # The tip of the arrow is at the bar.
    tip = end if packet.is_lost else end - down * 0.02
    axes.plot([sent_s, arrives_s], [start, tip], color=colour, linewidth=width, zorder=2)
    axes.plot(arrives_s, tip, marker=marker, color=colour, markersize=5, zorder=3)
    if what:
        side = {"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.85}
        beside = (sent_s + 0.05, start + down * 0.1)
        axes.text(*beside, what, va="center", fontsize=9, color=colour, bbox=side, zorder=5)


def legend() -> list[Patch]:
    """What the colours mean."""
    states = [Patch(color=COLOURS[state], label=WORDS[state]) for state in State]
    messages = [("RAM", RAM), ("RMCM", RMCM), ("lost", LOST)]
    return states + [Patch(color=colour, label=label) for label, colour in messages]


# %% Cross, have the log validated, and draw.
def main(arguments: list[str]) -> int:
    """The crossing, its log and its picture."""
    picture = arguments[0] if arguments else "crossing.svg"
    log = io.StringIO()
    record = cross(seed=5, log=log)
    log.seek(0)
    validation = validate([log])
    if not validation:
        print(f"not valid: {validation.fault}")
        return 1
    assert validation.validated is not None
    kept = ", ".join(validation.validated.properties)
    print(f"{validation.validated.steps} steps, each one of the transition function; kept: {kept}")
    lost = sum(packet.is_lost for packet in record.packets)
    title = f"A crossing of two robots; the radio lost {lost} of {len(record.packets)} packets"
    # The same crossing is the same file.
    plt.rcParams.update({"svg.hashsalt": "crossguard", "svg.fonttype": "none"})
    metadata = {"Date": None} if picture.endswith(".svg") else None
    draw(record, title).savefig(picture, dpi=150, metadata=metadata)
    print(f"wrote {picture}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
