"""Exact signs in a real number field Q(theta), and whether a symmetric matrix over it is positive semidefinite.

theta is the one root of an irreducible integer polynomial in ``(lower, upper]``. Elements are polynomials in theta
of degree below that of p.
"""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq, fmpq_poly

from fomas_verify.exact.matrix import Matrix
from fomas_verify.exact.polynomial import Polynomial

Element = fmpq_poly


class RealField:
    """Q(theta) with its order; the enclosure of theta is narrowed as signs ask for it."""

    def __init__(self, polynomial: Polynomial, lower: Fraction, upper: Fraction) -> None:
        """The field of the root of an irreducible polynomial in ``(lower, upper]``; the caller has isolated it."""
        self.modulus = fmpq_poly(polynomial)
        self.lower, self.upper = lower, upper
        self._upper_sign = _sign(self.modulus(fmpq(upper.numerator, upper.denominator)))

    def affine(self, a: Fraction, b: Fraction) -> Element:
        """``a + b theta``."""
        return self.reduce(fmpq_poly([fmpq(a.numerator, a.denominator), fmpq(b.numerator, b.denominator)]))

    def reduce(self, x: Element) -> Element:
        """The representative of least degree."""
        return x % self.modulus

    def divide(self, x: Element, y: Element) -> Element:
        """``x / y`` for y != 0: p is irreducible, so a nonzero y of smaller degree is invertible."""
        _, inverse, _ = y.xgcd(self.modulus)
        return self.reduce(x * inverse)

    def sign(self, x: Element) -> int:
        """-1, 0 or 1, exact."""
        if not x:
            return 0
        while (sign := self._sign_on_enclosure(x)) == 0:
            self._narrow()
        return sign

    def _sign_on_enclosure(self, x: Element) -> int:
        low = high = Fraction(0)
        for c in reversed(x.coeffs()):
            ends = [low * self.lower, low * self.upper, high * self.lower, high * self.upper]
            shift = Fraction(int(c.p), int(c.q))
            low, high = min(ends) + shift, max(ends) + shift
        return 1 if low > 0 else -1 if high < 0 else 0

    def _narrow(self) -> None:
        middle = (self.lower + self.upper) / 2
        sign = _sign(self.modulus(fmpq(middle.numerator, middle.denominator)))
        if sign == self._upper_sign:
            self.upper = middle
        else:
            self.lower = middle


def _sign(x: fmpq) -> int:
    return (x > 0) - (x < 0)


def quadratic_in_theta(field: RealField, constant: Matrix, linear: Matrix, quadratic: Matrix) -> list[list[Element]]:
    """The matrix ``constant + theta linear + theta^2 quadratic`` over the field."""
    n = constant.nrows()
    return [
        [field.reduce(fmpq_poly([constant[i, j], linear[i, j], quadratic[i, j]])) for j in range(n)] for i in range(n)
    ]


def is_semidefinite(field: RealField, a: list[list[Element]]) -> bool:
    """Whether the symmetric matrix A over Q(theta) is positive semidefinite; exact, by elimination with diagonal
    pivots.

    A negative pivot, or a zero pivot whose row is not zero, is a negative direction; nothing else is.
    """
    a = [list(row) for row in a]
    while a:
        pivots = [i for i in range(len(a)) if a[i][i]]
        if not pivots:
            return not any(x for row in a for x in row)
        p = pivots[0]
        if field.sign(a[p][p]) < 0:
            return False
        rest = [i for i in range(len(a)) if i != p]
        scaled = {i: field.divide(a[i][p], a[p][p]) for i in rest}
        a = [[field.reduce(a[i][j] - scaled[i] * a[p][j]) for j in rest] for i in rest]
    return True
