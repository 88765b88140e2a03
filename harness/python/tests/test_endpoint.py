"""Whole robots, in virtual time."""

from __future__ import annotations

import errno
import io
import json
import math
from dataclasses import replace

import pytest

from crossguard import (
    Endpoint,
    HelpRequest,
    Identifiers,
    MessageIdentifiers,
    Moment,
    Position,
    RobotState,
    State,
    TaskParameters,
    TaskType,
    decode,
    events,
    notices,
    outputs,
    reasons,
    validate,
)
from crossguard.body import (
    Intersection,
    Lane,
    PublicSignal,
    RoadSegment,
    SignalMeans,
    SignalsShown,
    SlowState,
    ToPosition,
)

UNIX_MS = 1_795_305_600_000
PLACE = RobotState(position=Position(latitude_deg=49.0101, longitude_deg=8.4124))


def at(now_ms: int) -> Moment:
    return Moment(now_ms, UNIX_MS + now_ms)


def robot(station: int, log: io.StringIO | None = None) -> Endpoint:
    return Endpoint(station, 1, name=f"R{station}", at=at(0), body=PLACE, log=log)


def packets(effects: list[outputs.Effect]) -> list[bytes]:
    return [effect.packet for effect in effects if isinstance(effect, outputs.Send)]


def exchange(one: Endpoint, other: Endpoint, now_ms: int, sent: list[bytes]) -> list[outputs.Effect]:
    """Packets go to the other robot and back until both have said all; every effect."""
    effects: list[outputs.Effect] = []
    receiver, sender = other, one
    while sent:
        answers = [effect for packet in sent for effect in receiver.receive(packet, at(now_ms))]
        effects += answers
        sent = packets(answers)
        receiver, sender = sender, receiver
    return effects


def team() -> tuple[Endpoint, Endpoint]:
    ari, go2 = robot(1), robot(2)
    for now_ms in range(10, 1_200, 10):
        for one, other in ((ari, go2), (go2, ari)):
            exchange(one, other, now_ms, packets(one.elapse(at(now_ms))))
        if now_ms == 300:
            told = ari.tell(events.PedestrianDetected(HelpRequest()), at(now_ms))
            exchange(ari, go2, now_ms, packets(told))
    assert ari.robot.state is go2.robot.state is State.ROLE_ESTABLISHED
    return ari, go2


def test_a_command_brings_its_parameters() -> None:
    ari, go2 = team()
    target = ToPosition(49.0102, 8.4125)
    parameters = TaskParameters(target, maximum_speed_mps=1.4, validity_ms=5_000)
    told = ari.tell(events.CommandManeuver(2, TaskType.MOVE), at(1_200), parameters)
    effects = exchange(ari, go2, 1_200, packets(told))
    (start,) = [effect for effect in effects if isinstance(effect, outputs.StartManeuver)]
    assert start.maneuver.task is TaskType.MOVE
    match start.parameters:
        case TaskParameters(target=ToPosition(latitude, longitude), validity_ms=5_000):
            assert math.isclose(latitude, 49.0102, abs_tol=1e-6)
            assert math.isclose(longitude, 8.4125, abs_tol=1e-6)
        case other:
            pytest.fail(repr(other))
    notified = [effect.notice for effect in effects if isinstance(effect, outputs.Notify)]
    assert notices.CommandAcknowledged(2, start.maneuver.id) in notified


def test_a_command_names_its_place_on_the_map() -> None:
    ari, go2 = team()
    for now_ms, place in ((1_200, Intersection(276, 4_711)), (1_210, RoadSegment(None, 12))):
        parameters = TaskParameters(map_place=place)
        told = ari.tell(events.CommandManeuver(2, TaskType.MOVE), at(now_ms), parameters)
        effects = exchange(ari, go2, now_ms, packets(told))
        (start,) = [effect for effect in effects if isinstance(effect, outputs.StartManeuver)]
        assert start.parameters.map_place == place


def test_what_a_robot_shows_to_people_and_what_it_is_there_for_are_in_its_ram() -> None:
    ari, go2 = robot(1), robot(2)
    shown = SignalsShown(PublicSignal.STOP, PublicSignal.CAUTION, SignalMeans.GESTURE | SignalMeans.SPEECH)
    ari.body = replace(PLACE, slow=SlowState(signals=shown, area=RoadSegment(276, 12)))
    heard = exchange(ari, go2, 10, packets(ari.elapse(at(10))))
    ram = next(effect.message for effect in heard if isinstance(effect, outputs.Heard))
    parameters = decode(ram)["message"]["ram"]["ram"]["ramParameters"]
    slow = parameters["robotLowFrequencyContainer"]
    assert slow["areaServed"] == {"roadsegment": {"region": 276, "id": 12}}
    assert slow["signalsShown"] == {"toVehicles": "stop", "toPedestrians": "caution", "means": "90"}


