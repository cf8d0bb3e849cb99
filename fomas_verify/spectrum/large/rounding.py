"""What rounding to nearest in doubles can change, counted once for the whole room.

u = 2^-53; a sum of k products, in any order, fused or not, is within ``gamma_k sum abs`` of the true one, where
``gamma_k = k u / (1 - k u)``. Source: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, section 3.1.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

U = 2.0**-53
SLACK = 1 + 2.0**-20
"""Covers the rounding in a bound: sums and products of nonnegative doubles, fewer than 2^30 one after another."""

UNDERFLOW = 2.0**-400
"""More than all that underflow can change in a row, or in a norm by way of squares, where no number is beyond `LARGEST`
and fewer than 2^80 numbers are added.
"""

LARGEST = 2.0**100


def gamma(terms: int) -> float:
    """gamma_k, rounded up, for k < 2^50."""
    return terms * U / (1 - terms * U) * SLACK


def gammas(terms: NDArray[Any]) -> NDArray[Any]:
    """gamma_k of each."""
    return terms * U / (1 - terms * U) * SLACK
