"""Approximate linear algebra in Arb: candidates for exact tests.

Nothing here is a proof: the results are midpoints, the same on every machine, which an exact test accepts or refuses.
"""

from __future__ import annotations

from fractions import Fraction

from flint import arb, arb_mat

from fomas_verify.enclosure.real import exact_end, working_precision
from fomas_verify.exact.matrix import Matrix, identity, matrix


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


def approx_top_vector(a: Matrix, doublings: int, bits: int) -> list[Fraction]:
    """A vector near the eigenspace of the largest eigenvalue of a positive semidefinite A: its column of largest
    diagonal entry after A has been squared ``doublings`` times, with largest entry 1.
    """
    with working_precision(bits):
        power = arb_mat(a)
        n = a.nrows()
        for _ in range(doublings):
            power = power * power
            trace = sum((power[i, i] for i in range(n)), arb(0)).mid()
            if not trace > 0:
                break
            power = (power * (1 / trace)).mid()
        best = max(range(n), key=lambda i: exact_end(power[i, i].mid()))
        column = [exact_end(power[i, best].mid()) for i in range(n)]
    largest = max((abs(x) for x in column), default=Fraction(0)) or Fraction(1)
    return [x / largest for x in column]
