"""What a sparse factor shows of the eigenvalues of a symmetric matrix; what made it is not believed.

``A + E = U diag(d) U^T``, U unit lower triangular in the order of elimination. Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from fomas_verify.spectrum.large.elimination import eliminated
from fomas_verify.spectrum.large.matrices import Near
from fomas_verify.spectrum.large.ordering import Order
from fomas_verify.spectrum.large.residual import residual_norm
from fomas_verify.spectrum.large.rounding import SLACK, U

if TYPE_CHECKING:
    from numpy.typing import NDArray

Solve = Callable[["NDArray[Any]"], "NDArray[Any]"]

BYTES_AN_ENTRY = 64
"""What an entry of the factor takes, all in all, with room; 41 were measured on a torus."""

BYTES_A_FRONT_ENTRY = 32
"""What an entry of the largest dense matrix takes: there, in what was left for it, in what it leaves, in a product."""


@dataclass(frozen=True, eq=False)
class SparseFactors:
    """Factors of matrices of one pattern."""

    order: Order
    prefers_no_factor: ClassVar[bool] = False

    def expected_error(self, near: Near) -> float:
        """None to speak of."""
        return 0.0

    def solve_near_zero(self, near: Near, shift: float) -> Solve:
        """Apply the inverse of ``A + shift I``, as floats do. Raises RuntimeError where that is singular."""
        from scipy.sparse.linalg import splu

        rows = self.order.rows
        factor = splu(self._moved(near, shift), permc_spec="NATURAL", options={"SymmetricMode": True})

        def solve(x: NDArray[Any]) -> NDArray[Any]:
            import numpy as np

            y = np.empty_like(x)
            y[rows] = factor.solve(x[rows])
            return y

        return solve

    def second_at_least(self, near: Near, shift: float) -> float | None:
        """A lower bound of the second smallest eigenvalue of A, the smallest being 0 at the vector 1. Rigorous.

        With at most one d_i < 0, at most one eigenvalue is at or below ``shift - norm E``: none but the 0 if that is
        > 0. None where the factor does not show a positive bound.
        """
        found = self._inertia(near, 1.0, -shift, most=1)
        return None if found is None or shift - found * SLACK <= 0 else (shift - found * SLACK) * (1 - 2 * U)

    def all_at_most(self, near: Near, shift: float) -> float | None:
        """An upper bound of every eigenvalue of A, from ``shift I - A``; None where the factor shows none. Rigorous."""
        found = self._inertia(near, -1.0, shift, most=0)
        return None if found is None else (shift + found * SLACK) * (1 + 2 * U)

    def _moved(self, near: Near, shift: float, sign: float = 1.0) -> Any:
        """``sign A + shift I``, rows and columns in the order of elimination."""
        rows = self.order.rows
        moved = (near.matrix * sign)[rows][:, rows].tocsc()
        moved.setdiag(moved.diagonal() + shift)
        moved.sort_indices()
        return moved

    def _inertia(self, near: Near, sign: float, shift: float, *, most: int) -> float | None:
        """A bound of norm E if at most `most` of the d_i are negative and none is 0; else None."""
        import numpy as np

        moved = self._moved(near, shift, sign)
        found = eliminated(moved, self.order.fronts, most)
        if found is None or (found[1] == 0).any() or int((found[1] < 0).sum()) > most:
            return None
        lower, pivots, order = found
        if not np.array_equal(order, np.arange(len(order))):
            if not np.array_equal(np.sort(order), np.arange(len(order))):
                return None
            moved = moved[order][:, order].tocsc()
            moved.sort_indices()
        error = residual_norm(moved, lower, pivots, self.order.fronts)
        # The shift was added to the diagonal with one rounding.
        return (error + near.error + 2 * U * (near.largest + abs(shift))) * SLACK if np.isfinite(error) else None
