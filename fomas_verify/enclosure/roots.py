"""All roots of an integer polynomial, each enclosed and counted.

python-flint isolates them rigorously: one ball a distinct root, with its multiplicity.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import acb, arb, fmpz_poly

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import exact_end, to_ball, to_fmpq, to_interval, working_precision


@dataclass(frozen=True)
class Root:
    """One distinct complex root: its enclosure and multiplicity."""

    real: Interval
    imag: Interval
    multiplicity: int


def _gaussian_integer(p: fmpz_poly, real: arb, imag: arb) -> tuple[int, int] | None:
    """The isolated root as ``a + b i`` with integers a and b, where it is one: the one root in a ball is the root of
    p found there.
    """
    a, b = real.unique_fmpz(), imag.unique_fmpz()
    if a is None or b is None:
        return None
    factor = fmpz_poly([a * a + b * b, -2 * a, 1]) if b else fmpz_poly([-a, 1])
    return (int(a), int(b)) if p.gcd(factor).degree() == factor.degree() else None


def complex_roots(p: fmpz_poly, bits: int) -> list[Root]:
    """Every distinct root of p, its real and imaginary parts rigorously enclosed; exact where both are integers.
    Sorted by real, then imaginary part.
    """
    with working_precision(bits):
        roots = []
        found: Any = p.complex_roots()  # the stubs say acb; it is a list of pairs
        for ball, multiplicity in found:
            real, imag = ball.real, ball.imag
            whole = _gaussian_integer(p, real, imag)
            parts = [Interval.exactly(x) for x in whole] if whole else [to_interval(real), to_interval(imag)]
            roots.append(Root(parts[0], parts[1], int(multiplicity)))
    return sorted(roots, key=lambda r: (r.real.mid, r.imag.mid))


def real_roots(p: fmpz_poly, bits: int) -> list[tuple[Interval, int]]:
    """Every distinct root of a polynomial all of whose roots are real (a symmetric matrix's), in increasing order,
    with multiplicities.
    """
    return [(root.real, root.multiplicity) for root in complex_roots(p, bits)]


def is_on_unit_circle(roots: list[Root]) -> list[bool]:
    """For the distinct roots of a self-reciprocal real polynomial: which have modulus exactly 1; False also means
    don't know.

    With z, ``1/conj(z)`` is a root too. Where its enclosure meets the ball of z alone, it is z, so abs z = 1.
    """
    verdicts = []
    for root in roots:
        square = root.real * root.real + root.imag * root.imag
        if square.lower <= 0:
            verdicts.append(False)
            continue
        real, imag = root.real / square, root.imag / square
        meets = [other for other in roots if other.real.overlaps(real) and other.imag.overlaps(imag)]
        verdicts.append(meets == [root])
    return verdicts


def power_sum(eigenvalues: list[Root], t: Fraction, n: int, bits: int) -> Interval:
    """``abs sum (1 - t lambda)^n`` over eigenvalues lambda with their multiplicities; rigorous, and useless where n
    is too large for the bits.
    """
    with working_precision(bits):
        total = acb(0)
        for root in eigenvalues:
            base = 1 - arb(to_fmpq(t)) * acb(to_ball(root.real), to_ball(root.imag))
            total += root.multiplicity * base**n
        if not total.is_finite():
            return Interval(Fraction(0), Fraction(0))
        return Interval(exact_end(total.abs_lower()), exact_end(total.abs_upper()))
