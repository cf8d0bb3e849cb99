"""What arrays say of a digraph is what its edges say."""

import random
from fractions import Fraction

import pytest

from fomas_verify.network import (
    GraphError,
    degree_max,
    digraph,
    family,
    imbalances,
    in_degrees,
    is_symmetric,
    out_degrees,
    unreachable_pair,
)
from fomas_verify.network.sparse import SparseDigraph, sparse_digraph
from fomas_verify.network.sparse_facts import (
    sparse_degree_max,
    sparse_imbalance,
    sparse_in_sums,
    sparse_is_symmetric,
    sparse_out_sums,
    sparse_unreachable_pair,
)
from fomas_verify.network.sparse_families import Family, recognised_family, sparse_family

SIZES = [2, 3, 4, 5, 8, 16]
SHAPES = [(3, 3), (3, 5), (5, 3), (4, 4), (2, 3), (1, 2), (2, 1), (1, 5), (5, 1), (2, 2)]


def same(one: SparseDigraph, two: SparseDigraph) -> bool:
    return one.to_digraph() == two.to_digraph() and one.denominator == two.denominator


@pytest.mark.parametrize("name", ["directed-cycle", "cycle", "path", "star", "complete", "hypercube"])
@pytest.mark.parametrize("agents", SIZES)
def test_a_family_as_arrays_is_that_family(name, agents) -> None:
    if name == "hypercube" and agents in (3, 5):
        with pytest.raises(GraphError, match="expected a power of 2"):
            sparse_family(name, agents=agents)
        return
    assert same(sparse_family(name, agents=agents), sparse_digraph(family(name, agents=agents)))


@pytest.mark.parametrize("shape", SHAPES)
def test_a_grid_and_a_torus_as_arrays(shape) -> None:
    assert same(sparse_family("grid", shape=shape), sparse_digraph(family("grid", shape=shape)))
    if min(shape) >= 3:
        assert same(sparse_family("torus", shape=shape), sparse_digraph(family("torus", shape=shape)))


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("torus", {"shape": (2, 3)}),
        ("grid", {"shape": (1, 1)}),
        ("grid", {"agents": 4}),
        ("cycle", {"agents": 1}),
        ("cycle", {"shape": (2, 2)}),
        ("wheel", {"agents": 4}),
    ],
)
def test_refusals_are_those_of_the_families(name, options) -> None:
    with pytest.raises(GraphError) as small:
        family(name, **options)
    with pytest.raises(GraphError) as large:
        sparse_family(name, **options)
    assert str(large.value) == str(small.value)


@pytest.mark.parametrize(
    ("name", "options"),
    [(n, {"agents": 9}) for n in ("directed-cycle", "cycle", "path", "star", "complete")]
    + [("hypercube", {"agents": 16}), ("torus", {"shape": (3, 4)}), ("torus", {"shape": (5, 3)})]
    + [("grid", {"shape": (3, 4)}), ("grid", {"shape": (4, 2)})],
)
def test_a_family_is_recognised_with_its_weight(name, options) -> None:
    plain = sparse_family(name, **options)
    graph = SparseDigraph(plain.agents, plain.sources, plain.targets, 3 * plain.weights, 7)
    sizes = options.get("shape") or (options["agents"],)
    assert recognised_family(graph) == Family(name, tuple(sizes), Fraction(3, 7))


def test_what_is_no_family_is_not_recognised() -> None:
    one = digraph(4, [(1, 2, Fraction(1)), (2, 3, Fraction(1)), (3, 4, Fraction(1)), (4, 1, Fraction(2))])
    swapped = digraph(4, [(i, j, Fraction(1)) for i, j in [(1, 3), (3, 2), (2, 4), (4, 1)]])
    empty = digraph(3, [])
    assert [recognised_family(sparse_digraph(g)) for g in (one, swapped, empty)] == [None, None, None]


@pytest.mark.parametrize("seed", range(60))
def test_facts_are_those_of_the_edges(seed) -> None:
    rng = random.Random(seed)
    agents = rng.randint(2, 9)
    pairs = [(i, j) for i in range(1, agents + 1) for j in range(1, agents + 1) if i != j]
    kept = [pair for pair in pairs if rng.random() < rng.choice([0.15, 0.4])]
    if seed % 3 == 0:
        kept = sorted({end for i, j in kept for end in ((i, j), (j, i))})
    weights = [Fraction(1), Fraction(2, 3)] if seed % 2 else [Fraction(2**61 + seed, 5), Fraction(1, 7)]
    edges = [(i, j, weights[(min(i, j) + max(i, j)) % 2]) for i, j in kept]
    graph = digraph(agents, edges)
    arrays = sparse_digraph(graph)
    d = arrays.denominator
    assert [Fraction(int(x), d) for x in sparse_in_sums(arrays)] == list(in_degrees(graph))
    assert [Fraction(int(x), d) for x in sparse_out_sums(arrays)] == list(out_degrees(graph))
    assert sparse_degree_max(arrays) == degree_max(graph)
    assert sparse_imbalance(arrays) == next(iter(imbalances(graph)), None)
    assert sparse_is_symmetric(arrays) == is_symmetric(graph)
    assert sparse_unreachable_pair(arrays) == unreachable_pair(graph)


def test_sums_beyond_63_bits_are_exact() -> None:
    heavy = [(i, 3, Fraction(2**62 + 1)) for i in (1, 2)]
    graph = sparse_digraph(digraph(3, [*heavy, (3, 1, Fraction(2**63 + 2))]))
    assert list(sparse_in_sums(graph)) == [2**63 + 2, 0, 2**63 + 2]
    assert sparse_imbalance(graph).agent == 1
