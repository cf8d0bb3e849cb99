"""Characteristic polynomials with integer coefficients and their factors over Q.

A rational matrix A with common denominator s has the integer matrix Z = s A; the roots of det(z I - Z) are s times
the eigenvalues of A.
"""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq_mat, fmpz, fmpz_poly

Polynomial = fmpz_poly


def polynomial(coefficients: list[int]) -> Polynomial:
    """The integer polynomial with these coefficients, the constant one first."""
    return fmpz_poly(coefficients)


def integer_characteristic_polynomial(a: fmpq_mat) -> tuple[Polynomial, int]:
    """``det(z I - s A)`` and s > 0: monic with integer coefficients; its roots divided by s are the eigenvalues of
    A.
    """
    numerators, denominator = a.numer_denom()
    return numerators.charpoly(), int(denominator)


def scaled_roots(p: Polynomial, s: Fraction) -> Polynomial:
    """An integer polynomial without content whose roots are those of p times s; s != 0."""
    degree = p.degree()
    a, b = fmpz(s.numerator), fmpz(s.denominator)
    coefficients = [c * b**i * a ** (degree - i) for i, c in enumerate(p.coeffs())]
    q = fmpz_poly(coefficients)
    q = q // fmpz_poly([q.content()])
    return -q if q.leading_coefficient() < 0 else q


def rational_characteristic_polynomial(a: fmpq_mat) -> Polynomial:
    """An integer polynomial without content whose roots are the eigenvalues of A."""
    polynomial, scale = integer_characteristic_polynomial(a)
    return scaled_roots(polynomial, Fraction(1, scale))


def without_zero_root(p: Polynomial) -> Polynomial:
    """p divided by z; p(0) must be 0."""
    return fmpz_poly(p.coeffs()[1:])


def irreducible_factors(p: Polynomial) -> list[Polynomial]:
    """The distinct irreducible factors over Q, each with a positive leading coefficient."""
    _, factors = p.factor()
    return [-q if q.leading_coefficient() < 0 else q for q, _ in factors]


def is_self_reciprocal(p: Polynomial) -> bool:
    """Whether ``z^deg p(1/z) = +- p(z)`` and p(0) != 0."""
    c = p.coeffs()
    return bool(c[0]) and (c == c[::-1] or c == [-x for x in reversed(c)])


def divides(q: Polynomial, p: Polynomial) -> bool:
    """Whether q divides p over Q."""
    return p.gcd(q).degree() == q.degree()


def power_sums(p: Polynomial, count: int) -> list[Fraction]:
    """The sums of the i-th powers of the roots of p, i = 0..count-1, by Newton's identities."""
    degree, lead = p.degree(), int(p.leading_coefficient())
    a = [Fraction(int(c), lead) for c in reversed(p.coeffs())]
    sums = [Fraction(degree)]
    for i in range(1, count):
        known = sum((a[j] * sums[i - j] for j in range(1, min(i - 1, degree) + 1)), Fraction(0))
        sums.append(-known - (i * a[i] if i <= degree else 0))
    return sums