def test_a_command_without_parameters_does_not_keep_older_ones() -> None:
    ari, go2 = team()
    for now_ms, parameters in ((1_200, TaskParameters(target=Lane(2))), (1_210, None)):
        told = ari.tell(events.CommandManeuver(2, TaskType.BLOCK), at(now_ms), parameters)
        effects = exchange(ari, go2, now_ms, packets(told))
        (start,) = [effect for effect in effects if isinstance(effect, outputs.StartManeuver)]
        assert start.parameters == (TaskParameters() if parameters is None else parameters)


def test_a_refused_event_says_why() -> None:
    effects = robot(1).tell(events.OpenCorridor(), at(10))
    assert outputs.Ignored(reasons.NotLeading()) in effects


def test_what_comes_to_nothing_is_named_and_counted() -> None:
    go2 = robot(2)
    effects = go2.receive(b"nonsense", at(10))
    (dropped,) = [effect for effect in effects if isinstance(effect, outputs.Dropped)]
    assert dropped.layer == "packet"
    assert go2.counters["packet"][dropped.cause] == 1
    go2.tell(events.TaskCompleted(), at(20))
    assert go2.counters["protocol"]["not leading"] == 1


def test_an_idle_robot_announces_itself() -> None:
    go2 = robot(2)
    sent = 0
    for now_ms in range(10, 5_001, 10):
        sent += len(packets(go2.elapse(at(now_ms))))
    assert 5 <= sent <= 50
    assert go2.next_wakeup_ms > 5_000


def test_time_does_not_go_back() -> None:
    go2 = robot(2)
    go2.elapse(at(100))
    with pytest.raises(ValueError, match="the clock went back from 100 ms to 99 ms"):
        go2.elapse(at(99))
    with pytest.raises(OverflowError):
        go2.elapse(Moment(-1, 0))


def test_what_makes_no_sense_is_refused() -> None:
    go2 = robot(2)
    with pytest.raises(TypeError, match="only a CommandManeuver has parameters"):
        go2.tell(events.OpenCorridor(), at(10), TaskParameters())
    with pytest.raises(ValueError, match="NaN or infinite: None stands for what is not known"):
        go2.body = RobotState(position=Position(latitude_deg=math.nan))
    assert go2.body == PLACE
    clash = MessageIdentifiers(1, 241, 2_998, 16_480)
    with pytest.raises(ValueError, match="same messageId 241"):
        Identifiers(ram=clash)


def test_a_log_is_lines_of_records_and_valid() -> None:
    log = io.StringIO()
    go2 = robot(2, log)
    go2.tell(events.PedestrianDetected(), at(10))
    go2.stop(at(500))
    records = [json.loads(line) for line in log.getvalue().splitlines()]
    assert records[0]["entry"] == "started" and records[0]["robot"] == "R2"
    assert records[-1] == {"atUs": 500_000, "robot": "R2", "entry": "stopped", "counters": {}}
    log.seek(0)
    validation = validate([log])
    assert validation and validation.validated is not None
    assert validation.validated.robots == 1


def test_a_full_disk_ends_the_log_and_costs_no_effect(caplog: pytest.LogCaptureFixture) -> None:
    """Hazard: the disk is full, the step that says *fall back* raises, and the body is not told."""

    class Full(io.StringIO):
        def write(self, text: str, /) -> int:
            if "pedestrianDetected" in text:
                raise OSError(errno.ENOSPC, "No space left on device")
            return super().write(text)

    log = Full()
    go2 = robot(2, log)
    assert outputs.LockIdentity() in go2.tell(events.PedestrianDetected(), at(10))
    assert isinstance(go2.log_error, OSError) and "its log ends here" in caplog.text
    assert any(isinstance(it, outputs.Send) for it in go2.elapse(at(1_000)))
    assert len(log.getvalue().splitlines()) == 1 and len(caplog.records) == 1


def test_a_robot_that_is_looked_at_is_a_copy() -> None:
    go2 = robot(2)
    looked_at = go2.robot
    looked_at.step(events.PedestrianDetected())
    assert looked_at != go2.robot
    assert "R2: Idle" in repr(go2)
