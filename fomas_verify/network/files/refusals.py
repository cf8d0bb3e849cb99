"""What is refused of a graph file, worded in one place.

Each message is one line `FILE: place: expected ..., got ...`.
"""

from __future__ import annotations

import stat
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Final

from fomas_verify.exact.errors import MissingExtraError
from fomas_verify.exact.rational import excerpt
from fomas_verify.network.digraph import GraphError

_HEAD: Final = 256
# What a compressed file may unpack to: so many bytes, or so many times its own size.
UNPACKED_BYTES: Final = 1 << 27
UNPACKED_TIMES: Final = 4
# How files begin that are taken for one another.
_BEGINNINGS: Final = (
    (b"%%MatrixMarket", "a Matrix Market file"),
    (b"%matrixmarket", "a Matrix Market file"),
    (b"PK\x03\x04", "a zip archive, as .npz is"),
    (b"\x93NUMPY", "a .npy array"),
    (b"MATLAB ", "a MATLAB file"),
    (b"\x89HDF", "an HDF5 file"),
    (b"\x89PNG", "a PNG image"),
    (b"%PDF", "a PDF file"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"PAR1", "a Parquet file"),
    (b"graph [", "a GML file"),
    (b"{", "JSON"),
)


class GraphFileError(GraphError):
    """A graph file, or a graph object, is not what it has to be; one line."""


def refused(name: str, expected: str, got: str) -> GraphFileError:
    """The refusal of what stands in the file or object `name`."""
    return GraphFileError(f"{name}: expected {expected}, got {got}")


def need_extra(*modules: str) -> None:
    """Raise `MissingExtraError` where a module of the extra `graphs` is not installed."""
    for module in modules:
        try:
            import_module(module)
        except ImportError:
            raise MissingExtraError(
                f"graph files need {module.partition('.')[0]}, which the extra `graphs` brings: "
                "pip install 'fomas_verify[graphs]'"
            ) from None


def must_be_file(path: Path, name: str) -> None:
    """Refuse what is missing, no regular file, empty or not to be read."""
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            kind = "a directory" if stat.S_ISDIR(status.st_mode) else "a device, pipe or socket"
            raise refused(name, "a file", kind)
        if status.st_size == 0:
            raise refused(name, "a graph", "an empty file")
        with path.open("rb") as file:
            file.read(1)
    except FileNotFoundError:
        raise refused(name, "a file", "no such file") from None
    except OSError as error:
        raise refused(name, "a readable file", (error.strerror or "an error of the system").lower()) from None


def must_unpack_small(path: Path, name: str, sizes: Iterable[int]) -> None:
    """Refuse a compressed file whose parts, added as they come, would fill memory: a megabyte may hold a thousand."""
    limit, total = max(UNPACKED_BYTES, UNPACKED_TIMES * path.stat().st_size), 0
    for size in sizes:
        total += size
        if total > limit:
            raise refused(name, f"at most {limit} bytes unpacked", "more: save it as a sparse matrix, or uncompressed")


def begins_like(path: Path) -> str:
    """What a file is by its first bytes; empty where they do not tell."""
    with path.open("rb") as file:
        head = file.read(_HEAD).lstrip(b"\xef\xbb\xbf \t\r\n")
    for beginning, kind in _BEGINNINGS:
        if head.lower().startswith(beginning.lower()):
            return kind
    if head.startswith(b"<"):
        return "GraphML or other XML"
    return ""


def lies(path: Path, name: str, expected: str, reason: str = "") -> GraphFileError:
    """The refusal of a file that is not of the format that its name promises, or is damaged."""
    kind = begins_like(path)
    words = " ".join(reason.split())
    return refused(name, expected, kind or (f"something else: {excerpt(words)}" if words else "something else"))


def damaged(path: Path, name: str, expected: str, kind: str, reason: str) -> GraphFileError:
    """The refusal of a file that begins as a sound one does, `kind`, and is not; of any other as `lies` says."""
    if begins_like(path) == kind:
        return refused(name, f"{expected} that is whole", f"a damaged one: {excerpt(reason)}")
    return lies(path, name, expected, reason)


@contextmanager
def reading(path: Path, name: str, expected: str, kind: str) -> Iterator[None]:
    """Turn whatever a library raises or warns of while it reads into one refusal.

    `kind` is what `begins_like` says of a sound file.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)
            warnings.simplefilter("ignore", DeprecationWarning)
            yield
    except GraphError:
        raise
    except MemoryError:
        raise refused(name, expected, "one that asks for more memory than there is") from None
    except Exception as error:  # a damaged file can make a library raise anything
        words = " ".join(f"{error}".split()) or type(error).__name__
        raise damaged(path, name, expected, kind, words) from None
