"""A sparse factor ``U diag(d) U^T``, U unit lower triangular, of a symmetric matrix in a given order: approximate.

The columns of a range are eliminated in a dense matrix, to which the ranges below have left theirs (the multifrontal
method). Source: I. S. Duff, J. K. Reid, *The multifrontal solution of indefinite sparse symmetric linear equations*,
ACM Trans. Math. Softw. 9 (1983).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from fomas_verify.spectrum.large.fronts import Fronts

if TYPE_CHECKING:
    from numpy.typing import NDArray

_NARROW = 64

_PIVOTED = 256
"""So many of the last columns of a range are taken by their pivots, where the range is not positive definite."""


def eliminated(matrix: Any, ranges: Fronts, most: int) -> tuple[Any, NDArray[Any], NDArray[Any]] | None:
    """(U as csc, d, order), d with at most `most` negative entries; None where there would be more, or one is 0.

    U diag(d) U^T is near the matrix with its rows and columns in that order, which moves columns within a range alone.

    Parameters
    ----------
    matrix : csc, symmetric, sorted
    ranges : of columns
    most : int
    """
    import numpy as np
    from scipy.sparse import csc_array

    n = matrix.shape[0]
    work = _Elimination(matrix, ranges, most, np.arange(n))
    for start, end in pairwise(ranges.edges):
        if not work.front(start, end):
            return None
    pointers = np.concatenate([[0], np.cumsum(np.concatenate(work.lengths))])
    places = np.argsort(work.order).astype(np.int32)
    indices, values = places[np.concatenate(work.rows)], np.concatenate(work.values)
    lower = csc_array((values, indices, pointers), shape=(n, n))
    return lower, np.concatenate(work.pivots), work.order


@dataclass(eq=False)
class _Elimination:
    """What is left of the matrix, and the columns of the factor so far.

    Attributes
    ----------
    order : of the columns
    left : what each range's children leave: rows, and a symmetric matrix on them
    lengths, rows, values, pivots : of the columns of the factor, range by range
    """

    matrix: Any
    ranges: Fronts
    most: int
    order: NDArray[Any]
    left: dict[int, list[tuple[Any, Any]]] = field(default_factory=dict)
    lengths: list[Any] = field(default_factory=list)
    rows: list[Any] = field(default_factory=list)
    values: list[Any] = field(default_factory=list)
    pivots: list[Any] = field(default_factory=list)

    def front(self, start: int, end: int) -> bool:
        """Eliminate the columns of one range; False where a pivot is 0 or too many are negative."""
        import numpy as np

        width = end - start
        front, rows = self._assembled(start, end)
        found = _panel(front, width)
        if found is None:
            return False
        scaled, pivots, order = found
        self.most -= int((pivots < 0).sum())
        if self.most < 0 or not np.isfinite(scaled).all():
            return False
        below = scaled[width:]
        rest = rows[width:]
        if len(rest):
            left = front[width:, width:] - (below * np.sign(pivots)) @ below.T
            self.left.setdefault(int(self.ranges.of_column[rest[0]]), []).append((rest, left))
        self.order[start:end] = start + order
        self._keep(np.concatenate([self.order[start:end], rest]), scaled / np.sqrt(abs(pivots)), pivots)
        return True

    def _assembled(self, start: int, end: int) -> tuple[Any, Any]:
        """The range's columns and what was left for them, as a dense matrix on these rows."""
        import numpy as np

        children = self.left.pop(int(self.ranges.of_column[start]), [])
        pointers = self.matrix.indptr[start : end + 1]
        given, values = (part[pointers[0] : pointers[-1]] for part in (self.matrix.indices, self.matrix.data))
        columns = np.repeat(np.arange(end - start), np.diff(pointers))
        kept = given >= start
        given, values, columns = given[kept], values[kept], columns[kept]
        rows = np.unique(np.concatenate([np.arange(start, end), given, *(child[0] for child in children)]))
        front = np.zeros((len(rows), len(rows)))
        front[np.searchsorted(rows, given), columns] = values
        for child_rows, child in children:
            places = np.searchsorted(rows, child_rows)
            front[places[:, None], places] += child
        return front, rows

    def _keep(self, rows: Any, unit: Any, pivots: Any) -> None:
        import numpy as np

        height, width = unit.shape
        inside = np.arange(height)[None, :] >= np.arange(width)[:, None]
        turned = unit.T
        turned[np.arange(width), np.arange(width)] = 1.0
        self.lengths.append(height - np.arange(width))
        self.rows.append(np.broadcast_to(rows, (width, height))[inside].astype(np.int32))
        self.values.append(turned[inside])
        self.pivots.append(pivots)


def _panel(front: Any, width: int) -> tuple[Any, Any, Any] | None:
    """(B, d, order): the first columns of `front`, in that order, are near ``B diag(sign d) B_1^T``, B_1 the lower
    triangular top of B.
    """
    import numpy as np
    from scipy.linalg import solve_triangular

    signs, order, below = np.ones(width), np.arange(width), front[width:, :width]
    try:
        corner = np.linalg.cholesky(front[:width, :width])
    except np.linalg.LinAlgError:
        found = _indefinite(front[:width, :width])
        if found is None:
            return None
        corner, signs, order = found
        below = below[:, order]
    # Rows below: X diag(signs) corner^T = front. Most ranges are narrow: there scipy's BLAS, which is another than
    # numpy's, would have its threads wait for those of the other.
    if width <= _NARROW:
        below = below @ np.linalg.inv(corner).T
    else:
        below = solve_triangular(corner, below.T, lower=True, check_finite=False).T
    return np.concatenate([corner, below * signs]), signs * corner.diagonal() ** 2, order


def _indefinite(square: Any) -> tuple[Any, Any, Any] | None:
    """(C, s, order): the matrix in that order is near ``C diag(s) C^T``, C lower triangular, s = 1 or -1.

    None at a pivot 0. Among the last columns the largest pivot comes first: one near 0 would make C large.
    """
    import numpy as np
    from scipy.linalg import solve_triangular

    width = len(square)
    first = max(width - _PIVOTED, 0)
    try:
        head = np.linalg.cholesky(square[:first, :first])
    except np.linalg.LinAlgError:
        first, head = 0, square[:0, :0]
    cross = solve_triangular(head, square[:first, first:], lower=True, check_finite=False).T
    left = np.tril(square[first:, first:]) - np.tril(cross @ cross.T)
    left += np.tril(left, -1).T
    corner, signs, order = np.zeros((width, width)), np.ones(width), np.arange(width)
    corner[:first, :first] = head
    tail, moved = corner[first:, first:], order[first:]
    for k in range(width - first):
        best = k + int(abs(left.diagonal()[k:]).argmax())
        for rows in (left, left.T, tail, cross, moved):
            rows[[k, best]] = rows[[best, k]]
        pivot = left[k, k]
        if pivot == 0 or not np.isfinite(pivot):
            return None
        signs[first + k] = np.sign(pivot)
        tail[k:, k] = left[k:, k] * (signs[first + k] / np.sqrt(abs(pivot)))
        left[k + 1 :, k + 1 :] -= signs[first + k] * np.outer(tail[k + 1 :, k], tail[k + 1 :, k])
    corner[first:, :first] = cross
    return corner, signs, order
