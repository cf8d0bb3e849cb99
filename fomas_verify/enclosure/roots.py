"""All roots of an integer polynomial, each enclosed and counted.

python-flint isolates them rigorously: one ball a distinct root, with its multiplicity.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from flint import acb, arb, fmpz, fmpz_poly

from fomas_verify.enclosure.interval import Interval, round_down, round_up
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


def least_root(p: fmpz_poly, bits: int) -> Interval:
    """The smallest root of a polynomial all of whose roots are real; exact where it is an integer. Rigorous.

    Laguerre's steps from the left stay left of it, whatever the rounding of x, which is down. p and its derivatives are
    evaluated exactly, their quotients enclosed. Clusters need not be resolved.
    """
    p = p // p.gcd(p.derivative())
    x = -(Fraction(2) ** _radius_exponent(p))
    while value := _scaled_value(p, x):
        slope, curve = (_scaled_value(q, x) for q in (p.derivative(), p.derivative().derivative()))
        near, far = _laguerre(p.degree(), value, slope, curve, 2 * bits)
        near, far = x + near / x.denominator, x + far / x.denominator
        precision = bits + min(bits, max(0, near.denominator.bit_length() - abs(near.numerator).bit_length()))
        if (far - near) * 2**precision <= 1:
            return _integer_end(p, Interval(near, far))
        x = round_down(near, precision + 2 * p.degree().bit_length() + 2)
    return Interval.exactly(x)


def _laguerre(degree: int, value: fmpz, slope: fmpz, curve: fmpz, bits: int) -> tuple[Fraction, Fraction]:
    """Bounds of the distance to the least root, from ``p``, ``p'`` and ``p''`` left of it.

    With ``G = sum 1/d_i`` and ``H = sum 1/d_i^2`` over the distances d_i it is at least
    ``degree/(G + sqrt((degree - 1)(degree H - G^2)))`` (Laguerre) and at most ``G/H``.
    """
    with working_precision(bits):
        g = -arb(slope) / arb(value)
        h = g * g - arb(curve) / arb(value)
        spread = ((degree - 1) * (degree * h - g * g)).nonnegative_part()
        return to_interval(degree / (g + spread.sqrt())).lower, to_interval(g / h).upper


def _radius_exponent(p: fmpz_poly) -> int:
    """An e with every root of p below 2^e in modulus (Fujiwara)."""
    *others, lead = (c.height_bits() for c in p.coeffs())
    return int(max(((size - lead) / (len(others) - i) for i, size in enumerate(others) if size), default=0.0)) + 3


def _scaled_value(p: fmpz_poly, x: Fraction) -> fmpz:
    """``p(x) q^deg p`` for x = a/q."""
    a, q, scale, value = fmpz(x.numerator), fmpz(x.denominator), fmpz(1), fmpz(0)
    for c in reversed(p.coeffs()):
        value, scale = value * a + c * scale, scale * q
    return value


def _integer_end(p: fmpz_poly, x: Interval) -> Interval:
    """The least root as an integer, where the one integer inside is a root and no root lies below it.

    All roots being real, Descartes' rule on ``p(n - y)`` counts those below n exactly.
    """
    n = int(round_up(x.lower, 0))
    if n > x.upper or p(fmpz(n)) != 0:
        return x
    signs = [c > 0 for c in p(fmpz_poly([n, -1])).coeffs() if c]
    return Interval.exactly(n) if not any(a != b for a, b in pairwise(signs)) else x


def greatest_root(p: fmpz_poly, bits: int) -> Interval:
    """The largest root of a polynomial all of whose roots are real; as :func:`least_root`."""
    return -least_root(p(fmpz_poly([0, -1])), bits)


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
