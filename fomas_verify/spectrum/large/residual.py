"""How far the product of a sparse factor is from the matrix, with a bound of what rounding may have hidden.

The product is formed from dense ones: that of a range of columns is added to what its children in the elimination tree
left for later columns (as in the multifrontal method), so that few roundings follow each other.

Notation: ``E = A - U diag(d) U^T``, U unit lower triangular. For T >= abs E entry by entry, T symmetric, and any x > 0,
norm E is at most the largest ``(T x)_i / x_i`` (Collatz). Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from math import sqrt
from typing import TYPE_CHECKING, Any

from fomas_verify.spectrum.large.fronts import Fronts
from fomas_verify.spectrum.large.rounding import LARGEST, SLACK, UNDERFLOW, U, gammas

if TYPE_CHECKING:
    from numpy.typing import NDArray

_TERMS = 48
"""So many products are summed by one dense product."""

_STEPS, _LEAST = 4, 2.0**-6


def residual_norm(matrix: Any, lower: Any, pivots: NDArray[Any], ranges: Fronts) -> float:
    """A bound of the 2-norm of E; infinity where U is not unit lower triangular, or a number is out of range. Rigorous.

    Parameters
    ----------
    matrix : csc, exactly symmetric, sorted
    lower : csc, U
    pivots : d, shape (N,)
    ranges : of columns; any give a true bound
    """
    import numpy as np
    from scipy.sparse import csc_array

    n = len(pivots)
    lower.sort_indices()
    # No NaN is <= anything.
    in_range = all(bool((abs(part) <= LARGEST).all()) for part in (lower.data, pivots, matrix.data))
    firsts = lower.indptr[:-1]
    # Each column is to begin with its diagonal entry, which is 1.
    if not in_range or (np.diff(lower.indptr) == 0).any() or (lower.data[firsts] != 1).any():
        return float("inf")
    if not np.array_equal(lower.indices[firsts], np.arange(n)):
        return float("inf")
    product = _Product(matrix, lower, pivots, ranges)
    product.form()
    sizes, heights = csc_array((abs(lower.data), lower.indices, lower.indptr), shape=(n, n)), abs(pivots)
    x = _weights(sizes, heights)
    hidden = sizes @ (gammas(product.roundings()) * heights * (sizes.T @ x)) + 4 * U * (abs(matrix) @ x)
    # What is seen is small everywhere, or large in a few full rows: the row sums or the Frobenius norm are near then.
    seen = min(float(product.sums.max()), sqrt(product.squares))
    return (float((hidden / x).max()) + seen) * SLACK**2 + UNDERFLOW


def _weights(sizes: Any, heights: NDArray[Any]) -> NDArray[Any]:
    """Weights near the dominant eigenvector of ``sizes diag(heights) sizes^T``; any positive ones would do."""
    import numpy as np

    x = np.ones(len(heights))
    for _ in range(_STEPS):
        x = sizes @ (heights * (sizes.T @ x))
        x = x / x.max() + _LEAST
    return x


@dataclass(eq=False)
class _Product:
    """U diag(d) U^T, a range of columns after the other.

    Attributes
    ----------
    sums : of the absolute values of each row of E, as computed
    squares : the sum of the squares of its entries
    left : what each range's children leave: rows, and a symmetric matrix on them
    added : for each range, the matrices that are added in it
    parents : for each range, that to which it leaves something, or -1
    """

    matrix: Any
    lower: Any
    pivots: NDArray[Any]
    ranges: Fronts
    sums: Any = None
    squares: float = 0.0
    left: dict[int, list[tuple[Any, Any]]] = field(default_factory=dict)
    added: list[int] = field(default_factory=list)
    parents: list[int] = field(default_factory=list)

    def form(self) -> None:
        """Go through all ranges."""
        import numpy as np

        self.sums = np.zeros(len(self.pivots))
        edges = self.ranges.edges
        for start, end in pairwise(edges):
            self._front(start, end)

    def roundings(self) -> NDArray[Any]:
        """For each column, how many roundings a product of two of its entries may go through, at most."""
        import numpy as np

        after = np.zeros(len(self.added) + 1)
        for s in range(len(self.added) - 1, -1, -1):
            after[s] = self.added[s] + (after[self.parents[s]] if self.parents[s] >= 0 else 0)
        # Two products and the sum of at most _TERMS; all that is added later; the difference from the matrix.
        terms: NDArray[Any] = (after[:-1] + _TERMS + 4)[self.ranges.of_column]
        return terms

    def _front(self, start: int, end: int) -> None:
        """Form the columns of one range, compare them with the matrix, and leave the rest to the next above."""
        import numpy as np

        number, width = len(self.added), end - start
        children = self.left.pop(number, [])
        own, given = self._columns(self.lower, start, end), self._columns(self.matrix, start, end)
        rows = np.unique(np.concatenate([np.arange(start, end), own[0], given[0], *(child[0] for child in children)]))
        panel = np.zeros((len(rows), width))
        panel[np.searchsorted(rows, own[0]), own[1]] = own[2]
        front = np.zeros((len(rows), len(rows)))
        for child_rows, child in children:
            places = np.searchsorted(rows, child_rows)
            front[places[:, None], places] += child
        for first in range(0, width, _TERMS):
            part = panel[:, first : first + _TERMS]
            front += (part * self.pivots[start + first : start + first + part.shape[1]]) @ part.T
        self._compare(rows, front[:, :width], given, start, end)
        self.added.append(len(children) + -(-width // _TERMS))
        rest = rows[width:]
        self.parents.append(int(self.ranges.of_column[rest[0]]) if len(rest) else -1)
        if len(rest):
            self.left.setdefault(self.parents[-1], []).append((rest, front[width:, width:].copy()))

    def _compare(self, rows: Any, formed: Any, given: Any, start: int, end: int) -> None:
        import numpy as np

        formed[np.searchsorted(rows, given[0]), given[1]] -= given[2]
        apart = abs(formed)
        self.sums[rows] += apart.sum(axis=1)
        self.sums[start:end] += apart[end - start :].sum(axis=0)
        self.squares += float((apart**2).sum() + (apart[end - start :] ** 2).sum())

    def _columns(self, whole: Any, start: int, end: int) -> tuple[Any, Any, Any]:
        """The rows from `start` on, the columns counted from `start`, and the values of the entries of a range."""
        import numpy as np

        pointers = whole.indptr[start : end + 1]
        rows, values = whole.indices[pointers[0] : pointers[-1]], whole.data[pointers[0] : pointers[-1]]
        columns = np.repeat(np.arange(end - start), np.diff(pointers))
        kept = rows >= start
        return rows[kept], columns[kept], values[kept]
