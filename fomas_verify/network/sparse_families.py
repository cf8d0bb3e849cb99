"""Families of graphs by name, as arrays: the graphs of `families`, a million agents in about a second.

Source: as `families`.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fomas_verify.network.digraph import GraphError
from fomas_verify.network.families import FAMILIES, Shape, checked_size
from fomas_verify.network.family_facts import Family
from fomas_verify.network.sparse import SparseDigraph

if TYPE_CHECKING:
    from numpy.typing import NDArray


def sparse_family(name: str, *, agents: int | None = None, shape: Shape | None = None) -> SparseDigraph:
    """Build the graph of a family as arrays; the same graph, of any size, and `GraphError` as `families.family`."""
    size = checked_size(name, agents, shape)
    return _FAMILIES[name](size) if isinstance(size, int) else _SHAPED[name](size)


def recognised_family(graph: SparseDigraph) -> Family | None:
    """The family whose graph this is, agents numbered as `families` numbers them; None where it is none.

    Exact: the graph is compared with the family's, edge by edge.
    """
    if len(graph.weights) == 0 or (graph.weights != graph.weights[0]).any():
        return None
    for name, sizes in _candidates(graph):
        try:
            shaped = len(sizes) == 2
            other = sparse_family(name, shape=(sizes[0], sizes[1])) if shaped else sparse_family(name, agents=sizes[0])
        except GraphError:
            continue
        if _same_edges(graph, other):
            return Family(name, sizes, Fraction(int(graph.weights[0]), graph.denominator))
    return None


def _candidates(graph: SparseDigraph) -> list[tuple[str, tuple[int, ...]]]:
    """The families that have this many edges; the columns of a shape are read off the first agent's neighbours."""
    agents, edges = graph.agents, len(graph.sources)
    found: list[tuple[str, tuple[int, ...]]] = [
        (name, (agents,)) for name in FAMILIES if Family(name, (agents,)).edges == edges
    ]
    first = graph.targets[: 5 if edges > 4 else edges][graph.sources[: 5 if edges > 4 else edges] == 0].tolist()
    if len(first) == 4 and edges == 4 * agents:
        found.append(("torus", (agents // first[2], first[2])))
    if len(first) == 2:
        found.append(("grid", (agents // first[1], first[1])))
    return [(name, sizes) for name, sizes in found if len(sizes) == 1 or sizes[0] * sizes[1] == agents]


def _same_edges(one: SparseDigraph, two: SparseDigraph) -> bool:
    import numpy as np

    return bool(np.array_equal(one.sources, two.sources) and np.array_equal(one.targets, two.targets))


def _directed_cycle(agents: int) -> SparseDigraph:
    import numpy as np

    here = np.arange(agents, dtype=np.int64)
    return _graph(agents, here, (here + 1) % agents)


def _cycle(agents: int) -> SparseDigraph:
    import numpy as np

    here = np.arange(agents, dtype=np.int64)
    return _both_ways(agents, [(here, (here + 1) % agents)], repeats=agents == 2)


def _path(agents: int) -> SparseDigraph:
    import numpy as np

    here = np.arange(agents - 1, dtype=np.int64)
    return _both_ways(agents, [(here, here + 1)])


def _star(agents: int) -> SparseDigraph:
    import numpy as np

    leaves = np.arange(1, agents, dtype=np.int64)
    return _both_ways(agents, [(np.zeros_like(leaves), leaves)])


def _complete(agents: int) -> SparseDigraph:
    import numpy as np

    sources = np.repeat(np.arange(agents, dtype=np.int64), agents - 1)
    place = np.tile(np.arange(agents - 1, dtype=np.int64), agents)
    return _graph(agents, sources, place + (place >= sources))


def _hypercube(agents: int) -> SparseDigraph:
    import numpy as np

    here = np.arange(agents, dtype=np.int64)
    bits = [1 << d for d in range(agents.bit_length() - 1)]
    return _graph(agents, np.concatenate([here] * len(bits)), np.concatenate([here ^ bit for bit in bits]))


def _grid(shape: Shape) -> SparseDigraph:
    import numpy as np

    rows, columns = shape
    here = np.arange(rows * columns, dtype=np.int64).reshape(rows, columns)
    pairs = [(here[:, :-1], here[:, 1:]), (here[:-1], here[1:])]
    return _both_ways(rows * columns, [(one.ravel(), two.ravel()) for one, two in pairs])


def _torus(shape: Shape) -> SparseDigraph:
    import numpy as np

    rows, columns = shape
    here = np.arange(rows * columns, dtype=np.int64).reshape(rows, columns)
    beside = [np.roll(here, -1, axis) for axis in (0, 1)]
    return _both_ways(rows * columns, [(here.ravel(), other.ravel()) for other in beside])


def _both_ways(agents: int, pairs: list[tuple[NDArray[Any], NDArray[Any]]], *, repeats: bool = False) -> SparseDigraph:
    """Join the ends in both directions; `repeats` where a pair may be named twice."""
    import numpy as np

    sources = np.concatenate([end for one, two in pairs for end in (one, two)])
    targets = np.concatenate([end for one, two in pairs for end in (two, one)])
    if repeats:
        ends = np.unique(np.stack([sources, targets]), axis=1)
        sources, targets = ends[0], ends[1]
    return _graph(agents, sources, targets)


def _graph(agents: int, sources: NDArray[Any], targets: NDArray[Any]) -> SparseDigraph:
    """The graph of these edges, sorted by one key: agents^2 stays below 2^63 as long as arrays fit into memory."""
    import numpy as np

    order = np.argsort(sources * agents + targets, kind="stable")
    weights = np.ones(len(order), dtype=np.int64)
    return SparseDigraph(agents, sources[order], targets[order], weights, 1)


_FAMILIES: dict[str, Callable[[int], SparseDigraph]] = {
    "directed-cycle": _directed_cycle,
    "cycle": _cycle,
    "path": _path,
    "star": _star,
    "complete": _complete,
    "hypercube": _hypercube,
}
_SHAPED: dict[str, Callable[[Shape], SparseDigraph]] = {"torus": _torus, "grid": _grid}
