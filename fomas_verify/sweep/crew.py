"""Who computes the parts: this process, others on this machine, or a Dask cluster. None of them writes a file.

No more parts are handed out than keep everyone busy, so a sweep of any length needs little memory.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from typing import Final, Protocol

from fomas_verify.exact.memory import allowed_memory
from fomas_verify.prover.processes import processes
from fomas_verify.sweep.plan import Plan
from fomas_verify.sweep.table import compute_part

TRIES: Final = 3
"""A part whose process is ended this often is given up."""

LOOK_EVERY: Final = 2.0
"""Seconds between two looks at who is there."""

Computed = tuple[int, bytes | None]
"""A part and its bytes; None where the processes that computed it were ended each time."""


class Submit(Protocol):
    """Hands out one part."""

    def __call__(self, part: int, /) -> Future[bytes]:
        """Its bytes, some day."""
        ...


def compute_here(plan: Plan, parts: Iterable[int], jobs: int) -> Iterator[Computed]:
    """Compute parts on so many processes, or in this one; each as soon as it is there, in any order."""
    remaining = list(parts)
    if jobs == 1:
        yield from ((part, compute_part(plan, part)) for part in remaining)
        return
    tries = dict.fromkeys(remaining, 0)
    while remaining:
        lost: list[int] = []
        queue = iter(remaining)
        with processes(min(jobs, len(remaining)), fresh=True) as pool:
            for part, future in in_flight(lambda part: pool.submit(compute_part, plan, part), queue, lambda: 2 * jobs):
                try:
                    yield part, future.result()
                except BrokenExecutor:
                    lost.append(part)
        if lost and allowed_memory() is not None:
            raise MemoryError("a process was ended under a limit of memory")
        for part in lost:
            tries[part] += 1
        yield from ((part, None) for part in lost if tries[part] >= TRIES)
        remaining = [part for part in lost if tries[part] < TRIES] + list(queue)


def in_flight(
    submit: Submit, parts: Iterator[int], slots: Callable[[], int], look: Callable[[], None] = lambda: None
) -> Iterator[tuple[int, Future[bytes]]]:
    """Keep so many parts handed out, and tell each that is done; stops handing out when that fails."""
    running: dict[Future[bytes], int] = {}
    going = True
    while going or running:
        while going and len(running) < slots():
            part = next(parts, None)
            if part is None:
                going = False
                break
            try:
                running[submit(part)] = part
            except BrokenExecutor as error:
                failed: Future[bytes] = Future()
                failed.set_exception(error)
                running[failed], going = part, False
        done, _ = wait(running, timeout=LOOK_EVERY, return_when=FIRST_COMPLETED)
        if not done:
            look()
        for future in done:
            going = going and not (future.cancelled() or isinstance(future.exception(), BrokenExecutor))
            yield running.pop(future), future
