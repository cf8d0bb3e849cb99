"""Matrices and degrees of a digraph, exact.

Notation: `A = [a_ij]`, agent i hears agent j; `L = diag(A 1) - A`. Rows and columns 0..N-1 stand for agents 1..N.
Source: the paper's section on graphs; docs/certificate-format.md, section 2.
"""

from fractions import Fraction

from fomas_verify.network.digraph import Digraph

Matrix = tuple[tuple[Fraction, ...], ...]

_ZERO = Fraction(0)


def adjacency(graph: Digraph) -> Matrix:
    """Return A, N x N: entry (i, j) is the weight with which agent i+1 hears agent j+1, or 0. Exact."""
    return _frozen(_adjacency_rows(graph))


def laplacian(graph: Digraph) -> Matrix:
    """Return L = diag(A 1) - A, N x N; each row sums to 0. Exact."""
    rows = [[-entry if entry else entry for entry in row] for row in _adjacency_rows(graph)]
    for i, degree in enumerate(in_degrees(graph)):
        rows[i][i] = degree
    return _frozen(rows)


def in_degrees(graph: Digraph) -> tuple[Fraction, ...]:
    """Return the row sums of A: how much each agent hears. Exact."""
    sums = [_ZERO] * graph.agents
    for _, target, weight in graph.edges:
        sums[target - 1] += weight
    return tuple(sums)


def out_degrees(graph: Digraph) -> tuple[Fraction, ...]:
    """Return the column sums of A: how much each agent is heard. Exact."""
    sums = [_ZERO] * graph.agents
    for source, _, weight in graph.edges:
        sums[source - 1] += weight
    return tuple(sums)


def degree_max(graph: Digraph) -> Fraction:
    """Return D = max_i (A 1)_i, the paper's Delta_max; 0 for a graph without edges. Exact."""
    return max(in_degrees(graph))


def is_symmetric(graph: Digraph) -> bool:
    """Say whether A = A^T, that is, every edge has its reverse with the same weight. Exact."""
    weights = {(source, target): weight for source, target, weight in graph.edges}
    return all(weights.get((target, source)) == weight for (source, target), weight in weights.items())


def _adjacency_rows(graph: Digraph) -> list[list[Fraction]]:
    rows = [[_ZERO] * graph.agents for _ in range(graph.agents)]
    for source, target, weight in graph.edges:
        rows[target - 1][source - 1] = weight
    return rows


def _frozen(rows: list[list[Fraction]]) -> Matrix:
    return tuple(tuple(row) for row in rows)
