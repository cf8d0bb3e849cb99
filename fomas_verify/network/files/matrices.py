"""Matrices of numpy and scipy."""

from __future__ import annotations

from typing import Any

from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.refusals import need_extra, refused
from fomas_verify.network.files.weights import SHORTEST, ratios_of_array, ratios_of_objects

_KINDS = "biuf"


def entries_of_matrix(matrix: Any, name: str) -> Entries:
    """The entries of a square matrix, dense or sparse, of integers, truth values, floats or Python's own numbers.

    Stored zeros are no edges. Binary floats are read as their shortest decimals, those of single precision as theirs.

    Raises
    ------
    GraphFileError
        It is not square, or its numbers are complex or none.
    """
    need_extra("numpy", "scipy.sparse")
    import numpy as np
    from scipy.sparse import issparse

    found = matrix if issparse(matrix) else np.asarray(matrix)
    if found.ndim != 2 or found.shape[0] != found.shape[1]:
        raise refused(name, "a square matrix", " x ".join(map(str, found.shape)) or "a single number")
    if found.dtype.kind not in _KINDS and not (found.dtype == object and not issparse(matrix)):
        raise refused(name, "a matrix of real numbers", f"one of {found.dtype}")
    rows, columns, values = _sparse(found, name) if issparse(matrix) else _dense(found)
    remarks = (SHORTEST,) if _has_floats(values) else ()

    def place(entry: int) -> str:
        return f"row {rows[entry] + 1}, column {columns[entry] + 1}"

    if values.dtype == object:
        codes = np.arange(len(values))
        return Entries(
            found.shape[0], rows, columns, codes, lambda: ratios_of_objects(values.tolist()), place, remarks=remarks
        )  # fmt: skip
    finite = np.isfinite(values)
    if not finite.all():
        position = int(np.flatnonzero(~finite)[0])
        raise refused(f"{name}: {place(position)}", "a finite number", str(values[position]))
    different, codes = np.unique(values, return_inverse=True)
    return Entries(
        found.shape[0], rows, columns, codes.astype(np.int64), lambda: ratios_of_array(different), place,
        remarks=remarks,
    )  # fmt: skip


def _has_floats(values: Any) -> bool:
    return values.dtype.kind == "f" or (values.dtype == object and any(isinstance(x, float) for x in values))


def _dense(matrix: Any) -> tuple[Any, Any, Any]:
    import numpy as np

    rows, columns = np.nonzero(matrix)
    return rows.astype(np.int64), columns.astype(np.int64), np.ascontiguousarray(matrix[rows, columns])


def _sparse(matrix: Any, name: str) -> tuple[Any, Any, Any]:
    import numpy as np

    if hasattr(matrix, "check_format"):
        try:
            matrix.check_format(full_check=True)
        except ValueError as error:
            raise refused(name, "a sparse matrix that is whole", f"a damaged one: {error}") from None
    # scipy does not look between its ends where the last pointer says that nothing is stored.
    if hasattr(matrix, "indptr") and (matrix.indptr[1:] < matrix.indptr[:-1]).any():
        raise refused(name, "a sparse matrix that is whole", "a damaged one: its pointers decrease")
    entries = matrix.tocoo()
    return entries.row.astype(np.int64), entries.col.astype(np.int64), np.ascontiguousarray(entries.data)
