"""Rigorous enclosures of powers, roots and Gamma by ball arithmetic (Arb).

Precision is an argument of every function: the bits of the working precision, set here and restored here.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from math import isqrt

from flint import arb, ctx, fmpq

from fomas_verify.enclosure.interval import Interval

Ball = arb

LARGEST_LOG = 1 << 13
"""The binary logarithm beyond which no number is given digits."""


@contextmanager
def working_precision(bits: int) -> Iterator[None]:
    """Arb's working precision inside the block; the former one after it."""
    with ctx.workprec(bits):
        yield


def to_fmpq(x: Fraction) -> fmpq:
    """The same rational in flint's type."""
    return fmpq(x.numerator, x.denominator)


def exact_end(x: arb) -> Fraction:
    """The rational that an exact ball is."""
    mantissa, exponent = x.man_exp()
    m, e = int(mantissa), int(exponent)
    return Fraction(m << e) if e >= 0 else Fraction(m, 1 << -e)


def to_interval(x: arb) -> Interval:
    """The ball's ends, rounded outward, as rationals; raises ArithmeticError for a ball that is not finite."""
    if not x.is_finite():
        raise ArithmeticError("an enclosure is not finite")
    return Interval(exact_end(x.lower()), exact_end(x.upper()))


def to_ball(x: Interval) -> arb:
    """A ball that contains the enclosure."""
    lower = arb(to_fmpq(x.lower))
    return lower if x.is_exact else lower.union(arb(to_fmpq(x.upper)))


def power(base: Fraction, exponent: Fraction, bits: int) -> Interval:
    """``base^exponent`` for base > 0."""
    with working_precision(bits):
        return to_interval(arb(to_fmpq(base)) ** to_fmpq(exponent))


def square_root(x: Interval, bits: int) -> Interval:
    """The square root of a nonnegative number, exact for the square of a rational.

    A negative lower end, a rounding of 0, is taken as 0.
    """
    lower, upper = max(x.lower, Fraction(0)), max(x.upper, Fraction(0))
    if x.is_exact:
        root = isqrt(lower.numerator), isqrt(lower.denominator)
        if root[0] ** 2 == lower.numerator and root[1] ** 2 == lower.denominator:
            return Interval.exactly(Fraction(*root))
    with working_precision(bits):
        low, high = (to_interval(arb(to_fmpq(end)).sqrt()) for end in (lower, upper))
    return Interval(max(low.lower, Fraction(0)), high.upper)


def one_minus_cosine(x: Fraction, bits: int) -> Interval:
    """``1 - cos(pi x) = 2 sin(pi x/2)^2`` for rational x, with about ``bits`` correct bits however small it is."""
    with working_precision(bits):
        return to_interval(2 * arb.sin_pi_fmpq(to_fmpq(x / 2)) ** 2)


def gamma_function(x: Fraction, bits: int) -> Interval:
    """Gamma(x) for rational x > 0."""
    with working_precision(bits):
        return to_interval(arb.gamma_fmpq(to_fmpq(x)))


def power_of(base: Interval, exponent: Fraction, bits: int) -> Interval:
    """``base^exponent`` for an enclosed base > 0."""
    with working_precision(bits):
        return to_interval(to_ball(base) ** to_fmpq(exponent))


def root_of(x: Interval, alpha: Fraction, bits: int) -> Interval | None:
    """``x^(1/alpha)`` for an enclosed x > 0; None beyond ``2^-8192`` and ``2^8192``, where alpha is near 0."""
    far = max(map(abs, log2(x, bits).ends)) > LARGEST_LOG * alpha
    return None if far else power_of(x, 1 / alpha, bits)


def log2(x: Interval, bits: int) -> Interval:
    """The binary logarithm of an enclosed x > 0."""
    with working_precision(bits):
        return to_interval(to_ball(x).log() / arb(2).log())
