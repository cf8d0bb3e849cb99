"""Signs and semidefiniteness over Q(theta), against sympy's exact algebraic numbers."""

from fractions import Fraction
from itertools import combinations

import pytest
import sympy
from flint import fmpq_mat, fmpq_poly, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.exact.matrix import matrix
from fomas_verify.exact.numberfield import RealField, is_semidefinite, quadratic_in_theta

SQRT2 = ([-2, 0, 1], Fraction(1), Fraction(2), sympy.sqrt(2))
MINUS_SQRT2 = ([-2, 0, 1], Fraction(-2), Fraction(0), -sympy.sqrt(2))
CUBE_ROOT = ([-5, 0, 0, 1], Fraction(0), Fraction(3), sympy.cbrt(5))
SEVENTH = ([-1, -2, 1, 1], Fraction(1), Fraction(3, 2), 2 * sympy.cos(2 * sympy.pi / 7))
RATIONAL = ([-3, 7], Fraction(0), Fraction(3, 7), sympy.Rational(3, 7))
FIELDS = [SQRT2, MINUS_SQRT2, CUBE_ROOT, SEVENTH, RATIONAL]
small = st.builds(Fraction, st.integers(-20, 20), st.integers(1, 6))


def field(case: tuple) -> RealField:
    return RealField(fmpz_poly(case[0]), case[1], case[2])


def element(f: RealField, parts: list[Fraction]) -> fmpq_poly:
    return f.reduce(fmpq_poly([_q(x) for x in parts]))


def _q(x: Fraction) -> object:
    return matrix([[x]])[0, 0]


def value(case: tuple, parts: list[Fraction]) -> sympy.Expr:
    return sum((sympy.Rational(x.numerator, x.denominator) * case[3] ** i for i, x in enumerate(parts)), sympy.S(0))


@pytest.mark.parametrize("case", FIELDS)
@given(parts=st.lists(small, min_size=1, max_size=4))
def test_signs(case: tuple, parts: list[Fraction]) -> None:
    number = value(case, parts).evalf(60)
    expected = 0 if abs(number) < 1e-50 else int(sympy.sign(number))
    f = field(case)
    assert f.sign(element(f, parts)) == expected


def test_a_sign_that_needs_a_narrow_enclosure() -> None:
    """Convergents p/q of sqrt 2 come as near as 1/q^2, from both sides in turn."""
    p, q = 1, 1
    for step in range(80):
        f = field(SQRT2)
        assert f.sign(f.affine(Fraction(-p, q), Fraction(1))) == (1 if step % 2 == 0 else -1)
        p, q = p + 2 * q, p + q


def test_zero_is_seen_exactly() -> None:
    f = field(SQRT2)
    assert f.sign(element(f, [Fraction(-2), Fraction(0), Fraction(1)])) == 0


@pytest.mark.parametrize("case", FIELDS)
@given(x=st.lists(small, min_size=1, max_size=3), y=st.lists(small, min_size=1, max_size=3))
def test_quotients(case: tuple, x: list[Fraction], y: list[Fraction]) -> None:
    f = field(case)
    a, b = element(f, x), element(f, y)
    if b:
        assert f.reduce(f.divide(a, b) * b) == a


@given(st.lists(small, min_size=18, max_size=18), st.booleans())
def test_semidefinite_over_the_field(numbers: list[Fraction], square: bool) -> None:
    """A = a + sqrt 2 b, or its square, against the signs of the eigenvalues at 40 digits where these are not near 0."""
    parts = (numbers[:9], numbers[9:])
    half = [sympy.Matrix(3, 3, [sympy.Rational(x.numerator, x.denominator) for x in part]) for part in parts]
    a, b = (m + m.T for m in half)
    if square:
        a, b = a * a + 2 * b * b, a * b + b * a
    f = field(SQRT2)
    linear, constant = (matrix([[Fraction(int(x.p), int(x.q)) for x in row] for row in m.tolist()]) for m in (b, a))
    form = quadratic_in_theta(f, constant, linear, fmpq_mat(3, 3))
    whole = (a + sympy.sqrt(2) * b).evalf(50)
    minors = [whole.extract(list(rows), list(rows)).det() for k in (1, 2, 3) for rows in combinations(range(3), k)]
    if all(abs(x) > 1e-30 or abs(x) < 1e-44 for x in minors):
        assert is_semidefinite(f, form) == all(x > -1e-40 for x in minors)
    if square:
        assert is_semidefinite(f, form)


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        ([[0, 0], [0, 0]], True),
        ([[0, 1], [1, 0]], False),
        ([[0, 1], [1, 5]], False),
        ([[5, 1], [1, 0]], False),
        ([[0, 0], [0, 2]], True),
        ([[1, 1], [1, 1]], True),
        ([[-1]], False),
    ],
)
def test_zero_pivots(rows: list[list[int]], expected: bool) -> None:
    f = field(SQRT2)
    assert is_semidefinite(f, [[fmpq_poly([x]) for x in row] for row in rows]) is expected


def test_singular_only_because_theta_is_irrational() -> None:
    """[[theta, 2], [2, 2 theta]] has determinant 2 theta^2 - 4 = 0; a hair less on the diagonal makes it indefinite."""
    f = field(SQRT2)
    theta = fmpq_poly([0, 1])
    assert is_semidefinite(f, [[theta, fmpq_poly([2])], [fmpq_poly([2]), theta * 2]])
    less = theta * 2 - fmpq_poly([_q(Fraction(1, 10**60))])
    assert not is_semidefinite(f, [[theta, fmpq_poly([2])], [fmpq_poly([2]), less]])
