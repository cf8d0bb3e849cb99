"""Bounds of large networks against exact arithmetic: never beyond the truth, near it, and fit to be redone."""

import random
import subprocess
import sys
from fractions import Fraction
from math import cos, pi
from types import SimpleNamespace

import pytest

from fomas_verify.network import digraph
from fomas_verify.network.sparse import SparseDigraph, sparse_digraph
from fomas_verify.network.sparse_families import sparse_family
from fomas_verify.numeric import Redo
from fomas_verify.spectrum.large import LargeBounds, large_bounds
from tests.spectrum.large.exact_counts import (
    Edges,
    Rows,
    gram,
    laplacian,
    negative_eigenvalues,
    quotient,
    random_network,
    shifted,
    symmetric_part,
)

MEMORY = 1 << 30


def graph_of(n: int, edges: Edges) -> SparseDigraph:
    return sparse_digraph(digraph(n, [(i, j, w) for (i, j), w in edges.items()]))


def given_to_the_checker(graph: SparseDigraph) -> SimpleNamespace:
    return SimpleNamespace(
        agents=graph.agents,
        sources=graph.sources.tolist(),
        targets=graph.targets.tolist(),
        weights=graph.weights.tolist(),
        denominator=graph.denominator,
    )


def assert_vectors_fit(found: LargeBounds, n: int) -> None:
    assert 1 <= len(found.vectors) <= 8
    for vector in found.vectors:
        assert len(vector) == n
        assert sum(vector) == 0
        assert any(vector)
        assert max(map(abs, vector)) <= 1 << 62
        assert all(type(x) is int for x in vector)


def assert_true(found: LargeBounds, rows: Rows, mu: tuple[Fraction, Fraction]) -> None:
    """No bound is beyond the exact value; a matrix shifted by a bound has the signs that this means."""
    part = symmetric_part(rows)
    if found.lambda2_lower is not None:
        assert found.lambda2_lower > 0
        assert negative_eigenvalues(shifted(part, 1, -found.lambda2_lower)) == 1
    if found.lambda_max_upper is not None:
        assert negative_eigenvalues(shifted(part, -1, found.lambda_max_upper)) == 0
    if found.sigma_upper is not None:
        assert 0 < found.sigma_upper < 1
        for end in mu:
            assert negative_eigenvalues(shifted(gram(rows, end), -1, found.sigma_upper**2)) == 1


@pytest.mark.parametrize("seed", range(120))
def test_bounds_are_true_and_near(seed: int) -> None:
    rng = random.Random(seed)
    n, symmetric = rng.randint(2, 14 if seed % 6 else 40), seed % 3 == 0
    edges = random_network(rng, n, symmetric=symmetric)
    rows = laplacian(n, edges)
    degree = max(rows[i][i] for i in range(n))
    mu = Fraction(rng.randint(1, 99), 100) / degree
    ends = (mu, mu * (1 + Fraction(1, 10**15)))
    found = large_bounds(graph_of(n, edges), ends, memory=MEMORY)
    assert found.reason is None
    assert_vectors_fit(found, n)
    assert_true(found, rows, ends)
    assert found.lambda2_lower is not None
    value = quotient(symmetric_part(rows), found.vectors[0])
    assert found.lambda2_lower < value
    assert value - found.lambda2_lower < value / 10**6
    if all(edges.get((j, i)) == w for (i, j), w in edges.items()):
        assert found.sigma_upper is None
        assert len(found.vectors) == 1 or mu * (2 * degree + value) > 2
    else:
        assert found.lambda_max_upper is None
        # 1 - sigma^2 is known as well as lambda2, so sigma is: its vector says how near.
        assert found.sigma_upper is not None
        reached = quotient(gram(rows, mu), found.vectors[1])
        assert 0 <= found.sigma_upper**2 - reached < (1 - reached) / 10**6 + Fraction(1, 10**11)


