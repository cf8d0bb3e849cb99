"""Optimised Python, warnings as errors, locales, time zones, hash seeds, threads: the same words, files and status."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from .commands import COMMANDS, NEW, Command, Files, environment, found, lay
from .processes import NO_LATEX

pytestmark = pytest.mark.slow
USUAL = {"LC_ALL": "C.UTF-8", "TZ": "UTC", "PYTHONHASHSEED": "0", "COLUMNS": "120"}
CHANGED = {
    "optimised, and warnings are errors": (("-O", "-W", "error"), {}),
    "another place": (
        (),
        {"LC_ALL": "tr_TR.UTF-8", "TZ": "Asia/Kathmandu", "PYTHONHASHSEED": "4242", "COLUMNS": "40", "LANGUAGE": "tr"},
    ),
    "a plain place and two threads": (
        (),
        {"LC_ALL": "C", "TZ": "America/St_Johns", "PYTHONHASHSEED": "random", "NO_COLOR": "1"}
        | {f"{name}_NUM_THREADS": "2" for name in ("OMP", "OPENBLAS", "MKL")},
    ),
}


def outcome(
    command: Command, folder: Path, flags: tuple[str, ...] = (), changed: dict[str, str] | None = None
) -> tuple[int, bytes, bytes, Files]:
    """Status, both streams and the files of a run over the outputs of none."""
    lay(NEW, folder)
    run = subprocess.run(
        [sys.executable, *flags, "-m", "fomas_verify", *command.arguments],
        cwd=folder,
        env=environment(**(NO_LATEX | USUAL | (changed or {}))),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        check=False,
    )
    return run.returncode, run.stdout, run.stderr, found(folder)


@pytest.mark.parametrize(
    "command", COMMANDS, ids=lambda command: "-".join(command.arguments[:1] + command.arguments[2:3])
)
def test_nothing_around_it_changes_what_a_command_does(command: Command, tmp_path: Path) -> None:
    usual = outcome(command, tmp_path / "usual")
    assert usual[0] == 0
    assert len(usual[3]) > 4
    for name, (flags, changed) in CHANGED.items():
        assert (name, outcome(command, tmp_path / name.replace(" ", "-").replace(",", ""), flags, changed)) == (
            name,
            usual,
        )
