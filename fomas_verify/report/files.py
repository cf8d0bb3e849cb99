"""Files written whole or not at all: under a temporary name first, then renamed. No output takes a design's place.

A process that is killed leaves `.NAME.<16 hex digits>.tmp`. Whoever writes holds a lock on it, which the system lets go
of when the process ends; so the next process that writes NAME knows what is left over, and removes it.

A run that may be ended by a limit holds its files back: they keep their temporary names until it has ended, and whoever
watches over it is told every name before it is made, to remove it where the run does not end by itself.
"""

from __future__ import annotations

import os
import re
import secrets
import stat
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from functools import cache
from io import FileIO
from itertools import chain
from pathlib import Path

from fomas_verify.exact.errors import FomasError, source_name
from fomas_verify.exact.inputs import was_read

_NAME_PART = 40
_UNFINISHED = re.compile(r"\.(.{0,40})\.[0-9a-f]{16}\.tmp", re.DOTALL)
_LOOKED_AT = 1 << 20
_ALPHA = re.compile(rb"""(?:^|[{,\n])\s*(?:["']?grid["']?\s*\.\s*)?["']?alpha["']?\s*[=:]""")
_GRAPH = re.compile(rb"""(?:^|[{,\n])\s*(?:["']?graphs?["']?\s*[:=.]|\[+\s*["']?graphs?["']?\s*[\].])""")
_CERTIFICATE = re.compile(rb'"format"\s*:\s*"fomas-certificate/')


@dataclass
class Held:
    """What is held back: each file under its temporary name, with the path it is meant for; None in place of the first
    where a file is to be removed. The files stay open, and so locked, until the process ends.
    """

    tell: Callable[[Path], None]
    names: bool
    files: list[tuple[Path | None, Path]] = field(default_factory=list)
    locks: ExitStack = field(default_factory=ExitStack)


_held: Held | None = None


class OutputError(FomasError):
    """A file or folder cannot be written; one line: `FILE: why`."""


def hold_back(tell: Callable[[Path], None], *, names: bool = True) -> Held:
    """From now on tell each path that is made; with ``names`` nothing takes its own name before `release`."""
    global _held  # noqa: PLW0603  # this process writes for one run, which is watched or is not
    _held = Held(tell, names)
    if names and sys.platform != "win32":
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
        with suppress(OSError, ValueError):  # each file stays open, and so locked, until all of them have their names
            resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    return _held


def release(files: Iterable[tuple[Path | None, Path]]) -> None:
    """Give files that were held back their names; raises `OutputError`."""
    for temporary, path in files:
        with _refusals_named(path):
            if temporary is None:
                path.unlink(missing_ok=True)
            elif temporary.parent != path.parent:  # no regular file, so that no name can be given
                path.write_bytes(temporary.read_bytes())
            else:
                temporary.replace(path)


def write_whole(path: Path, data: bytes, *, durable: bool = False) -> None:
    """Write a file so that a reader sees the former content or the new one, never a part.

    Parameters
    ----------
    path : Path
        A file, new or existing; a symbolic link is followed. What is no regular file, such as ``/dev/stdout``, is
        written to directly.
    data : bytes
        The content.
    durable : bool
        Wait until the disk has it, so that it is whole after a loss of power too.

    Raises
    ------
    OutputError
        It cannot be written, or a design stands there; then the former file is unchanged and no temporary file is
        left.
    """
    write_all({path: data}, durable=durable)


def write_all(*contents: Mapping[Path, bytes | Iterable[bytes]], durable: bool = False) -> None:
    """Write several files, whole or part after part, as `write_whole` does, none where one cannot be stored, or two are
    the same file; raises `OutputError`.
    """
    staged: list[tuple[Path, Path]] = []
    taken: set[Path] = set()
    with ExitStack() as files:
        try:
            for path, data in chain.from_iterable(x.items() for x in contents):
                with _refusals_named(path):
                    _stage(path, data, staged, taken, files, durable=durable)
            if _held is not None and _held.names:
                _held.files += staged
                _held.locks.push(files.pop_all())
                staged.clear()
            while staged:
                temporary, path = staged[0]
                with _refusals_named(path):
                    temporary.replace(path)
                del staged[0]
        finally:
            for temporary, _ in staged:
                with suppress(OSError):
                    temporary.unlink(missing_ok=True)


