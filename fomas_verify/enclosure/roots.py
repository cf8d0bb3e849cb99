"""All roots of an integer polynomial, each enclosed and counted.

python-flint isolates them rigorously: one ball a distinct root, with its multiplicity.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import acb, arb, fmpz_poly

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import exact_end, square_root, to_ball, to_fmpq, to_interval, working_precision


@dataclass(frozen=True)
class Root:
    """One distinct complex root: its parts, the square of its modulus, its multiplicity."""

    real: Interval
    imag: Interval
    square: Interval
    multiplicity: int

    def over(self, scale: int) -> Root:
        """The root divided by a positive integer."""
        return Root(self.real / scale, self.imag / scale, self.square / scale**2, self.multiplicity)


def root_of(real: Interval, imag: Interval, multiplicity: int) -> Root:
    """A root from its parts."""
    square = real * real + imag * imag
    return Root(real, imag, Interval(max(square.lower, Fraction(0)), square.upper), multiplicity)


def complex_roots(p: fmpz_poly, bits: int) -> list[Root]:
    """Every distinct root of p, rigorously enclosed, sorted by real, then imaginary part.

    Exact are rational roots, and the real part and modulus of a conjugate pair that is quadratic over Q.
    """
    _, factors = p.factor()
    roots = [root for factor, count in factors for root in _factor_roots(factor, int(count), bits)]
    return sorted(roots, key=lambda r: (r.real.mid, r.imag.mid))


def _factor_roots(p: fmpz_poly, count: int, bits: int) -> list[Root]:
    """The roots of an irreducible polynomial."""
    c, *rest = (int(x) for x in p.coeffs())
    if len(rest) == 1:
        return [root_of(Interval.exactly(Fraction(-c, rest[0])), Interval.exactly(0), count)]
    if len(rest) == 2 and (discriminant := rest[0] ** 2 - 4 * rest[1] * c) < 0:
        real, square = Interval.exactly(Fraction(-rest[0], 2 * rest[1])), Interval.exactly(Fraction(c, rest[1]))
        imag = square_root(Interval.exactly(Fraction(-discriminant, 4 * rest[1] ** 2)), bits)
        return [Root(real, part, square, count) for part in (-imag, imag)]
    with working_precision(bits):
        balls: Any = p.complex_roots()  # the stubs say acb; it is a list of pairs
        return [root_of(to_interval(ball.real), to_interval(ball.imag), count) for ball, _ in balls]


def real_roots(p: fmpz_poly, bits: int) -> list[tuple[Interval, int]]:
    """Every distinct root of a polynomial all of whose roots are real (a symmetric matrix's), in increasing order.

    Each comes with its multiplicity, and is exact where it is an integer.
    """
    with working_precision(bits):
        balls: Any = p.complex_roots()
        roots = [(_integer_root(p, ball.real) or to_interval(ball.real), int(count)) for ball, count in balls]
    return sorted(roots, key=lambda pair: pair[0].mid)


def _integer_root(p: fmpz_poly, ball: arb) -> Interval | None:
    """The isolated root as an integer, where it is one: the one root in the ball is the root of p found there."""
    candidate = ball.unique_fmpz()
    return None if candidate is None or p(candidate) != 0 else Interval.exactly(int(candidate))


def is_on_unit_circle(roots: list[Root]) -> list[bool]:
    """For the distinct roots of a self-reciprocal real polynomial: which have modulus exactly 1.

    With z, ``1/conj(z)`` is a root too. Where its enclosure meets that of z alone, it is z, so abs z = 1. False also
    means don't know.
    """
    verdicts = []
    for root in roots:
        if root.square.lower <= 0:
            verdicts.append(False)
            continue
        real, imag = root.real / root.square, root.imag / root.square
        meets = [other for other in roots if other.real.overlaps(real) and other.imag.overlaps(imag)]
        verdicts.append(meets == [root])
    return verdicts


def power_sum(eigenvalues: list[Root], t: Fraction, n: int, bits: int) -> Interval:
    """``abs sum (1 - t lambda)^n`` over eigenvalues lambda with their multiplicities.

    Rigorous, and useless where n is too large for the bits.
    """
    with working_precision(bits):
        total = acb(0)
        for root in eigenvalues:
            base = 1 - arb(to_fmpq(t)) * acb(to_ball(root.real), to_ball(root.imag))
            total += root.multiplicity * base**n
        if not total.is_finite():
            return Interval(Fraction(0), Fraction(0))
        return Interval(exact_end(total.abs_lower()), exact_end(total.abs_upper()))
