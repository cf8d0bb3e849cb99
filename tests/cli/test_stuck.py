"""When a process counts as one that asks for memory in vain."""

import os
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from fomas_verify.cli import stuck, supervision
from fomas_verify.cli.stuck import ROOM, SECONDS, Use, Watch, in_vain

SINCE = Use(10.0, 10.0, 1 << 30)
LIMIT = (1 << 30) + ROOM - 1


def test_time_in_the_system_close_to_the_limit_is_in_vain() -> None:
    assert in_vain(SINCE, Use(10.1, 10.0 + SECONDS, 1 << 30), LIMIT)


@pytest.mark.parametrize(
    ("now", "limit"),
    [
        (Use(10.1, 12.0, 1 << 30), None),
        (Use(10.1, 12.0, 1 << 30), LIMIT + 1),
        (Use(10.1, 12.0, (1 << 30) + 4096), LIMIT),
        (Use(10.1, 9.9 + SECONDS, 1 << 30), LIMIT),
        (Use(11.0, 12.0, 1 << 30), LIMIT),
    ],
    ids=["no limit", "room for a buffer", "it was given some", "not long enough", "it works"],
)
def test_anything_else_is_not(now: Use, limit: int | None) -> None:
    assert not in_vain(SINCE, now, limit)


def test_processes_are_seen_by_group_and_a_change_begins_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    uses = [Use(0.0, 0.0, 1 << 30), Use(0.0, 5.0, 1 << 30), Use(0.0, 10.0, 1 << 31), Use(0.0, 15.0, 1 << 31)]
    monkeypatch.setattr(stuck, "_uses", lambda group: [(group, uses.pop(0))])
    monkeypatch.setattr(stuck, "_limit", lambda _: 1 << 31)
    watch = Watch(7)
    assert [watch.stuck() for _ in range(4)] == [False, False, False, True]


# Elsewhere the watch itself reads no limit of another process, so that there is nothing to test.
@pytest.mark.skipif(not hasattr(resource, "prlimit"), reason="only Linux lets one process read another's limit")
def test_a_real_process_is_read() -> None:
    code = (
        "import resource, sys; resource.setrlimit(resource.RLIMIT_AS, (1 << 32, 1 << 32)); print(flush=True); input()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
    ) as process:
        assert process.stdout is not None
        process.stdout.readline()
        ((number, use),) = stuck._uses(process.pid)
        assert number == process.pid
        assert 1 << 20 < use.size < 1 << 32
        assert stuck._limit(process.pid) == 1 << 32
        process.communicate(b"\n")
    assert stuck._limit(process.pid) is None
    assert process.pid not in dict(stuck._uses(os.getpgid(0)))


@pytest.mark.slow
@pytest.mark.parametrize("size", range(160, 480, 40))
def test_numpy_ends_in_whatever_memory(verify: Callable[..., CompletedProcess[str]], size: int) -> None:
    run = verify("simulate", "examples/paper.toml", "--samples", 2, "--memory", f"{size}M")
    assert run.returncode in (0, 3)
    assert bool(run.stdout) is (run.returncode == 0)
    assert run.stderr.count("\n") == (run.returncode == 3)


@pytest.mark.slow
@pytest.mark.parametrize("size", [365, 380, 395])
def test_pyarrow_ends_in_whatever_memory(
    verify: Callable[..., CompletedProcess[str]], size: int, tmp_path: Path
) -> None:
    run = verify("sweep", "examples/sweeps/grid.toml", "--jobs", 1, "-o", tmp_path / "rows", "--memory", f"{size}M")
    assert run.returncode in (0, 3)


@pytest.mark.parametrize(
    ("error", "starved"),
    [
        (SystemError("error return without exception set"), True),
        (KeyboardInterrupt(), True),
        (Exception("Unknown error: Failed to launch worker thread: Resource temporarily unavailable"), True),
        (ValueError("x"), False),
    ],
)
def test_how_libraries_say_that_they_got_no_memory(error: BaseException, starved: bool) -> None:
    assert supervision._starved(error) is starved
