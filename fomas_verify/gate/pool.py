"""Many designs on several processes, answered in the order of the input.

A process starts once and decides many designs. One that dies is told as an internal error of the design that it was
deciding, and of no other.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

from fomas_verify.exact.errors import source_name
from fomas_verify.exact.memory import allowed_memory
from fomas_verify.gate.deciding import Options, decide
from fomas_verify.gate.model import BROKEN, INTERNAL, Finding, Result
from fomas_verify.prover.processes import processes


def decide_all(paths: Sequence[Path], options: Options, jobs: int) -> Generator[Result, None, None]:
    """Decide designs on so many processes, or in this one where one is enough.

    Parameters
    ----------
    paths : sequence of Path
        The designs' files.
    options : Options
        How each is decided.
    jobs : int
        Processes, at least 1.

    Yields
    ------
    Result
        In the order of the paths, each as soon as those before it are there.
    """
    if min(jobs, len(paths)) <= 1:
        yield from (decide(path, options) for path in paths)
        return
    remaining = list(paths)
    while remaining:
        answered = 0
        with processes(min(jobs, len(remaining))) as pool:
            futures = [pool.submit(decide, path, options) for path in remaining]
            while answered < len(futures) and (result := _result(futures[answered])) is not None:
                yield result
                answered += 1
        remaining = remaining[answered:]
        if remaining:
            yield _alone(remaining.pop(0), options)


def _alone(path: Path, options: Options) -> Result:
    """Decide the first design that was lost with a pool again, to know whether it is the one that ends processes."""
    with processes(1) as pool:
        result = _result(pool.submit(decide, path, options))
    if result is None and allowed_memory() is not None:
        raise MemoryError("a process was ended under a limit of memory")
    return result or _ended(path)


def _result(future: Future[Result]) -> Result | None:
    try:
        return future.result()
    except BrokenProcessPool:
        return None


def _ended(path: Path) -> Result:
    reason = "the process that decided it was ended from outside, or ran out of memory"
    return Result(source_name(path), str(path), findings=(Finding(BROKEN, "", INTERNAL, reason),))
