"""The quotients of a vector on a digraph given as arrays, exact.

Notation: L the Laplacian, L_s its symmetric part; of columns e, ``q = sum e^T L_s e / sum e^T e`` and
``s = sum norm(L e)^2 / sum e^T e``. Source: theory, section 14.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from operator import mul
from typing import TYPE_CHECKING, Any

from fomas_verify.network.sparse import SparseDigraph
from fomas_verify.network.sparse_facts import MOST_SUM, sparse_in_sums

if TYPE_CHECKING:
    from numpy.typing import NDArray

Quotients = tuple[Fraction, Fraction]


def quotients(graph: SparseDigraph, columns: Sequence[Sequence[int]]) -> Quotients:
    """(q, s) of integer columns, of which one is not 0. Exact; linear in agents and edges."""
    square = form = stretch = 0
    for column in columns:
        moved = image(graph, column)
        square += sum(map(mul, column, column))
        form += sum(map(mul, column, moved))
        stretch += sum(map(mul, moved, moved))
    return Fraction(form, square * graph.denominator), Fraction(stretch, square * graph.denominator**2)


def image(graph: SparseDigraph, column: Sequence[int]) -> list[int]:
    """``denominator L e`` of an integer column e. Exact: with Python's integers where 63 bits might not hold a sum."""
    import numpy as np

    longest = max(map(abs, column))
    largest = int(max(sparse_in_sums(graph), default=0))
    small = 2 * longest * max(largest, 1) < MOST_SUM and graph.weights.dtype != object
    x = np.array(column, dtype=np.int64 if small else object)
    weights: NDArray[Any] = graph.weights if small else graph.weights.astype(object)
    moved = np.zeros(graph.agents, dtype=x.dtype)
    np.add.at(moved, graph.targets, weights * (x[graph.targets] - x[graph.sources]))
    found: list[int] = moved.tolist()
    return found
