"""The memory of the fractional integrator in binary floats: approximate, each number to a few units in the last place.

``c_n = (n+1)^alpha - n^alpha``, ``F(z) = 1 + sum f(l) z^l`` with ``f(l) = c_l - c_{l-1}``. Source: theory, sections 1
and 2; the rigorous numbers are those of the room `kernel`.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]

_SERIES_FROM, _SERIES_TERMS = 10, 9


def approx_step_response(alpha: float, count: int, share: float = 1.0) -> Array:
    """The memory's response a share of a period after sample n, for n = 0..count-1.

    ``(n + share)^alpha - (n - 1 + share)^alpha`` for n >= 1 and ``share^alpha`` for n = 0, with 0 < share <= 1; the
    share 1 gives c_n. Without the cancellation that the difference of two powers suffers.
    """
    base = np.arange(count, dtype=np.float64) - 1.0 + share
    base[0] = 1.0
    found: Array = base**alpha * np.expm1(alpha * np.log1p(1.0 / base))
    found[0] = share**alpha
    return found


def approx_memory_series(alpha: float, count: int) -> Array:
    """``1, f(1), ..., f(count-1)``; from f(10) on by ``2 j^alpha sum_i binomial(alpha, 2 i) j^(-2 i)``, which cancels
    nothing.
    """
    found = np.ones(count)
    near = np.arange(1, min(count, _SERIES_FROM), dtype=np.float64)
    found[1:_SERIES_FROM] = (near + 1) ** alpha - 2 * near**alpha + (near - 1) ** alpha
    far = np.arange(_SERIES_FROM, count, dtype=np.float64)
    square, total, binomial = far**-2.0, np.zeros_like(far), 1.0
    coefficients = []
    for i in range(1, _SERIES_TERMS + 1):
        binomial *= (alpha - 2 * i + 2) * (alpha - 2 * i + 1) / ((2 * i - 1) * (2 * i))
        coefficients.append(binomial)
    for coefficient in reversed(coefficients):
        total = (total + coefficient) * square
    found[_SERIES_FROM:] = 2 * far**alpha * total
    return found


def largest(x: Array) -> float:
    """``max abs x_i``, without a copy; NaN where one is."""
    return max(float(x.max()), -float(x.min()))
