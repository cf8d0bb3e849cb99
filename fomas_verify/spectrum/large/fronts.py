"""How the columns of a sparse factor are taken together, so that its product is formed from small dense ones.

Any partition into ranges gives a true residual; a good one makes it cheap. Source: docs/theory.md, section 14.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SMALL_TREE = 64


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


def fronts(lower: Any) -> Fronts:
    """Ranges for a unit lower triangular csc factor with sorted columns.

    Small subtrees of its elimination tree, several where they share a parent; else chains of columns, each of which has
    the rows of the one before, less one.
    """
    import numpy as np

    n = lower.shape[0]
    counts = np.diff(lower.indptr)
    parents = np.full(n, n, dtype=np.int64)
    inner = counts > 1
    parents[inner] = lower.indices[lower.indptr[:-1][inner] + 1]
    sizes = _subtree_sizes(parents.tolist())
    edges = _edges(parents.tolist(), sizes, counts.tolist())
    lengths = np.diff(edges)
    return Fronts(edges, np.repeat(np.arange(len(lengths)), lengths))


def _subtree_sizes(parents: list[int]) -> list[int]:
    sizes = [1] * len(parents)
    for j, parent in enumerate(parents):
        if parent < len(parents):
            sizes[parent] += sizes[j]
    return sizes


def _edges(parents: list[int], sizes: list[int], counts: list[int]) -> list[int]:
    """Where a range begins, and N. In a postorder the subtree of j is the last `sizes[j]` columns up to j."""
    n = len(parents)
    edges, start, above = [0], 0, -1
    j = 0
    while j < n:
        while parents[j] < n and parents[j] > j and sizes[parents[j]] <= _SMALL_TREE:
            j = parents[j]
        small = sizes[j] <= _SMALL_TREE
        if small and above == parents[j] and j + 1 - start <= _SMALL_TREE:
            edges[-1] = j + 1
        else:
            chained = not small and above == -2 and counts[j] == counts[j - 1] - 1 and parents[j - 1] == j
            start = start if chained else edges[-1]
            edges[-1 if chained else len(edges) :] = [j + 1]
        above = parents[j] if small else -2
        j += 1
    return edges
