"""Files written whole or not at all: under a temporary name first, then renamed. No output takes a design's place."""

from __future__ import annotations

import os
import re
import secrets
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from fomas_verify.exact.errors import FomasError

_NAME_PART = 40
_LOOKED_AT = 1 << 20
_ALPHA = re.compile(rb'(?:^|[{,\n])\s*"?alpha"?\s*[=:]')
_GRAPH = re.compile(rb'(?:^|[{,\n])\s*(?:"graphs?"\s*:|graphs?\s*[=.]|\[+\s*graphs?\s*[\].])')
_CERTIFICATE = re.compile(rb'"format"\s*:\s*"fomas-certificate/')


class OutputError(FomasError):
    """A file or folder cannot be written; one line: `FILE: why`."""


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


def write_all(contents: Mapping[Path, bytes], *, durable: bool = False) -> None:
    """Write several files as `write_whole` does, none where one cannot be stored; raises `OutputError`."""
    staged: list[tuple[Path, Path]] = []
    try:
        for path, data in contents.items():
            with _refusals_named(path):
                _stage(path, data, staged, durable=durable)
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
        folder.mkdir(parents=True, exist_ok=True)


def remove_file(path: Path) -> None:
    """Remove a file if it exists; raises `OutputError`."""
    with _refusals_named(path):
        path.unlink(missing_ok=True)


def _stage(path: Path, data: bytes, staged: list[tuple[Path, Path]], *, durable: bool) -> None:
    if path.is_dir():
        raise IsADirectoryError(None, "is a directory")
    if path.exists() and not path.is_file():
        path.write_bytes(data)
        return
    target = Path(os.path.realpath(path))
    if _is_a_design(target):
        raise FileExistsError(None, "expected a file of its own, found a design")
    temporary = target.with_name(f".{target.name[:_NAME_PART]}.{secrets.token_hex(8)}.tmp")
    staged.append((temporary, target))
    with temporary.open("xb") as file:
        file.write(data)
        if durable:
            file.flush()
            os.fsync(file.fileno())


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
        raise OutputError(f"{_shown(path)}: cannot write: {reason}") from None


def _shown(path: Path) -> str:
    name = str(path)
    return name if name.isprintable() else repr(name)
