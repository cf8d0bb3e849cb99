"""The folder of a sweep: a Parquet dataset of parts, ``_sweep.json``, which says whose they are, and a lock.

A part is there whole or not at all, under a name that its number gives; so a sweep goes on where it ended, however that
was. Only the process that holds the lock writes.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.plan import Plan
from fomas_verify.sweep.table import is_whole

MANIFEST: Final = "_sweep.json"
LOCK: Final = "_lock"
FORMAT: Final = "fomas-sweep/1"

_UNFINISHED = re.compile(r"\.(part-\d+\.parquet|_sweep\.json)\.[0-9a-f]{16}\.tmp")
Write = Callable[[Path, bytes], None]


def part_name(part: int) -> str:
    """The name of a part's file."""
    return f"part-{part:08d}.parquet"


def known_part_rows(folder: Path) -> int | None:
    """The rows of a part in a folder where a sweep was begun; None where none was."""
    manifest = _manifest(folder)
    rows = None if manifest is None else manifest.get("plan", {}).get("part_rows")
    return rows if isinstance(rows, int) and rows > 0 else None


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the folder, which exists; the system lets go of it when the process ends.

    Raises
    ------
    SweepError
        Another process holds it, or there are files and no sweep in it, which then stays as it is.
    """
    names = {entry.name for entry in folder.iterdir() if not _UNFINISHED.fullmatch(entry.name)} - {LOCK}
    if names and MANIFEST not in names:
        raise SweepError(f"{folder}: expected an empty folder or one of this sweep, found {min(names)}")
    try:
        file = (folder / LOCK).open("ab")
    except OSError as error:
        raise SweepError(f"{folder}: cannot write: {error.strerror}") from None
    with file:
        if not _acquired(file.fileno()):
            raise SweepError(f"{folder}: another sweep is writing into it: wait for its end, or give another -o DIR")
        yield


def open_for(plan: Plan, folder: Path, write: Write) -> list[int]:
    """Make a locked folder ready for the parts of a plan.

    Returns
    -------
    list of int
        The parts that are still missing, in order.

    Raises
    ------
    SweepError
        The folder holds rows of another grid, or other files beside them.
    """
    for entry in sorted(folder.iterdir()):
        if _UNFINISHED.fullmatch(entry.name):
            entry.unlink(missing_ok=True)
    manifest = _manifest(folder)
    names = {entry.name for entry in folder.iterdir()} - {MANIFEST, LOCK}
    if manifest is None:
        text = json.dumps({"format": FORMAT, "digest": plan.digest, "plan": plan.content}, indent=1)
        write(folder / MANIFEST, text.encode())
    else:
        _must_be_of(plan, folder, manifest)
    wanted = {part_name(part): part for part in range(plan.parts)}
    if others := names - set(wanted):
        raise SweepError(f"{folder}: expected the parts of this sweep only, found {min(others)}")
    return [part for name, part in wanted.items() if name not in names or not is_whole(plan, part, folder / name)]


def _manifest(folder: Path) -> dict[str, Any] | None:
    path = folder / MANIFEST
    try:
        found = json.loads(path.read_bytes())
    except FileNotFoundError:
        return None
    except OSError as error:
        raise SweepError(f"{path}: expected a readable file: {error.strerror}") from None
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict) or found.get("format") != FORMAT or not isinstance(found.get("plan"), dict):
        raise SweepError(f"{path}: expected the description of a sweep ({FORMAT}), got something else")
    return found


def _must_be_of(plan: Plan, folder: Path, manifest: dict[str, Any]) -> None:
    if manifest.get("digest") == plan.digest:
        return
    before = manifest["plan"]
    if before.get("version") != plan.version:
        other = f"of fomas_verify {before.get('version')}, this is {plan.version}"
    elif before.get("claims") != plan.content["claims"]:
        other = "of other --claims"
    elif before | {"part_rows": plan.part_rows} == plan.content:
        other = f"in parts of {before.get('part_rows')} rows"
    else:
        other = "of another grid"
    raise SweepError(f"{folder}: holds rows {other}; nothing was changed: give another -o DIR")


def _acquired(descriptor: int) -> bool:
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return os.fstat(descriptor).st_nlink > 0
