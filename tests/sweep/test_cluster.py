"""Clusters that will not do: each is refused in one line, before any row is computed."""

import socket
import threading
import time
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest

from fomas_verify.sweep.cluster import different
from fomas_verify.sweep.grid import grid_from_mapping
from fomas_verify.sweep.plan import make_plan

from .conftest import parts, wait_until

GRID = {"mu": ["0.1"], "agents": [2, 3]}
SECONDS = 10


def refusal(sweep, write_grid, address: str, tmp_path: Path) -> str:
    """The line on standard error."""
    grid = write_grid({"mu": ["0.1", "0.2"]}, alpha="0.9")
    process = sweep(grid, "-o", tmp_path / "rows", "--scheduler", address)
    out, err = process.communicate()
    assert (process.returncode, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert not parts(tmp_path / "rows")
    return err


@pytest.mark.slow
@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("nowhere", "missing port number in address 'nowhere'"),
        ("", "missing port number"),
        ("tcp://127.0.0.1:1", "nothing did"),
        ("carrier-pigeon://127.0.0.1:8786", "unknown address scheme"),
    ],
)
def test_no_scheduler_there(sweep, write_grid, tmp_path: Path, address: str, words: str) -> None:
    begun = time.monotonic()
    err = refusal(sweep, write_grid, address, tmp_path)
    assert f"--scheduler {address}: expected a Dask scheduler that answers within 4 s" in err
    assert words in err
    assert time.monotonic() - begun < SECONDS


@pytest.mark.slow
@pytest.mark.parametrize("answer", [b"", b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n"])
def test_something_else_listens(sweep, write_grid, tmp_path: Path, answer: bytes) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:

        def listen() -> None:
            while True:
                try:
                    kept.append(server.accept()[0])
                except OSError:
                    return
                kept[-1].sendall(answer)

        kept: list[socket.socket] = []
        threading.Thread(target=listen, daemon=True).start()
        err = refusal(sweep, write_grid, f"tcp://127.0.0.1:{server.getsockname()[1]}", tmp_path)
        server.shutdown(socket.SHUT_RDWR)
    for connection in kept:
        connection.close()
    assert "expected a Dask scheduler that answers within 4 s" in err


@pytest.mark.slow
def test_a_scheduler_without_workers(sweep, write_grid, tmp_path: Path, scheduler: str) -> None:
    assert "expected at least one worker, got none" in refusal(sweep, write_grid, scheduler, tmp_path)


@pytest.mark.slow
def test_a_worker_of_another_version(sweep, write_grid, tmp_path: Path, scheduler: str, worker) -> None:
    """The worker's path begins with the metadata of a version that does not exist."""
    metadata = tmp_path / "path" / "fomas_verify-9.9.9.dist-info" / "METADATA"
    metadata.parent.mkdir(parents=True)
    metadata.write_text("Metadata-Version: 2.1\nName: fomas_verify\nVersion: 9.9.9\n")
    worker(PYTHONPATH=str(tmp_path / "path"))
    err = refusal(sweep, write_grid, scheduler, tmp_path)
    assert "has fomas_verify 9.9.9, this process" in err


@pytest.fixture
def plan():
    return make_plan(grid_from_mapping({"grid": GRID, "alpha": "0.9", "graph": {"family": "path"}}))


def test_versions_that_differ_are_named(plan, monkeypatch) -> None:
    monkeypatch.setattr("platform.python_version", lambda: "3.11.7")
    same = (plan.version, "3.11.2")
    assert different({"a": same, "b": same}, plan) == ""
    assert different({"a": same, "b": ("0.0.9", "3.11.7")}, plan).startswith("b has fomas_verify 0.0.9")
    assert different({"a": (plan.version, "3.12.1")}, plan) == "a has Python 3.12, this process 3.11: expected the same"
    assert "a has no fomas_verify" in different({"a": (PackageNotFoundError(), "3.11.7")}, plan)
    assert different({"a": (TimeoutError(), "3.11.7")}, plan)


@pytest.mark.slow
def test_the_scheduler_is_lost_on_the_way(sweep, cluster, worker, long_grid: Path, tmp_path: Path) -> None:
    folder, (address, process) = tmp_path / "rows", cluster
    worker()
    run = sweep(long_grid, "-o", folder, "--part-rows", 12, "--scheduler", address)
    wait_until(lambda: parts(folder), run)
    process.kill()
    out, err = run.communicate(timeout=60)
    assert (run.returncode, out) == (2, "")
    assert f"{address}: the scheduler was lost" in err
    assert "the same call computes the others" in err
    assert "Traceback" not in err
