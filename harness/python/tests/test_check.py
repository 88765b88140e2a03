"""The model checker."""

from __future__ import annotations

import os
import re
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from conftest import REPOSITORY
from crossguard import Progress, ScenarioError, Verdict, check, scenarios

SCENARIOS = REPOSITORY / "model-check" / "scenarios"

# What no machine explores within the time after which a check that was told to end fails its test.
LONG = SCENARIOS / "trio-lossy.toml"
END_S = 120


def test_a_scenario_is_exhausted_and_nothing_is_broken() -> None:
    report = check("stable")
    assert report.is_exhaustive and not report.has_failed
    assert report.cut_off is None
    assert report.verdict("I4") is Verdict.HOLDS
    assert report.verdict("I4-premise") is Verdict.REACHABLE
    assert report.chart("I4") is None
    assert f"unique_states = {report.unique_states}" in (SCENARIOS / "stable.toml").read_text()
    assert "passed" in repr(report) and report.assumptions
    assert report.to_dict()["name"] == report.name == "stable"
    with pytest.raises(KeyError):
        report.verdict("I99")


def test_the_papers_wording_fails_and_shows_how() -> None:
    report = check("paper-literal")
    assert not report.has_failed  # It fails as it must.
    assert report.verdict("P1") is Verdict.VIOLATED
    text = report.chart("P1")
    assert (text is not None and text.startswith("1. ")) or (text is not None and " 1" in text)
    mermaid = report.chart("P1", "mermaid")
    assert mermaid is not None and "sequenceDiagram" in mermaid


def test_a_check_that_is_cut_off_says_so() -> None:
    report = check("pair", threads=1, max_states=1_000)
    assert not report.is_exhaustive and report.cut_off == "state-limit"
    assert report.verdict("L1") is Verdict.INCOMPLETE
    assert "incomplete" in repr(report)


def test_a_scenario_may_be_a_file(tmp_path: Path) -> None:
    text = (SCENARIOS / "stable.toml").read_text()
    path = tmp_path / "mine.toml"
    path.write_text(text.replace('name = "stable"', 'name = "mine"'))
    assert check(path, max_states=100).name == "mine"
    path.write_text(text + "\n[nonsense]\n")
    with pytest.raises(ScenarioError, match=r"mine\.toml"):
        check(path)
    with pytest.raises(ScenarioError, match="no scenario 'par'"):
        check("par")


def test_scenarios_are_listed() -> None:
    names = scenarios()
    assert names[0] == "pair" and names[-1] == "paper-literal"
    sizes = {
        path.stem: int(re.findall(r"unique_states = (\d+)", path.read_text())[0])
        for path in SCENARIOS.glob("*.toml")
    }
    # Larger ones are for workers, which the package does not have.
    in_reach = {name for name, states in sizes.items() if states < 100_000_000}
    streets = {name for name in names if name.startswith("street-")}
    assert len(streets) == 10
    assert in_reach == set(names) - {"paper-literal"} - streets
    assert in_reach < set(sizes)


def test_nonsense_is_refused() -> None:
    with pytest.raises(ValueError, match="timeout_s"):
        check("pair", timeout_s=-1)
    with pytest.raises(ValueError):
        check("pair", threads=0)


def test_progress_is_told_and_other_threads_run() -> None:
    told: list[Progress] = []
    turns = 0
    done = threading.Event()

    def count() -> None:
        nonlocal turns
        while not done.is_set():
            turns += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    report = check("team-of-four", timeout_s=2, progress=told.append)
    done.set()
    counter.join()
    assert told and told[-1].expected is not None
    assert turns > 10
    assert report.cut_off == "time-limit"


def test_what_progress_raises_ends_the_check() -> None:
    class Enough(Exception):
        pass

    def enough(_: Progress) -> None:
        raise Enough

    began = time.monotonic()
    with pytest.raises(Enough):
        check(LONG, timeout_s=2 * END_S, progress=enough)
    assert time.monotonic() - began < END_S


@pytest.fixture
def _interruptible() -> Iterator[None]:
    """What a shell starts in the background ignores SIGINT, and Python then does so as well."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("_interruptible")
def test_an_interrupt_ends_the_check() -> None:
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        check(LONG, timeout_s=2 * END_S)
    assert time.monotonic() - began < END_S
    timer.join()
