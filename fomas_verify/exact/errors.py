"""The base of the project's own errors, how they name a file, and whether an error says that memory ran out."""

import errno
from os import PathLike, fspath
from typing import ClassVar

_NO_ROOM = ("failed to map segment", "cannot allocate memory", "can't start new thread", "unable to allocate")
"""What the loader of libraries, the C library and Python say, in errors that have another type than MemoryError."""


class FomasError(Exception):
    """Base class: what went wrong is one line of text, written for the user; the command ends with ``exit_status``."""

    exit_status: ClassVar[int] = 2


class MissingExtraError(FomasError):
    """A library of an extra is not installed; the message says which, and how to install it."""


def source_name(path: str | PathLike[str]) -> str:
    """Return the name by which messages call a file: its path, quoted where that would not be one printable line."""
    name = fspath(path)
    return name if name.isprintable() else repr(name)


def out_of_memory(error: BaseException) -> bool:
    """Whether this error, or one that led to it, is that there was no memory left."""
    seen: BaseException | None = error
    while seen is not None:
        if isinstance(seen, MemoryError) or (isinstance(seen, OSError) and seen.errno == errno.ENOMEM):
            return True
        words = str(seen).lower()
        if isinstance(seen, ImportError | RuntimeError | OSError) and any(part in words for part in _NO_ROOM):
            return True
        seen = seen.__cause__ or seen.__context__
    return False
