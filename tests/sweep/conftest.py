"""Sweeps as a user starts them, and a Dask cluster on loopback that the test starts and stops."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pyarrow.parquet as pq
import pytest

PAPER = [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]
LONG = {"gamma": {"from": "0.1", "to": "0.5", "steps": 16}, "h": {"from": "0.6", "to": "2", "steps": 15}}
PATIENCE = 120


def wait_until(happened: Callable[[], object], process: subprocess.Popen | None = None) -> None:
    """Fail where it has not happened while the process runs."""
    for _ in range(PATIENCE * 50):
        if happened():
            return
        assert process is None or process.poll() is None, "it ended before"
        time.sleep(0.02)
    pytest.fail("it did not happen")


def parts(folder: Path) -> dict[str, bytes]:
    """The files of a dataset."""
    return {file.name: file.read_bytes() for file in sorted(folder.glob("part-*.parquet"))}


def rows(folder: Path) -> list[dict]:
    """Every row, in the order of the files."""
    return [row for file in sorted(folder.glob("part-*.parquet")) for row in pq.read_table(file).to_pylist()]


@pytest.fixture
def write_grid(tmp_path: Path) -> Callable[..., Path]:
    """Write a grid file of the paper's graph, or of other keys."""

    def write(grid: dict, **keys: object) -> Path:
        path = tmp_path / "grid.json"
        path.write_text(json.dumps({"grid": grid, "graph": {"adjacency": PAPER}, **keys}))
        return path

    return write


@pytest.fixture
def long_grid(write_grid) -> Path:
    """Designs that take seconds in all, so that a sweep can be ended on the way."""
    return write_grid(LONG, alpha="0.9")


@pytest.fixture
def start() -> Iterator[Callable[..., subprocess.Popen]]:
    """Start a process of this interpreter; killed at the end of the test where it still runs."""
    running = []

    def begin(*arguments: object, **environment: str) -> subprocess.Popen:
        process = subprocess.Popen(
            [sys.executable, *map(str, arguments)],
            env={**os.environ, **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        running.append(process)
        return process

    yield begin
    for process in reversed(running):
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
        process.communicate()


@pytest.fixture
def sweep(start) -> Callable[..., subprocess.Popen]:
    """Start a sweep."""
    return lambda *arguments: start("-m", "fomas_verify", "sweep", *arguments)


@pytest.fixture
def cluster(start, tmp_path: Path) -> tuple[str, subprocess.Popen]:
    """A Dask scheduler on loopback: its address and its process."""
    file = tmp_path / "scheduler.json"
    where = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", file)
    process = start("-m", "distributed.cli.dask_scheduler", *where)
    wait_until(lambda: file.exists() and file.read_text().endswith("}"), process)
    return json.loads(file.read_text())["address"], process


@pytest.fixture
def scheduler(cluster) -> str:
    """The address of a Dask scheduler in a process of its own."""
    return cluster[0]


@pytest.fixture
def worker(start, scheduler: str, tmp_path: Path) -> Callable[..., subprocess.Popen]:
    """Start a worker of it."""
    options = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", tmp_path / "workers")
    return lambda **environment: start("-m", "distributed.cli.dask_worker", scheduler, *options, **environment)
