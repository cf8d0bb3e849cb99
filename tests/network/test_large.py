"""What is known of a large graph is what its edges say."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from fomas_verify.network import (
    Digraph,
    GraphError,
    degree_max,
    digraph,
    family,
    imbalances,
    is_symmetric,
    laplacian,
    unreachable_pair,
)
from fomas_verify.network.large import LargeGraph, edge_lines, graph_facts, large_family
from fomas_verify.network.quotients import image, quotients
from fomas_verify.network.sparse import sparse_digraph
from fomas_verify.network.sparse_facts import sparse_has_root

PLAIN = ("directed-cycle", "cycle", "path", "star", "complete", "hypercube")


def drawn(seed: int, agents: int = 7, largest: int = 9) -> Digraph:
    draw = random.Random(seed)
    ends = [(i, j) for i in range(1, agents + 1) for j in range(1, agents + 1) if i != j]
    chosen = draw.sample(ends, draw.randint(0, 2 * agents))
    return digraph(agents, [(i, j, Fraction(draw.randint(1, largest), draw.randint(1, 9))) for i, j in chosen])


def reached(graph: Digraph, start: int) -> set[int]:
    found, waiting = {start}, [start]
    while waiting:
        here = waiting.pop()
        new = {j for i, j, _ in graph.edges if i == here} - found
        found |= new
        waiting += new
    return found


@pytest.mark.parametrize("shape", [(1, 2), (1, 5), (2, 2), (4, 1), (3, 3), (3, 4), (5, 6)])
def test_what_is_known_of_a_lattice_without_its_edges(shape: tuple[int, int]) -> None:
    for name in ("grid", "torus") if min(shape) > 2 else ("grid",):
        assert_known(large_family(name, shape=shape), family(name, shape=shape))


@pytest.mark.parametrize("agents", [2, 3, 4, 5, 8, 16])
@pytest.mark.parametrize("name", PLAIN)
def test_what_is_known_of_a_family_without_its_edges(name: str, agents: int) -> None:
    if name == "hypercube" and agents & (agents - 1):
        with pytest.raises(GraphError, match="expected a power of 2"):
            large_family(name, agents=agents)
    else:
        assert_known(large_family(name, agents=agents), family(name, agents=agents))


def assert_known(large: LargeGraph, graph: Digraph) -> None:
    facts = graph_facts(large)
    assert (large.agents, large.edge_count) == (graph.agents, len(graph.edges))
    assert (facts.degree_max, facts.is_symmetric) == (degree_max(graph), is_symmetric(graph))
    assert facts.assumption1 is (unreachable_pair(graph) is None and not imbalances(graph)) is True
    assert large.digraph() == graph


@pytest.mark.parametrize("seed", range(60))
def test_the_facts_of_a_graph_given_by_its_edges(seed: int) -> None:
    graph = drawn(seed)
    facts = graph_facts(LargeGraph(listed=graph))
    assert facts.unreachable == unreachable_pair(graph)
    assert facts.imbalance == next(iter(imbalances(graph)), None)
    assert (facts.degree_max, facts.is_symmetric) == (degree_max(graph), is_symmetric(graph))
    roots = [i for i in range(1, 8) if len(reached(graph, i)) == 7]
    assert facts.has_root is bool(roots)
    assert sparse_has_root(sparse_digraph(graph)) is bool(roots)


@pytest.mark.parametrize("largest", [9, 10**6, 10**18, 10**40])
@pytest.mark.parametrize("entry", [5, 2**20, 2**62])
def test_quotients_against_fractions(largest: int, entry: int) -> None:
    """Below, at and beyond what 63 bits hold."""
    for seed in range(8):
        graph = drawn(seed, largest=largest)
        draw = random.Random(seed)
        columns = [[draw.randint(-entry, entry) for _ in range(7)] for _ in range(2)]
        rows = laplacian(graph)
        moved = [[sum(a * x for a, x in zip(row, column, strict=True)) for row in rows] for column in columns]
        square = sum(x * x for column in columns for x in column)
        form = sum(x * y for pair in zip(columns, moved, strict=True) for x, y in zip(*pair, strict=True))
        stretch = sum(y * y for column in moved for y in column)
        sparse = sparse_digraph(graph)
        assert quotients(sparse, columns) == (Fraction(form) / square, Fraction(stretch) / square)
        assert [Fraction(y, sparse.denominator) for y in image(sparse, columns[0])] == moved[0]


def test_the_edge_list_is_canonical() -> None:
    graph = drawn(3)
    lines = [f"{i} {j} {w}\n" for i, j, w in sorted(graph.edges)]
    assert b"".join(edge_lines(sparse_digraph(graph))).decode() == "".join(lines)
    assert LargeGraph(listed=graph).edge_list.decode() == "".join(lines)
    many = large_family("cycle", agents=70_000)
    assert many.edge_list.count(b"\n") == 140_000
    assert many.edge_list.startswith(b"1 2 1\n1 70000 1\n2 1 1\n")


def test_a_family_with_another_weight_is_not_known_by_its_name() -> None:
    doubled = digraph(6, [(i, j, 2 * w) for i, j, w in family("cycle", agents=6).edges])
    assert LargeGraph(listed=doubled).known_family is None
    assert LargeGraph(listed=family("cycle", agents=6)).known_family == large_family("cycle", agents=6).family


def test_a_graph_is_a_familys_or_has_edges() -> None:
    with pytest.raises(TypeError, match="a family's or has edges"):
        _ = LargeGraph().agents
