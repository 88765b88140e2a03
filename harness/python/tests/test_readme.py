"""The Python in the README is what works."""

from __future__ import annotations

from conftest import HERE, REPOSITORY
from crossguard import State

README = (HERE.parent / "README.md").read_text()
BLOCKS = [block.split("```")[0] for block in README.split("```python\n")[1:]]


def the_block_with(words: str) -> str:
    (block,) = [block for block in BLOCKS if words in block]
    return block


def test_every_block_is_python() -> None:
    assert len(BLOCKS) == 3
    for block in BLOCKS:
        compile(block, "README.md", "exec")


def test_two_robots_take_their_roles() -> None:
    names: dict[str, object] = {}
    exec(the_block_with("go2 = Robot"), names)
    assert getattr(names["ari"], "state", None) is State.ROLE_ESTABLISHED


def test_messages_are_taken_apart_and_put_together() -> None:
    vectors = (REPOSITORY / "codec" / "tests" / "golden" / "packets.txt").read_text()
    (cam,) = [line.removeprefix("G1: ") for line in vectors.splitlines() if line.startswith("G1: ")]
    lines = the_block_with("encode(decode(packet))").splitlines()
    names: dict[str, object] = {"packet": bytes.fromhex(cam)}
    exec(lines[0], names)
    (equal,) = [line for line in lines if "==" in line]
    assert eval(equal, names) is True
