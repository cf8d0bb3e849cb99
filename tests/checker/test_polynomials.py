"""Integer polynomials against sympy: quotient, remainder, greatest common divisor, signs, up to positive factors."""

import random
from fractions import Fraction
from itertools import pairwise

import pytest
import sympy

from fomas_verify.checker.polynomials import (
    Poly,
    cleared,
    common_divisor,
    derivative,
    divided,
    primitive,
    roots_between,
    sign_at,
)

X = sympy.Symbol("x")


def drawn(choose: random.Random, degree: int) -> Poly:
    return primitive([*(choose.randint(-9, 9) for _ in range(degree)), choose.choice([-6, -1, 1, 4])])


def expression(a: Poly) -> sympy.Poly:
    return sympy.Poly(list(reversed(a)) or [0], X, domain="QQ")


def is_positive_multiple(a: Poly, b: sympy.Poly) -> bool:
    """a = c b for a rational c > 0, and a has no common divisor."""
    if b.is_zero:
        return a == ()
    ratio = Fraction(a[-1]) / Fraction(int(b.LC().p), int(b.LC().q)) if a else Fraction(0)
    same = expression(a) == b * sympy.Rational(ratio.numerator, ratio.denominator)
    return ratio > 0 and same and sympy.igcd(0, *a) == 1


@pytest.mark.parametrize("seed", range(60))
def test_division_and_greatest_common_divisor(seed: int) -> None:
    choose = random.Random(seed)
    common, a, b = (drawn(choose, choose.randint(0, 4)) for _ in range(3))
    a, b = (primitive(int(c) for c in reversed((expression(common) * expression(p)).all_coeffs())) for p in (a, b))
    quotient, rest = sympy.div(expression(a), expression(b))
    assert is_positive_multiple(divided(a, b)[0], quotient)
    assert is_positive_multiple(divided(a, b)[1], rest)
    found = common_divisor(a, b)
    assert found[-1] > 0
    assert is_positive_multiple(found, sympy.gcd(expression(a), expression(b)) * (1 if found else 0))
    assert common_divisor(a, ()) == (a if a[-1] > 0 else tuple(-c for c in a))
    assert is_positive_multiple(derivative(a), expression(a).diff(X))


@pytest.mark.parametrize("seed", range(40))
def test_signs_and_roots(seed: int) -> None:
    choose = random.Random(seed)
    a = drawn(choose, choose.randint(1, 5))
    ends = sorted({Fraction(choose.randint(-30, 30), choose.randint(1, 9)) for _ in range(4)} | {Fraction(0)})
    for x in ends:
        exact = expression(a).eval(sympy.Rational(x.numerator, x.denominator))
        assert sign_at(a, x) == sympy.sign(exact)
    simple = divided(a, common_divisor(a, derivative(a)))[0]
    for lower, upper in pairwise(ends):
        roots = {r for r in sympy.Poly(expression(a)).real_roots() if lower < r <= upper}
        assert roots_between(simple, lower, upper) == len(roots)


def test_a_root_at_either_end() -> None:
    assert roots_between((-1, 0, 1), Fraction(-1), Fraction(1)) == 1
    assert roots_between((-1, 0, 1), Fraction(-2), Fraction(1)) == 2
    assert roots_between((-1, 0, 1), Fraction(-1), Fraction(0)) == 0


def test_primitive_forms() -> None:
    assert primitive([0, 0]) == ()
    assert primitive([]) == ()
    assert primitive([-4, 6, 0, 0]) == (-2, 3)
    assert cleared([Fraction(-1, 6), Fraction(3, 4), Fraction(0)]) == (-2, 9)