def test_the_largest_eigenvalue_is_bounded_where_it_matters() -> None:
    # A triangle with a tail: lambda_max is clearly below 2 D, and mu above what 2 D would allow.
    edges = {ends: Fraction(1) for i, j in [(1, 2), (2, 3), (3, 1), (3, 4), (4, 5)] for ends in ((i, j), (j, i))}
    rows = laplacian(5, edges)
    small = large_bounds(graph_of(5, edges), (Fraction(1, 4),) * 2, memory=MEMORY)
    assert small.lambda_max_upper is None
    large = large_bounds(graph_of(5, edges), (Fraction(2, 5),) * 2, memory=MEMORY)
    assert large.lambda_max_upper is not None
    assert_true(large, rows, (Fraction(2, 5),) * 2)
    value = quotient(rows, large.vectors[1])
    assert 0 < large.lambda_max_upper - value < value / 10**6


@pytest.mark.parametrize("seed", range(40))
def test_what_is_bounded_can_be_redone(seed: int) -> None:
    rng = random.Random(seed)
    n, symmetric = rng.randint(20, 60), seed % 2 == 0
    edges = random_network(rng, n, symmetric=symmetric)
    edges[1, 2] = edges.get((1, 2), Fraction(0)) + Fraction(1, 3)
    edges[2, 1] = edges.get((2, 1), Fraction(0)) + Fraction(1, 3)
    graph, redo = graph_of(n, edges), Redo(MEMORY)
    network = given_to_the_checker(graph)
    degree = max(sum(w for (_, j), w in edges.items() if j == i) for i in range(1, n + 1))
    mu = (Fraction(9, 10) / degree,) * 2
    found = large_bounds(graph, mu, memory=MEMORY)
    assert found.lambda2_lower is not None
    assert redo.lambda2_at_least(network, found.lambda2_lower) is True
    if symmetric:
        assert found.lambda_max_upper is None or redo.lambda_max_at_most(network, found.lambda_max_upper) is True
    else:
        assert found.sigma_upper is not None
        assert redo.sigma_at_most(network, mu, found.sigma_upper) is True


@pytest.mark.parametrize("exponent", [3, 6, 9, 12, 15, 18])
def test_two_groups_nearly_apart(exponent: int) -> None:
    """lambda2 of two complete graphs of 4, joined by one edge of weight w, is nearly w/2."""
    weak = Fraction(1, 10**exponent)
    pairs = [(i + 4 * half, j + 4 * half, Fraction(1)) for half in (0, 1) for i in range(1, 5) for j in range(1, i)]
    edges = {ends: w for i, j, w in [*pairs, (1, 5, weak)] for ends in ((i, j), (j, i))}
    found = large_bounds(graph_of(8, edges), (Fraction(1, 8),) * 2, memory=MEMORY)
    rows = laplacian(8, edges)
    assert_true(found, rows, (Fraction(1, 8),) * 2)
    if exponent <= 9:
        assert found.lambda2_lower is not None
        assert Redo(MEMORY).lambda2_at_least(given_to_the_checker(graph_of(8, edges)), found.lambda2_lower) is True
    else:
        # The vector still shows how small lambda2 is.
        assert quotient(rows, found.vectors[0]) < weak
    if exponent >= 15:
        assert found.lambda2_lower is None
        assert found.reason is not None
        assert "too small" in found.reason


@pytest.mark.parametrize("seed", range(40))
def test_weights_over_twelve_orders_of_magnitude(seed: int) -> None:
    rng = random.Random(seed)
    n = rng.randint(3, 12)
    edges = random_network(rng, n, symmetric=seed % 2 == 0, spread=12)
    rows = laplacian(n, edges)
    mu = (Fraction(9, 10) / max(rows[i][i] for i in range(n)),) * 2
    found = large_bounds(graph_of(n, edges), mu, memory=MEMORY)
    assert_true(found, rows, mu)
    assert found.lambda2_lower is not None or found.reason is not None


