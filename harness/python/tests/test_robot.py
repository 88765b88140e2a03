"""The state machine: what it does, what it refuses, and what always holds."""

from __future__ import annotations

import copy
import pickle

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crossguard import (
    BrokenInequality,
    Config,
    FallbackPolicy,
    HelpRequest,
    Robot,
    Role,
    State,
    TaskSet,
    TaskType,
    events,
    inputs,
    messages,
    notices,
    outputs,
    phases,
    reasons,
    timers,
    types,
)


def pair() -> tuple[Robot, Robot]:
    """A leader and its follower, both in their roles."""
    ari, go2 = Robot(1, 1), Robot(2, 1)
    ari.step(events.PedestrianDetected(HelpRequest()))
    go2.step(inputs.Ram(ari.ram(), distance_dm=40))
    ari.step(inputs.Ram(go2.ram(), distance_dm=40))
    ari.step(inputs.Elapsed(300))
    go2.step(inputs.Ram(ari.ram()))
    ari.step(inputs.Ram(go2.ram()))
    return ari, go2


def rmcm(step: list[outputs.Output]) -> messages.Rmcm:
    """The RMCM that a step sends."""
    (sent,) = [output.rmcm for output in step if isinstance(output, outputs.SendRmcm)]
    return sent


def test_two_robots_take_their_roles() -> None:
    ari, go2 = pair()
    assert (ari.role, ari.state) == (Role.LEADER, State.ROLE_ESTABLISHED)
    assert (go2.role, go2.state) == (Role.FOLLOWER, State.ROLE_ESTABLISHED)
    assert ari.session == go2.session == types.SessionId(1, types.UniqueNumber(1, 0))
    assert str(ari.session) == "1#1.0"
    match ari.phase:
        case phases.Leading(members=(phases.Member(station=2, lease=phases.Stands(left)),)):
            assert left == 1900
        case other_phase:
            pytest.fail(repr(other_phase))
    match go2.ram().coordination:
        case messages.Follower(session, echo=3, last=None):
            assert session == ari.session
        case other:
            pytest.fail(repr(other))
    assert isinstance(ari.identity, phases.Locked)
    assert ari.next_due_ms is not None and ari.next_due_ms <= 100


def test_a_command_is_acknowledged_before_it_is_started() -> None:
    ari, go2 = pair()
    command = rmcm(ari.step(events.CommandManeuver(2, TaskType.MOVE)))
    session = ari.session
    assert session is not None
    assert command == messages.Command(session, 2, 0, TaskType.MOVE)
    step = go2.step(inputs.Rmcm(command))
    answer = rmcm(step)
    assert answer == messages.Answer(2, session, 0, messages.Accepted())
    kinds = [type(output) for output in step]
    assert kinds.index(outputs.SendRmcm) < kinds.index(outputs.StartManeuver)
    assert go2.state is State.MANEUVER_EXECUTING
    step = ari.step(inputs.Rmcm(answer))
    id = types.ManeuverId(session, 0)
    assert outputs.Notify(notices.CommandAcknowledged(2, id)) in step

    refused = ari.step(events.OpenCorridor())
    assert refused == [outputs.Ignored(reasons.NotEngaged(2, reasons.NotExecuting()))]
    ari.step(inputs.Ram(go2.ram()))
    (opened,) = ari.step(events.OpenCorridor())
    # The sign shows go for what is left of the lease, and is extended when that is renewed.
    assert opened == outputs.CorridorOpened(1_900)
    ari.step(inputs.Elapsed(100))
    go2.step(inputs.Ram(ari.ram()))
    assert outputs.CorridorExtended(1_900) in ari.step(inputs.Ram(go2.ram()))

    go2.step(inputs.Elapsed(2_000))
    assert go2.phase.contact == phases.Lost(5_000)  # type: ignore[union-attr]
    fell_back = ari.step(inputs.Ram(go2.ram()))
    closed = reasons.NotEngaged(2, reasons.SafeIdle())
    assert outputs.CorridorClosed(closed) in fell_back
    assert ari.phase.corridor is phases.Corridor.CLEARING  # type: ignore[union-attr]

    # Its duty lasts until it is told that the road is clear; until then it does nothing new.
    assert isinstance(go2.duty, phases.FallingBack) and go2.ram().on_duty
    other = events.CommandManeuver(2, TaskType.INITIAL_POS)
    rejected = rmcm(go2.step(inputs.Rmcm(rmcm(ari.step(other)))))
    assert rejected == messages.Answer(2, session, 1, messages.Rejected(reasons.OnDuty()))
    go2.step(events.RoadClear())
    assert go2.duty is None and not go2.ram().on_duty


