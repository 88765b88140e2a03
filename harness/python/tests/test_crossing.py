"""Crossings with a robot of `crossguard run` in another process, judged by logs; the README leads."""

from __future__ import annotations

import io
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import HERE
from crossguard import UnreadableLog, Validation, validate

CROSSING = HERE.parent / "examples" / "crossing.py"
ROBOT = HERE.parent / "examples" / "robot.py"
PATIENCE_S = 60


def robot_file(folder: Path, name: str, station: int, port: int, peer: int) -> Path:
    """The configuration of a robot of `crossguard run`."""
    build = "humanoid" if station == 1 else "quadruped"
    path = folder / f"{name}.toml"
    path.write_text(
        f'name = "{name}"\nstation = {station}\nbuild = "{build}"\nboot_file = "{name}.boot"\n'
        f'speed = 40.0\nautopilot = true\n\n[link]\naddress = "127.0.0.1:{port}"\n'
        f'peers = ["127.0.0.1:{peer}"]\n'
    )
    return path


class Rust:
    """A robot of `crossguard run`."""

    def __init__(self, command: str, config: Path) -> None:
        self.log = config.with_suffix(".log")
        run = [command, "run", "--config", str(config), "--json", "--log", str(self.log)]
        self.process = subprocess.Popen(run, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)

    def finish(self, lines: str) -> None:
        """Types lines, and waits for its end."""
        self.process.communicate(lines, timeout=PATIENCE_S)
        assert self.process.returncode == 0


class Python:
    """A robot of examples/robot.py."""

    def __init__(self, folder: Path, role: str, station: int, port: int, peer: int) -> None:
        self.log = folder / "python.log"
        arguments = [role, str(station), str(port), str(peer), str(folder / "python.boot"), str(self.log)]
        self.process = subprocess.Popen(
            [sys.executable, str(ROBOT), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def finish(self) -> str:
        """Waits until it has ended, the crossing being completed; what it said."""
        said, errors = self.process.communicate(timeout=PATIENCE_S)
        assert (self.process.returncode, errors) == (0, ""), said + errors
        assert said.endswith("crossing completed\n")
        return said


def assert_valid(python: Path, rust: Path, command: str) -> None:
    """The log of the robot in Python is whole, and so are both together; the command says the same."""
    alone = validate([python]).validated
    assert alone is not None and alone.steps > 50 and alone.sent > 10
    assert alone.missing == 0 and alone.cut_off == ()
    together = validate([python, rust]).validated
    assert together is not None and (together.robots, together.from_strangers) == (2, 0)
    assert {"I2", "I3", "I6", "I8", "I11"} <= set(together.properties)
    for logs in ([python], [python, rust]):
        judged = subprocess.run([command, "validate", *logs], capture_output=True, text=True)
        assert judged.returncode == 0, judged.stdout + judged.stderr


def test_a_robot_in_python_follows(
    crossguard_command: str, two_ports: tuple[int, int], tmp_path: Path
) -> None:
    own, peer = two_ports
    python = Python(tmp_path, "follower", 2, own, peer)
    ari = Rust(crossguard_command, robot_file(tmp_path, "ARI", 1, peer, own))
    ari.finish("wait 0.3\ndetect\nuntil maneuver-executing\nuntil idle\nquit\n")
    said = python.finish()
    assert "starts MOVE of request 1\n" in said
    assert_valid(tmp_path / "python.log", ari.log, crossguard_command)


def test_wrong_usage_says_how(tmp_path: Path) -> None:
    used = subprocess.run([sys.executable, ROBOT, "leader"], capture_output=True, text=True)
    assert used.returncode == 2 and "Usage: robot.py" in used.stderr
    (tmp_path / "boot").write_text("nonsense")
    arguments = ["leader", "1", "0", "1", str(tmp_path / "boot")]
    used = subprocess.run([sys.executable, ROBOT, *arguments], capture_output=True, text=True)
    assert used.returncode == 2 and "does not hold a boot counter" in used.stderr


def crossed(tmp_path: Path) -> str:
    """The log of the crossing of the README, which has no more than sixty lines."""
    assert len(CROSSING.read_text().splitlines()) <= 60
    subprocess.run([sys.executable, CROSSING, tmp_path / "crossing.log"], check=True)
    return (tmp_path / "crossing.log").read_text()


def test_a_crossing_in_virtual_time_is_valid_and_an_altered_log_is_not(tmp_path: Path) -> None:
    text = crossed(tmp_path)
    validation = validate([io.StringIO(text)])
    assert validation and validation.validated is not None
    assert validation.validated.robots == 2
    assert "I11" in validation.validated.properties

    altered = text.replace('{"corridorOpened":', '{"corridorExtended":')
    validation = validate([io.StringIO(altered)])
    assert not validation and validation.fault is not None
    fault = validation.fault
    assert fault.log == "log 1" and fault.line > 1 and fault.robot in ("ARI", "Go2")
    assert str(fault).startswith(f"log 1, line {fault.line}: {fault.robot} ")

    (tmp_path / "altered.log").write_text(altered)
    assert isinstance(validate([tmp_path / "altered.log"]), Validation)


def test_logs_that_cannot_be_read_are_no_verdict(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"missing\.log"):
        validate([tmp_path / "missing.log"])
    with pytest.raises(UnreadableLog, match="nothing in this log"):
        validate([io.StringIO("")])
    with pytest.raises(UnreadableLog, match="line 1: is not a record"):
        validate([io.StringIO("nonsense\n")])
    with pytest.raises(TypeError, match="a list of logs"):
        validate("some.log")
