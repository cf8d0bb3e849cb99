"""Several runs at once on the same outputs: each file is one run's, whole; none is lost, and nothing is left over."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from .commands import Command, call, environment, found, lay
from .conftest import Known
from .processes import NO_LATEX

pytestmark = pytest.mark.slow
RUNS = 3


def test_the_same_run_several_times_at_once(command: Command, known: Known, room: Path) -> None:
    prepared = known(command)
    lay(prepared.before, room)
    runs = [
        subprocess.Popen(
            call(command.arguments),
            cwd=room,
            env=environment(**NO_LATEX),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        for _ in range(RUNS)
    ]
    said = [run.communicate()[1] for run in runs]
    statuses = [run.returncode for run in runs]
    if command.arguments[0] == "sweep":  # one holds the folder, the others say so, or come when all is done
        assert prepared.status in statuses
        refused = [text for status, text in zip(statuses, said, strict=True) if status != prepared.status]
        assert all("another sweep is writing into it" in text and text.count("\n") == 1 for text in refused)
        assert {status for status in statuses if status != prepared.status} <= {2}
    elif (
        command.arguments[0] == "synthesize"
    ):  # a design is never replaced, not even by the same one of a run beside it
        assert prepared.status in statuses
        assert set(statuses) <= {prepared.status, 2}
    else:
        assert statuses == [prepared.status] * RUNS
    assert found(room) == prepared.after
