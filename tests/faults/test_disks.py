"""Disks that are full and folders that cannot be written: one line, status 2, and every former file as it was."""

from __future__ import annotations

import ctypes
import os
import resource
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from .commands import Command, call, found, lay
from .conftest import Known
from .killing import TEMPORARY, Prepared, faults
from .processes import told

pytestmark = [
    pytest.mark.slow,
    # Mounting a tmpfs and dropping a capability are calls that no other system has.
    pytest.mark.skipif(sys.platform != "linux", reason="a tmpfs is filled and a capability dropped, as Linux can"),
]
CAP_DAC_OVERRIDE, PR_CAPBSET_DROP = 1, 24


def disturbed(
    command: Command, folder: Path, before_start: Callable[[], None] | None = None
) -> subprocess.CompletedProcess[str]:
    return told(call(command.arguments), folder, before_start=before_start)


def must_be_refused(run: subprocess.CompletedProcess[str], folder: Path, prepared: Prepared, reason: str) -> None:
    """In one line or, of several reports, in one for each; with no file lost, cut or left over."""
    assert run.returncode == 2, run.stderr
    lines = run.stderr.splitlines()
    assert lines
    assert [
        line for line in lines if not (line.startswith("verify-design: ") and f"cannot write: {reason}" in line)
    ] == []
    left = found(folder)
    assert [name for name in left if TEMPORARY.fullmatch(name)] == []
    assert faults({name: data for name, data in left.items() if name != "rows/_lock"}, prepared) == []


def test_a_file_that_may_not_grow(command: Command, known: Known, room: Path) -> None:
    prepared = known(command)
    lay(prepared.before, room)
    run = disturbed(command, room, lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100)))
    must_be_refused(run, room, prepared, "File too large")


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of its own, where this user may mount one."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", folder], capture_output=True, check=False
    )
    if mounted.returncode != 0:
        pytest.skip("needs the right to mount a file system")
    yield folder
    subprocess.run(["umount", folder], check=True)


def test_a_full_disk(command: Command, known: Known, small_disk: Path) -> None:
    prepared = known(command)
    lay(prepared.before, small_disk)
    filler = small_disk / "plant.toml.filler"
    with filler.open("wb", buffering=0) as file, suppress(OSError):
        while file.write(bytes(1 << 12)) == 1 << 12:
            pass
    run = disturbed(command, small_disk)
    size = filler.stat().st_size
    filler.unlink()
    must_be_refused(run, small_disk, prepared, "No space left on device")
    assert size > 1 << 20


def without_override() -> None:
    """Let the next program of root obey the modes of folders, as those of others do."""
    if os.geteuid() == 0 and ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0) != 0:
        raise OSError("the right could not be given up")


def test_a_folder_that_is_not_writable(command: Command, known: Known, room: Path) -> None:
    prepared = known(command)
    lay(prepared.before, room)
    folders = [room, *(path for path in room.rglob("*") if path.is_dir())]
    for folder in folders:
        folder.chmod(0o555)
    try:
        run = disturbed(command, room, without_override)
    finally:
        for folder in folders:
            folder.chmod(0o755)
    must_be_refused(run, room, prepared, "Permission denied")


def test_a_read_only_disk(command: Command, known: Known, small_disk: Path) -> None:
    prepared = known(command)
    lay(prepared.before, small_disk)
    subprocess.run(["mount", "-o", "remount,ro", small_disk], check=True)
    must_be_refused(disturbed(command, small_disk), small_disk, prepared, "Read-only file system")


def test_the_next_run_mends_all(command: Command, known: Known, room: Path) -> None:
    """After a limit that let some files pass and others not."""
    prepared = known(command)
    lay(prepared.before, room)
    disturbed(command, room, lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2_000, 2_000)))
    run = disturbed(command, room)
    assert (run.returncode, "Traceback" in run.stderr) == (prepared.status, False)
    assert found(room) == prepared.after
