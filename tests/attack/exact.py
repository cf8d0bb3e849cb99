"""Exact tests on rational matrices and at algebraic numbers, by characteristic polynomials.

A matrix is a list of rows of Fractions; a polynomial a list of Fractions, constant term first. Source: Faddeev and
LeVerrier for the coefficients; Descartes' rule, which is exact for a polynomial with real roots only, for the inertia.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from math import lcm
from typing import Any

from mpmath import mp

Matrix = list[list[Fraction]]
Poly = tuple[Fraction, ...]


def matmul(a: Matrix, b: Matrix) -> Matrix:
    """Product of two rational matrices."""
    columns = list(zip(*b, strict=True))
    return [[sum((x * y for x, y in zip(row, col, strict=True)), Fraction(0)) for col in columns] for row in a]


def transpose(a: Matrix) -> Matrix:
    """Transpose of a rational matrix."""
    return [list(row) for row in zip(*a, strict=True)]


def combine(p: Fraction, a: Matrix, q: Fraction, b: Matrix) -> Matrix:
    """The matrix p a + q b."""
    return [[p * x + q * y for x, y in zip(r, s, strict=True)] for r, s in zip(a, b, strict=True)]


def identity(n: int) -> Matrix:
    """The unit matrix."""
    return [[Fraction(i == j) for j in range(n)] for i in range(n)]


def charpoly(a: Matrix) -> Poly:
    """Coefficients of det(z I - a), constant term first, exactly."""
    n = len(a)
    scale = lcm(1, *(x.denominator for row in a for x in row))
    ints = [[int(x * scale) for x in row] for row in a]
    coefficients = [1]
    m = [[int(i == j) for j in range(n)] for i in range(n)]
    for k in range(1, n + 1):
        columns = list(zip(*m, strict=True))
        am = [[sum(x * y for x, y in zip(row, col, strict=True)) for col in columns] for row in ints]
        c = -sum(am[i][i] for i in range(n)) // k
        coefficients.append(c)
        m = [[am[i][j] + (c if i == j else 0) for j in range(n)] for i in range(n)]
    return tuple(reversed([Fraction(c, scale**k) for k, c in enumerate(coefficients)]))


def _inertia_from_signs(signs: Sequence[int]) -> tuple[int, int, int]:
    """(negative, zero, positive) roots of a real-rooted polynomial, from its coefficients' signs."""
    zero = next(i for i, s in enumerate(signs) if s)
    kept = [s for s in signs if s]
    positive = sum(s != t for s, t in pairwise(kept))
    return len(signs) - 1 - zero - positive, zero, positive


def inertia(a: Matrix) -> tuple[int, int, int]:
    """(negative, zero, positive) eigenvalues of a symmetric rational matrix, exactly."""
    return _inertia_from_signs([(c > 0) - (c < 0) for c in charpoly(a)])


def is_pd(a: Matrix) -> bool:
    """Whether a symmetric rational matrix is positive definite."""
    return inertia(a)[2] == len(a)


def is_psd(a: Matrix) -> bool:
    """Whether a symmetric rational matrix is positive semidefinite."""
    return inertia(a)[0] == 0


@dataclass(frozen=True)
class Root:
    """The one real root of `poly` in (lower, upper]."""

    poly: Poly
    lower: Fraction
    upper: Fraction


def sympy_poly(p: Sequence[Fraction]) -> Any:
    import sympy

    z = sympy.Symbol("z")
    return sympy.Poly([sympy.Rational(c.numerator, c.denominator) for c in reversed(p)], z, domain="QQ")


def count_roots(p: Sequence[Fraction], lower: Fraction, upper: Fraction) -> int:
    """Number of distinct real roots of p in (lower, upper], exactly (Sturm, by sympy)."""
    import sympy

    if not any(p):
        raise ValueError("the zero polynomial has every root")
    if upper <= lower:
        return 0
    poly = sympy_poly(p)
    ends = [sympy.Rational(x.numerator, x.denominator) for x in (lower, upper)]
    return int(poly.count_roots(*ends)) - int(poly.eval(ends[0]) == 0)


