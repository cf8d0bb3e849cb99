"""A sweep from its plan to its rows on disk."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from fomas_verify.sweep.cluster import compute_there
from fomas_verify.sweep.crew import TRIES, compute_here
from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.plan import Plan
from fomas_verify.sweep.store import Write, locked, open_for, part_name
from fomas_verify.sweep.table import need_pyarrow


class LostPartsError(SweepError):
    """Some rows were never decided: the processes that tried were ended each time."""

    exit_status = 4


@dataclass(frozen=True)
class Listener:
    """Who is told how far it is: rows that are on disk, of all, and words for the user."""

    rows: Callable[[int, int], None]
    say: Callable[[str], None]


def run_sweep(plan: Plan, folder: Path, write: Write, listener: Listener, *, jobs: int, scheduler: str | None) -> None:
    """Compute the parts that a folder lacks, and write each as it comes.

    Parameters
    ----------
    plan : Plan
        What to compute.
    folder : Path
        An existing folder, empty or of this plan.
    write : callable
        Writes a file whole or not at all.
    listener : Listener
        Told at the start and after each part.
    jobs : int
        Processes on this machine, where there is no scheduler.
    scheduler : str or None
        Address of a Dask scheduler.

    Raises
    ------
    SweepError
        The folder or the cluster will not do; `LostPartsError` at the end where parts were given up.
    """
    need_pyarrow()
    with locked(folder):
        missing = open_for(plan, folder, write)
        done = plan.grid.rows - sum(len(plan.rows_of(part)) for part in missing)
        listener.rows(done, plan.grid.rows)
        if not missing:
            return
        computed = (
            compute_there(plan, missing, scheduler, listener.say)
            if scheduler is not None
            else compute_here(plan, missing, jobs)
        )
        lost = []
        for part, data in computed:
            if data is None:
                lost.append(part)
                continue
            write(folder / part_name(part), data)
            done += len(plan.rows_of(part))
            listener.rows(done, plan.grid.rows)
    if lost:
        rows = plan.rows_of(min(lost))
        raise LostPartsError(
            f"{folder}: {len(lost)} parts are missing, the first with the rows {rows[0]} to {rows[-1]}: the processes "
            f"that decided them were ended {TRIES} times, perhaps out of memory; the same call tries them again"
        )
