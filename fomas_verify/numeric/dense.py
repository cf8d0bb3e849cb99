"""Signs of eigenvalues from a dense factor R R^T, multiplied out and compared: where a sparse factor would fill in.

With ``A + c 1 1^T + E = R R^T`` the eigenvalues of A on 1perp are at least ``-norm E``, and all of them if c = 0.
LAPACK is not believed to have factored; a dense product is believed to be one of doubles, summed in any order.
Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from fractions import Fraction
from math import fsum, sqrt
from typing import TYPE_CHECKING, Any

from fomas_verify.numeric.floats import SLACK, Symmetric, U
from fomas_verify.numeric.inertia import limited

if TYPE_CHECKING:
    from numpy.typing import NDArray

_BLOCK = 256
"""Rows of a block, and as many columns: what of R lies right of its block on the diagonal is 0 by never being read."""

_LARGEST = 2.0**150
_TINY = 2.0**-500
"""More than all that underflow can change, squares of what is below 2^-537 being lost."""

_DIRECTION_BITS = 30


def dense_bytes(n: int) -> int:
    """What a factor and its residual take."""
    return 8 * n * (n + 6 * _BLOCK) + (64 << 20)


def least(matrix: Symmetric, memory: int, *, lift: float) -> float | Fraction | None:
    """A float e: no eigenvalue of A, or none on 1perp, is below -e; or a fraction: the least is at most that. Rigorous.

    None where neither is found. `lift` is c, and 1perp is meant where it is not 0.
    """
    import numpy as np

    try:
        with limited(memory):
            factor, failed = _factored(matrix, lift)
            if failed:
                return _quotient(matrix, _direction(factor, matrix, lift, failed - 1), on_perp=lift > 0)
            error = (_error(matrix, factor, lift) + float(matrix.error.max())) * SLACK + _TINY
    except MemoryError:
        return None
    return error if np.isfinite(error) else None


def expected_error(matrix: Symmetric) -> float:
    """About what `least` will answer."""
    n = matrix.upper.shape[0]
    return 1.1 * _share(n) * (float(abs(matrix.upper.diagonal()).sum()) + 10 * float(abs(matrix.upper).max()))


def lift_of(matrix: Symmetric) -> float:
    """c so that the vector 1 is farther from 0 than any shift of use, lambda2 being below twice the largest entry."""
    return 6 * float(abs(matrix.upper).max()) / int(matrix.upper.shape[0])


def _share(n: int) -> float:
    """gamma_m: a product in a sum of `_BLOCK` of them, which is one of so many sums, and two matrices subtracted."""
    terms = _BLOCK + -(-n // _BLOCK) + 4
    return terms * U / (1 - terms * U)


def _factored(matrix: Symmetric, lift: float) -> tuple[Any, int]:
    """The factor, 0 right of the diagonal in its block; the number is that of the leading minor which is not positive,
    or 0. By blocks, as OpenBLAS 0.3.31 writes beyond its memory where it factors 16,000 rows at once on two threads.
    """
    import numpy as np
    from scipy.linalg.blas import dtrsm
    from scipy.linalg.lapack import dpotrf

    n, upper = matrix.upper.shape[0], matrix.upper
    whole = np.full((n, n), lift, order="F")
    columns = np.repeat(np.arange(n), np.diff(upper.indptr))
    whole[columns, upper.indices] += upper.data
    for start in range(0, n, _BLOCK):
        end = min(start + _BLOCK, n)
        block, left = whole[start:end, start:end], whole[start:end, :start]
        block[:], failed = dpotrf(block - left @ left.T, lower=1, clean=1)
        if failed:
            return whole, start + int(failed)
        below = whole[end:, start:end] - whole[end:, :start] @ left.T
        whole[end:, start:end] = dtrsm(1.0, block, below, side=1, lower=1, trans_a=1)
    return whole, 0


def _error(matrix: Symmetric, factor: Any, lift: float) -> float:
    """A bound of norm E: the Frobenius norm of the residual as computed, and what rounding may have hidden in it.

    That is at most gamma_m times the norms of both matrices and of ``abs R abs R^T``, the sum of the squares of R.
    """
    import numpy as np

    n, full = matrix.upper.shape[0], matrix.full()
    seen, squares = [], []
    for start in range(0, n, _BLOCK):
        end = min(start + _BLOCK, n)
        rows = factor[start:end]
        if not (abs(rows[:, :end]) <= _LARGEST).all():
            return float("inf")
        apart = np.full((end - start, end), -lift)
        for first in range(0, end, _BLOCK):
            last = min(first + _BLOCK, end)
            apart[:, first:] += rows[:, first:last] @ factor[first:end, first:last].T
        apart -= full[start:end, :end].toarray()
        # Both triangles hold what stands left of the block on the diagonal.
        seen.append(2 * float((apart[:, :start] ** 2).sum()) + float((apart[:, start:] ** 2).sum()))
        squares.append(float((rows[:, :end] ** 2).sum()))
    size = sum(squares) + float(abs(full).sum(axis=1).max()) + n * lift
    return float(sqrt(sum(seen)) + _share(n) * size)


def _direction(factor: Any, matrix: Symmetric, lift: float, k: int) -> NDArray[Any]:
    """x with ``x^T A x`` near the pivot that was not positive, the k-th: as floats find it, in the factor's place."""
    import numpy as np
    from scipy.linalg.blas import dtrsv

    n = matrix.upper.shape[0]
    column = np.full(n, lift) + matrix.full()[[k]].toarray().ravel()
    column[k:] = 0
    factor[k:], factor[:, k:] = 0, 0
    factor[range(k, n), range(k, n)] = 1
    x: NDArray[Any] = -dtrsv(factor, dtrsv(factor, column, lower=1), lower=1, trans=1)
    x[k] = 1
    return x


def _quotient(matrix: Symmetric, x: NDArray[Any], *, on_perp: bool) -> Fraction | None:
    """An upper bound of the least eigenvalue (on 1perp): ``x^T A x / x^T x`` of x rounded to integers. Rigorous."""
    import numpy as np

    x = x - x.mean() if on_perp else x
    largest = abs(x).max()
    if not 0 < largest < np.inf:
        return None
    whole = np.rint(x * (2.0**_DIRECTION_BITS / largest)).astype(np.int64)
    if on_perp:
        whole[int(abs(whole).argmin())] -= int(whole.sum())
    if not abs(whole).max() < 2**50:
        return None
    full, floats = matrix.full(), whole.astype(np.float64)
    value = fsum(floats * (full @ floats))
    hidden = (int(np.diff(full.indptr).max()) + 4) * U * float(abs(floats) @ (abs(full) @ abs(floats))) * SLACK
    norm = sum(v * v for v in whole.tolist())
    bound: Fraction = (Fraction(value) + Fraction(hidden)) / norm + Fraction(float(matrix.error.max()) + _TINY) * 2
    return bound
