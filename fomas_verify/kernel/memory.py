"""The memory of the fractional integrator.

``c_n = (n+1)^alpha - n^alpha`` is its step response, ``f(j) = c_j - c_{j-1}`` (label eqL2_1), ``c_0 = 1``; the
partial sums of abs f telescope to ``1 - c_n``; ``r`` is the inverse of ``1 + sum f(l) z^l`` as a power series (the
resolvent).
Source: theory, section 2.
"""

from __future__ import annotations

from fractions import Fraction

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import gamma_function, power
from fomas_verify.enclosure.series import inverse_series


def _cancelled_bits(n: int) -> int:
    """The bits that the second difference of ``n^alpha`` loses: its terms are about n^2 times larger than it."""
    return 2 * n.bit_length() + 16


def step_response(alpha: Fraction, n: int, bits: int) -> Interval:
    """``c_n`` for n >= 0, with about ``bits`` correct bits; rigorous."""
    if n == 0:
        return Interval.exactly(1)
    working = bits + _cancelled_bits(n) + alpha.denominator.bit_length()
    return power(Fraction(n + 1), alpha, working) - power(Fraction(n), alpha, working)


def second_difference(alpha: Fraction, j: int, bits: int) -> Interval:
    """``f(j) = (j+1)^alpha - 2 j^alpha + (j-1)^alpha`` for j >= 1, with about ``bits`` correct bits; rigorous."""
    working = bits + _cancelled_bits(j) + 2 * alpha.denominator.bit_length()
    before = power(Fraction(j - 1), alpha, working) if j > 1 else Interval.exactly(0)
    return power(Fraction(j + 1), alpha, working) - power(Fraction(j), alpha, working) * 2 + before


def resolvent(alpha: Fraction, terms: int, bits: int) -> list[Interval]:
    """``r_0 .. r_{terms-1}``; rigorous."""
    working = bits + 2 * terms.bit_length() + 32
    coefficients = [Interval.exactly(1)] + [second_difference(alpha, j, working) for j in range(1, terms)]
    return inverse_series(coefficients, working)


def one_step_weight(alpha: Fraction, h: Fraction, bits: int) -> Interval:
    """``m = h^alpha / Gamma(alpha + 1)``; rigorous."""
    return power(h, alpha, bits) / gamma_function(alpha + 1, bits)


def threshold(alpha: Fraction, bits: int) -> Interval:
    """``c_1 = 2^alpha - 1``; rigorous."""
    return step_response(alpha, 1, bits)
