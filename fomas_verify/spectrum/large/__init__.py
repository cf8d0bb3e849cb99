"""Bounds of the eigenvalues of a large network, proved by floats whose errors are bounded."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.network.sparse import SparseDigraph


@dataclass(frozen=True)
class LargeBounds:
    """What was seen of a strongly connected, balanced digraph.

    Attributes
    ----------
    vectors : tuple of tuples of int
        Each has N entries of absolute value at most 2^62, sums to 0 and is not 0; the first matter most.
    lambda2_lower, lambda_max_upper, sigma_upper : Fraction or None
        Bounds of lambda2, of the largest eigenvalue of L_s, and of sigma; None where there is none.
    reason : str or None
        Why a bound is missing.
    """

    vectors: tuple[tuple[int, ...], ...] = ()
    lambda2_lower: Fraction | None = None
    lambda_max_upper: Fraction | None = None
    sigma_upper: Fraction | None = None
    reason: str | None = None


def large_bounds(graph: SparseDigraph, mu: tuple[Fraction, Fraction], *, memory: int) -> LargeBounds:
    """The bounds that take no factor: none."""
    del graph, mu, memory
    return LargeBounds(reason="no bound of lambda2 from below is computed")
