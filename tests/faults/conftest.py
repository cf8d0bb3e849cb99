"""What each command leaves over a folder of a former run, found once for all faults."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest

from .commands import COMMANDS, Command
from .killing import Prepared, prepare

Known = Callable[[Command], Prepared]


@pytest.fixture(scope="session")
def known(tmp_path_factory: pytest.TempPathFactory) -> Known:
    """The files before and after an undisturbed run of a command."""
    return cache(lambda command: prepare(command, tmp_path_factory.mktemp("known") / "room"))


@pytest.fixture(params=COMMANDS, ids=lambda command: "-".join(command.arguments[:1] + command.arguments[2:3]))
def command(request: pytest.FixtureRequest) -> Iterator[Command]:
    """Each command that writes files."""
    return request.param


@pytest.fixture
def room(tmp_path: Path) -> Path:
    """An empty folder."""
    folder = tmp_path / "room"
    folder.mkdir()
    return folder
