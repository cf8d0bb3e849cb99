"""MATLAB files of version 4 to 7.2: the square matrix in them, full or sparse, by scipy."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.matlab_elements import must_be_sound, unpacked_sizes
from fomas_verify.network.files.matrices import entries_of_matrix
from fomas_verify.network.files.refusals import must_unpack_small, need_extra, reading, refused
from fomas_verify.network.files.variables import choose

EXPECTED: Final = "a MATLAB file"

_CLASSES = ("double", "single", "logical", "sparse", *(f"{u}int{bits}" for u in ("", "u") for bits in (8, 16, 32, 64)))


def read(path: Path, name: str, variable: str | None = None) -> Entries:
    """Read the square matrix of a MATLAB file; raises `GraphFileError`."""
    need_extra("numpy", "scipy.io")
    from scipy.io import loadmat, whosmat

    with reading(path, name, EXPECTED, EXPECTED):
        must_unpack_small(path, name, unpacked_sizes(path))
        must_be_sound(path)
        try:
            found = {key: _other(shape, kind) for key, shape, kind in whosmat(path)}
        except NotImplementedError:
            raise refused(name, f"{EXPECTED} of version 7.2 or older", "7.3, which is HDF5: save it as -v7") from None
        chosen = choose(found, variable, name)
        matrix = loadmat(path, variable_names=[chosen], struct_as_record=True)[chosen]
    return entries_of_matrix(matrix, name)


def _other(shape: tuple[int, ...], kind: str) -> str:
    """What a variable is; empty where it is a square matrix of numbers."""
    if len(shape) == 2 and shape[0] == shape[1] >= 2 and kind in _CLASSES:
        return ""
    return f"{' x '.join(map(str, shape))} {kind}"
