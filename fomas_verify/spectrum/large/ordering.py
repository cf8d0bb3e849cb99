"""An order in which a symmetric sparse matrix is eliminated, and how large its factor becomes, before it is formed.

Nothing here bears on the truth of a bound. Source: J. R. Gilbert, E. G. Ng, B. W. Peyton, *An efficient algorithm to
compute row and column counts for sparse Cholesky factorization*, SIAM J. Matrix Anal. Appl. 15 (1994).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fomas_verify.spectrum.large.fronts import Fronts, fronts

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Order:
    """Rows in the order of elimination, the entries of each column of the factor, and the columns taken together."""

    rows: NDArray[Any]
    counts: NDArray[Any]
    fronts: Fronts

    @property
    def entries(self) -> int:
        """Entries of the factor's triangle."""
        return int(self.counts.sum())

    @property
    def work(self) -> float:
        """Products in the elimination, about."""
        return float((self.counts.astype(float) ** 2).sum())


def elimination_order(matrix: Any) -> Order:
    """An order for a symmetric csc matrix: minimum degree where scipy finds one, else that of a narrow band."""
    import numpy as np

    rows = _minimum_degree(matrix)
    parents = _tree(matrix, rows)
    rows = rows[_postorder(parents)]
    parents = _tree(matrix, rows)
    counts = _counts(matrix, rows, parents)
    return Order(rows, np.array(counts), fronts(parents, counts))


def _minimum_degree(matrix: Any) -> NDArray[Any]:
    """The order alone: an incomplete factor that drops everything costs next to nothing."""
    import numpy as np
    from scipy.sparse import csc_array, eye_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee
    from scipy.sparse.linalg import spilu

    n = matrix.shape[0]
    ones = csc_array((np.full(matrix.nnz, -1.0), matrix.indices, matrix.indptr), shape=matrix.shape)
    heavy = csc_array(ones + eye_array(n, format="csc") * (2.0 * n + 2.0))
    try:
        factor = spilu(heavy, drop_tol=1e300, fill_factor=1, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0)
        rows = np.argsort(factor.perm_c)
    except RuntimeError:
        rows = np.asarray(reverse_cuthill_mckee(matrix.tocsr(), symmetric_mode=True))
    return rows


def _below(matrix: Any, rows: NDArray[Any], *, by_row: bool) -> tuple[list[int], list[int]]:
    """The strict lower triangle in this order: pointers, and the columns of each row or the rows of each column."""
    from scipy.sparse import tril

    moved = matrix[rows][:, rows]
    lower = tril(moved, k=-1, format="csr" if by_row else "csc")
    return lower.indptr.tolist(), lower.indices.tolist()


def _tree(matrix: Any, rows: NDArray[Any]) -> list[int]:
    """The elimination tree: each column's parent, -1 for a root."""
    pointers, columns = _below(matrix, rows, by_row=True)
    n = len(pointers) - 1
    parents, ancestors = [-1] * n, [-1] * n
    for i in range(n):
        for start in columns[pointers[i] : pointers[i + 1]]:
            j = start
            while (above := ancestors[j]) != i:
                ancestors[j] = i
                if above < 0:
                    parents[j] = i
                    break
                j = above
    return parents


def _postorder(parents: list[int]) -> NDArray[Any]:
    """Children before parents, each subtree in one piece."""
    import numpy as np

    n = len(parents)
    sizes = [1] * n
    for j, parent in enumerate(parents):
        if parent >= 0:
            sizes[parent] += sizes[j]
    # From the roots down: a child is placed right before what its parent has given away already.
    free, places, end = [0] * n, [0] * n, n
    for j in range(n - 1, -1, -1):
        parent = parents[j]
        if parent < 0:
            place, end = end - 1, end - sizes[j]
        else:
            place = free[parent]
            free[parent] -= sizes[j]
        places[j], free[j] = place, place - 1
    order = np.empty(n, dtype=np.int64)
    order[places] = np.arange(n)
    return order


def _counts(matrix: Any, rows: NDArray[Any], parents: list[int]) -> list[int]:
    """The entries of each column of the factor, for an order that is a postorder of its tree."""
    pointers, below = _below(matrix, rows, by_row=False)
    n = len(parents)
    firsts = list(range(n))
    for j, parent in enumerate(parents):
        if parent >= 0 and firsts[j] < firsts[parent]:
            firsts[parent] = firsts[j]
    counts = [1 if firsts[j] == j else 0 for j in range(n)]
    reached, leaves, ancestors = [-1] * n, [-1] * n, list(range(n))
    for j, parent in enumerate(parents):
        if parent >= 0:
            counts[parent] -= 1
        for i in below[pointers[j] : pointers[j + 1]]:
            if firsts[j] > reached[i]:
                # j is a leaf of row i's subtree: what it shares with the leaf before is counted once.
                reached[i] = firsts[j]
                counts[j] += 1
                if leaves[i] >= 0:
                    counts[_root(ancestors, leaves[i])] -= 1
                leaves[i] = j
        if parent >= 0:
            ancestors[j] = parent
    for j, parent in enumerate(parents):
        if parent >= 0:
            counts[parent] += counts[j]
    return counts


def _root(ancestors: list[int], j: int) -> int:
    root = j
    while ancestors[root] != root:
        root = ancestors[root]
    while ancestors[j] != root:
        ancestors[j], j = root, ancestors[j]
    return root
