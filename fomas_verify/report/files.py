"""Files written whole or not at all: under a temporary name first, then renamed."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from fomas_verify.exact.errors import FomasError

_NAME_PART = 40


class OutputError(FomasError):
    """A file or folder cannot be written; one line: `FILE: why`."""


def write_whole(path: Path, data: bytes) -> None:
    """Write a file so that a reader sees the former content or the new one, never a part.

    Parameters
    ----------
    path : Path
        A file, new or existing; a symbolic link is followed. What is no regular file, such as ``/dev/stdout``, is
        written to directly.
    data : bytes
        The content.

    Raises
    ------
    OutputError
        It cannot be written; then the former file is unchanged and no temporary file is left.
    """
    write_all({path: data})


def write_all(contents: Mapping[Path, bytes]) -> None:
    """Write several files as `write_whole` does, none where one cannot be stored; raises `OutputError`."""
    staged: list[tuple[Path, Path]] = []
    try:
        for path, data in contents.items():
            with _refusals_named(path):
                _stage(path, data, staged)
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


def _stage(path: Path, data: bytes, staged: list[tuple[Path, Path]]) -> None:
    if path.is_dir():
        raise IsADirectoryError(None, "is a directory")
    if path.exists() and not path.is_file():
        path.write_bytes(data)
        return
    target = Path(os.path.realpath(path))
    temporary = target.with_name(f".{target.name[:_NAME_PART]}.{secrets.token_hex(8)}.tmp")
    staged.append((temporary, target))
    with temporary.open("xb") as file:
        file.write(data)


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
