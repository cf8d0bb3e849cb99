"""Enclosures of powers, square roots and Gamma(1 + alpha), in integers rounded outward.

A fixed-point number is an integer n that stands for n / 2^w. Every series here has positive terms, so the whole error
analysis is the direction of each division, and a bound of what comes after the last term.
Source: gamma(z, T) = T^z e^-T sum_{k>=0} T^k / (z (z+1) ... (z+k)), DLMF 8.7.1.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import isqrt

_GUARD = 64
REMEMBERED = 1024
"""Answers kept: the parts of an interval of alpha share their ends, and all certificates of one loop share them."""


@dataclass(frozen=True)
class Enclosure:
    """A real number x with lower <= x <= upper."""

    lower: Fraction
    upper: Fraction

    @property
    def middle(self) -> Fraction:
        """Half way between."""
        return (self.lower + self.upper) / 2

    @property
    def radius(self) -> Fraction:
        """How far x may be from the middle."""
        return (self.upper - self.lower) / 2


def point(x: Fraction) -> Enclosure:
    """The enclosure of a rational by itself."""
    return Enclosure(x, x)


@lru_cache(maxsize=REMEMBERED)
def power(base: Fraction, exponent: Fraction, bits: int) -> Enclosure:
    """base^exponent for rational base > 0 and 0 < exponent < 1, to a relative width of about 2^-bits. Rigorous."""
    w = bits + _GUARD
    lower, upper = _log(base, w)
    p, q = exponent.numerator, exponent.denominator
    return outward(_exp(_div(lower * p, q, False), w, False), _exp(_div(upper * p, q, True), w, True), bits)


@lru_cache(maxsize=REMEMBERED)
def gamma_one_plus(alpha: Fraction, bits: int) -> Enclosure:
    """Gamma(1 + alpha) for rational 0 < alpha < 1, to a relative width of about 2^-bits. Rigorous."""
    w = bits + _GUARD
    return outward(*_gamma_ends(alpha, w * 7 // 10 + 1, w), bits)


def square_root(x: Enclosure, bits: int) -> Enclosure:
    """The square root of a number >= 0, to an absolute width of 2^-bits where x is a point. Rigorous."""
    lower = isqrt((max(x.lower.numerator, 0) << 2 * bits) // x.lower.denominator)
    upper = isqrt((x.upper.numerator << 2 * bits) // x.upper.denominator) + 1
    return Enclosure(Fraction(lower, 1 << bits), Fraction(upper, 1 << bits))


def first_threshold(alpha: Fraction, bits: int) -> Enclosure:
    """c_1 = 2^alpha - 1 for 0 <= alpha <= 1, exactly at the ends. Rigorous."""
    if alpha in (0, 1):
        return point(alpha)
    two = power(Fraction(2), alpha, bits)
    return Enclosure(max(two.lower, Fraction(1)) - 1, two.upper - 1)


def second_threshold(alpha: Fraction, bits: int) -> Enclosure:
    """sqrt(c_2) = sqrt(3^alpha - 2^alpha) for 0 <= alpha <= 1, exactly at the ends. Rigorous."""
    if alpha in (0, 1):
        return point(alpha)
    two, three = (power(Fraction(base), alpha, bits) for base in (2, 3))
    return square_root(Enclosure(three.lower - two.upper, three.upper - two.lower), bits)


def outward(lower: Fraction, upper: Fraction, bits: int) -> Enclosure:
    """An enclosure of [lower, upper], both > 0, its ends of bits + 8 bits: short numbers make short matrices."""
    return Enclosure(
        _rounded(lower.numerator, lower.denominator, bits, False),
        _rounded(upper.numerator, upper.denominator, bits, True),
    )


def outward_over(x: Fraction, top: Enclosure, below: Enclosure, bits: int) -> Enclosure:
    """The same of x top / below, all > 0; numbers of any length share no divisors that would have to be sought."""
    ends = ((top.lower, below.upper, False), (top.upper, below.lower, True))
    lower, upper = (
        _rounded(x.numerator * a.numerator * b.denominator, x.denominator * a.denominator * b.numerator, bits, up)
        for a, b, up in ends
    )
    return Enclosure(lower, upper)


def _rounded(above: int, below: int, bits: int, up: bool) -> Fraction:
    """above / below > 0, rounded up or down to bits + 8 bits."""
    shift = bits + 8 + below.bit_length() - above.bit_length()
    units = _div(above << max(shift, 0), below << max(-shift, 0), up)
    return Fraction(units << max(-shift, 0), 1 << max(shift, 0))


def quotient(x: Enclosure, y: Enclosure) -> Enclosure:
    """x / y for y > 0. Rigorous."""
    lower = x.lower / (y.upper if x.lower >= 0 else y.lower)
    return Enclosure(lower, x.upper / (y.lower if x.upper >= 0 else y.upper))


def _div(a: int, b: int, up: bool) -> int:
    """a / b rounded to an integer, up or down; b > 0."""
    return -(-a // b) if up else a // b


@lru_cache(maxsize=64)
def _log(x: Fraction, w: int) -> tuple[int, int]:
    """Bounds of log x, x > 0: with x = 2^e m, 1 <= m < 2, log x = e log 2 + 2 atanh((m - 1)/(m + 1))."""
    e = x.numerator.bit_length() - x.denominator.bit_length()
    above, below = x.numerator << max(-e, 0), x.denominator << max(e, 0)
    if above < below:
        e, above = e - 1, 2 * above
    z = Fraction(above - below, above + below)
    two = tuple(2 * _atanh(Fraction(1, 3), w, up) for up in (False, True))
    return (e * two[e < 0] + 2 * _atanh(z, w, False), e * two[e >= 0] + 2 * _atanh(z, w, True))


def _atanh(z: Fraction, w: int, up: bool) -> int:
    """A bound of atanh z = sum z^(2j+1)/(2j+1) for 0 <= z <= 1/3."""
    term = _div(z.numerator << w, z.denominator, up)
    square = _div(term * term, 1 << w, up)
    total, odd = 0, 1
    while term > 1:
        total += _div(term, odd, up)
        term = _div(term * square, 1 << w, up)
        odd += 2
    # What is left out is at most term (1 + z^2 + z^4 + ...) <= 9/8 term, and at least 0.
    return total + 2 * term if up else total


def _exp(x: int, w: int, up: bool) -> Fraction:
    """A bound of e^(x / 2^w) = 2^n e^r with r = x - n log 2, where n is such that every bound of r is >= 0."""
    low, high = _log(Fraction(2), w)
    n, r = divmod(x, high if x >= 0 else low)
    if up:
        r += abs(n) * (high - low)
    term, total, k = 1 << w, 0, 1
    while term > 1:
        total += term
        term = _div(term * r, k << w, up)
        k += 1
    # r <= 1: the terms from here on are at most term (1 + 1/k + 1/k^2 + ...) <= 2 term, as k >= 2.
    return Fraction((total + 2 * term if up else total) << max(n - w, 0), 1 << max(w - n, 0))


def _gamma_ends(alpha: Fraction, t: int, w: int) -> tuple[Fraction, Fraction]:
    """Bounds of Gamma(z) = gamma(z, t) + Gamma(z, t), z = 1 + alpha, for an integer t >= 1."""
    p, q = alpha.numerator, alpha.denominator
    log_t = _log(Fraction(t), w)
    ends = []
    for up in (False, True):
        factor = _exp(_div(log_t[up] * (p + q), q, up) - (t << w), w, up)
        ends.append(factor * Fraction(_incomplete_series(p, q, t, w, up), 1 << w))
    # As z <= 2 and s >= t >= 1: s^(z-1) <= s, so Gamma(z, t) <= int_t^oo s e^-s ds = (t + 1) e^-t; and e > 2^(36/25).
    return ends[0], ends[1] + Fraction(t + 1, 1 << (t * 36 // 25))


def _incomplete_series(p: int, q: int, t: int, w: int, up: bool) -> int:
    """A bound of sum_{k>=0} t^k / (z (z+1) ... (z+k)) for z = 1 + p/q."""
    below = p + q
    term = _div(q << w, below, up)
    total = 0
    # From a ratio t/(z+k) <= 1/2 of neighbours on, what follows a term is at most that term.
    while below < 2 * t * q or term > 1 + (total >> w):
        total += term
        below += q
        term = _div(term * t * q, below, up)
    return total + 2 * term if up else total
