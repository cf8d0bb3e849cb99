"""MATLAB files of version 4 to 7.2: the square matrix in them, full or sparse, by scipy in a process of its own."""

from __future__ import annotations

import io
import json
import struct
import subprocess
import sys
import zlib
from collections.abc import Iterator
from os import SEEK_CUR
from pathlib import Path
from typing import Any, Final

from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.matrices import entries_of_matrix
from fomas_verify.network.files.refusals import damaged, must_unpack_small, need_extra, reading, refused
from fomas_verify.network.files.variables import choose

EXPECTED: Final = "a MATLAB file"

_HEADER: Final = 128
_COMPRESSED: Final = 15
_PIECE: Final = 1 << 20

_CHILD = Path(__file__).with_name("matlab_child.py")


def read(path: Path, name: str, variable: str | None = None) -> Entries:
    """Read the square matrix of a MATLAB file; raises `GraphFileError`."""
    need_extra("numpy", "scipy.io")
    with reading(path, name, EXPECTED, EXPECTED):
        must_unpack_small(path, name, _unpacked_sizes(path))
    call = [sys.executable, "-I", str(_CHILD), str(path.resolve()), *([] if variable is None else [variable])]
    run = subprocess.run(call, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    if run.returncode or not run.stdout:
        raise damaged(path, name, EXPECTED, EXPECTED, "scipy ends on it")
    answer = io.BytesIO(run.stdout)
    record = json.loads(answer.readline())
    if "newer" in record:
        raise refused(name, f"{EXPECTED} of version 7.2 or older", "7.3, which is HDF5: save it as -v7")
    if "error" in record:
        raise damaged(path, name, EXPECTED, EXPECTED, record["error"])
    choose(record["variables"], variable, name)
    with reading(path, name, EXPECTED, EXPECTED):
        matrix = _matrix(answer, record["sparse"])
    return entries_of_matrix(matrix, name)


def _unpacked_sizes(path: Path) -> Iterator[int]:
    """The sizes to which a file of version 5 to 7.2 unpacks, piece by piece; nothing where it is of version 4.

    Source: MAT-File Level 5 File Format, MathWorks, chapter 1.
    """
    with path.open("rb") as file:
        header = file.read(_HEADER)
        order = "<" if header[126:] == b"IM" else ">"
        if 0 in header[:4] or header[124:126] not in (b"\0\1", b"\1\0"):
            return
        while len(tag := file.read(8)) == 8:
            kind, size = struct.unpack(f"{order}II", tag)
            if kind != _COMPRESSED:
                yield size
                file.seek(size + -size % 8, SEEK_CUR)
                continue
            unpack, data = zlib.decompressobj(), file.read(size)
            while data and not unpack.eof:
                yield len(unpack.decompress(data, _PIECE))
                data = unpack.unconsumed_tail


def _matrix(answer: io.BytesIO, shape: list[int] | None) -> Any:
    import numpy as np
    from scipy.sparse import coo_array

    arrays = [np.load(answer, allow_pickle=False) for _ in range(1 if shape is None else 3)]
    if shape is None:
        return arrays[0]
    return coo_array((arrays[2], (arrays[0], arrays[1])), shape=tuple(shape))
