"""The boot counter."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from crossguard import Boot, BootError


def test_each_boot_takes_the_next_counter(tmp_path: Path) -> None:
    for expected in (1, 2, 3):
        with Boot.take(tmp_path / "robot.boot") as boot:
            assert boot.counter == expected
            assert repr(boot) == f"<Boot {expected}>"


def test_a_counter_is_renewed_while_it_is_in_use(tmp_path: Path) -> None:
    path = tmp_path / "robot.boot"
    with Boot.take(path) as boot:
        assert boot.renew() == boot.counter == 2
    with pytest.raises(BootError, match="not in use any more"):
        boot.renew()
    assert Boot.take(path).counter == 3


def test_one_robot_one_process(tmp_path: Path) -> None:
    path = tmp_path / "robot.boot"
    take = [sys.executable, "-c", "import crossguard, sys; crossguard.Boot.take(sys.argv[1])"]
    with Boot.take(str(path)):
        with pytest.raises(BootError, match="in use by another process"):
            Boot.take(path)
        other = subprocess.run([*take, path], capture_output=True, text=True)
        assert other.returncode == 1 and "one robot, one process" in other.stderr
    assert subprocess.run([*take, path]).returncode == 0
    assert Boot.take(path).counter == 3


def test_a_corrupt_file_is_refused_and_left_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "robot.boot"
    path.write_text("17")
    with pytest.raises(BootError, match="does not hold a boot counter"):
        Boot.take(path)
    assert path.read_text() == "17"
