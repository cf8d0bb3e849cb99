"""MATLAB files of version 4 to 7.2: the square matrix in them, full or sparse, by scipy in a process of its own."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from pathlib import Path
from typing import Any, Final

from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.matlab_elements import must_be_sound, unpacked_sizes
from fomas_verify.network.files.matrices import entries_of_matrix
from fomas_verify.network.files.refusals import damaged, must_unpack_small, need_extra, reading, refused
from fomas_verify.network.files.variables import choose

EXPECTED: Final = "a MATLAB file"

PATIENCE: Final = 120
"""Seconds for scipy, which can go round in circles on a damaged file; a sound one of the largest takes a few."""

_CHILD = Path(__file__).with_name("matlab_child.py")


def read(path: Path, name: str, variable: str | None = None) -> Entries:
    """Read the square matrix of a MATLAB file; raises `GraphFileError`."""
    need_extra("numpy", "scipy.io")
    with reading(path, name, EXPECTED, EXPECTED):
        must_unpack_small(path, name, unpacked_sizes(path))
        must_be_sound(path)
    call = [sys.executable, "-I", str(_CHILD), str(path.resolve()), *([] if variable is None else [variable])]
    nothing, told = subprocess.DEVNULL, subprocess.PIPE
    try:
        run = subprocess.run(call, stdin=nothing, stdout=told, stderr=nothing, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        raise damaged(path, name, EXPECTED, EXPECTED, f"scipy has not read it within {PATIENCE} s") from None
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


def _matrix(answer: io.BytesIO, shape: list[int] | None) -> Any:
    import numpy as np
    from scipy.sparse import coo_array

    arrays = [np.load(answer, allow_pickle=False) for _ in range(1 if shape is None else 3)]
    if shape is None:
        return arrays[0]
    return coo_array((arrays[2], (arrays[0], arrays[1])), shape=tuple(shape))
