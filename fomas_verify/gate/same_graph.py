"""Whether the graph of a certificate is the one meant."""

from __future__ import annotations

from hashlib import sha256
from typing import TYPE_CHECKING

from fomas_verify.checker.large_form import EdgeFile
from fomas_verify.network import Digraph
from fomas_verify.network.family_facts import Family
from fomas_verify.network.large import LargeGraph

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fomas_verify.checker.designs import Edge
    from fomas_verify.checker.large_form import LargeDesign


def is_graph_of(named: LargeDesign, graph: Digraph | LargeGraph) -> bool:
    """Whether a large certificate's graph is this one: by the digest of its edge list, by the family's name, or edge by
    edge.
    """
    if isinstance(named.graph, EdgeFile):
        return named.graph.sha256 == _digest(graph)
    if isinstance(graph, LargeGraph):
        return _is_family(Family(named.graph.name, named.graph.shape or (named.agents,)), graph)
    if (named.agents, named.graph.edge_count) != (graph.agents, len(graph.edges)):
        return False
    pairs = {(source + 1, target + 1) for source, target in named.graph.pairs()}
    return all(weight == 1 and (source, target) in pairs for source, target, weight in graph.edges)


def are_edges_of(edges: Sequence[Edge], agents: int, graph: Digraph | LargeGraph) -> bool:
    """Whether these are the edges of a graph on so many agents."""
    if isinstance(graph, LargeGraph):
        if (agents, len(edges)) != (graph.agents, graph.edge_count):
            return False
        graph = graph.digraph()
    return sorted(edges) == sorted(graph.edges)


def _is_family(family: Family, graph: LargeGraph) -> bool:
    if (family.agents, family.edges) != (graph.agents, graph.edge_count):
        return False
    if graph.family == family:
        return True
    import numpy as np

    ours, theirs = graph.sparse, LargeGraph(family).sparse
    same = np.array_equal(ours.sources, theirs.sources) and np.array_equal(ours.targets, theirs.targets)
    return bool(same and ours.denominator == 1 and (ours.weights == 1).all())


def _digest(graph: Digraph | LargeGraph) -> str:
    """That of the canonical edge list."""
    if isinstance(graph, Digraph):
        return sha256("".join(f"{i} {j} {w}\n" for i, j, w in sorted(graph.edges)).encode()).hexdigest()
    return graph.digest
