"""The number field Q(theta), theta a real root of a polynomial that need not be irreducible.

theta is scaled to an algebraic integer y (monic modulus), and a number is an integer polynomial in y, reduced. Zero is
decided by a gcd with the modulus; where that splits the modulus, the factor that has the root y takes its place
(dynamic evaluation).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from fomas_verify.checker.polynomials import (
    Poly,
    cleared,
    common_divisor,
    derivative,
    divided,
    roots_between,
    scaled_value,
    sign_at,
)


class Root:
    """One real root theta: y = `scale` theta is the only root of the monic square-free `modulus` in [lower, upper],
    and is not `lower`.

    The modulus shrinks to a factor, and the interval narrows, as questions are asked; theta stays.
    """

    def __init__(self, modulus: Poly, scale: int, lower: Fraction, upper: Fraction) -> None:
        self.modulus = modulus
        self.scale = scale
        self.lower = lower
        self.upper = upper
        self._inverses: dict[Poly, tuple[Poly, int]] = {}

    @property
    def degree(self) -> int:
        """The degree of the modulus."""
        return len(self.modulus) - 1

    def element(self, coefficients: Sequence[Fraction], denominator: int) -> Element:
        """`denominator` times the value of a polynomial at theta; `integer_scale` gives a denominator."""
        return Element(self, self.reduced([int(c * denominator / self.scale**i) for i, c in enumerate(coefficients)]))

    def integer_scale(self, coefficients: Sequence[Fraction]) -> int:
        """A positive integer that takes a polynomial in theta to an integer polynomial in scale theta."""
        return lcm(*((c / self.scale**i).denominator for i, c in enumerate(coefficients)))

    def reduced(self, coefficients: list[int]) -> Poly:
        """The remainder modulo the modulus, without zeros at the top."""
        while len(coefficients) >= len(self.modulus):
            top = coefficients.pop()
            shift = len(coefficients) - self.degree
            for i, entry in enumerate(self.modulus[:-1]):
                coefficients[shift + i] -= top * entry
        while coefficients and coefficients[-1] == 0:
            coefficients.pop()
        return tuple(coefficients)

    def sign(self, coefficients: Poly) -> int:
        """The sign of a polynomial at y."""
        bits = 8
        settled = False
        while True:
            coefficients = self.reduced(list(coefficients))
            lower, upper = self._range(coefficients)
            if lower > 0 or upper < 0 or lower == upper:
                return (lower > 0) - (upper < 0)
            if not settled:
                self._split(common_divisor(self.modulus, coefficients))
                settled = True
            else:
                self._narrow(bits)
                bits *= 2

    def inverse(self, coefficients: Poly) -> tuple[Poly, int]:
        """(p, d) with p(y) / d the inverse of a polynomial that is not zero at y."""
        if coefficients not in self._inverses:
            self._split(common_divisor(self.modulus, coefficients))
            self._inverses[coefficients] = _inverse(self.modulus, coefficients)
        return self._inverses[coefficients]

    def _split(self, factor: Poly) -> None:
        """Take for modulus that one of `factor` (a divisor) and its cofactor which has the root y.

        The modulus has one simple root in (lower, upper], and none at `lower`: a divisor has that root iff its signs at
        the ends differ.
        """
        if sign_at(factor, self.lower) != sign_at(factor, self.upper):
            self.modulus = factor
        else:
            self.modulus = divided(self.modulus, factor)[0]

    def _narrow(self, bits: int) -> None:
        """Make the interval 2^bits times narrower, or more, or find y itself, which the modulus then says.

        The three multiples of a power of two around the root of the chord are tried, with a step of at most 2^-depth
        of the interval: twice the depth where one step holds y afterwards, half of it otherwise. Only signs move an
        end, however good the chord is; a step is at most half of the interval, so that one of the three lies inside.
        """
        goal, depth = (self.upper - self.lower) / 2**bits, 2
        while (width := self.upper - self.lower) > goal:
            left = scaled_value(self.modulus, self.lower) * self.upper.denominator**self.degree
            right = scaled_value(self.modulus, self.upper) * self.lower.denominator**self.degree
            shift = depth + 1 + width.denominator.bit_length() - width.numerator.bit_length()
            up, down = 1 << max(shift, 0), 1 << max(-shift, 0)
            first = self.lower.numerator * up // (self.lower.denominator * down)
            first += width.numerator * up * left // (width.denominator * down * (left - right))
            for x in (Fraction((first + i) * down, up) for i in range(3)):
                if not self.lower < x <= self.upper:
                    continue
                side = sign_at(self.modulus, x)
                if side == 0:
                    # y = x: as an algebraic integer that is rational, it is an integer.
                    self.modulus = (-x.numerator, 1)
                    return
                if (side > 0) == (left > 0):
                    self.lower = x
                else:
                    self.upper = x
            depth = 2 * depth if self.upper - self.lower <= Fraction(down, up) else max(depth // 2, 1)

    def _range(self, coefficients: Poly) -> tuple[Fraction, Fraction]:
        """Bounds of a polynomial at y (Horner's scheme in intervals)."""
        lower = upper = Fraction(0)
        for entry in reversed(coefficients):
            corners = [a * b for a in (lower, upper) for b in (self.lower, self.upper)]
            lower, upper = min(corners) + entry, max(corners) + entry
        return lower, upper


@dataclass(frozen=True)
class Element:
    """A number of Q(theta), as a reduced integer polynomial in the scaled root."""

    root: Root
    coefficients: Poly

    @property
    def bits(self) -> int:
        """Of the longest coefficient."""
        return max(map(abs, self.coefficients), default=0).bit_length()

    def __sub__(self, other: Element) -> Element:
        a, b = self.coefficients, other.coefficients
        length = max(len(a), len(b))
        padded = zip(a + (0,) * (length - len(a)), b + (0,) * (length - len(b)), strict=True)
        return Element(self.root, self.root.reduced([x - y for x, y in padded]))

    def __mul__(self, other: Element) -> Element:
        return Element(self.root, self.root.reduced(_product(self.coefficients, other.coefficients)))

    def __floordiv__(self, other: Element) -> Element:
        """The quotient, where it is an integer polynomial in the scaled root (as Bareiss' divisions are)."""
        inverse, denominator = self.root.inverse(other.coefficients)
        product = self.root.reduced(_product(self.coefficients, inverse))
        return Element(self.root, tuple(entry // denominator for entry in product))

    def sign(self) -> int:
        """The sign of the number."""
        return self.root.sign(self.coefficients)


def isolate(polynomial: Sequence[Fraction], lower: Fraction, upper: Fraction) -> Root | None:
    """The root of a polynomial in (lower, upper], or None unless there is exactly one there.

    Rigorous and exact: the roots are counted by a Sturm sequence, multiplicities left out.
    """
    whole = cleared(polynomial)
    if len(whole) < 2 or lower >= upper:
        return None
    simple = divided(whole, common_divisor(whole, derivative(whole)))[0]
    if roots_between(simple, lower, upper) != 1:
        return None
    if sign_at(simple, lower) == 0:
        simple = divided(simple, (-lower.numerator, lower.denominator))[0]
    scale = abs(simple[-1])
    degree = len(simple) - 1
    top = 1 if simple[-1] > 0 else -1
    monic = tuple(top * c * scale ** (degree - 1 - i) for i, c in enumerate(simple[:-1]))
    return Root((*monic, 1), scale, lower * scale, upper * scale)


def _product(a: Poly, b: Poly) -> list[int]:
    result = [0] * max(len(a) + len(b) - 1, 0)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            result[i + j] += x * y
    return result


def _inverse(modulus: Poly, a: Poly) -> tuple[Poly, int]:
    """(p, d) with p a = d modulo the modulus, gcd(a, modulus) = 1: Euclid's algorithm with cofactors of a."""
    rest, cofactor = [Fraction(c) for c in modulus], [Fraction(0)]
    next_rest, next_cofactor = [Fraction(c) for c in a], [Fraction(1)]
    while len(next_rest) > 1:
        while len(rest) >= len(next_rest):
            factor, shift = rest[-1] / next_rest[-1], len(rest) - len(next_rest)
            rest = _without(rest, next_rest, factor, shift)
            cofactor = _without(cofactor, next_cofactor, factor, shift)
        rest, next_rest = next_rest, rest
        cofactor, next_cofactor = next_cofactor, cofactor
    scaled = [c / next_rest[0] for c in next_cofactor]
    denominator = lcm(*(c.denominator for c in scaled))
    return tuple(int(c * denominator) for c in scaled), denominator


def _without(a: list[Fraction], b: list[Fraction], factor: Fraction, shift: int) -> list[Fraction]:
    """a - factor y^shift b, without zeros at the top."""
    result = a + [Fraction(0)] * (len(b) + shift - len(a))
    for i, entry in enumerate(b):
        result[shift + i] -= factor * entry
    while result and result[-1] == 0:
        result.pop()
    return result
