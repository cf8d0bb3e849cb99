"""Approximate eigenvectors, and integer vectors that sum to 0 near them. Nothing here bears on the truth of a bound."""

from __future__ import annotations

from math import ceil, log2
from typing import TYPE_CHECKING, Any

from fomas_verify.spectrum.large.matrices import Near

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from fomas_verify.spectrum.large.factor import Solve

_SMALL = 100
_FINEST, _COARSEST = 60, 20
_WANTED = 2.0**-31
"""The relative error that rounding may add to a quotient."""

_TOLERANCE = 1e-7
_ROUGH_TOLERANCE = 1e-5
_LONGEST = 2000
_MOST_WORK = 2e9
"""Products of numbers that may be spent on multiplying by a matrix."""

_BASIS = 20


def quotient(near: Near, x: NDArray[Any]) -> float:
    """``x^T A x / x^T x``."""
    return float(x @ (near.matrix @ x) / (x @ x))


def slowest(near: Near, solve: Solve) -> NDArray[Any] | None:
    """A vector of 1perp near an eigenvector of the eigenvalue nearest to 0 there; None if none is found."""
    from scipy.sparse.linalg import LinearOperator

    n = near.matrix.shape[0]
    if n <= _SMALL:
        return _dense(near, which=0)
    inverse = LinearOperator((n, n), matvec=lambda x: _apart(solve(_apart(x))), dtype=float)
    return _lanczos(inverse, n, "LM", _TOLERANCE)


def slowest_without_factor(near: Near) -> NDArray[Any] | None:
    """A vector of 1perp near an eigenvector of the smallest eigenvalue there; good where the spectrum has a gap."""
    from scipy.sparse.linalg import LinearOperator

    n = near.matrix.shape[0]
    if n <= _SMALL:
        return _dense(near, which=0)
    away = 4 * near.largest
    lifted = LinearOperator((n, n), matvec=lambda x: near.matrix @ _apart(x) + away * x.mean(), dtype=float)
    return _lanczos(lifted, n, "SA", _TOLERANCE, _restarts(near))


def fastest(near: Near) -> NDArray[Any] | None:
    """A vector of 1perp near an eigenvector of the largest eigenvalue."""
    n = near.matrix.shape[0]
    return _dense(near, which=-1) if n <= _SMALL else _lanczos(near.matrix, n, "LA", _ROUGH_TOLERANCE, _restarts(near))


def integer_vector(near: Near, x: NDArray[Any]) -> tuple[int, ...] | None:
    """Integers that sum to 0, not all 0, near a multiple of x; as many digits as its quotient needs."""
    import numpy as np

    x = _apart(x)
    value, top = abs(quotient(near, x)), float(abs(x).max())
    if not np.isfinite(value) or not top > 0:
        return None
    spread = top / float(np.sqrt(x @ x / len(x)))
    wanted = log2(max(1.0, 2 * near.largest / max(value, 2.0**-200) / _WANTED)) / 2 + log2(spread)
    bits = min(_FINEST, max(_COARSEST, ceil(wanted)))
    whole = np.rint(x * (2.0**bits / top)).astype(np.int64)
    # At most half a unit an agent is missing from the sum 0, and what the floats lost.
    share, rest = divmod(int(whole.sum()), len(whole))
    whole -= share
    whole[:rest] -= 1
    return tuple(whole.tolist()) if whole.any() else None


def _apart(x: NDArray[Any]) -> NDArray[Any]:
    """What is left of x on 1perp."""
    apart: NDArray[Any] = x - x.mean()
    return apart


def _dense(near: Near, *, which: int) -> NDArray[Any]:
    """An eigenvector on 1perp, counted from the smallest eigenvalue (0) or from the largest (-1)."""
    import numpy as np

    n = near.matrix.shape[0]
    away = 4 * n * near.largest * (1 if which == 0 else -1)
    vectors = np.linalg.eigh(near.matrix.toarray() + away / n)[1]
    return _apart(vectors[:, which])


def _restarts(near: Near) -> int:
    """How often Lanczos' method may begin anew within `_MOST_WORK`."""
    return int(min(_LONGEST, max(10.0, _MOST_WORK / (_BASIS * near.matrix.nnz))))


def _lanczos(operator: Any, n: int, which: str, tolerance: float, restarts: int = _LONGEST) -> NDArray[Any] | None:
    """One eigenvector; None where none is found. The start is the same in every run."""
    import numpy as np
    from scipy.sparse.linalg import ArpackError, ArpackNoConvergence, eigsh

    start = _apart(np.random.default_rng(0).standard_normal(n))
    try:
        vectors = eigsh(operator, k=1, which=which, v0=start, ncv=_BASIS, tol=tolerance, maxiter=restarts)[1]
    except ArpackNoConvergence as stopped:
        vectors = stopped.eigenvectors
    except ArpackError:
        return None
    if vectors.shape[1] == 0 or not np.isfinite(vectors[:, 0]).all():
        return None
    return _apart(vectors[:, 0])