@pytest.mark.parametrize(
    ("name", "size", "lambda2"),
    [
        ("complete", {"agents": 30}, 30),
        ("star", {"agents": 30}, 1),
        ("hypercube", {"agents": 256}, 2),
        ("torus", {"shape": (4, 4)}, 2),
        ("torus", {"shape": (6, 60)}, Fraction(2 - 2 * cos(2 * pi / 60))),
        ("cycle", {"agents": 6}, 1),
        ("cycle", {"agents": 300}, Fraction(2 - 2 * cos(2 * pi / 300))),
        ("path", {"agents": 2}, 2),
        ("grid", {"shape": (30, 31)}, Fraction(2 - 2 * cos(pi / 31))),
        ("grid", {"shape": (3, 300)}, Fraction(2 - 2 * cos(pi / 300))),
        ("directed-cycle", {"agents": 6}, Fraction(1, 2)),
    ],
)
def test_families_whose_eigenvalues_are_known_and_often_repeat(name: str, size: dict, lambda2: Fraction | int) -> None:
    graph = sparse_family(name, **size)
    found = large_bounds(graph, (Fraction(1, 1000),) * 2, memory=MEMORY)
    assert_vectors_fit(found, graph.agents)
    assert found.lambda2_lower is not None
    assert 0 < lambda2 - found.lambda2_lower < Fraction(lambda2, 10**4)


def test_weights_beyond_doubles_are_left_alone_with_a_reason() -> None:
    edges = {(1, 2): Fraction(10**200), (2, 1): Fraction(10**200), (2, 3): Fraction(1), (3, 2): Fraction(1)}
    found = large_bounds(graph_of(3, edges), (Fraction(1, 10**201),) * 2, memory=MEMORY)
    assert found == LargeBounds((), None, None, None, found.reason)
    assert found.reason is not None
    assert "doubles" in found.reason


def test_weights_beyond_63_bits_are_rounded_and_the_bounds_stay_true() -> None:
    rng = random.Random(7)
    edges = {ends: w * (2**80 + 1) / 3 for ends, w in random_network(rng, 9, symmetric=False).items()}
    rows = laplacian(9, edges)
    mu = (Fraction(1, 2) / max(rows[i][i] for i in range(9)),) * 2
    found = large_bounds(graph_of(9, edges), mu, memory=MEMORY)
    assert found.lambda2_lower is not None
    assert found.sigma_upper is not None
    assert_true(found, rows, mu)


def test_sigma_is_bounded_over_the_whole_enclosure_of_mu() -> None:
    edges = random_network(random.Random(3), 12, symmetric=False)
    rows = laplacian(12, edges)
    mu = Fraction(1, 3) / max(rows[i][i] for i in range(12))
    narrow = large_bounds(graph_of(12, edges), (mu, mu), memory=MEMORY)
    ends = (mu * Fraction(99, 100), mu * Fraction(101, 100))
    wide = large_bounds(graph_of(12, edges), ends, memory=MEMORY)
    assert narrow.sigma_upper is not None
    assert wide.sigma_upper is None or wide.sigma_upper > narrow.sigma_upper
    assert_true(wide, rows, ends)


def test_a_gain_that_makes_sigma_grow_is_shown_by_a_vector() -> None:
    edges = random_network(random.Random(5), 150, symmetric=False)
    rows = laplacian(150, edges)
    mu = 3 / max(rows[i][i] for i in range(150))
    found = large_bounds(graph_of(150, edges), (mu, mu), memory=MEMORY)
    assert found.sigma_upper is None
    p = [mu * sum(a * x for a, x in zip(row, found.vectors[1], strict=True)) for row in rows]
    after = [x - y for x, y in zip(found.vectors[1], p, strict=True)]
    assert sum(x * x for x in after) > sum(x * x for x in found.vectors[1])


def test_no_memory_is_a_reason_and_not_a_factor() -> None:
    rng = random.Random(1)
    edges = random_network(rng, 400, symmetric=False)
    found = large_bounds(graph_of(400, edges), (Fraction(1, 100),) * 2, memory=1000)
    assert (found.lambda2_lower, found.lambda_max_upper, found.sigma_upper) == (None, None, None)
    assert found.reason is not None
    assert "GB" in found.reason
    assert_vectors_fit(found, 400)


def test_the_same_call_gives_the_same_answer() -> None:
    graph = graph_of(200, random_network(random.Random(2), 200, symmetric=False))
    mu = (Fraction(1, 100),) * 2
    assert large_bounds(graph, mu, memory=MEMORY) == large_bounds(graph, mu, memory=MEMORY)


def test_nothing_is_imported_before_something_is_asked() -> None:
    code = "import sys, fomas_verify.spectrum.large; print({'numpy', 'scipy', 'qdldl'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"
