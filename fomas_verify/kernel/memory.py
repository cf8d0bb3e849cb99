"""The memory of the fractional integrator.

``c_n = (n+1)^alpha - n^alpha`` is its step response, ``f(j) = c_j - c_{j-1}`` (label eqL2_1), ``c_0 = 1``; the
partial sums of abs f telescope to ``1 - c_n``; ``r`` is the inverse of ``1 + sum f(l) z^l`` as a power series (the
resolvent).
Source: theory, section 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import gamma_function, power, to_ball
from fomas_verify.enclosure.series import inverse_series, second_differences

LEAST_SLOPE, GREATEST_SLOPE = Fraction(578, 1000), Fraction(423, 1000)
"""``-LEAST_SLOPE <= Gamma'(1 + x) <= GREATEST_SLOPE`` on [0, 1]: Gamma'(1) = -0.57721..., Gamma'(2) = 0.42278..., and
Gamma is convex."""


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


@lru_cache(maxsize=16)
def resolvent(alpha: Fraction, terms: int, bits: int) -> Sequence[Interval]:
    """``r_0 .. r_{terms-1}``; rigorous."""
    working = bits + 2 * terms.bit_length() + 32 + _cancelled_bits(terms) + 2 * alpha.denominator.bit_length()
    f = second_differences(alpha, terms - 1, working)
    return tuple(inverse_series([to_ball(Interval.exactly(1)), *f], working))


def step_response_over(alpha: Interval, n: int, bits: int) -> Interval:
    """Every ``c_n`` with alpha in a closed part of [0, 1]: it increases with alpha for n >= 1; rigorous."""
    lower = step_response(alpha.lower, n, bits)
    return lower if alpha.is_exact else Interval(lower.lower, step_response(alpha.upper, n, bits).upper)


def resolvent_over(alpha: Interval, terms: int, bits: int) -> Sequence[Interval]:
    """Enclosures of ``r_0 .. r_{terms-1}`` for every alpha in a closed part of (0, 1): none increases with alpha;
    rigorous.
    """
    upper = resolvent(alpha.lower, terms, bits)
    if alpha.is_exact:
        return upper
    lower = resolvent(alpha.upper, terms, bits)
    return [Interval(a.lower, b.upper) for a, b in zip(lower, upper, strict=True)]


def one_step_weight_over(alpha: Interval, h: Interval, bits: int) -> Interval:
    """Every ``m = h^alpha / Gamma(alpha + 1)`` with alpha in a closed part of [0, 1] and h > 0 enclosed; rigorous.

    h^alpha is monotone in each; Gamma is convex on [1, 2], with a derivative between -0.578 and 0.423.
    """
    powers = [power(base, exponent, bits) for base in (h.lower, h.upper) for exponent in (alpha.lower, alpha.upper)]
    left, right = (gamma_function(1 + end, bits) for end in (alpha.lower, alpha.upper))
    least = max(left.lower - LEAST_SLOPE * alpha.width, right.lower - GREATEST_SLOPE * alpha.width)
    gamma = Interval(least, max(left.upper, right.upper))
    return Interval(min(x.lower for x in powers), max(x.upper for x in powers)) / gamma


def one_step_weight(alpha: Fraction, h: Fraction, bits: int) -> Interval:
    """``m = h^alpha / Gamma(alpha + 1)``; rigorous."""
    return power(h, alpha, bits) / gamma_function(alpha + 1, bits)


def threshold(alpha: Fraction, bits: int) -> Interval:
    """``c_1 = 2^alpha - 1``; rigorous."""
    return step_response(alpha, 1, bits)
