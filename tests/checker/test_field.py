"""Roots and numbers of Q(theta) against sympy."""

import random
from fractions import Fraction
from itertools import pairwise

import pytest
import sympy

from fomas_verify.checker import field
from fomas_verify.checker.definite import exact_sign
from fomas_verify.checker.field import Element, Root, isolate
from fomas_verify.checker.polynomials import common_divisor, divided, roots_between, sign_at

X = sympy.Symbol("x")


def rationals(*numbers: int | str) -> list[Fraction]:
    return [Fraction(x) for x in numbers]


def coefficients(expression: sympy.Expr) -> list[Fraction]:
    return [Fraction(int(c.p), int(c.q)) for c in reversed(sympy.Poly(expression, X).all_coeffs())]


def sqrt2() -> Root:
    root = isolate(rationals(-2, 0, 1), Fraction(0), Fraction(2))
    assert root is not None
    return root


def number(root: Root, *entries: int | Fraction) -> Element:
    exact = [Fraction(c) for c in entries]
    return root.element(exact, root.integer_scale(exact))


@pytest.mark.parametrize(
    ("polynomial", "lower", "upper", "found"),
    [
        ((-2, 0, 1), 0, 2, True),
        ((-2, 0, 1), -2, 2, False),
        ((-2, 0, 1), 2, 3, False),
        ((-2, 0, 1), 2, 1, False),
        ((-2, 0, 1), 1, 1, False),
        ((0, -1, 1), 0, 1, True),
        ((0, -1, 1), -1, 0, True),
        ((0, -1, 1), -1, 1, False),
        ((1, -2, 1), 0, 1, True),
        ((1, -2, 1), 1, 2, False),
        ((4, 0, -4, 0, 1), 1, 2, True),
        ((3, "-1/2"), 0, 6, True),
        ((3, "-1/2"), 6, 7, False),
        ((1, 0, 1), -9, 9, False),
        ((5, 0), 0, 1, False),
        ((0, 0), 0, 1, False),
    ],
)
def test_isolate(polynomial: tuple[int | str, ...], lower: int, upper: int, found: bool) -> None:
    assert (isolate(rationals(*polynomial), Fraction(lower), Fraction(upper)) is not None) == found


def test_roots_are_counted_as_sympy_counts_them() -> None:
    choose = random.Random(5)
    for _ in range(150):
        factors = [X - sympy.Rational(choose.randint(-6, 6), choose.randint(1, 3)) for _ in range(choose.randint(1, 3))]
        factors.append(X**2 - choose.randint(-3, 7))
        whole = sympy.Poly(sympy.prod(factors), X)
        simple = sympy.Poly(sympy.sqf_part(whole.as_expr()), X)
        a, b = sorted(Fraction(choose.randint(-12, 12), choose.randint(1, 3)) for _ in range(2))
        if a == b:
            b += 1
        ends = [sympy.Rational(x.numerator, x.denominator) for x in (a, b)]
        expected = sum(1 for r in set(sympy.real_roots(simple)) if ends[0] < r <= ends[1])
        integers = simple.clear_denoms(convert=True)[1].all_coeffs()
        assert roots_between(tuple(int(c) for c in reversed(integers)), a, b) == expected
        assert (isolate(coefficients(whole.as_expr()), a, b) is not None) == (expected == 1)


def test_gcd_and_quotient_as_sympy() -> None:
    choose = random.Random(6)
    for _ in range(100):
        a, b, c = (
            sympy.Poly([choose.randint(-5, 5) or 1, *(choose.randint(-5, 5) for _ in range(choose.randint(0, 3)))], X)
            for _ in range(3)
        )
        left, right = (tuple(int(x) for x in reversed((p * c).all_coeffs())) for p in (a, b))
        expected = sympy.gcd(a * c, b * c).primitive()[1]
        divisor = common_divisor(left, right)
        assert divisor == tuple(int(x) for x in reversed(expected.all_coeffs()))
        quotient, rest = divided(left, divisor)
        assert rest == ()
        assert sympy.rem((a * c).as_expr(), sympy.Poly(quotient[::-1], X).as_expr(), X) == 0


