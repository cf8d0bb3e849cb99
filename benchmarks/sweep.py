"""A sweep of designs of five agents, on the local pool and on a Dask cluster: ``python -m benchmarks.sweep [STEPS]``.

Both do the same parts on two processes, one after the other and twice each, so that what else the machine does falls on
both; the ratio is of the medians.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median

from benchmarks.measure import Cost, run

GRAPH = [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]
STEPS = (20, 20, 25)
TIMES = 2
PROCESSES = 2


def write_grid(path: Path, steps: tuple[int, int, int]) -> int:
    """A grid over alpha, gamma and h on the paper's graph; the number of its rows."""
    ends = {"alpha": ("0.5", "0.99"), "gamma": ("0.1", "0.8"), "h": ("0.2", "2")}
    grid = {
        name: {"from": start, "to": end, "steps": count}
        for (name, (start, end)), count in zip(ends.items(), steps, strict=True)
    }
    path.write_text(json.dumps({"grid": grid, "graph": {"adjacency": GRAPH}}))
    return steps[0] * steps[1] * steps[2]


@contextmanager
def cluster(folder: Path) -> Iterator[str]:
    """A scheduler and two workers on loopback, in processes of their own; its address."""
    file, silent = folder / "scheduler.json", {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    where = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file)]
    started = [subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_scheduler", *where], **silent)]
    try:
        while not file.exists() or not file.read_text().endswith("}"):
            time.sleep(0.1)
        address: str = json.loads(file.read_text())["address"]
        options = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(folder)]
        for _ in range(PROCESSES):
            command = [sys.executable, "-m", "distributed.cli.dask_worker", address, *options]
            started.append(subprocess.Popen(command, **silent))
        time.sleep(5)
        yield address
    finally:
        for process in reversed(started):
            process.terminate()
            process.wait()


def rows(steps: tuple[int, int, int] = STEPS) -> Iterator[tuple[str, str, str]]:
    """The measurements: what, the figure, the goal."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        grid = folder / "grid.json"
        count = write_grid(grid, steps)
        here: list[Cost] = []
        there: list[Cost] = []
        with cluster(folder) as address:
            for i in range(TIMES):
                call = ["-m", "fomas_verify", "sweep", str(grid), "-o"]
                there.append(run([*call, str(folder / f"there{i}"), "--scheduler", address]))
                here.append(run([*call, str(folder / f"here{i}"), "--jobs", str(PROCESSES)]))
        size = sum(file.stat().st_size for file in (folder / "here0").glob("part-*"))
    local, dask = median(x.wall for x in here), median(x.wall for x in there)
    designs = f"{count} designs of 5 agents, {PROCESSES} processes"
    yield f"sweep, {designs}", f"{count / local:.0f} designs/s", "at least 50 designs/s"
    yield "sweep, Dask / local pool, wall", f"{dask:.2f} s / {local:.2f} s = {dask / local:.3g}", "below 1.2"
    yield "sweep, bytes a row", f"{size / count:.0f}", ""


def main(steps: int = 0) -> None:
    """Measure and print."""
    for row in rows((steps, steps, steps) if steps else STEPS):
        print(*row, sep="    ")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
