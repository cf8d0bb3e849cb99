"""Run as a program of its own: the variables of a MATLAB file as JSON, and the square matrix in it as arrays.

scipy's compiled reader can end the process on a damaged file; here it ends this one only. Arguments: the path and
perhaps the variable. Imports nothing of the package.
"""

from __future__ import annotations

import io
import json
import sys
import warnings
from typing import Any, Final

CLASSES: Final = ("double", "single", "logical", "sparse", *(f"{u}int{n}" for u in ("", "u") for n in (8, 16, 32, 64)))

HDF5: Final = 2
"""scipy's number of MATLAB's version 7.3, which it does not read."""


def other(shape: tuple[int, ...], kind: str) -> str:
    """What a variable is; empty where it is a square matrix of numbers."""
    if len(shape) == 2 and shape[0] == shape[1] >= 2 and kind in CLASSES:
        return ""
    return f"{' x '.join(map(str, shape))} {kind}"


def told(path: str, variable: str | None) -> tuple[dict[str, Any], list[Any]]:
    """The variables and what each is, and the arrays of the one that is named or is the only square matrix."""
    from scipy.io import loadmat, whosmat
    from scipy.io.matlab import matfile_version
    from scipy.sparse import issparse

    if matfile_version(path)[0] == HDF5:
        return {"newer": True}, []
    found = {name: other(shape, kind) for name, shape, kind in whosmat(path)}
    square = [name for name, words in found.items() if not words]
    chosen = variable if variable is not None else square[0] if len(square) == 1 else None
    if chosen not in found:
        return {"variables": found}, []
    matrix = loadmat(path, variable_names=[chosen])[chosen]
    if not issparse(matrix):
        return {"variables": found, "sparse": None}, [matrix]
    matrix.check_format(full_check=True)
    if (matrix.indptr[1:] < matrix.indptr[:-1]).any():  # not looked at where the last one says that nothing is stored
        raise ValueError("its pointers decrease")
    entries = matrix.tocoo()
    return {"variables": found, "sparse": entries.shape}, [entries.row, entries.col, entries.data]


def main() -> None:
    """Write a line of JSON and the arrays in numpy's format; an error is a line of JSON too."""
    import numpy as np

    warnings.simplefilter("error", UserWarning)
    path, *variable = sys.argv[1:]
    try:
        record, arrays = told(path, variable[0] if variable else None)
    except Exception as error:  # a damaged file can make a library raise anything
        record, arrays = {"error": " ".join(f"{error}".split()) or type(error).__name__}, []
    out = sys.stdout.buffer
    out.write(json.dumps(record).encode() + b"\n")
    for array in arrays:
        whole = io.BytesIO()  # numpy wants a file in which it knows its place, which a pipe is not
        np.save(whole, array, allow_pickle=False)
        out.write(whole.getbuffer())
    out.flush()


if __name__ == "__main__":
    main()
