"""Characteristic polynomials, scaled roots and power sums, against sympy."""

from fractions import Fraction

import pytest
import sympy
from flint import fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.exact import polynomial as exact
from fomas_verify.exact.matrix import matrix

Z = sympy.Symbol("z")
fractions = st.builds(Fraction, st.integers(-9, 9), st.integers(1, 5))
polynomials = st.lists(st.integers(-9, 9), min_size=2, max_size=6).filter(lambda c: c[-1] != 0)
squares = st.integers(1, 4).flatmap(
    lambda n: st.lists(st.lists(fractions, min_size=n, max_size=n), min_size=n, max_size=n)
)


def to_sympy(p: fmpz_poly) -> sympy.Poly:
    return sympy.Poly([int(c) for c in reversed(p.coeffs())], Z, domain="QQ")


def over_q(expression: sympy.Expr) -> sympy.Poly:
    return sympy.Poly(expression.expand(), Z, domain="QQ")


def rational(x: Fraction) -> sympy.Rational:
    return sympy.Rational(x.numerator, x.denominator)


@given(squares)
def test_characteristic_polynomials(rows: list[list[Fraction]]) -> None:
    expected = sympy.Matrix([[rational(x) for x in row] for row in rows]).charpoly(Z)
    got = to_sympy(exact.rational_characteristic_polynomial(matrix(rows)))
    assert got.monic() == over_q(expected.as_expr())
    scaled, scale = exact.integer_characteristic_polynomial(matrix(rows))
    assert to_sympy(scaled) == over_q(scale ** len(rows) * expected.as_expr().subs(Z, Z / scale))


@given(polynomials, fractions.filter(bool))
def test_scaled_roots(coefficients: list[int], s: Fraction) -> None:
    p = fmpz_poly(coefficients)
    q = exact.scaled_roots(p, s)
    assert q.leading_coefficient() > 0
    assert q.content() == 1
    assert to_sympy(q).monic() == over_q(to_sympy(p).as_expr().subs(Z, Z / rational(s))).monic()


@given(st.lists(fractions, min_size=1, max_size=5), st.integers(1, 9))
def test_power_sums_of_known_roots(roots: list[Fraction], count: int) -> None:
    p = fmpz_poly([1])
    for root in roots:
        p *= fmpz_poly([-root.numerator, root.denominator])
    assert exact.power_sums(p, count) == [sum((r**i for r in roots), Fraction(0)) for i in range(count)]


def test_power_sums_of_complex_roots() -> None:
    """z^2 + 1: i and -i."""
    assert exact.power_sums(fmpz_poly([1, 0, 1]), 7) == [2, 0, -2, 0, 2, 0, -2]


@given(polynomials, polynomials)
def test_divisibility_and_factors(p: list[int], q: list[int]) -> None:
    a, b = fmpz_poly(p), fmpz_poly(q)
    assert exact.divides(a, a * b)
    assert exact.divides(a, b) == to_sympy(b).rem(to_sympy(a)).is_zero
    factors = {to_sympy(f).monic() for f in exact.irreducible_factors(a)}
    assert factors == {f.monic() for f, _ in to_sympy(a).factor_list()[1]}


@pytest.mark.parametrize(
    ("coefficients", "expected"),
    [([-1, 1], True), ([1, 1], True), ([5, -6, 5], True), ([1, 0, 0, -1], True), ([1, 2], False), ([0, 1, 1], False)],
)
def test_self_reciprocal(coefficients: list[int], expected: bool) -> None:
    assert exact.is_self_reciprocal(fmpz_poly(coefficients)) is expected
