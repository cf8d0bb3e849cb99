"""Enclosures of 1 - cos(pi p/q), in integers rounded outward, to a relative width: eigenvalues of cycles and paths.

Source: 1 - cos y = y^2/2! - y^4/4! + ..., with terms that fall for 0 <= y <= pi, as y^2 < 12; Machin's formula for pi.
"""

from fractions import Fraction
from functools import lru_cache

from fomas_verify.checker.powers import Enclosure, point

_GUARD = 64
_EXACT = {
    Fraction(1): Fraction(2),
    Fraction(2, 3): Fraction(3, 2),
    Fraction(1, 2): Fraction(1),
    Fraction(1, 3): Fraction(1, 2),
}


@lru_cache(maxsize=64)
def versine(x: Fraction, bits: int) -> Enclosure:
    """1 - cos(pi x) for rational 0 < x <= 1, to a relative width of about 2^-bits, exactly where it is rational."""
    if x in _EXACT:
        return point(_EXACT[x])
    w = bits + 2 * x.denominator.bit_length() + _GUARD
    pi = _pi(w)
    lower, upper = (pi[0] * x.numerator // x.denominator, -(-pi[1] * x.numerator // x.denominator))
    # 1 - cos y increases with y up to pi; above pi by no more than its rounding is no argument here, as x < 1.
    ends = _series(lower * lower >> w, w, False), _series((upper * upper >> w) + 1, w, True)
    return Enclosure(*(Fraction(end, 1 << w) for end in ends))


def _series(square: int, w: int, up: bool) -> int:
    """A bound of 1 - cos y where y^2 = square / 2^w < 12."""
    low, high = square // 2, (square + 1) // 2
    total, k, positive = 0, 1, True
    while high > 1:
        total += (high if up else low) if positive else -(low if up else high)
        below = ((2 * k + 1) * (2 * k + 2)) << w
        low, high = low * square // below, -(-high * square // below)
        k, positive = k + 1, not positive
    # The terms alternate and fall: what is left out is at most the next one.
    return total + high if up else total - high


@lru_cache(maxsize=8)
def _pi(w: int) -> tuple[int, int]:
    """Bounds of 2^w pi, pi = 16 atan(1/5) - 4 atan(1/239)."""
    five, other = _atan_of_inverse(5, w), _atan_of_inverse(239, w)
    return 16 * five[0] - 4 * other[1], 16 * five[1] - 4 * other[0]


def _atan_of_inverse(n: int, w: int) -> tuple[int, int]:
    """Bounds of 2^w atan(1/n) = 2^w sum (-1)^j / ((2j+1) n^(2j+1))."""
    low = high = 0
    odd, below, positive = 1, n, True
    while (1 << w) >= odd * below:
        term = (1 << w) // (odd * below)
        low += term if positive else -(term + 1)
        high += (term + 1) if positive else -term
        odd, below, positive = odd + 2, below * n * n, not positive
    return low - 1, high + 1
