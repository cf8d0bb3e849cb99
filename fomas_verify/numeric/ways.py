"""Which factor bounds an eigenvalue, a sparse or a dense one, or none, known before any is formed.

Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.numeric.dense import dense_bytes, expected_error, least, lift_of
from fomas_verify.numeric.fill import fill
from fomas_verify.numeric.floats import Symmetric
from fomas_verify.numeric.inertia import inertia

_BYTES_AN_ENTRY = 80
_SPARSE_COST, _DENSE_COST = 5e-9, 2e-11
"""Seconds, about, for each product of a sparse factor's and its residual's, and of the N^3 of a dense one's."""

_SOON = 1.0

_FIRST = 2.0**-40


@dataclass(frozen=True)
class Found:
    """Bounds of an eigenvalue, where found, and the error met, where known."""

    lower: Fraction | None
    upper: Fraction | None
    error: float | None


@dataclass(frozen=True)
class Way:
    """Bounds of an eigenvalue of `sign` times `matrix`, sign = 1 or -1: of the least of all, or on 1perp (`on_perp`).

    On 1perp 0 is the eigenvalue at the vector 1, and what is asked is whether the next is beyond something positive.
    """

    matrix: Symmetric
    memory: int
    dense: bool
    on_perp: bool
    sign: float = 1.0

    def first_room(self) -> float:
        """A distance within which a bound is likely to be found."""
        room = _FIRST * float(abs(self.matrix.upper).max())
        return max(room, expected_error(self.matrix)) if self.dense else room

    def near(self, shift: float) -> Found | None:
        """A lower bound below the shift, if the eigenvalue is beyond it, or an upper bound near it. Rigorous, if > 0.

        None where there is no factor.
        """
        moved = self.matrix.shifted(self.sign, -shift)
        exact = Fraction(shift)
        if self.dense:
            found = least(moved, self.memory, lift=lift_of(self.matrix) if self.on_perp else 0.0)
            if found is None:
                return None
            if isinstance(found, Fraction):
                return Found(None, exact + found, None)
            return Found(exact - Fraction(found), None, found)
        counted = inertia(moved, self.memory)
        if counted is None:
            return None
        negative, error = counted
        if negative <= (1 if self.on_perp else 0):
            return Found(exact - Fraction(error), None, error)
        return Found(None, exact + Fraction(error), error)


def way_for(matrix: Symmetric, memory: int, *, on_perp: bool) -> Way | None:
    """The cheapest way that the memory allows, the sparse one where both take no time, or None."""
    n = matrix.upper.shape[0]
    filled = fill(matrix.upper)
    costs = []
    if filled.entries * _BYTES_AN_ENTRY <= memory:
        costs.append((max(filled.work * _SPARSE_COST, _SOON), False))
    if dense_bytes(n) <= memory:
        costs.append((max(n**3 * _DENSE_COST, _SOON), True))
    return Way(matrix, memory, min(costs)[1], on_perp) if costs else None
