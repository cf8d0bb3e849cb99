"""Commands killed at random moments: each file is the former one or the new one, and the next run mends all.

Half of the kills come at a moment drawn from the length of an undisturbed run, and half as soon as a temporary file is
seen, or a little later: between the first byte written and the last file renamed there is less than a millisecond.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from .commands import COMMANDS, NEW, OLD, Command, Files, found, lay
from .processes import Run, run_afresh, run_forked, start_afresh, start_forked

TEMPORARY = re.compile(r"(.*/)?\.[^/]{1,40}\.[0-9a-f]{16}\.tmp")
_LOCK = "rows/_lock"


@dataclass(frozen=True)
class Prepared:
    """What stands in the folder before and after an undisturbed run, and how long that takes."""

    command: Command
    before: Files
    after: Files
    status: int
    seconds: float


@dataclass
class Figures:
    """What came of the kills."""

    kills: int = 0
    during: Counter[str] = field(default_factory=Counter)
    failures: list[str] = field(default_factory=list)

    def line(self) -> str:
        """The figures in one line."""
        states = ", ".join(f"{count} {name}" for name, count in sorted(self.during.items()))
        return f"{self.kills} kills ({states}), {len(self.failures)} failures"


def prepare(command: Command, folder: Path, end: Run = run_afresh) -> Prepared:
    """Run a command on the old inputs, then on the new ones over what that left, twice: the bytes must be the same."""
    lay(OLD, folder)
    if command.over_old:
        _must_work(command, folder, end)
    lay(NEW, folder)
    before = found(folder)
    began = time.monotonic()
    status = _must_work(command, folder, end)
    seconds = time.monotonic() - began
    after = found(folder)
    again = folder.with_name(f"{folder.name}-again")
    lay(before, again)
    _must_work(command, again, end)
    if after != found(again):
        raise AssertionError(f"{command.name}: two runs differ: {_differing(after, found(again))}")
    if not set(after) - set(NEW) or (command.over_old and before == after):
        raise AssertionError(f"{command.name}: the new run leaves what the old one left")
    return Prepared(command, before, after, status, seconds)


def _must_work(command: Command, folder: Path, end: Run) -> int:
    status, errors = end(command, folder)
    if status not in (0, 1):
        raise AssertionError(f"{command.name}: status {status}: {errors}")
    return status


def campaign(kills: int, seed: int, commands: list[Command] = COMMANDS, forked: float = 0) -> Iterator[Figures]:
    """Kill so many times, and tell after each what came of all so far; `forked`: which share is forked."""
    random, figures = Random(f"kills {seed}"), Figures()
    with tempfile.TemporaryDirectory(prefix="faults-") as room:
        ready: dict[str, Prepared] = {}
        while figures.kills < kills:
            (command,) = random.choices(commands, [command.weight for command in commands])
            if command.name not in ready:
                place = Path(room) / f"prepared-{len(ready)}"
                ready[command.name] = prepare(command, place, run_forked if forked else run_afresh)
            folder = Path(room) / f"kill-{figures.kills}"
            _one(ready[command.name], folder, random, figures, forked=random.random() < forked)
            shutil.rmtree(folder)
            figures.kills += 1
            yield figures


def _one(prepared: Prepared, folder: Path, random: Random, figures: Figures, *, forked: bool) -> None:
    """Kill once, or twice in a row, look at what is left, and run to the end."""
    lay(prepared.before, folder)
    where = f"kill {figures.kills} ({prepared.command.name})"
    leftovers: set[str] = set()
    for _ in range(random.choice((1, 1, 1, 2))):
        _kill(prepared, folder, random, (start_forked if forked else start_afresh)(prepared.command, folder))
        left = found(folder)
        leftovers |= set(filter(TEMPORARY.fullmatch, left))
        figures.during[_state(left, prepared)] += 1
        figures.failures += [f"{where}: {fault}" for fault in faults(left, prepared)]
    status, errors = (run_forked if forked else run_afresh)(prepared.command, folder)
    if status != prepared.status or "Traceback" in errors:
        figures.failures.append(f"{where}: the next run: status {status}: {errors!r}")
    if (last := found(folder)) != prepared.after:
        figures.failures.append(f"{where}: after the next run: {_differing(last, prepared.after)}")


def faults(left: Files, prepared: Prepared) -> list[str]:
    """What is neither the former content nor the new one, what is gone, and what nobody asked for."""
    found_faults = []
    for name, data in left.items():
        known = [files[name] for files in (prepared.before, prepared.after) if name in files]
        if not known and not TEMPORARY.fullmatch(name):
            found_faults.append(f"{name}: nobody asked for it")
        elif known and data not in known:
            found_faults.append(f"{name}: {len(data)} bytes, neither those before nor those after")
    return found_faults + [f"{name}: gone" for name in prepared.before if name not in left]


def _state(left: Files, prepared: Prepared) -> str:
    if any(TEMPORARY.fullmatch(name) for name in left):
        return "with temporaries"
    if left in (prepared.before, prepared.after):
        return "before any output" if left == prepared.before else "after the last"
    return "between outputs"


def _kill(prepared: Prepared, folder: Path, random: Random, pid: int) -> None:
    """Kill a process, alone or with its children, and wait until it is gone."""
    if random.random() < 0.5:
        time.sleep(random.uniform(0, 1.05 * prepared.seconds))
    else:
        _until_something_is_written(pid, folder, set(prepared.before))
        time.sleep(random.choice((0, 0, random.uniform(0, 0.002), random.uniform(0, 0.02))))
    if random.random() < 0.5:
        os.kill(pid, signal.SIGKILL)
    with suppress(ProcessLookupError):
        os.killpg(pid, signal.SIGKILL)
    os.waitpid(pid, 0)


def _until_something_is_written(pid: int, folder: Path, before: set[str]) -> None:
    """Wait for a file that was not there, or for the end."""
    while os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
        for parent, _, names in os.walk(folder):
            inside = os.path.relpath(parent, folder)
            if any(os.path.normpath(f"{inside}/{name}") not in before | {_LOCK} for name in names):
                return


def _differing(left: Files, right: Files) -> list[str]:
    return sorted(name for name in left.keys() | right.keys() if left.get(name) != right.get(name))
