"""The mutants of the checker's source against its tests: which are killed, which run out of time, which survive.

The tests are collected and run once, to see which of them reach each line. Then every mutant has a process of its own,
which takes over the mutated code and runs the tests that reach the mutated line until one fails, first those
that are quick and have killed its neighbours. Time is the processor's, not the clock's.
"""

from __future__ import annotations

import gc
import mmap
import os
import resource
import signal
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest
from _pytest.runner import runtestprotocol

from .mutations import Mutation
from .transplant import CHECKER, forget, transplant

SECONDS, TIMES = 1.0, 10
MEMORY = 4 * 2**30


@dataclass(frozen=True)
class Fate:
    """What became of a mutant: `killed`, `timed out` or `survived`."""

    mutation: Mutation
    word: str


class Duel:
    """A pytest plugin that lets the mutants fight where the tests would be run; `fates` says what came of it."""

    def __init__(self, mutants: Sequence[Mutation], jobs: int) -> None:
        self.mutants, self.jobs = mutants, jobs
        self.fates: list[Fate] = []
        self.items: Sequence[pytest.Item] = ()
        self.seconds: list[float] = []
        self.reach: dict[tuple[str, int], list[int]] = {}
        self.kills: Counter[tuple[str, int]] = Counter()
        # One place a mutant, in which its process leaves which test killed it.
        self.board = mmap.mmap(-1, 4 * (len(mutants) + 1))

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        self.items = session.items
        self._survey()
        gc.freeze()
        running: dict[int, int] = {}
        for place in range(len(self.mutants)):
            if len(running) == self.jobs:
                self._await(running)
            running[self._fork(place)] = place
        while running:
            self._await(running)
        return True

    def _survey(self) -> None:
        """Run each test once; see how long it takes and which lines it reaches."""
        import coverage

        trace = coverage.Coverage(data_file=None, config_file=False, include=[f"{CHECKER}/*"])
        trace.start()
        for index, item in enumerate(self.items):
            forget()
            trace.switch_context(str(index))
            start = time.process_time()
            if _fails(item):
                raise pytest.UsageError(f"fails without a mutation: {item.nodeid}")
            self.seconds.append(time.process_time() - start)
        trace.stop()
        data = trace.get_data()
        for file in data.measured_files():
            for line, contexts in data.contexts_by_lineno(file).items():
                self.reach[Path(file).stem, line] = [int(context) for context in contexts]

    def _order(self, mutant: Mutation) -> list[int]:
        """The tests that reach the mutant's line; all, where it is executed at import only."""
        found = self.reach.get((mutant.module, mutant.line), range(len(self.items)))
        near, nearer = mutant.module, f"{mutant.module}.{mutant.function}"
        kills = {index: self.kills[near, index] + 50 * self.kills[nearer, index] for index in found}
        return sorted(found, key=lambda index: self.seconds[index] / (1 + 10 * kills[index]))

    def _fork(self, place: int) -> int:
        process = os.fork()
        if process == 0:
            status = 1
            try:
                status = int(self._dies(place))
            finally:
                os._exit(status)
        return process

    def _dies(self, place: int) -> bool:
        """Whether a test fails, or what the module does at import."""
        mutant = self.mutants[place]
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        signal.signal(signal.SIGVTALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
        transplant(mutant.module, mutant.source)
        for index in self._order(mutant):
            signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS + TIMES * self.seconds[index])
            forget()
            if _fails(self.items[index]):
                self.board[4 * place : 4 * place + 4] = (index + 1).to_bytes(4, "big")
                return True
        return False

    def _await(self, running: dict[int, int]) -> None:
        process, status = os.wait()
        place = running.pop(process)
        killer = int.from_bytes(self.board[4 * place : 4 * place + 4], "big")
        mutant = self.mutants[place]
        for near in (mutant.module, f"{mutant.module}.{mutant.function}") if killer else ():
            self.kills[near, killer - 1] += 1
        word = "survived" if status == 0 else "timed out" if os.WIFSIGNALED(status) else "killed"
        self.fates.append(Fate(mutant, word))


def _fails(item: pytest.Item) -> bool:
    return any(report.failed for report in runtestprotocol(item, log=False, nextitem=None))
