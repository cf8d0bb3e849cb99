"""Designs to measure on."""

import random
from fractions import Fraction
from typing import Any


def weighted_digraph(agents: int, cycles: int, seed: int) -> dict[str, object]:
    """A design on a balanced digraph: a sum of weighted random cycles through all agents."""
    source = random.Random(seed)
    weights: dict[tuple[int, int], Fraction] = {}
    for _ in range(cycles):
        order = source.sample(range(1, agents + 1), agents)
        weight = Fraction(source.randrange(1, 100), 10)
        for edge in zip(order, order[1:] + order[:1], strict=True):
            weights[edge] = weights.get(edge, Fraction(0)) + weight
    edges = [[*edge, str(weight)] for edge, weight in sorted(weights.items())]
    return {"alpha": "0.9", "gamma": "0.025", "h": "0.85", "graph": {"agents": agents, "edges": edges}}


def grid(rows: int) -> Any:
    """The graph of a grid of ``rows`` times ``rows + 1`` agents, as arrays: its eigenvalues are simple."""
    from fomas_verify.network.sparse_families import sparse_family

    return sparse_family("grid", shape=(rows, rows + 1))


def grid_laplacian(rows: int) -> Any:
    """Its Laplacian as a sparse matrix of floats."""
    import numpy as np
    from scipy import sparse

    graph = grid(rows)
    weights = graph.weights / graph.denominator
    matrix = sparse.csc_array((-weights, (graph.targets, graph.sources)), shape=(graph.agents, graph.agents))
    return (matrix + sparse.diags_array(np.bincount(graph.targets, weights=weights), format="csc")).tocsc()
