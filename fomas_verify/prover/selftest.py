"""Known answers of every primitive that a verdict rests on, proved again.

Each test compares with a fact of arithmetic that needs no library: integer powers, exact rationals, closed forms. A
library with a wrong negation, a rounding to nearest where it should be outward, or a wrong characteristic polynomial
fails here.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import (
    Ball,
    gamma_function,
    log2,
    power,
    square_root,
    to_ball,
    to_interval,
    working_precision,
)
from fomas_verify.enclosure.reference import approx_memory
from fomas_verify.enclosure.roots import complex_roots, real_roots
from fomas_verify.enclosure.series import inverse_series
from fomas_verify.exact import matrix as exact
from fomas_verify.exact.matrix import Inertia
from fomas_verify.exact.numberfield import RealField
from fomas_verify.exact.polynomial import (
    integer_characteristic_polynomial,
    irreducible_factors,
    polynomial,
    power_sums,
)
from fomas_verify.kernel.memory import second_difference

BITS = 128
THIN = Fraction(1, 2**100)
PI = Fraction(31415926535897932384626433832795028841, 10**37), Fraction(31415926535897932384626433832795028842, 10**37)


def _encloses_root(x: Interval, degree: int, radicand: int) -> bool:
    """Whether the enclosure holds the positive root of ``x^degree = radicand`` and is thin."""
    return x.lower > 0 and x.lower**degree <= radicand <= x.upper**degree and x.width < THIN * radicand


def negation() -> bool:
    """``-x`` and ``1 - x`` of a ball negate it (before python-flint 0.9, ``arb.neg()`` returned its input)."""
    with working_precision(BITS):
        third = to_ball(Interval.exactly(Fraction(1, 3)))
        negated, complement = to_interval(-third), to_interval(1 - third)
        method = to_interval(third.neg())
    return all(x.contains(Fraction(-1, 3)) and x.upper < 0 for x in (negated, method)) and complement.contains(
        Fraction(2, 3)
    )


def ball_ends() -> bool:
    """A ball from two ends contains both, and its ends come back outward."""
    wide = Interval(Fraction(1, 3), Fraction(2, 3))
    with working_precision(53):
        back = to_interval(to_ball(wide))
    return back.lower <= wide.lower and back.upper >= wide.upper


def powers() -> bool:
    """``2^(9/10)``, ``3^(1/2)``, ``(17/20)^(9/10)`` against exact integer powers."""
    base = power(Fraction(17, 20), Fraction(9, 10), BITS)
    inside = base.lower**10 <= Fraction(17, 20) ** 9 <= base.upper**10 and base.width < THIN
    return (
        inside
        and _encloses_root(power(Fraction(2), Fraction(9, 10), BITS), 10, 2**9)
        and _encloses_root(power(Fraction(3), Fraction(1, 2), BITS), 2, 3)
    )


def square_roots() -> bool:
    """Of 2, and exactly of 9/4."""
    two = square_root(Interval.exactly(2), BITS)
    return _encloses_root(two, 2, 2) and square_root(Interval.exactly(Fraction(9, 4)), BITS) == Interval.exactly(
        Fraction(3, 2)
    )


def gamma_values() -> bool:
    """``Gamma(5) = 24``, ``Gamma(1/2)^2 = pi``, ``Gamma(19/10) = 9/10 Gamma(9/10)``."""
    half = gamma_function(Fraction(1, 2), BITS)
    step = gamma_function(Fraction(9, 10), BITS) * Fraction(9, 10)
    return (
        gamma_function(Fraction(5), BITS).contains(Fraction(24))
        and half.lower**2 <= PI[1]
        and half.upper**2 >= PI[0]
        and half.width < THIN
        and step.overlaps(gamma_function(Fraction(19, 10), BITS))
    )


def logarithm() -> bool:
    """``log2(8) = 3`` and ``log2(1/4) = -2``."""
    return log2(Interval.exactly(8), BITS).contains(Fraction(3)) and log2(
        Interval.exactly(Fraction(1, 4)), BITS
    ).contains(Fraction(-2))


def series() -> bool:
    """``1/(1 - z) = 1 + z + z^2 + ...``."""
    ones = inverse_series([Ball(x) for x in (1, -1, 0, 0, 0, 0, 0, 0)], BITS)
    return all(x.contains(Fraction(1)) and x.width < THIN for x in ones)


def memory_kernel() -> bool:
    """``f(1) = 2^alpha - 2`` and mpmath's f(10^12) inside Arb's."""
    alpha, far = Fraction(9, 10), 10**12
    first = second_difference(alpha, 1, BITS) + 2
    distant = second_difference(alpha, far, BITS)
    return _encloses_root(first, 10, 2**9) and distant.contains(approx_memory(alpha, far, 60)[0])


def characteristic_polynomial() -> bool:
    """Of ``[[2, 1], [1, 2]]/3``: ``z^2 - 4 z + 3``, the roots scaled by 3."""
    a = exact.matrix([[Fraction(2, 3), Fraction(1, 3)], [Fraction(1, 3), Fraction(2, 3)]])
    return integer_characteristic_polynomial(a) == (polynomial([3, -4, 1]), 3)


def inertias() -> bool:
    """Of a matrix with eigenvalues 3, 1, 0 and -1, and of one that is singular by structure."""
    mixed = exact.matrix(
        [[Fraction(x) for x in row] for row in ([2, 1, 0, 0], [1, 2, 0, 0], [0, 0, -1, 0], [0, 0, 0, 0])]
    )
    return (exact.inertia(mixed), exact.inertia(exact.all_ones(5))) == (Inertia(1, 1, 2), Inertia(0, 4, 1))


def polynomial_roots() -> bool:
    """Of ``(z - 1)...(z - 12)``, all real and exact, and of ``(z^2 - 2 z + 2)^2``, twice 1 +- i."""
    wilkinson = polynomial([1])
    for root in range(1, 13):
        wilkinson *= polynomial([-root, 1])
    pair = complex_roots(polynomial([2, -2, 1]) * polynomial([2, -2, 1]), BITS)
    return real_roots(wilkinson, BITS) == [(Interval.exactly(n), 1) for n in range(1, 13)] and [
        (root.real.lower, root.imag.lower, root.multiplicity) for root in pair
    ] == [(Fraction(1), Fraction(-1), 2), (Fraction(1), Fraction(1), 2)]


def factors() -> bool:
    """``z^4 + 4`` splits over Q, ``z^4 + 1`` does not; Newton's sums of ``z^2 - 3 z + 1`` are 2, 3, 7, 18."""
    split, whole = irreducible_factors(polynomial([4, 0, 0, 0, 1])), irreducible_factors(polynomial([1, 0, 0, 0, 1]))
    return len(split) == 2 and len(whole) == 1 and power_sums(polynomial([1, -3, 1]), 4) == [2, 3, 7, 18]


def number_field() -> bool:
    """In Q(sqrt 2): ``99/70 > sqrt 2 > 239/169``, though they differ in the fifth decimal."""
    field = RealField(polynomial([-2, 0, 1]), Fraction(1), Fraction(2))
    return (
        field.sign(field.affine(Fraction(-99, 70), Fraction(1))) < 0
        and field.sign(field.affine(Fraction(-239, 169), Fraction(1))) > 0
    )


def digits() -> bool:
    """Printed digits are truncated: 2/3 in an interval reads 0.666..., never 0.667."""
    around = Interval(Fraction(2, 3) - THIN, Fraction(2, 3) + THIN)
    return decimal(around, 5) == "0.66666..." and decimal(Interval.exactly(Fraction(9, 10)), 5) == "0.9"


PRIMITIVES: tuple[Callable[[], bool], ...] = (
    negation,
    ball_ends,
    powers,
    square_roots,
    gamma_values,
    logarithm,
    series,
    memory_kernel,
    characteristic_polynomial,
    inertias,
    polynomial_roots,
    factors,
    number_field,
    digits,
)
