"""What a dense Cholesky factor shows, by an a-priori bound: for matrices whose sparse factor fills in.

If the factorisation of a symmetric A runs to its end in doubles, A has no eigenvalue below
``-gamma_m / (1 - gamma_m) trace A``, m = N + 1 and a few more. Source: S. M. Rump, *Verification of positive
definiteness*, BIT 46 (2006); docs/theory.md, section 14.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from fomas_verify.spectrum.large.matrices import Near
from fomas_verify.spectrum.large.rounding import SLACK, UNDERFLOW, U, gamma

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from fomas_verify.spectrum.large.factor import Solve

_MORE = 10
"""1 for the bound, and for programs that multiply by a rounded reciprocal of the diagonal where others divide."""

_COLUMNS = 512


@dataclass(frozen=True)
class DenseFactors:
    """Factors of matrices of one size, each in the place of its matrix."""

    prefers_no_factor: ClassVar[bool] = True

    def expected_error(self, near: Near) -> float:
        """Twice the a-priori bound, nearly."""
        n = near.matrix.shape[0]
        trace = float(near.matrix.diagonal().sum())
        return 2 * gamma(n + _MORE) * (trace + 2 * near.largest)

    def solve_near_zero(self, near: Near, shift: float) -> Solve:
        """Apply the inverse of ``A + shift I`` with the vector 1 moved away from 0, as floats do.

        Raises RuntimeError where that is not positive definite.
        """
        from scipy.linalg import cho_solve

        factor, info = _cholesky(_full(near, 1.0, shift, _lift(near)))
        if info:
            raise RuntimeError

        def solve(x: NDArray[Any]) -> NDArray[Any]:
            solved: NDArray[Any] = cho_solve((factor, True), x, check_finite=False)
            return solved

        return solve

    def second_at_least(self, near: Near, shift: float) -> float | None:
        """A lower bound of the second smallest eigenvalue of A, the smallest being 0 at the vector 1. Rigorous.

        It is that of ``A - shift I + c 1 1^T`` on 1perp, plus the shift, whatever c is.
        """
        error = self._definite(near, 1.0, -shift, _lift(near))
        return None if error is None or shift - error * SLACK <= 0 else (shift - error * SLACK) * (1 - 2 * U)

    def all_at_most(self, near: Near, shift: float) -> float | None:
        """An upper bound of every eigenvalue of A, from ``shift I - A``; None where the factor shows none. Rigorous."""
        error = self._definite(near, -1.0, shift, 0.0)
        return None if error is None else (shift + error * SLACK) * (1 + 2 * U)

    def _definite(self, near: Near, sign: float, shift: float, lift: float) -> float | None:
        """e >= 0 such that ``sign A + shift I + lift 1 1^T`` has no eigenvalue below -e; None where none is found."""
        import numpy as np

        full = _full(near, sign, shift, lift)
        trace = float(abs(full.diagonal()).sum())
        _, info = _cholesky(full)
        if info or not np.isfinite(trace):
            return None
        n, share = full.shape[0], gamma(full.shape[0] + _MORE)
        most = int(np.diff(near.matrix.indptr).max())
        # Each stored entry was added to the lift, and the diagonal to the shift, with one rounding each.
        rows = float(abs(near.matrix).sum(axis=0).max())
        moved = 4 * U * (rows + most * lift + abs(shift))
        return float((share / (1 - share) * trace + moved + near.error + n * UNDERFLOW) * SLACK)


def dense_bytes(agents: int) -> int:
    """What one factor takes."""
    return 8 * agents * agents


def _lift(near: Near) -> float:
    """c so that the vector 1 gets an eigenvalue of the size of the largest."""
    return 2 * near.largest / int(near.matrix.shape[0])


def _full(near: Near, sign: float, shift: float, lift: float) -> Any:
    import numpy as np

    n = near.matrix.shape[0]
    full = np.full((n, n), lift, order="F")
    columns = np.repeat(np.arange(n), np.diff(near.matrix.indptr))
    full[near.matrix.indices, columns] += sign * near.matrix.data
    full[np.arange(n), np.arange(n)] += shift
    return full


def _cholesky(full: Any) -> tuple[Any, int]:
    """The lower factor, in the same place; the number is 0 if it exists. `_COLUMNS` columns at a time, from the left.

    Not by one call of LAPACK: in OpenBLAS 0.3.31 that of 16,000 rows on two threads writes beyond its
    memory.
    """
    import numpy as np
    from scipy.linalg.blas import dtrsm
    from scipy.linalg.lapack import dpotrf

    n = len(full)
    for start in range(0, n, _COLUMNS):
        end = min(start + _COLUMNS, n)
        columns = full[start:, start:end]
        columns -= np.matmul(full[start:, :start], full[start:end, :start].T)
        corner, info = dpotrf(columns[: end - start], lower=1, clean=1)
        if info:
            return full, start + int(info)
        columns[: end - start] = corner
        columns[end - start :] = dtrsm(1.0, corner, columns[end - start :], side=1, lower=1, trans_a=1)
    return full, 0
