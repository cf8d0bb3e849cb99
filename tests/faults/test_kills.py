"""Killed at any moment: no file is ever half-written, and the next run mends all.

`python -m tests.faults` does it at any size.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from . import commands
from .commands import COMMANDS, Command
from .killing import Figures, Prepared, campaign, faults

BEFORE = {"plant.toml": b"in", "plant.json": b"old"}
AFTER = {**BEFORE, "plant.json": b"new", "gate.xml": b"<x/>"}
PREPARED = Prepared(Command(("prove",)), BEFORE, AFTER, 0, 1.0)


@pytest.mark.slow
def test_killed_at_any_moment() -> None:
    *_, figures = campaign(10, 2026, [command for command in COMMANDS if command.weight > 3 or not command.over_old])
    assert figures.failures == []
    assert figures.kills == 10
    assert figures.during.total() >= 10


@pytest.mark.parametrize(
    "left",
    [BEFORE, AFTER, {**BEFORE, ".plant.json.0123456789abcdef.tmp": b"n"}, {**BEFORE, "gate.xml": b"<x/>"}],
)
def test_what_may_be_left(left: dict[str, bytes]) -> None:
    assert faults(left, PREPARED) == []


@pytest.mark.parametrize(
    ("left", "fault"),
    [
        ({**BEFORE, "plant.json": b"ne"}, "plant.json: 2 bytes, neither those before nor those after"),
        ({**BEFORE, "gate.xml": b""}, "gate.xml: 0 bytes, neither"),
        ({**BEFORE, "plant.toml": b""}, "plant.toml: 0 bytes, neither"),
        ({"plant.toml": b"in"}, "plant.json: gone"),
        ({**BEFORE, "plant.json.tmp": b"new"}, "plant.json.tmp: nobody asked for it"),
    ],
)
def test_what_may_not_be_left(left: dict[str, bytes], fault: str) -> None:
    (found,) = faults(left, PREPARED)
    assert found.startswith(fault)


@pytest.mark.parametrize("cure", [True, False])
def test_a_command_that_writes_in_place_is_seen(cure: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It writes one byte after the other, and may take what it finds for its own."""
    script = tmp_path / "bad.py"
    script.write_text(
        "import os, time\nfrom pathlib import Path\n"
        f"if {cure} or not os.path.exists('out'):\n"
        "    with open('out', 'wb', 0) as file:\n"
        "        for byte in Path('grid.toml').read_bytes():\n"
        "            file.write(bytes([byte]))\n            time.sleep(0.003)\n"
    )
    monkeypatch.setattr(commands, "START", [sys.executable, str(script)])
    figures = Figures()
    for figures in campaign(20, 1, [Command(("bad",), over_old=False)]):
        if figures.failures:
            break
    assert "neither those before nor those after" in figures.failures[0]
    assert any("after the next run" in failure for failure in figures.failures) is not cure
