"""Archives of numpy: a sparse matrix that scipy saved, or a square array. Nothing in them is executed."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final
from zipfile import ZipFile

from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.matrices import entries_of_matrix
from fomas_verify.network.files.refusals import need_extra, reading, refused
from fomas_verify.network.files.variables import choose

EXPECTED: Final = "a .npz file of numpy or scipy"
MAX_BYTES: Final = 1 << 32

_KIND = "a zip archive, as .npz is"


def read(path: Path, name: str, variable: str | None = None) -> Entries:
    """Read a sparse matrix, or a square array; raises `GraphFileError`."""
    need_extra("numpy", "scipy.sparse")
    with reading(path, name, EXPECTED, _KIND):
        with ZipFile(path) as archive:
            size = sum(member.file_size for member in archive.infolist())
        if size > MAX_BYTES:
            raise refused(name, f"at most {MAX_BYTES} bytes unpacked", str(size))
        matrix = _matrix(path, name, variable)
    return entries_of_matrix(matrix, name)


def _matrix(path: Path, name: str, variable: str | None) -> Any:
    import numpy as np
    from scipy.sparse import load_npz

    with np.load(path, allow_pickle=False) as archive:
        if {"format", "shape", "data"} <= set(archive.files):
            if variable is not None:
                raise refused(name, "variable only where there are several arrays", "a sparse matrix of scipy")
            return load_npz(path)
        arrays = {key: archive[key] for key in archive.files}
    return arrays[choose({key: _other(array) for key, array in arrays.items()}, variable, name)]


def _other(array: Any) -> str:
    """What an array is; empty where it is a square matrix of numbers."""
    if array.ndim == 2 and array.shape[0] == array.shape[1] >= 2 and array.dtype.kind in "biuf":
        return ""
    return f"{' x '.join(map(str, array.shape)) or 'single'} {array.dtype}"
