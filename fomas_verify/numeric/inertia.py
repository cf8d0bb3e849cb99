"""Signs of eigenvalues from a factor whose product is multiplied out and compared: qdldl itself is not believed.

With ``A + E = U D U^T``, U unit lower triangular, A has at most as many eigenvalues at or below ``-norm E`` as D has
negative entries (Sylvester, Weyl). Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from fomas_verify.numeric.floats import SLACK, Symmetric, U

_BLOCK = 20_000
_STEPS, _LEAST = 8, 1e-3
_TINY = 2.0**-900
"""More than all that underflow can change in a row, entries being at most about 2^60."""


def inertia(matrix: Symmetric, memory: int) -> tuple[int, float] | None:
    """(n, e): at most n eigenvalues of the exact matrix are at or below -e, and n of a matrix within e are negative.

    None where a pivot is 0 or not finite, or the factor would take more memory than `memory` bytes.
    """
    import numpy as np
    import qdldl

    try:
        with _limited(memory):
            lower, pivots, order = qdldl.Solver(matrix.upper, upper=True).factors()
            if not np.isfinite(pivots).all() or (pivots == 0).any() or not np.isfinite(lower.data).all():
                return None
            error = _error(matrix, lower, pivots, order)
    except (MemoryError, RuntimeError):
        return None
    return (int((pivots < 0).sum()), error) if np.isfinite(error) else None


def _error(matrix: Symmetric, lower: Any, pivots: Any, order: Any) -> float:
    """A bound of norm E: the residual as computed, and what rounding may have hidden in it.

    With ``abs E <= T`` entry by entry and any x > 0, norm E is at most the largest ``(T x)_i / x_i`` (Collatz).
    """
    import numpy as np
    from scipy.sparse import csr_array, diags_array, eye_array, triu

    n = len(pivots)
    if sorted(order) != list(range(n)):
        return float("inf")
    unit = (csr_array(lower) + eye_array(n, format="csr")).tocsr()
    if (unit.diagonal() != 1).any() or triu(unit, k=1).nnz:
        return float("inf")
    full = csr_array(matrix.upper + triu(matrix.upper, k=1).T)[order][:, order]
    sizes, weights = abs(unit), np.ones(n)
    for _ in range(_STEPS):
        weights = sizes @ (abs(pivots) * (sizes.T @ weights))
        weights = weights / weights.max() + _LEAST
    rounded = sizes @ (abs(pivots) * (sizes.T @ weights))
    # The sum at place (i, j) has at most as many terms as row i of U has entries.
    terms = (np.diff(unit.indptr) + 8) * U
    rounded = rounded * (terms / (1 - terms))
    scaled, turned = unit @ diags_array(pivots, format="csr"), unit.T.tocsr()
    worst = 0.0
    for start in range(0, n, _BLOCK):
        rows = slice(start, start + _BLOCK)
        left = abs(scaled[rows] @ turned - full[rows]) @ weights
        worst = max(worst, float(((left + rounded[rows]) / weights[rows]).max()))
    return (worst + float(matrix.error.max())) * SLACK + _TINY


@contextmanager
def _limited(memory: int) -> Iterator[None]:
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