def test_a_corridor_waits_for_guards_that_hold_a_place() -> None:
    ari, go2 = pair()
    step = go2.step(inputs.Rmcm(rmcm(ari.step(events.CommandManeuver(2, TaskType.BLOCK)))))
    (start,) = [output for output in step if isinstance(output, outputs.StartManeuver)]
    ari.step(inputs.Rmcm(rmcm(step)))
    ari.step(inputs.Ram(go2.ram()))
    refused = ari.step(events.OpenCorridor())
    assert refused == [outputs.Ignored(reasons.NotEngaged(2, reasons.NotInPosition()))]
    go2.step(events.InPosition(start.maneuver.id))
    # That it is there counts by the echo of a newer heartbeat.
    ari.step(inputs.Elapsed(100))
    go2.step(inputs.Ram(ari.ram()))
    step = ari.step(inputs.Ram(go2.ram()))
    assert outputs.Notify(notices.ManeuverInPosition(2, start.maneuver.id)) in step
    assert isinstance(ari.step(events.OpenCorridor())[0], outputs.CorridorOpened)
    go2.step(events.OutOfPosition(start.maneuver.id))
    closed = outputs.CorridorClosed(reasons.NotEngaged(2, reasons.NotInPosition()))
    assert closed in ari.step(inputs.Ram(go2.ram()))


def test_a_crossing_that_is_completed_frees_its_followers() -> None:
    ari, go2 = pair()
    go2.step(inputs.Rmcm(rmcm(ari.step(events.CommandManeuver(2, TaskType.MOVE)))))
    ari.step(events.TaskCompleted())
    (ended,) = [ari.ram().farewell]
    assert isinstance(ended, messages.Ended) and ended.how is messages.Ending.COMPLETED
    step = go2.step(inputs.Ram(ari.ram()))
    (stop,) = [output for output in step if isinstance(output, outputs.StopManeuver)]
    assert stop.why == reasons.Released(reasons.TaskCompleted())
    assert go2.duty is None


def test_a_new_epoch_has_a_larger_boot_counter() -> None:
    robot = Robot(1, 1)
    assert robot.step(events.EpochRenewed(1)) == [outputs.Ignored(reasons.NothingNew())]
    assert robot.step(events.EpochRenewed(2)) == []
    assert robot.boot == 2


def test_a_follower_falls_back_by_the_policy_of_its_task() -> None:
    policies = {TaskType.MOVE: FallbackPolicy.STOP_IN_PLACE}
    go2 = Robot(2, 1, Config(fallback=policies))
    ari = Robot(1, 1)
    ari.step(events.PedestrianDetected())
    go2.step(inputs.Ram(ari.ram()))
    ari.step(inputs.Ram(go2.ram()))
    ari.step(inputs.Elapsed(300))
    go2.step(inputs.Ram(ari.ram()))
    ari.step(inputs.Ram(go2.ram()))
    go2.step(inputs.Rmcm(rmcm(ari.step(events.CommandManeuver(2, TaskType.MOVE)))))
    step = go2.step(inputs.Elapsed(2_000))
    (fallback,) = [output for output in step if isinstance(output, outputs.FallBack)]
    assert fallback.policy is FallbackPolicy.STOP_IN_PLACE
    assert fallback.maneuver.task is TaskType.MOVE


def test_unavailable_robots_say_why() -> None:
    robot = Robot(1, 1)
    why = reasons.Unavailable(reasons.Unavailability.LOW_BATTERY)
    robot.step(events.AvailabilityChanged(why))
    assert robot.availability == why
    assert robot.step(events.PedestrianDetected()) == [outputs.Ignored(why)]