@lru_cache(maxsize=4096)
def distinct_roots(p: Poly, dps: int) -> tuple[tuple[Any, int], ...]:
    """The complex roots of p with their multiplicities, to about `dps` digits (each square-free factor on its own)."""
    found: list[tuple[Any, int]] = []
    for factor, multiplicity in sympy_poly(p).sqf_list()[1]:
        with mp.workdps(dps + 20):
            coefficients = [mp.mpf(int(c.p)) / int(c.q) for c in factor.all_coeffs()]
            roots = mp.polyroots(coefficients, maxsteps=2000, extraprec=8 * dps + 600)
        found.extend((root, multiplicity) for root in roots)
    return tuple(found)


def has_common_root(p: Sequence[Fraction], root: Root) -> bool:
    """Whether p vanishes at the root, exactly."""
    if not any(p):
        return True
    shared = sympy_poly(p).gcd(sympy_poly(root.poly))
    if shared.degree() < 1:
        return False
    coefficients = [Fraction(int(c.p), int(c.q)) for c in reversed(shared.all_coeffs())]
    return count_roots(coefficients, root.lower, root.upper) == 1


def _value_at(p: Sequence[Fraction], x: Fraction) -> Fraction:
    return sum((c * x**k for k, c in enumerate(p)), Fraction(0))


@lru_cache(maxsize=1024)
def approx_root(root: Root, dps: int) -> Any:
    """The root as an mpf, to about `dps` digits."""
    with mp.workdps(dps + 20):
        lower, upper = (mp.mpf(x.numerator) / x.denominator for x in (root.lower, root.upper))
        slack = mp.mpf(10) ** (-dps)
        excluded = slack if _value_at(root.poly, root.lower) == 0 else -slack
        inside = [
            mp.re(z)
            for z, _ in distinct_roots(root.poly, dps)
            if abs(mp.im(z)) < slack and lower + excluded < mp.re(z) < upper + slack
        ]
        if len(inside) != 1:
            raise ArithmeticError(f"{len(inside)} roots seen where one was counted")
        return inside[0]


def sign_at(p: Sequence[Fraction], root: Root) -> int:
    """Sign of p at the root: zero exactly, otherwise with the digits it takes.

    Raises
    ------
    ArithmeticError
        When 3000 digits do not separate a value that is not zero from zero.
    """
    if has_common_root(p, root):
        return 0
    for dps in (100, 300, 1000, 3000):
        with mp.workdps(dps):
            theta = approx_root(root, dps)
            terms = [mp.mpf(c.numerator) / c.denominator * theta**k for k, c in enumerate(p)]
            value, size = mp.fsum(terms), mp.fsum(terms, absolute=True)
            if abs(value) > size * mp.mpf(10) ** (-dps // 2):
                return int(mp.sign(value))
    raise ArithmeticError("3000 digits did not decide a sign")


def _interpolate(points: Sequence[Fraction], values: Sequence[Fraction]) -> Poly:
    """The polynomial of least degree through the points (Newton's form, exactly)."""
    table = list(values)
    for level in range(1, len(points)):
        for i in range(len(points) - 1, level - 1, -1):
            table[i] = (table[i] - table[i - 1]) / (points[i] - points[i - level])
    result = [Fraction(0)]
    for point, value in zip(reversed(points), reversed(table), strict=True):
        shifted = [Fraction(0), *result]
        for k, c in enumerate(result):
            shifted[k] -= point * c
        shifted[0] += value
        result = shifted
    return tuple(result)


def is_psd_at(matrix: Callable[[Fraction], Matrix], degree: int, root: Root) -> bool:
    """Whether the symmetric matrix, polynomial of the given degree in x, is positive semidefinite at x = root.

    Each coefficient of its characteristic polynomial is a polynomial in x, found by interpolation; its sign at the
    root is exact.
    """
    size = len(matrix(Fraction(0)))
    points = [Fraction(k) for k in range(degree * size + 1)]
    columns = list(zip(*(charpoly(matrix(x)) for x in points), strict=True))
    signs = [sign_at(_interpolate(points, values), root) for values in columns]
    return _inertia_from_signs(signs)[0] == 0
