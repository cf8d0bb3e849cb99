"""How large the factor of a symmetric sparse matrix becomes, counted before it is formed.

The order is a minimum degree's, near to that which qdldl chooses. Row i of the factor has its entries on the paths of
the elimination tree from the neighbours of i before it up to i; with the neighbours in postorder, column k has
as many entries as the subtree of k holds such neighbours, less the meeting points of each two in turn and the ends of
the paths. Nothing here bears on the truth of a bound. Source: J. W. H. Liu, *The role of elimination trees in sparse
factorization*, SIAM J. Matrix Anal. Appl. 11 (1990).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Fill:
    """Entries of the factor, the diagonal too, and the sum of the squares of its columns' counts."""

    entries: int
    work: float


@dataclass(frozen=True, eq=False)
class _Tree:
    """The elimination tree, its nodes in postorder: parents (-1 of a root), sizes of subtrees, depths."""

    parents: NDArray[Any]
    sizes: NDArray[Any]
    depths: NDArray[Any]


def fill(upper: Any) -> Fill:
    """That of the matrix whose upper triangle this csc array is, every diagonal entry stored."""
    import numpy as np

    counts = column_counts(upper, _minimum_degree(upper)).astype(np.float64)
    return Fill(int(counts.sum()), float((counts**2).sum()))


def column_counts(upper: Any, places: NDArray[Any]) -> NDArray[Any]:
    """The entries of each column of the factor in some order, row i of the matrix being eliminated `places[i]`-th.

    The columns stand in a postorder of the elimination tree.
    """
    import numpy as np

    n = upper.shape[0]
    rows, columns = upper.tocoo().coords
    ends = np.sort(np.stack([places[rows], places[columns]]), axis=0)
    tree, post = _tree(ends, n)
    early, late = post[ends[0]], post[ends[1]]
    turn = np.lexsort((early, late))
    early, late = early[turn], late[turn]
    same = late[1:] == late[:-1]
    meeting = _meeting(tree, early[:-1][same], early[1:][same])
    change = np.bincount(early, minlength=n) - np.bincount(meeting, minlength=n)
    change -= np.bincount(tree.parents[tree.parents >= 0], minlength=n)
    sums = np.concatenate([[0], np.cumsum(change)])
    here = np.arange(1, n + 1)
    counts: NDArray[Any] = sums[here] - sums[here - tree.sizes]
    return counts


def _minimum_degree(upper: Any) -> NDArray[Any]:
    """The place of each row in the order that SuperLU finds, which is asked for a factor of next to nothing."""
    import numpy as np
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import spilu

    n = upper.shape[0]
    pattern = csc_array((np.ones(upper.nnz), upper.indices, upper.indptr), shape=upper.shape)
    pattern = csc_array(pattern + pattern.T)
    pattern.setdiag(3.0 * n)
    try:
        return np.asarray(spilu(pattern, drop_tol=2.0, fill_factor=1, permc_spec="MMD_AT_PLUS_A").perm_c)
    except RuntimeError:
        return np.arange(n)


def _tree(ends: NDArray[Any], n: int) -> tuple[_Tree, NDArray[Any]]:
    """The tree, and the place of each row in its postorder."""
    import numpy as np

    parents = _parents(ends, n)
    sizes, depths, free = [1] * n, [0] * n, [0] * n
    for node, parent in enumerate(parents):
        if parent >= 0:
            sizes[parent] += sizes[node]
    post, start = [0] * n, 0
    # Each subtree takes the places from `free` on, its root the last of them.
    for node in range(n - 1, -1, -1):
        parent = parents[node]
        if parent < 0:
            free[node], start = start, start + sizes[node]
        else:
            free[node] = free[parent]
            free[parent] += sizes[node]
            depths[node] = depths[parent] + 1
        post[node] = free[node] + sizes[node] - 1
    moved, above = np.array(post), np.array(parents)
    turn = np.argsort(moved)
    above = above[turn]
    above = np.where(above < 0, -1, moved[above])
    return _Tree(above, np.array(sizes)[turn], np.array(depths)[turn]), moved


def _parents(ends: NDArray[Any], n: int) -> list[int]:
    """The parent of each row, the next that its elimination changes, from the entries (earlier, later)."""
    import numpy as np

    parents, shortcut = [-1] * n, [-1] * n
    turn = np.argsort(ends[1], kind="stable")
    for early, late in zip(ends[0][turn].tolist(), ends[1][turn].tolist(), strict=True):
        node = early
        while node not in (-1, late):
            after, shortcut[node] = shortcut[node], late
            if after == -1:
                parents[node] = late
            node = after
    return parents


def _meeting(tree: _Tree, a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """The lowest common ancestor of each a and b, a < b in postorder.

    It is b, or the parent of the node nearest to the root from a to b: of those, none is a common ancestor.
    """
    import numpy as np

    n = len(tree.depths)
    rows = [tree.depths.astype(np.int64) * n + np.arange(n)]
    levels = np.frexp((b - a + 1).astype(float))[1] - 1
    for level in range(int(levels.max(initial=0))):
        half = 1 << level
        rows.append(np.minimum(rows[-1][:-half], rows[-1][half:]))
    highest = np.empty(len(a), dtype=np.int64)
    for level, row in enumerate(rows):
        here = levels == level
        highest[here] = np.minimum(row[a[here]], row[b[here] + 1 - (1 << level)]) % n
    return np.where(a > b - tree.sizes[b], b, tree.parents[highest])
