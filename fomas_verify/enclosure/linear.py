"""Approximate linear algebra in Arb: candidates for exact tests.

Nothing here is a proof: the results are midpoints, the same on every machine, which an exact test accepts or refuses.
"""

from __future__ import annotations

from fractions import Fraction

from flint import arb, arb_mat

from fomas_verify.enclosure.real import exact_end, to_fmpq, working_precision
from fomas_verify.exact.matrix import Matrix, all_ones, identity, matrix, scaled, to_rows


def _rounded(a: arb_mat, scale_bits: int) -> list[list[int]]:
    """The entries times ``2^scale_bits``, to the nearest integer."""
    factor = 1 << scale_bits
    return [[round(exact_end(x.mid()) * factor) for x in row] for row in a.tolist()]


def approx_lyapunov_sum(a: Matrix, bits: int) -> arb_mat | None:
    """``sum_k (A^k)^T A^k`` by doubling (Smith); None where the powers do not become small within ``bits``
    doublings.
    """
    with working_precision(bits):
        power = arb_mat(a)
        total = arb_mat(identity(a.nrows()))
        for _ in range(bits):
            total = (total + power.transpose() * total * power).mid()
            power = (power * power).mid()
            size = sum((abs(x) for row in power.tolist() for x in row), arb(0))
            if size < arb(2) ** (-bits // 2):
                return total
            if not size < arb(2) ** bits:
                return None
        return None


def integer_lyapunov_form(approximation: arb_mat, scale_bits: int) -> Matrix:
    """The symmetric integer matrix nearest to ``2^scale_bits`` times the approximation."""
    rows = _rounded(approximation, scale_bits)
    return matrix([[Fraction(rows[max(i, j)][min(i, j)]) for j in range(len(rows))] for i in range(len(rows))])


def approx_eigenvector(a: Matrix, shift: Fraction, bits: int) -> list[Fraction]:
    """A vector that sums to 0, near the eigenspace on 1perp of the symmetric A's eigenvalue next to the shift;
    largest entry 1.

    Inverse iteration; A keeps 1perp, and the vector 1 is moved out of the way.
    """
    n = a.nrows()
    a = a + scaled(all_ones(n), 1 + max(abs(x) for row in to_rows(a) for x in row))
    with working_precision(2 * bits):
        offset = arb(to_fmpq(shift)) * (1 + arb(2) ** -bits) + arb(2) ** (-2 * bits)
        shifted = arb_mat(a) - arb_mat(n, n, [offset * int(i == j) for i in range(n) for j in range(n)])
        vector = [arb((7 * i * i + 3 * i) % (2 * n + 3) + 1) for i in range(n)]
        for _ in range(4):
            mean = sum(vector, arb(0)) / n
            solved = shifted.solve(arb_mat(n, 1, [x - mean for x in vector]), algorithm="approx")
            size = max(abs(exact_end(solved[i, 0].mid())) for i in range(n))
            vector = [solved[i, 0].mid() / arb(to_fmpq(size)) for i in range(n)]
        entries = [exact_end(x.mid()) for x in vector]
    return [x / max(map(abs, entries)) for x in entries]