def test_arithmetic_as_sympy() -> None:
    choose = random.Random(8)
    theta = sympy.sqrt(2)
    for _ in range(200):
        root = sqrt2()
        a, b, c, d = (choose.randint(-9, 9) for _ in range(4))
        x, y = number(root, a, b), number(root, c, d)
        product = sympy.expand((a + b * theta) * (c + d * theta))
        assert (x * y - number(root, int(product.subs(theta, 0)), int(product.coeff(theta)))).sign() == 0
        assert (x - y).sign() == int(sympy.sign(a - c + (b - d) * theta))
        if y.sign() != 0:
            assert ((x * y) // y - x).sign() == 0


@pytest.mark.parametrize(
    ("entries", "sign"),
    [
        ((0,), 0),
        ((-7, 5), 1),
        ((-17, 12), -1),
        ((-2, 0, 1), 0),
        ((0, -2, 0, 1), 0),
        ((-(10**60), "707106781186547524400844362104849039284835937688474036588339868995366239231053/1"), 1),
        (("-707106781186547524400844362104849039284835937688474036588339", 5 * 10**59), 1),
        (("-707106781186547524400844362104849039284835937688474036588340", 5 * 10**59), -1),
    ],
)
def test_sign_at_sqrt2(entries: tuple[int | str, ...], sign: int) -> None:
    root = sqrt2()
    assert number(root, *(Fraction(c) for c in entries)).sign() == sign


def test_a_rational_root_of_a_reducible_polynomial() -> None:
    """(x - 1/2)(x^2 - 2)(x - 3) at x = 1/2: the modulus splits, and narrowing meets the root itself."""
    root = isolate(coefficients(sympy.expand((2 * X - 1) * (X**2 - 2) * (X - 3))), Fraction(0), Fraction(1))
    assert root is not None
    assert number(root, 1, 1).sign() == 1
    assert number(root, -2, 0, 1).sign() == -1
    assert number(root, Fraction(-1, 2) - Fraction(1, 10**30), 1).sign() == -1
    assert number(root, -1, 2).sign() == 0
    assert root.degree == 1


def test_narrowing_meets_a_rational_root() -> None:
    root = isolate(coefficients(sympy.expand((X - 1) * (X**2 - 7))), Fraction(0), Fraction(2))
    assert root is not None
    assert number(root, -(10**40) - 1, 10**40).sign() == -1
    assert root.modulus == (-1, 1)


@pytest.mark.parametrize(
    ("polynomial", "lower", "upper"),
    [
        (X**2 - 2, 0, 3),
        (-(X**2) + 2, -2, 0),
        (X**12 - 2, 0, 10**6),
        (3 * X**3 - X - Fraction(1, 10**400), 0, 1),
        (X**3 - 10**900 * X + 1, 0, 1),
        ((X**2 - 2) * (X**2 - 3), Fraction(3, 2), 2),
        ((X**2 - 2) * (X**2 - 2 - Fraction(1, 10**7)), Fraction(141421358, 10**8), 2),  # another one just below
    ],
)
def test_narrowing_keeps_the_root_with_few_signs(monkeypatch, polynomial, lower, upper) -> None:
    """Halving would ask for the sign at 4000 points."""
    root = isolate(coefficients(sympy.expand(polynomial)), Fraction(lower), Fraction(upper))
    assert root is not None
    asked = []
    monkeypatch.setattr(field, "sign_at", lambda *case: asked.append(case) or sign_at(*case))
    width = root.upper - root.lower
    root._narrow(4000)
    assert 0 < root.upper - root.lower <= width / 2**4000
    assert roots_between(root.modulus, root.lower, root.upper) == 1
    assert len(asked) < 300


def test_division_by_a_divisor_of_zero_that_is_not_zero_at_the_root() -> None:
    root = isolate(coefficients(sympy.expand((X**2 - 2) * (X**2 - 3))), Fraction(1), Fraction(3, 2))
    assert root is not None
    below = number(root, -3, 0, 1)
    assert ((below * number(root, 5, 1)) // below - number(root, 5, 1)).sign() == 0
    assert root.degree == 2


def test_elimination_over_the_field_of_a_cubic() -> None:
    """A - theta I, theta an eigenvalue of the symmetric A: semidefinite at the least one, indefinite at the others."""
    matrix = [[2], [1, 3], [0, 1, 5]]
    full = sympy.Matrix(3, 3, lambda i, j: matrix[max(i, j)][min(i, j)])
    polynomial = coefficients(full.charpoly(X).as_expr())
    ends = [Fraction(0), Fraction(2), Fraction(4), Fraction(7)]
    signs = []
    for lower, upper in pairwise(ends):
        root = isolate(polynomial, lower, upper)
        assert root is not None
        rows = [[number(root, x, -int(i == j)) for j, x in enumerate(row)] for i, row in enumerate(matrix)]
        signs.append(exact_sign(rows, number(root, 1), lambda entry: entry.sign()))
    assert signs == [0, -1, -1]
    root = isolate(polynomial, ends[0], ends[1])
    assert root is not None
    rows = [[number(root, x + int(i == j), -int(i == j)) for j, x in enumerate(row)] for i, row in enumerate(matrix)]
    assert exact_sign(rows, number(root, 1), lambda entry: entry.sign()) == 1


def test_a_root_at_the_excluded_end_is_no_root_of_the_field() -> None:
    """x (x^2 - 2) on (0, 2]: x itself shares the root 0 with the polynomial, and is sqrt 2 > 0."""
    root = isolate(rationals(0, -2, 0, 1), Fraction(0), Fraction(2))
    assert root is not None
    assert number(root, 0, 1).sign() == 1
    assert number(root, -2, 0, 1).sign() == 0


def test_a_root_at_the_included_end() -> None:
    """(x - 2)(x - 3) on (1, 2] is 2."""
    root = isolate(rationals(6, -5, 1), Fraction(1), Fraction(2))
    assert root is not None
    assert number(root, -3, 1).sign() == -1
    assert number(root, -2, 1).sign() == 0
    assert number(root, -2 - Fraction(1, 10**20), 1).sign() == -1
