"""Roots of integer polynomials: all of them, counted, enclosed; exact where they are Gaussian integers."""

import random
from fractions import Fraction

import pytest
from flint import fmpz_poly
from mpmath import mp

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.roots import complex_roots, is_on_unit_circle, power_sum, real_roots


def product(*factors: list[int]) -> fmpz_poly:
    p = fmpz_poly([1])
    for factor in factors:
        p *= fmpz_poly(factor)
    return p


def test_gaussian_integers_are_exact_with_their_multiplicities() -> None:
    roots = complex_roots(product([0, 1], [0, 1], [-3, 1], [5, -4, 1], [5, -4, 1]), 64)
    found = [(r.real, r.imag, r.multiplicity) for r in roots]
    one = Interval.exactly
    assert found == [(one(0), one(0), 2), (one(2), one(-1), 2), (one(2), one(1), 2), (one(3), one(0), 1)]


def test_near_integers_are_not_taken_for_integers() -> None:
    """z^2 - 10^60 - 1 has roots within 1e-30 of +-10^30; 10^40 z - 10^40 - 1 has 1 + 1e-40."""
    assert not any(root.real.is_exact for root in complex_roots(fmpz_poly([-(10**60) - 1, 0, 1]), 64))
    (root,) = complex_roots(fmpz_poly([-(10**40) - 1, 10**40]), 64)
    assert root.real.contains(1 + Fraction(1, 10**40))
    assert not (root.real.is_exact and root.real.contains(Fraction(1)))


def test_every_root_of_random_polynomials_is_held() -> None:
    seed = random.Random(5)
    for _ in range(60):
        coefficients = [seed.randint(-50, 50) for _ in range(seed.randint(2, 9))] + [1]
        p = fmpz_poly(coefficients)
        roots = complex_roots(p, 128)
        assert sum(r.multiplicity for r in roots) == p.degree()
        if p.gcd(p.derivative()).degree() > 0:
            continue
        with mp.workdps(60):
            for z in mp.polyroots(list(reversed(coefficients)), maxsteps=500, extraprec=500):
                near = [r for r in roots if _holds(r.real, z.real) and _holds(r.imag, z.imag)]
                assert len(near) == 1


def _holds(x: Interval, value: object) -> bool:
    slack = Fraction(1, 10**45)
    p = Fraction(mp.nstr(value, 58))
    return x.lower - slack <= p <= x.upper + slack


def test_real_roots_come_in_order() -> None:
    roots = real_roots(product([2, -4, 1], [-1, 3], [-1, 3], [-7, 1]), 96)
    assert [m for _, m in roots] == [2, 1, 1, 1]
    values = [0.3333333333333333, 0.5857864376269049, 3.414213562373095, 7]
    assert all(abs(float(x.mid) - v) < 1e-14 for (x, _), v in zip(roots, values, strict=True))
    assert roots[0][0].contains(Fraction(1, 3))


@pytest.mark.parametrize(
    ("factor", "expected"),
    [
        ([-1, 1], [True]),
        ([1, 1], [True]),
        ([1, 1, 1], [True, True]),
        ([5, -6, 5], [True, True]),  # 3/5 +- 4/5 i, no root of unity
        ([1, 0, -1, 0, 1], [True] * 4),
        ([1, -3, 1], [False, False]),
        ([1, -1, -1, -1, 1], [False, True, True, False]),  # a Salem number, its inverse, two on the circle
    ],
)
def test_which_roots_lie_on_the_unit_circle(factor: list[int], expected: list[bool]) -> None:
    roots = complex_roots(fmpz_poly(factor), 128)
    found = is_on_unit_circle(roots)
    assert sorted(found) == sorted(expected)
    for root, on in zip(roots, found, strict=True):
        assert on == (abs(float(root.real.mid) ** 2 + float(root.imag.mid) ** 2 - 1) < 1e-12)


@pytest.mark.parametrize("n", [1, 2, 3, 10, 77])
def test_power_sums(n: int) -> None:
    """Eigenvalues 1/2 (twice), 2 + i, 2 - i at t = 1/3: the trace of (1 - t lambda)^n by exact arithmetic."""
    roots = complex_roots(product([-1, 2], [-1, 2], [5, -4, 1]), 256)
    re, im = Fraction(1), Fraction(0)
    for _ in range(n):
        re, im = re * Fraction(1, 3) - im * Fraction(-1, 3), re * Fraction(-1, 3) + im * Fraction(1, 3)
    expected = abs(2 * Fraction(5, 6) ** n + 2 * re)
    assert power_sum(roots, Fraction(1, 3), n, 256).contains(expected)


def test_a_power_beyond_the_precision_claims_nothing() -> None:
    roots = complex_roots(fmpz_poly([-2, 0, 1]), 32)
    assert power_sum(roots, Fraction(1, 3), 2**200, 32).lower <= 0