def make_folder(folder: Path) -> None:
    """Make a folder and those above it where they are missing; raises `OutputError`."""
    with _refusals_named(folder):
        if _held is not None:
            for missing in reversed([x for x in (folder, *folder.parents) if not x.exists()]):
                _held.tell(missing)
        folder.mkdir(parents=True, exist_ok=True)


def remove_file(path: Path) -> None:
    """Remove a file if it exists; raises `OutputError`."""
    with _refusals_named(path):
        if _held is not None and _held.names:
            _held.files.append((None, path))
        else:
            path.unlink(missing_ok=True)


def _stage(
    path: Path,
    data: bytes | Iterable[bytes],
    staged: list[tuple[Path, Path]],
    taken: set[Path],
    files: ExitStack,
    *,
    durable: bool,
) -> None:
    if path.is_dir():
        raise IsADirectoryError(None, "is a directory")
    parts = (data,) if isinstance(data, bytes) else data
    if path.exists() and (not path.is_file() or _is_held_output(path)):
        if _held is None or not _held.names:
            with path.open("wb") as device:
                device.writelines(parts)
            return
        target, place = path, Path(tempfile.gettempdir(), path.name)
    else:
        target = place = Path(os.path.realpath(path))
        if _is_a_design(target):
            raise FileExistsError(None, "expected a file of its own, found a design")
        if was_read(target):
            raise FileExistsError(None, "expected a file of its own, found what this run reads")
        if target in taken:
            raise FileExistsError(None, "expected a file of its own, found another output of this run")
        taken.add(target)
        _remove_leftovers(target)
    temporary, file = _locked_temporary(place)
    files.enter_context(file)
    staged.append((temporary, target))
    for part in parts:
        rest = memoryview(part)
        while rest:
            rest = rest[file.write(rest) :]
    if durable:
        os.fsync(file.fileno())
    if sys.platform == "win32":
        file.close()  # an open file cannot be renamed there


def _locked_temporary(target: Path) -> tuple[Path, FileIO]:
    """A new file beside the target, open and locked; a further one where it was taken for a leftover before the lock.

    It has no buffer: closing it writes nothing, and so cannot fail.
    """
    while True:
        temporary = target.with_name(f".{target.name[:_NAME_PART]}.{secrets.token_hex(8)}.tmp")
        if _held is not None:
            _held.tell(temporary)
        file = temporary.open("xb", buffering=0)
        _lock(file.fileno(), wait=True)
        if os.fstat(file.fileno()).st_nlink or sys.platform == "win32":
            return temporary, file
        file.close()


def _remove_leftovers(target: Path) -> None:
    """Remove the temporaries of this name that no living process holds."""
    if sys.platform == "win32":
        return
    for name in _unfinished(target.parent).get(target.name[:_NAME_PART], ()):
        with suppress(OSError):
            # Opened for writing, because some network file systems lock nothing else.
            descriptor = os.open(target.with_name(name), os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
            try:
                if stat.S_ISREG(os.fstat(descriptor).st_mode) and _lock(descriptor, wait=False):
                    target.with_name(name).unlink()
            finally:
                os.close(descriptor)


@cache
def _unfinished(folder: Path) -> dict[str, list[str]]:
    """The temporaries by target when this process first wrote there: a folder is listed once, not for each file."""
    found: dict[str, list[str]] = {}
    with suppress(OSError):  # a folder may be writable and not readable
        for path in folder.iterdir():
            if match := _UNFINISHED.fullmatch(path.name):
                found.setdefault(match[1], []).append(path.name)
    return found


def _lock(descriptor: int, *, wait: bool) -> bool:
    """Whether a file is ours now; a file system without locks has none, and then nothing is removed."""
    if sys.platform == "win32":
        return False
    import fcntl

    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX if wait else fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _is_held_output(path: Path) -> bool:
    """Whether this is ``/dev/stdout`` or the like, which is a regular file only while output is held back."""
    return _held is not None and any(os.path.samestat(path.stat(), os.fstat(number)) for number in (1, 2))


def _is_a_design(path: Path) -> bool:
    """Whether a file that exists looks like a design by its keys; a user has no other copy of it."""
    if not path.exists():
        return False
    with path.open("rb") as file:
        start = file.read(_LOOKED_AT)
    keys = _ALPHA.search(start) is not None and _GRAPH.search(start) is not None
    return keys and _CERTIFICATE.search(start) is None


@contextmanager
def _refusals_named(path: Path) -> Iterator[None]:
    try:
        yield
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise OutputError(f"{source_name(path)}: cannot write: {reason}") from None
