"""Integer matrices that a Coq file checks: a nonnegative form with its factor and residual.

Notation: ``K M - eps I = F F^T + E`` with E symmetric and norm_inf(E) <= eps shows ``M >= 0``. Source:
``residual_factor`` and proofs/Design/Integers.v; the tables are those of proofs/Design, entry by entry. A form that is
singular is shown exactly, as a sum of squares (proofs/Design/Spectrum.v).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt, lcm

Table = list[list[int]]
MOST_BITS = 1024
"""Bits of the scale at which a factor is given up: the form is singular, or as good as."""


@dataclass(frozen=True)
class Factor:
    """F with its scale K and the bound eps of its residual; ``weight`` of 1 1^T in M."""

    weight: int
    rows: Table
    scale: int
    eps: int


@dataclass(frozen=True)
class Squares:
    """``K M = F^T diag(w) F``, exactly: the rows of F, the weights w >= 0 and the scale K > 0."""

    rows: Table
    weights: list[int]
    scale: int


def stein(q: Table, b: Table, a: int, times: int, shift: int) -> Table:
    """``a Q - times B^T Q B - shift I``."""
    n = len(q)
    qb = product(q, b)
    turned = product([list(column) for column in zip(*b, strict=True)], qb)
    return [[a * q[i][j] - times * turned[i][j] - (shift if i == j else 0) for j in range(n)] for i in range(n)]


def product(a: Table, b: Table) -> Table:
    """``A B``."""
    columns = list(zip(*b, strict=True))
    return [[sum(x * y for x, y in zip(row, column, strict=True)) for column in columns] for row in a]


def identity(n: int) -> Table:
    """The n x n identity."""
    return [[int(i == j) for j in range(n)] for i in range(n)]


def factor(m: Table, weight: int | None = None) -> Factor | None:
    """What shows that M is nonnegative on the vectors that sum to 0; None where no factor of so many bits does.

    ``weight 1 1^T`` is added to M first: it vanishes there, and M has the null vector 1. With ``weight`` 0 M is
    nonnegative on all vectors.
    """
    n = len(m)
    if weight is None:
        weight = max(abs(x) for row in m for x in row) + 1
    lifted = [[x + weight for x in row] for row in m]
    largest = isqrt(max(lifted[i][i] for i in range(n))) + 1
    bits = 4
    while bits <= MOST_BITS:
        eps = (n + 1) * (largest << bits)
        scaled = [[(x << 2 * bits) - (eps if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(lifted)]
        rows = _cholesky(scaled)
        if rows is not None and _residual(scaled, rows) <= eps:
            return Factor(weight, rows, 1 << 2 * bits, eps)
        bits *= 2
    return None


def squares(m: Table) -> Squares | None:
    """M as a sum of squares, exactly; None where M is not nonnegative."""
    n = len(m)
    rest = [[Fraction(x) for x in row] for row in m]
    rows, weights = [[0] * n for _ in range(n)], [Fraction(0)] * n
    for k in range(n):
        pivot, column = rest[k][k], list(rest[k])
        if pivot < 0 or (pivot == 0 and any(column)):
            return None
        if pivot == 0:
            continue
        unit = lcm(*(x.denominator for x in column))
        rows[k] = [int(x * unit) for x in column]
        weights[k] = 1 / (pivot * unit * unit)
        for i in range(k, n):
            rest[i] = [x - column[i] * y / pivot for x, y in zip(rest[i], column, strict=True)]
    scale = lcm(*(x.denominator for x in weights))
    return Squares(rows, [int(x * scale) for x in weights], scale)


def _cholesky(a: Table) -> Table | None:
    """A lower triangular integer F with F F^T near A; None at a pivot that is not positive."""
    n = len(a)
    f = [[0] * n for _ in range(n)]
    for j in range(n):
        rest = a[j][j] - sum(x * x for x in f[j][:j])
        if rest <= 0 or (pivot := isqrt(rest)) == 0:
            return None
        f[j][j] = pivot
        for i in range(j + 1, n):
            f[i][j] = (2 * (a[i][j] - sum(x * y for x, y in zip(f[i][:j], f[j][:j], strict=True))) + pivot) // (
                2 * pivot
            )
    return f


def _residual(a: Table, f: Table) -> int:
    squared = product(f, [list(column) for column in zip(*f, strict=True)])
    return max(sum(abs(x - y) for x, y in zip(*rows, strict=True)) for rows in zip(a, squared, strict=True))