def test_what_is_out_of_range_is_refused_and_changes_nothing() -> None:
    robot = Robot(1, 1)
    with pytest.raises(ValueError, match=r"input: invalid value: integer `300`, expected u8"):
        robot.step(events.PedestrianDetected(HelpRequest(followers=300)))
    with pytest.raises(ValueError, match="task type 16 does not exist"):
        robot.step(events.CommandManeuver(2, 16))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="expected u32"):
        robot.step(inputs.Elapsed(-1))
    with pytest.raises(TypeError, match="no value of crossguard"):
        robot.step(object())  # type: ignore[arg-type]
    assert robot == Robot(1, 1)
    with pytest.raises(OverflowError):
        Robot(2**32, 1)
    with pytest.raises(OverflowError):
        Robot(1, 65_536)


def test_impossible_requests_are_ignored_with_a_reason() -> None:
    step = Robot(1, 1).step(events.PedestrianDetected(HelpRequest(followers=0)))
    assert step == [outputs.Ignored(reasons.ImpossibleRequest())]


def test_settings_that_break_an_inequality_are_refused_by_its_name() -> None:
    with pytest.raises(BrokenInequality, match="lease-within-safety") as refused:
        Config(t_safety_ms=1_000)
    assert refused.value.inequality == "lease-within-safety"
    assert refused.value.formula == "(t_lease + delay_max) * (1 + drift) < t_safety * (1 - drift)"
    assert isinstance(refused.value, ValueError)
    assert str(pickle.loads(pickle.dumps(refused.value))) == str(refused.value)
    with pytest.raises(ValueError, match="expected u32"):
        Config(t_ack_ms=-1)
    with pytest.raises(ValueError, match="16 is not a valid TaskType"):
        Config(t_exec_ms={16: 1})  # type: ignore[dict-item]


def test_a_configuration_names_only_what_it_changes() -> None:
    config = Config(t_exec_ms={TaskType.MOVE: 90_000})
    assert config.t_exec_ms[TaskType.MOVE] == 90_000
    assert config.t_exec_ms[TaskType.INITIAL_POS] == 5_000
    assert config != Config() == Config()
    assert len({config, Config(), Config()}) == 2
    assert pickle.loads(pickle.dumps(config)) == config
    assert config.capabilities == TaskSet.INITIAL_POS | TaskSet.MOVE | TaskSet.BLOCK


def test_the_documented_defaults_are_those_of_the_core() -> None:
    config = Config()
    assert (config.ram_period_ms, config.t_select_ms, config.t_offer_ms) == (100, 300, 3_000)
    assert (config.t_help_ms, config.t_ack_ms, config.n_ack) == (10_000, 600, 3)
    assert (config.t_safety_ms, config.t_lease_ms, config.t_leave_ms) == (2_000, 1_900, 5_000)
    assert (config.t_farewell_ms, config.t_lock_ms, config.t_cross_ms) == (1_000, 300_000, 30_000)
    assert (config.drift_ppm, config.delay_max_ms) == (1_000, 50)
    assert config.guarding == TaskSet.MOVE | TaskSet.BLOCK
    assert config.holding == TaskSet.BLOCK
    assert config.t_exec_ms[TaskType.TASK15] == 60_000
    assert config.fallback[TaskType.INITIAL_POS] is FallbackPolicy.STOP_IN_PLACE
    assert config.fallback[TaskType.MOVE] is FallbackPolicy.ESCORT_TO_KERB
    assert config.fallback[TaskType.BLOCK] is FallbackPolicy.HOLD_UNTIL_CLEAR


def test_a_copy_goes_its_own_way() -> None:
    ari, _ = pair()
    other = copy.copy(ari)
    assert other == ari
    other.step(events.LeaveRequested())
    assert other != ari
    assert "RoleEstablished, leader" in repr(ari)
    assert "Idle" in repr(other)
    assert isinstance(other.farewell, messages.Ended)


