"""Facts of a digraph given as arrays, exact: degrees, balance, symmetry, strong connectivity.

Notation as in `sparse`; what these return counts agents from 1, as `balance` and `connectivity` do. Source: the paper's
Assumption 1.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fomas_verify.network.balance import Imbalance
from fomas_verify.network.sparse import SparseDigraph

if TYPE_CHECKING:
    from numpy.typing import NDArray

MOST_SUM = 1 << 62
"""Sums that could reach this are formed with Python's integers."""


def sparse_in_sums(graph: SparseDigraph) -> NDArray[Any]:
    """``denominator (A 1)_i``: what each agent hears, as int64 or Python's int, shape (N,). Exact."""
    return _sums(graph, graph.targets)


def sparse_out_sums(graph: SparseDigraph) -> NDArray[Any]:
    """``denominator (A^T 1)_i``: how much each agent is heard, as int64 or Python's int, shape (N,). Exact."""
    return _sums(graph, graph.sources)


def sparse_degree_max(graph: SparseDigraph) -> Fraction:
    """D = max_i (A 1)_i; 0 without edges. Exact."""
    return Fraction(int(max(sparse_in_sums(graph))), graph.denominator)


def sparse_imbalance(graph: SparseDigraph) -> Imbalance | None:
    """The first agent that breaks the balance, as `balance.imbalances` begins; None iff the digraph is balanced."""
    import numpy as np

    hears, heard = sparse_in_sums(graph), sparse_out_sums(graph)
    broken = np.flatnonzero(hears != heard)
    if not len(broken):
        return None
    i, d = int(broken[0]), graph.denominator
    return Imbalance(i + 1, Fraction(int(hears[i]), d), Fraction(int(heard[i]), d))


def sparse_is_symmetric(graph: SparseDigraph) -> bool:
    """Whether A = A^T. Exact."""
    import numpy as np

    turned = np.lexsort((graph.sources, graph.targets))
    return bool(
        np.array_equal(graph.targets[turned], graph.sources)
        and np.array_equal(graph.sources[turned], graph.targets)
        and np.array_equal(graph.weights[turned], graph.weights)
    )


def sparse_unreachable_pair(graph: SparseDigraph) -> tuple[int, int] | None:
    """The first pair (i, j), in lexicographic order, without a directed path from i to j, as
    `connectivity.unreachable_pair` finds it; None iff the digraph is strongly connected.
    """
    import numpy as np

    if _strong_parts(graph) == 1:
        return None
    missed = _missed(graph.agents, graph.sources, graph.targets)
    if len(missed):
        return (1, int(missed[0]) + 1)
    # Agent 1 reaches everyone, so an agent that cannot reach everyone cannot reach agent 1.
    stranded = _missed(graph.agents, graph.targets, graph.sources)
    return (int(np.min(stranded)) + 1, 1)


def sparse_has_root(graph: SparseDigraph) -> bool:
    """Whether some agent reaches every other: whether one strong component alone hears nobody outside."""
    import numpy as np
    from scipy.sparse.csgraph import connected_components

    pattern = _pattern(graph.agents, graph.sources, graph.targets)
    parts, labels = connected_components(pattern, directed=True, connection="strong")
    sources, targets = labels[graph.sources], labels[graph.targets]
    return bool(len(np.unique(targets[sources != targets])) == parts - 1)


def _strong_parts(graph: SparseDigraph) -> int:
    from scipy.sparse.csgraph import connected_components

    pattern = _pattern(graph.agents, graph.sources, graph.targets)
    return int(connected_components(pattern, directed=True, connection="strong", return_labels=False))


def _missed(agents: int, sources: NDArray[Any], targets: NDArray[Any]) -> NDArray[Any]:
    """The agents, in order, that no path from agent 0 reaches."""
    import numpy as np
    from scipy.sparse.csgraph import breadth_first_order

    reached = breadth_first_order(_pattern(agents, sources, targets), 0, return_predecessors=False)
    return np.setdiff1d(np.arange(agents), reached, assume_unique=True)


def _pattern(agents: int, sources: NDArray[Any], targets: NDArray[Any]) -> Any:
    import numpy as np
    from scipy.sparse import csr_array

    return csr_array((np.ones(len(sources), dtype=np.int8), (sources, targets)), shape=(agents, agents))


def _sums(graph: SparseDigraph, ends: NDArray[Any]) -> NDArray[Any]:
    import numpy as np

    weights = graph.weights
    largest = int(weights.max()) if len(weights) else 0
    small = largest * max(1, len(weights)) < MOST_SUM
    sums = np.zeros(graph.agents, dtype=np.int64 if small else object)
    np.add.at(sums, ends, weights if small else weights.astype(object))
    return sums
