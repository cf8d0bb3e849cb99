"""Which factor is affordable, sparse, dense or none, known before any is formed. Source: docs/theory.md, section 14."""

from __future__ import annotations

from typing import Protocol

from fomas_verify.spectrum.large.dense import DenseFactors, dense_bytes
from fomas_verify.spectrum.large.factor import BYTES_AN_ENTRY, Solve, SparseFactors
from fomas_verify.spectrum.large.matrices import Near
from fomas_verify.spectrum.large.ordering import elimination_order

_SPARSE_COST, _DENSE_COST = 1.5e-9, 0.06e-9
"""Seconds, about, that one product takes in a sparse factor and its residual, and in a dense factor."""


class Way(Protocol):
    """Factors of one kind."""

    @property
    def prefers_no_factor(self) -> bool:
        """Whether a factor costs more than many products with the matrix."""

    def expected_error(self, near: Near) -> float:
        """What rounding is likely to cost beyond what a sparse factor loses."""

    def solve_near_zero(self, near: Near, shift: float) -> Solve:
        """Apply the inverse of ``A + shift I`` on 1perp, about; RuntimeError where there is none."""

    def second_at_least(self, near: Near, shift: float) -> float | None:
        """A rigorous lower bound of the second smallest eigenvalue of A, near `shift`, the smallest being 0 at 1."""

    def all_at_most(self, near: Near, shift: float) -> float | None:
        """A rigorous upper bound of every eigenvalue of A, near `shift`."""


def way_for(near: Near, memory: int) -> tuple[Way | None, str | None]:
    """The cheapest way within the memory for matrices of this pattern; or None, and why."""
    n = near.matrix.shape[0]
    dense = dense_bytes(n)
    order = elimination_order(near.matrix)
    sparse = order.entries * BYTES_AN_ENTRY
    costs: list[tuple[float, Way]] = []
    if sparse <= memory:
        costs.append((order.work * _SPARSE_COST, SparseFactors(order)))
    if dense <= memory:
        costs.append((n**3 / 3 * _DENSE_COST, DenseFactors()))
    if costs:
        return min(costs, key=lambda each: each[0])[1], None
    least = min(sparse, dense)
    return None, f"a factor would take {least / 1e9:.1f} GB, more than the {memory / 1e9:.1f} GB allowed"
