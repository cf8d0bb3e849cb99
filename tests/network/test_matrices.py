"""Matrices, degrees and balance; the orientation by a trajectory that a transposed graph would change."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.network import (
    Digraph,
    GraphError,
    Imbalance,
    adjacency,
    degree_max,
    digraph,
    imbalances,
    in_degrees,
    is_symmetric,
    laplacian,
    out_degrees,
)

# The paper's matrix: row i lists the agents that agent i hears.
A = [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]
PAPER = digraph(5, ((j + 1, i + 1, Fraction(1)) for i in range(5) for j in range(5) if A[i][j]))


@st.composite
def digraphs(draw: st.DrawFn) -> Digraph:
    agents = draw(st.integers(2, 6))
    pairs = st.tuples(st.integers(1, agents), st.integers(1, agents)).filter(lambda pair: pair[0] != pair[1])
    weights = st.fractions(min_value=Fraction(1, 9), max_value=9, max_denominator=9)
    return digraph(agents, ((*ends, w) for ends, w in draw(st.dictionaries(pairs, weights)).items()))


def dense(graph: Digraph) -> list[list[Fraction]]:
    """A entry by entry from its definition."""
    weights = {(target, source): weight for source, target, weight in graph.edges}
    agents = range(1, graph.agents + 1)
    return [[weights.get((i, j), Fraction(0)) for j in agents] for i in agents]


def test_the_paper_graph() -> None:
    assert [list(row) for row in adjacency(PAPER)] == A
    assert laplacian(PAPER) == (
        (2, 0, 0, -1, -1),
        (-1, 2, -1, 0, 0),
        (-1, -1, 2, 0, 0),
        (0, -1, -1, 2, 0),
        (0, 0, 0, -1, 1),
    )
    assert in_degrees(PAPER) == out_degrees(PAPER) == (2, 2, 2, 2, 1)
    assert degree_max(PAPER) == 2
    assert imbalances(PAPER) == ()
    assert not is_symmetric(PAPER)


def test_one_step_moves_each_agent_towards_those_it_hears() -> None:
    mu, x0 = Fraction(1, 4), [Fraction(9, 2), Fraction(5), Fraction(6), Fraction(3, 2), Fraction(-1)]
    speeds = [sum(entry * x for entry, x in zip(row, x0, strict=True)) for row in laplacian(PAPER)]
    step = [x - mu * speed for x, speed in zip(x0, speeds, strict=True)]
    # Agent 1 hears 4 and 5: 9/2 + (3/2 - 9/2 - 1 - 9/2)/4; agent 5 hears 4: -1 + (3/2 + 1)/4.
    assert (step[0], step[4]) == (Fraction(19, 8), Fraction(-3, 8))
    hears, x = np.array(A, dtype=float), np.array([4.5, 5, 6, 1.5, -1])
    assert [float(entry) for entry in step] == list(x + 0.25 * (hears @ x - hears.sum(1) * x))
    assert [float(entry) for entry in step] != list(x + 0.25 * (hears.T @ x - hears.sum(0) * x))


@given(digraphs())
def test_laplacian_from_the_definition(graph: Digraph) -> None:
    a = dense(graph)
    assert [list(row) for row in adjacency(graph)] == a
    n = range(graph.agents)
    assert [list(row) for row in laplacian(graph)] == [[(sum(a[i]) if i == j else 0) - a[i][j] for j in n] for i in n]
    assert all(sum(row) == 0 for row in laplacian(graph))


@given(digraphs())
def test_balanced_iff_the_columns_of_the_laplacian_sum_to_zero(graph: Digraph) -> None:
    a = dense(graph)
    columns = [sum(column) for column in zip(*laplacian(graph), strict=True)]
    assert [x.agent for x in imbalances(graph)] == [i + 1 for i, total in enumerate(columns) if total]
    for found in imbalances(graph):
        i = found.agent - 1
        assert found == Imbalance(i + 1, in_=sum(a[i], Fraction(0)), out=sum((row[i] for row in a), Fraction(0)))


@given(digraphs())
def test_degrees_and_symmetry(graph: Digraph) -> None:
    a = np.array(dense(graph), dtype=object)
    assert list(in_degrees(graph)) == list(a.sum(axis=1))
    assert list(out_degrees(graph)) == list(a.sum(axis=0))
    assert degree_max(graph) == max(a.sum(axis=1))
    assert is_symmetric(graph) == bool((a == a.T).all())


@given(digraphs())
def test_both_ways_is_symmetric(graph: Digraph) -> None:
    both = {(min(e[:2]), max(e[:2])): e[2] for e in graph.edges}
    assert is_symmetric(digraph(graph.agents, (e for (i, j), w in both.items() for e in ((i, j, w), (j, i, w)))))


def test_which_agents_break_the_balance_and_by_how_much() -> None:
    graph = digraph(3, [(1, 2, Fraction(1)), (2, 3, Fraction(1, 2)), (3, 1, Fraction(1))])
    assert imbalances(graph) == (Imbalance(2, Fraction(1), Fraction(1, 2)), Imbalance(3, Fraction(1, 2), Fraction(1)))


@pytest.mark.parametrize(
    ("agents", "edges", "reason"),
    [
        (1, [], "expected at least 2 agents, got 1"),
        (2, [(1, 3, 1)], "expected agents between 1 and 2, got the edge from 1 to 3"),
        (2, [(0, 1, 1)], "expected agents between 1 and 2, got the edge from 0 to 1"),
        (2, [(2, 2, 1)], "expected no self-loop, got one at agent 2"),
        (2, [(1, 2, 0)], "expected positive weights, got 0 on the edge from 1 to 2"),
        (2, [(1, 2, Fraction(-1, 2))], "expected positive weights, got -1/2 on the edge from 1 to 2"),
        (2, [(1, 2, 1), (1, 2, 2)], "expected edges sorted and each once, got (1, 2) before (1, 2)"),
        (2, [(2, 1, 1), (1, 2, 1)], "expected edges sorted and each once, got (2, 1) before (1, 2)"),
    ],
)
def test_no_digraph(agents: int, edges: list[tuple[int, int, Fraction]], reason: str) -> None:
    with pytest.raises(GraphError) as caught:
        Digraph(agents, tuple((i, j, Fraction(w)) for i, j, w in edges))
    assert str(caught.value) == reason
