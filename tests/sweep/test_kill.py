"""Whatever is killed on the way, each row is there exactly once, and the same as without."""

import io
import os
import signal
from contextlib import suppress
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from fomas_verify.sweep.grid import grid_from_mapping
from fomas_verify.sweep.plan import make_plan
from fomas_verify.sweep.store import part_name
from fomas_verify.sweep.table import compute_part

from .conftest import LONG, PAPER, parts, wait_until

pytestmark = pytest.mark.slow
SIZE = ("--part-rows", 12)
OPTIONS = (*SIZE, "-j", 2)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> dict[str, bytes]:
    """The parts of the same sweep in one process."""
    plan = make_plan(grid_from_mapping({"grid": LONG, "graph": {"adjacency": PAPER}, "alpha": "0.9"}), part_rows=12)
    found = {part_name(part): compute_part(plan, part) for part in range(plan.parts)}
    numbers = [row["row"] for data in found.values() for row in pq.read_table(io.BytesIO(data)).to_pylist()]
    assert numbers == list(range(240))
    return found


def children(pid: int) -> list[int]:
    """The processes that a process started to decide designs."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
            if parent == pid and b"spawn_main" in (folder / "cmdline").read_bytes():
                found.append(int(folder.name))
    return found


def test_the_run_is_killed_and_started_again(sweep, long_grid: Path, tmp_path: Path, undisturbed) -> None:
    folder = tmp_path / "rows"
    first = sweep(long_grid, "-o", folder, *OPTIONS)
    wait_until(lambda: len(parts(folder)) >= 2, first)
    orphans = children(first.pid)
    assert len(orphans) == 2
    first.kill()
    first.wait()
    before = parts(folder)
    assert 2 <= len(before) < len(undisturbed)
    second = sweep(long_grid, "-o", folder, *OPTIONS)
    _, err = second.communicate()
    assert (second.returncode, err) == (0, "")
    assert parts(folder) == undisturbed
    assert before.items() <= undisturbed.items()
    wait_until(lambda: not any(map(alive, orphans)))


def alive(pid: int) -> bool:
    """Whether a process is there, and no zombie that nobody has collected."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_a_process_of_the_pool_is_killed(sweep, long_grid: Path, tmp_path: Path, undisturbed) -> None:
    folder = tmp_path / "rows"
    process = sweep(long_grid, "-o", folder, *OPTIONS)
    wait_until(lambda: parts(folder), process)
    os.kill(children(process.pid)[0], signal.SIGKILL)
    process.communicate()
    assert process.returncode == 0
    assert parts(folder) == undisturbed


def test_a_worker_of_the_cluster_is_killed(
    sweep, scheduler: str, worker, long_grid: Path, tmp_path: Path, undisturbed
) -> None:
    folder = tmp_path / "rows"
    first, _ = worker(), worker()
    process = sweep(long_grid, "-o", folder, *SIZE, "--scheduler", scheduler)
    wait_until(lambda: len(parts(folder)) >= 2, process)
    assert len(parts(folder)) < len(undisturbed)
    first.kill()
    _, err = process.communicate()
    assert (process.returncode, err) == (0, "")
    assert parts(folder) == undisturbed


def test_the_run_on_the_cluster_is_killed_and_started_again(
    sweep, scheduler: str, worker, long_grid: Path, tmp_path: Path, undisturbed
) -> None:
    folder = tmp_path / "rows"
    worker()
    first = sweep(long_grid, "-o", folder, *SIZE, "--scheduler", scheduler)
    wait_until(lambda: len(parts(folder)) >= 2, first)
    first.kill()
    first.wait()
    assert len(parts(folder)) < len(undisturbed)
    second = sweep(long_grid, "-o", folder, "--scheduler", scheduler)
    second.communicate()
    assert second.returncode == 0
    assert parts(folder) == undisturbed
