"""Spectral norms of matrices of balls, by repeated squaring.

With ``G = A^T A`` and s squarings, ``trace(G^(2^s))^(1/2^s)`` bounds the largest eigenvalue of G from above, and
a weighted mean of the eigenvalues from below; the two meet as s grows. Rigorous.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, arb_mat, fmpz

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import exact_end, to_ball, to_fmpq, to_interval
from fomas_verify.exact.matrix import Matrix, to_rows

BallMatrix = arb_mat

_FEW = 60
"""Agents up to which a whole product is cheap."""


def ball_identity(n: int) -> BallMatrix:
    """The n x n identity."""
    return arb_mat(n, n, [arb(int(i == j)) for i in range(n) for j in range(n)])


def plus_multiple(a: BallMatrix, x: Interval, b: BallMatrix) -> BallMatrix:
    """``A + x B``."""
    return a + b * to_ball(x)


def perron_matrix(laplacian: Matrix, mu: Interval) -> BallMatrix:
    """``I - mu L`` with mu enclosed, at the precision in force."""
    n, gain = laplacian.nrows(), to_ball(mu)
    rows = to_rows(laplacian)
    return arb_mat(n, n, [arb(int(i == j)) - gain * arb(to_fmpq(rows[i][j])) for i in range(n) for j in range(n)])


def centered(a: BallMatrix) -> BallMatrix:
    """``(I - J) A``, which takes from each column its mean: for A that keeps the vector 1, its norm is that of A on
    1perp.
    """
    n = a.nrows()
    share = arb(1) / n
    if n <= _FEW:
        # A whole product takes each entry once, which keeps wide balls as they are over a box.
        return arb_mat(n, n, [int(i == j) - share for i in range(n) for j in range(n)]) * a
    return a - arb_mat(n, 1, [1] * n) * (arb_mat(1, n, [share] * n) * a)


def spectral_norm(a: BallMatrix, squarings: int) -> Interval:
    """The 2-norm of A, its relative width about ``ln(N) / 2^(squarings + 1)`` at the most; rigorous."""
    gram = a.transpose() * a
    shifts = []
    for _ in range(squarings):
        shift = _magnitude(gram)
        shifts.append(shift)
        gram = gram * (arb(2) ** -shift)
        gram = gram * gram
    trace = _trace(gram)
    if not trace.abs_upper() > 0:
        return Interval.exactly(0)
    square = _sum_of_squares(gram)
    upper = square.nonnegative_part().sqrt()
    lower = square / trace if trace > 0 else arb(0)
    low, high = lower.nonnegative_part().lower(), upper.upper()
    for shift in reversed(shifts):
        low, high = (x.nonnegative_part().sqrt() * (arb(2) ** shift) for x in (low, high))
    low, high = low.nonnegative_part().sqrt(), high.nonnegative_part().sqrt()
    return Interval(max(exact_end(low.lower()), Fraction(0)), exact_end(high.upper()))


def _trace(a: BallMatrix) -> arb:
    return sum((a[i, i] for i in range(a.nrows())), arb(0))


def _sum_of_squares(a: BallMatrix) -> arb:
    """``trace(A A^T)``, which is ``trace(A^2)`` where A is symmetric."""
    return sum((x * x for row in a.tolist() for x in row), arb(0))


def _magnitude(a: BallMatrix) -> int:
    """An exponent near that of the trace."""
    upper = _trace(a).abs_upper()
    if not upper > 0:
        return 0
    mantissa, exponent = upper.man_exp()
    return int(exponent) + fmpz(mantissa).bit_length()


def ball_columns(vectors: Sequence[Sequence[Fraction]]) -> BallMatrix:
    """The matrix with these columns."""
    entries = [[arb(to_fmpq(x)) for x in vector] for vector in vectors]
    return arb_mat([list(row) for row in zip(*entries, strict=True)])


def squared_image(a: BallMatrix, vectors: BallMatrix) -> Interval:
    """The sum of the squares of all entries of A V, V given by `ball_columns`; rigorous."""
    image = a * vectors
    squares = [[x * x for x in column] for column in zip(*image.tolist(), strict=True)]
    return sum((to_interval(sum(column, arb(0))) for column in squares), Interval.exactly(0))


def approx_preimage_of_top(a: BallMatrix, laplacian: Matrix) -> list[Fraction] | None:
    """A vector x near which ``norm(A L x) / norm(L x)`` is largest, its largest entry 1; approximate. None where the
    precision in force does not tell ``L + D J`` from a singular matrix.

    It solves ``(L + D J) x = w`` for the top right singular vector w of ``(I - J) A``, D the largest entry of L.
    """
    n = a.nrows()
    top = centered(a)
    gram = (top.transpose() * top).mid()
    for _ in range(16):
        gram = gram * (arb(2) ** -_magnitude(gram))
        gram = (gram * gram).mid()
    best = max(range(n), key=lambda i: exact_end(gram[i, i]))
    column = arb_mat(n, 1, [gram[i, best] for i in range(n)])
    degree = arb(to_fmpq(max(x for row in to_rows(laplacian) for x in row)))
    shifted = arb_mat(laplacian) + arb_mat(n, n, [degree / n] * (n * n))
    try:
        solved = shifted.solve(column, algorithm="approx")
    except ZeroDivisionError:
        return None
    x = [exact_end(solved[i, 0].mid()) for i in range(n)]
    x = [entry - x[-1] for entry in x]
    largest = max(map(abs, x)) or Fraction(1)
    return [entry / largest for entry in x]
