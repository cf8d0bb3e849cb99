"""Signs of eigenvalues from a factor whose product is multiplied out and compared: qdldl itself is not believed.

With ``A + E = U diag(d) U^T``, U invertible, A has at most as many eigenvalues below ``-norm E`` as d has negative
entries (Sylvester, Weyl). U is unit lower triangular but for its last rows and columns: there it is Q where
``Q diag(d) Q^T`` is what the columns before leave, so that a pivot near 0, as a shift near a repeated eigenvalue makes
at the end, spoils nothing.
Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from fomas_verify.numeric.floats import SLACK, Symmetric, U

if TYPE_CHECKING:
    from numpy.typing import NDArray

_TAIL, _MOST_TAIL, _SMALL_PIVOT = 48, 512, 1 / 16
"""Rows of Q, at least and at most, and what share of its diagonal entry makes a pivot end the columns before them."""

_BLOCK_ENTRIES = 30_000_000
_MOST_PIECES = 8
_STEPS, _LEAST = 8, 1e-3
_LARGEST = 2.0**150
"""No entry of a factor may be larger, so that no product of a few overflows."""

_TINY = 2.0**-700
"""More than all that underflow can change in a row: each is below 2^-1021, and meets at most one factor beyond 1."""


@dataclass(frozen=True, eq=False)
class _Factor:
    """U (csr), d, and the rows of the matrix in the order of those of U."""

    left: Any
    pivots: NDArray[Any]
    order: NDArray[Any]


def inertia(matrix: Symmetric, memory: int) -> tuple[int, float] | None:
    """(n, e): at most n eigenvalues of the exact matrix are below -e, and n of a matrix within e are negative.

    None where no factor is found, or it would take more memory than `memory` bytes.
    """
    import numpy as np

    try:
        with limited(memory):
            full = matrix.full()
            factor = _factored(matrix.upper, full)
            if factor is None:
                return None
            error = _error(full, factor)
    except (MemoryError, RuntimeError):
        return None
    error = (error + float(matrix.error.max())) * SLACK + _TINY
    return (int((factor.pivots < 0).sum()), error) if np.isfinite(error) else None


def _factored(upper: Any, full: Any) -> _Factor | None:
    """A factor of qdldl's, its end replaced; None where it is none."""
    import numpy as np
    import qdldl
    from scipy.sparse import block_array, csc_array, csr_array, diags_array, eye_array, triu

    n = upper.shape[0]
    if n <= _TAIL:
        # All is the end: a first pivot of exactly 0 is no obstacle.
        lower, pivots, order = csc_array((n, n)), np.zeros(n), np.arange(n)
    else:
        lower, pivots, order = qdldl.Solver(upper, upper=True).factors()
    order = np.array(order)
    if not np.array_equal(np.sort(order), np.arange(n)):
        return None
    first = _first_of_tail(pivots, full.diagonal()[order])
    lower, pivots = csr_array(csc_array(lower)[:, :first]), np.array(pivots[:first])
    above, below = lower[:first], lower[first:]
    # No NaN is <= anything.
    if triu(above).nnz or not ((abs(lower.data) <= _LARGEST).all() and (abs(pivots) <= _LARGEST).all()):
        return None
    left = full[order[first:]][:, order[first:]].toarray() - (below @ diags_array(pivots) @ below.T).toarray()
    if not (abs(left) <= _LARGEST).all():
        return None
    values, vectors = np.linalg.eigh(left)
    # Invertible: what rounding hides in a product of so few bounded numbers is far below the rest of 1.
    if abs(vectors).max() > 2 or abs(vectors.T @ vectors - np.eye(n - first)).sum(axis=1).max() > 0.5:
        return None
    corner = csr_array(vectors)
    whole = corner if not first else block_array([[above + eye_array(first), None], [below, corner]], format="csr")
    return _Factor(whole, np.concatenate([pivots, values]), order)


def _first_of_tail(pivots: NDArray[Any], diagonal: NDArray[Any]) -> int:
    """Where Q begins: before the first small or negative pivot, if that is not too far from the end."""
    import numpy as np

    n = len(pivots)
    small = np.flatnonzero(~(np.array(pivots) > _SMALL_PIVOT * diagonal))
    small = small[small >= n - _MOST_TAIL]
    return max(0, min(n - _TAIL, int(small[0]) if len(small) else n))


def _error(matrix: Any, factor: _Factor) -> float:
    """A bound of norm E: the residual as computed, and what rounding may have hidden in it.

    With ``abs E <= T`` entry by entry and any x > 0, norm E is at most the largest ``(T x)_i / x_i`` (Collatz). The
    product is the sum of those of a few ranges of columns: a sum has as many terms as a row in one range, and those.
    """
    import numpy as np
    from scipy.sparse import diags_array

    left, pivots = factor.left, factor.pivots
    n, sizes, weights = len(pivots), abs(left), np.ones(len(pivots))
    heights = abs(pivots)
    for _ in range(_STEPS):
        weights = sizes @ (heights * (sizes.T @ weights))
        weights = weights / weights.max() + _LEAST
    rounded = sizes @ (heights * (sizes.T @ weights))
    del sizes
    pieces = _pieces(left)
    terms = np.max([np.diff(piece.indptr) for piece in pieces], axis=0) + len(pieces) + 8
    rounded = rounded * (terms * U / (1 - terms * U))
    edges = np.cumsum([0, *(piece.shape[1] for piece in pieces)])
    turned = [piece.T.tocsr() for piece in pieces]
    scaled = [piece @ diags_array(pivots[a:b]) for piece, (a, b) in zip(pieces, pairwise(edges), strict=True)]
    ratios, step = [], max(1, _BLOCK_ENTRIES // int(np.diff(left.indptr).max()))
    for start in range(0, n, step):
        rows = slice(start, start + step)
        apart = -matrix[factor.order[rows]][:, factor.order]
        for part, other in zip(scaled, turned, strict=True):
            apart = apart + part[rows] @ other
        ratios.append((abs(apart) @ weights + rounded[rows]) / weights[rows])
    return float(np.concatenate(ratios).max())


def _pieces(left: Any) -> list[Any]:
    """Ranges of the columns, with about equally many entries each; the more, the longer the longest row is."""
    import numpy as np

    columns = left.tocsc()
    number = min(_MOST_PIECES, 1 + int(np.diff(left.indptr).max()) // 200)
    edges = np.searchsorted(columns.indptr, np.linspace(0, columns.nnz, number + 1))
    edges[-1] = left.shape[1]
    return [columns[:, a:b].tocsr() for a, b in pairwise(edges) if a < b]


@contextmanager
def limited(memory: int) -> Iterator[None]:
    """Within the block the process may take this many bytes more; beyond, MemoryError. No limit where none is known."""
    try:
        import resource
        from pathlib import Path

        used = int(Path("/proc/self/statm").read_text("ascii").split()[0]) * resource.getpagesize()
    except (ImportError, OSError, ValueError):
        yield
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    wanted = used + memory
    tighter = wanted if soft == resource.RLIM_INFINITY else min(soft, wanted)
    try:
        resource.setrlimit(resource.RLIMIT_AS, (tighter, hard))
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
