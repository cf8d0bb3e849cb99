"""How the columns of a sparse factor are taken together, so that its product is formed from small dense ones.

Any partition into ranges gives a true residual; a good one makes it cheap. Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SMALL_TREE = 32
_CHAIN, _NONE = -2, -3


@dataclass(frozen=True, eq=False)
class Fronts:
    """Ranges of columns.

    Attributes
    ----------
    edges : list of int
        Range number s has the columns ``edges[s]`` to ``edges[s + 1] - 1``.
    of_column : array, shape (N,)
        The range of each column.
    """

    edges: list[int]
    of_column: NDArray[Any]


def fronts(parents: list[int], counts: list[int]) -> Fronts:
    """Ranges for an elimination tree (each column's parent, -1 for a root) and the entries of each factor column.

    Small subtrees, several where they share a parent; else chains of columns, each of which has the rows of the one
    before, less one.
    """
    import numpy as np

    edges = _edges(parents, _subtree_sizes(parents), counts)
    lengths = np.diff(edges)
    return Fronts(edges, np.repeat(np.arange(len(lengths)), lengths))


def _subtree_sizes(parents: list[int]) -> list[int]:
    sizes = [1] * len(parents)
    for j, parent in enumerate(parents):
        if parent >= 0:
            sizes[parent] += sizes[j]
    return sizes


def _edges(parents: list[int], sizes: list[int], counts: list[int]) -> list[int]:
    """Where a range begins, and N. In a postorder the subtree of j is the last `sizes[j]` columns up to j."""
    n = len(parents)
    edges, start, above = [0], 0, _NONE
    j = 0
    while j < n:
        while parents[j] > j and sizes[parents[j]] <= _SMALL_TREE:
            j = parents[j]
        small = sizes[j] <= _SMALL_TREE
        joined = (small and above == parents[j] and j + 1 - start <= _SMALL_TREE) or (
            not small and above == _CHAIN and counts[j] == counts[j - 1] - 1 and parents[j - 1] == j
        )
        if not joined:
            start = edges[-1]
            edges.append(start)
        edges[-1] = j + 1
        above = parents[j] if small else _CHAIN
        j += 1
    return edges