# Everything that a robot can be told, with small numbers, so that it concerns it now and then.
stations = st.integers(1, 3)
numbers = st.builds(types.UniqueNumber, st.integers(0, 1), st.integers(0, 2))
sessions = st.builds(types.SessionId, stations, numbers)
requests = st.integers(0, 2)
tasks = st.sampled_from(list(TaskType)[:4])
task_sets = st.integers(0, 7).map(TaskSet)
heartbeats = st.integers(0, 30)
unavailable = st.builds(reasons.Unavailable, st.sampled_from(reasons.Unavailability))
failures = st.one_of(st.builds(reasons.Maneuver), unavailable)
progresses = st.one_of(
    st.builds(messages.Executing),
    st.builds(messages.InPosition),
    st.builds(reasons.Completed),
    st.builds(reasons.Failed, failures),
    st.builds(reasons.SafeIdle),
)
urgencies = st.sampled_from(types.Urgency)
places = st.integers(0, 2)
help_requests = st.builds(HelpRequest, urgencies, st.integers(0, 5), task_sets, places)
coordinations = st.one_of(
    st.builds(messages.NoPart),
    st.builds(messages.NeedHelp, numbers, heartbeats, help_requests),
    st.builds(messages.OfferHelp, sessions, numbers, task_sets, heartbeats, st.integers(0, 3_000)),
    st.builds(
        messages.Leader,
        numbers,
        heartbeats,
        st.lists(st.builds(messages.Confirmation, stations, numbers), max_size=4).map(tuple),
        urgencies,
        places,
        st.booleans(),
    ),
    st.builds(
        messages.Follower,
        sessions,
        heartbeats,
        st.none() | st.builds(messages.Report, requests, progresses),
    ),
)
farewells = st.one_of(
    st.none(),
    st.builds(messages.Ended, numbers, st.sampled_from(messages.Ending)),
    st.builds(messages.Left, sessions, numbers),
)
rams = st.builds(messages.Ram, stations, coordinations, farewells, st.booleans())
verdicts = st.builds(messages.Accepted) | st.builds(
    messages.Rejected,
    st.builds(reasons.UnsupportedTask) | st.builds(reasons.OnDuty) | unavailable,
)
rmcms = st.one_of(
    st.builds(messages.Command, sessions, stations, requests, tasks),
    st.builds(messages.Answer, stations, sessions, requests, verdicts),
)
maneuver_ids = st.builds(types.ManeuverId, sessions, requests)
told = st.one_of(
    st.builds(events.PedestrianDetected, help_requests),
    st.builds(events.CommandManeuver, stations, tasks),
    st.builds(events.InPosition, maneuver_ids),
    st.builds(events.ManeuverCompleted, maneuver_ids),
    st.builds(events.ManeuverFailed, maneuver_ids),
    st.builds(events.TaskCompleted),
    st.builds(events.RoadClear),
    st.builds(events.AllAnswered),
    st.builds(events.LeaveRequested),
    st.builds(events.AvailabilityChanged, st.builds(types.Available) | unavailable),
    st.builds(events.OpenCorridor),
    st.builds(events.CloseCorridor),
    st.builds(events.IdentityChanged, stations),
    st.builds(events.EpochRenewed, st.integers(0, 3)),
)
expired = st.one_of(
    *[st.builds(kind, stations) for kind in (timers.Lease, timers.Lost, timers.Execution, timers.Offer)],
    *[st.builds(kind) for kind in (timers.Safety, timers.Help, timers.Selection, timers.Ram)],
)
anything = st.one_of(
    st.builds(inputs.Ram, rams, st.integers(0, 65_535)),
    st.builds(inputs.Rmcm, rmcms),
    st.builds(inputs.Elapsed, st.integers(0, 3_000)),
    st.builds(inputs.Expired, expired),
    st.builds(inputs.Local, told),
)


@settings(deadline=None, max_examples=150)
@given(st.lists(anything, max_size=40))
def test_any_inputs_keep_the_state_valid_and_every_output_has_its_class(
    run: list[inputs.Input],
) -> None:
    robot = Robot(1, 1)
    for input in run:
        before = copy.copy(robot)
        step = robot.step(input)
        assert robot.is_valid
        assert all(isinstance(output, outputs.Output) for output in step)
        # The same step of the same state does the same.
        assert before.step(input) == step and before == robot
        # All of it can be looked at.
        assert isinstance(robot.phase, phases.Phase)
        assert isinstance(robot.ram(), messages.Ram)
        assert robot.duty is None or isinstance(robot.duty, phases.Duty)
