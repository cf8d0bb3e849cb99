"""The memory of the fractional integrator in binary floats: approximate, each number to a few units in the last place.

``c_n = (n+1)^alpha - n^alpha``, ``F(z) = 1 + sum f(l) z^l`` with ``f(l) = c_l - c_{l-1}``. Source: theory, sections 1
and 2; the rigorous numbers are those of the room `kernel`.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import fft

Array: TypeAlias = NDArray[np.float64]

_SERIES_FROM, _SERIES_TERMS = 10, 9
_DIRECT_TERMS = 64


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


def approx_inverse_series(a: Array) -> Array:
    """The coefficients of ``1 / sum a_n z^n`` to the same length, with a_0 = 1: Newton's iteration by padded FFT."""
    count = len(a)
    found = np.zeros(count)
    found[0] = 1.0
    known = min(count, _DIRECT_TERMS)
    for n in range(1, known):
        found[n] = -(a[1 : n + 1] @ found[n - 1 :: -1][:n])
    while known < count:
        wanted = min(2 * known, count)
        # Cyclic of length 2 known: what wraps around falls on entries that are not read.
        spectrum = fft.rfft(found[:known], 2 * known)
        excess = fft.irfft(spectrum * fft.rfft(a[:wanted], 2 * known), 2 * known)[known:wanted]
        found[known:wanted] = -fft.irfft(spectrum * fft.rfft(excess, 2 * known), 2 * known)[: wanted - known]
        known = wanted
    return found
