"""What the tests share."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

HERE = Path(__file__).parent
REPOSITORY = HERE.parents[2]


@pytest.fixture(scope="session")
def crossguard_command() -> str:
    """The `crossguard` command, built by `try`."""
    command = os.environ.get("CROSSGUARD")
    if command is None:
        pytest.skip("CROSSGUARD does not name the crossguard command; harness/python/try builds it")
    return command


@pytest.fixture
def two_ports() -> tuple[int, int]:
    """Two UDP ports on 127.0.0.1 that are free."""
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    first, second = (each.getsockname()[1] for each in sockets)
    for each in sockets:
        each.close()
    return first, second
