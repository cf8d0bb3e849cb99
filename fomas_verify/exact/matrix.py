"""Rational matrices and the exact sign of a symmetric form.

Notation: ``Matrix`` is a matrix of exact rationals (``flint.fmpq_mat``). 1perp is the space of vectors that sum to
0, with the basis ``V = [I; -1^T]``; the differences from the last agent are ``C x`` with ``C = [I, -1]``. Source:
docs/certificate-format.md, section 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import gcd

from flint import fmpq, fmpq_mat, fmpz_mat, fmpz_poly

from fomas_verify.exact.polynomial import integer_characteristic_polynomial

Matrix = fmpq_mat
Rows = Sequence[Sequence[Fraction]]


@dataclass(frozen=True)
class Inertia:
    """Numbers of negative, zero and positive eigenvalues of a symmetric matrix."""

    negative: int
    zero: int
    positive: int


def matrix(rows: Rows) -> Matrix:
    """The exact matrix with these rows."""
    return fmpq_mat(len(rows), len(rows[0]), [fmpq(x.numerator, x.denominator) for row in rows for x in row])


def to_rows(a: Matrix) -> list[list[Fraction]]:
    """The entries as fractions, row by row."""
    return [[Fraction(int(x.p), int(x.q)) for x in row] for row in a.tolist()]


def identity(n: int) -> Matrix:
    """The n x n identity."""
    return fmpq_mat(n, n, [fmpq(int(i == j)) for i in range(n) for j in range(n)])


def scaled(a: Matrix, x: Fraction | int) -> Matrix:
    """``x A``."""
    return a * fmpq(x.numerator, x.denominator)


def all_ones(n: int) -> Matrix:
    """The n x n matrix of ones, ``1 1^T``."""
    return fmpq_mat(n, n, [fmpq(1)] * (n * n))


def on_sum_zero(a: Matrix) -> Matrix:
    """``V^T A V``: the form of A on 1perp, (N-1) x (N-1)."""
    n = a.nrows() - 1
    return fmpq_mat(n, n, [a[i, j] - a[i, n] - a[n, j] + a[n, n] for i in range(n) for j in range(n)])


def on_differences(a: Matrix) -> Matrix:
    """A (with ``A 1 = 0``) acting on the differences from the last agent: entries ``a_ij - a_Nj``."""
    n = a.nrows() - 1
    return fmpq_mat(n, n, [a[i, j] - a[n, j] for i in range(n) for j in range(n)])


def inertia(a: Matrix) -> Inertia:
    """The exact inertia of a symmetric rational matrix.

    A symmetric matrix has only real eigenvalues, so Descartes' rule of signs on its characteristic polynomial is an
    equality: the sign changes count the positive eigenvalues, and the power of x that divides it the zero ones.
    """
    n = a.nrows()
    coefficients = [int(c) for c in integer_characteristic_polynomial(a)[0].coeffs()]
    zero = next(i for i, c in enumerate(coefficients) if c)
    signs = [c > 0 for c in coefficients if c]
    positive = sum(x != y for x, y in pairwise(signs))
    return Inertia(n - zero - positive, zero, positive)


def is_positive_definite(a: Matrix) -> bool:
    """Whether the symmetric matrix A is positive definite; exact."""
    return inertia(a).positive == a.nrows()


def is_positive_semidefinite(a: Matrix) -> bool:
    """Whether the symmetric matrix A is positive semidefinite; exact."""
    return inertia(a).negative == 0


def kernel(a: Matrix) -> Matrix:
    """A matrix whose columns are a basis of the null space of A; it has no columns where the null space is 0."""
    reduced, rank = a.rref()
    n = a.ncols()
    pivots = [next(j for j in range(n) if reduced[i, j]) for i in range(rank)]
    free = [j for j in range(n) if j not in set(pivots)]
    basis = fmpq_mat(n, len(free))
    for column, j in enumerate(free):
        basis[j, column] = fmpq(1)
        for i, pivot in enumerate(pivots):
            basis[pivot, column] = -reduced[i, j]
    return basis


def evaluate(polynomial: fmpz_poly, a: Matrix) -> Matrix:
    """The polynomial at the square matrix A, by Horner's rule."""
    one = identity(a.nrows())
    value = scaled(one, 0)
    for c in reversed(polynomial.coeffs()):
        value = value * a + one * fmpq(c)
    return value


def longest_bits(a: Matrix) -> int:
    """The bits of the longest entry of A, common factors and denominators left out."""
    entries = [abs(int(x)) for x in a.numer_denom()[0].entries()]
    return (max(entries) // (gcd(*entries) or 1)).bit_length()


def leading_bits(a: Matrix, bits: int) -> tuple[Matrix, Fraction, int]:
    """B with whole entries, s > 0 and e with ``norm(A - s B) <= s e``, for a symmetric A of which every row sums to 0,
    as every row of B does. B holds so many of the leading bits of A's longest entry.
    """
    numerators, denominator = a.numer_denom()
    n = a.nrows()
    shift = max(0, max(abs(int(x)).bit_length() for x in numerators.entries()) - bits)
    rows = [[int(numerators[i, j]) >> shift if i != j else 0 for j in range(n)] for i in range(n)]
    for i, row in enumerate(rows):
        row[i] = -sum(row)
    # Each entry beside the diagonal is off by less than 1, each on it by less than n - 1.
    return fmpq_mat(fmpz_mat(rows)), Fraction(1 << shift, int(denominator)), 2 * (n - 1)


def norm_squared(vector: Sequence[Fraction]) -> Fraction:
    """The sum of the squares."""
    return sum((x * x for x in vector), Fraction(0))


def apply(a: Matrix, vector: Sequence[Fraction]) -> list[Fraction]:
    """A times the vector."""
    column = a * matrix([[x] for x in vector])
    return [row[0] for row in to_rows(column)]


def column(a: Matrix, j: int) -> Matrix:
    """Column j of A, as a matrix of one column."""
    return fmpq_mat(a.nrows(), 1, [a[i, j] for i in range(a.nrows())])


def columns(parts: Sequence[Matrix]) -> Matrix:
    """The matrix with these columns."""
    rows = parts[0].nrows()
    return fmpq_mat(rows, len(parts), [part[i, 0] for i in range(rows) for part in parts])
