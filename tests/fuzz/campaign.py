"""Workers watched: an input that ends its worker, or keeps it for too long, is a failure, and the next one goes on."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from .seeds import ROOT
from .targets import draw

WALL_SECONDS = 120
"""After which a worker that says nothing is ended; a processor's 10 s end it sooner, unless it sleeps."""

ENDLESS = 10**9
WORKER = ("-m", "tests.fuzz.worker")
FAILURES = ROOT / "build" / "fuzz" / "failures"


@dataclass
class Figures:
    """What came of the inputs of one target."""

    target: str
    seed: int
    outcomes: Counter[str] = field(default_factory=Counter)
    failures: dict[int, str] = field(default_factory=dict)
    longest: tuple[float, int] = (0.0, -1)
    kilobytes: int = 0

    @property
    def inputs(self) -> int:
        """How many were tried."""
        return self.outcomes.total()

    def line(self) -> str:
        """The figures in one line."""
        return (
            f"{self.target}: {self.inputs} inputs (seed {self.seed}), {self.outcomes['refusal']} refusals, "
            f"{self.outcomes['verdict']} verdicts, {len(self.failures)} failures; longest {self.longest[0]:.2f} s "
            f"(input {self.longest[1]}), at most {self.kilobytes // 1024} MB"
        )

    def fail(self, index: int, reason: str) -> None:
        """Keep an input under build/fuzz/failures and go on."""
        self.outcomes["failure"] += 1
        self.failures[index] = reason
        FAILURES.mkdir(parents=True, exist_ok=True)
        stem = FAILURES / f"{self.target}-{self.seed}-{index}"
        stem.with_suffix(".input").write_bytes(draw(self.target, self.seed, index))
        stem.with_suffix(".reason").write_text(f"{reason}\n", encoding="utf-8")


def campaign(target: str, seed: int, *, count: int = ENDLESS, seconds: float = ENDLESS, start: int = 0) -> Figures:
    """Try inputs start, start + 1, ... until so many are tried or the time is over."""
    figures, deadline, index = Figures(target, seed), time.monotonic() + seconds, start
    while index < start + count and time.monotonic() < deadline:
        index = _watch(figures, index, start + count - index, deadline)
    return figures


def _watch(figures: Figures, index: int, count: int, deadline: float) -> int:
    """Follow one worker to its end; the number of the first input that it did not try."""
    command = [sys.executable, *WORKER, figures.target, str(figures.seed), str(index), "1", str(count)]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    under_way: int | None = None
    reason = f"no word in {WALL_SECONDS} s"
    with subprocess.Popen(
        command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    ) as worker:
        for line in _lines(worker):
            word, number, *rest = line.split(" ", 5)
            if word == "start":
                under_way = int(number)
                continue
            _note(figures, int(number), rest)
            under_way, index = None, int(number) + 1
            if time.monotonic() > deadline:
                break
        else:
            try:
                status = worker.wait(timeout=5)
                reason = f"ended by {signal.Signals(-status).name}" if status < 0 else f"left with status {status}"
            except subprocess.TimeoutExpired:
                pass
        worker.kill()
    if under_way is not None and time.monotonic() <= deadline + WALL_SECONDS:
        figures.fail(under_way, reason)
        return under_way + 1
    if under_way is None and worker.returncode not in (0, -signal.SIGKILL):
        raise RuntimeError(f"the worker of {figures.target} does not start")
    return index


def _lines(worker: subprocess.Popen[bytes]) -> Iterator[str]:
    """Its lines, until it ends or says nothing for `WALL_SECONDS`."""
    pending = b""
    while select.select([worker.stdout], [], [], WALL_SECONDS)[0]:
        chunk = os.read(worker.stdout.fileno(), 1 << 16)
        if not chunk:
            return
        *lines, pending = (pending + chunk).split(b"\n")
        yield from (line.decode() for line in lines)


def _note(figures: Figures, index: int, rest: list[str]) -> None:
    outcome, seconds, kilobytes, reason = rest
    figures.kilobytes = max(figures.kilobytes, int(kilobytes))
    figures.longest = max(figures.longest, (float(seconds), index))
    if outcome == "failure":
        figures.fail(index, reason)
    else:
        figures.outcomes[outcome] += 1
