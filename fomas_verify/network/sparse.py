"""A digraph as arrays, for files and networks too large for one Python object an edge.

Notation as in `digraph`, but rows and columns 0..N-1 stand for agents 1..N. Source: the paper's connectivity matrix A.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import TYPE_CHECKING, Any

from fomas_verify.network.digraph import Digraph, digraph

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class SparseDigraph:
    """A digraph on agents 0..N-1, positive rational weights over one denominator; whoever builds it has tested that.

    Attributes
    ----------
    agents : int
        N >= 2.
    sources, targets : arrays of int64, shape (M,)
        Agent `targets[e]` hears agent `sources[e]`; sorted by (source, target), no self-loop, no pair twice.
    weights : array of int64, or of Python's int where one needs more than 63 bits, shape (M,)
        `a_(targets[e], sources[e]) = weights[e] / denominator`, exact.
    denominator : int
        The weights' common denominator, > 0, in lowest terms.
    """

    agents: int
    sources: NDArray[Any]
    targets: NDArray[Any]
    weights: NDArray[Any]
    denominator: int

    def to_digraph(self) -> Digraph:
        """The same digraph with one Python object an edge."""
        weights = {w: Fraction(w, self.denominator) for w in set(self.weights.tolist())}
        ends = zip(self.sources.tolist(), self.targets.tolist(), self.weights.tolist(), strict=True)
        return digraph(self.agents, ((i + 1, j + 1, weights[w]) for i, j, w in ends))


def sparse_digraph(graph: Digraph) -> SparseDigraph:
    """The same digraph as arrays."""
    import numpy as np

    denominator = lcm(*{weight.denominator for _, _, weight in graph.edges})
    weights = [int(weight * denominator) for _, _, weight in graph.edges]
    ends = np.array([edge[:2] for edge in graph.edges], dtype=np.int64).reshape(-1, 2) - 1
    fits = all(weight.bit_length() < 64 for weight in weights)
    kept = np.array(weights, dtype=np.int64 if fits else object)
    return SparseDigraph(graph.agents, ends[:, 0].copy(), ends[:, 1].copy(), kept, denominator)
