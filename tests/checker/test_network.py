"""A network as arrays: degrees, balance, roots and quotients, of small digraphs by hand and by definition."""

import io
import itertools
from array import array
from fractions import Fraction
from typing import Any

import pytest

from fomas_verify.checker import Malformed, edge_list, large_bounds, large_form
from fomas_verify.checker import network as network_module
from fomas_verify.checker.edge_list import read_edge_list
from fomas_verify.checker.network import Network
from tests.checker.large_networks import certificate, checked, design, file_graph
from tests.checker.large_networks import edge_list as text_of

Pairs = list[tuple[int, int]]
RING = b"1 2 1\n2 3 1\n3 1 1\n"


def network(n: int, edges: dict[tuple[int, int], int], denominator: int = 1) -> Network:
    """From edges (from, to) that count from 1."""
    ordered = sorted(edges)
    sources, targets = (array("q", (pair[side] - 1 for pair in ordered)) for side in (0, 1))
    return Network(n, sources, targets, [edges[pair] for pair in ordered], denominator)


def test_degrees_are_what_is_heard() -> None:
    out = network(3, {(1, 2): 1, (1, 3): 2}, 4)
    assert out.degree_max == Fraction(1, 2)
    assert [out.heard(i) for i in (1, 2, 3)] == [0, Fraction(1, 4), Fraction(1, 2)]
    assert [out.spoken(i) for i in (1, 2, 3)] == [Fraction(3, 4), 0, 0]
    into = network(3, {(2, 1): 1, (3, 1): 2}, 4)
    assert into.degree_max == Fraction(3, 4)


@pytest.mark.parametrize("order", list(itertools.permutations((1, 2, 3))), ids=str)
def test_balance_does_not_depend_on_the_numbers_of_the_agents(order: tuple[int, int, int]) -> None:
    a, b, c = order
    ring = {(a, b): 1, (b, c): 1, (c, a): 1}
    assert network(3, ring).satisfies_assumption
    assert not network(3, {**ring, (a, b): 2}).satisfies_assumption
    assert not network(3, {**ring, (a, c): 1}).is_balanced
    assert network(3, {**ring, (a, c): 1, (c, a): 2}).is_balanced
    assert network(3, {(a, b): 1, (b, a): 1}).is_balanced
    assert not network(3, {(a, b): 1, (b, a): 1}).satisfies_assumption


def closure(n: int, pairs: Pairs) -> set[tuple[int, int]]:
    """Who reaches whom, by squaring the relation."""
    found = {(i, i) for i in range(1, n + 1)} | set(pairs)
    while (more := found | {(a, d) for a, b in found for c, d in found if b == c}) != found:
        found = more
    return found


def test_roots_and_reach_of_every_digraph_on_three_agents() -> None:
    everyone = [(i, j) for i in (1, 2, 3) for j in (1, 2, 3) if i != j]
    for size in range(len(everyone) + 1):
        for pairs in itertools.combinations(everyone, size):
            reach, found = closure(3, list(pairs)), network(3, dict.fromkeys(pairs, 1))
            rooted = any(all((i, j) in reach for j in (1, 2, 3)) for i in (1, 2, 3))
            assert found.has_root == rooted, pairs
            for i in (1, 2, 3):
                assert [bool(x) for x in found.reached(i)] == [(i, j) in reach for j in (1, 2, 3)]
            assert found.is_symmetric == all((j, i) in pairs for i, j in pairs)


def test_symmetry_is_that_of_the_weights_too() -> None:
    for weights in itertools.product((1, 2), repeat=6):
        edges = dict(zip([(i, j) for i in (1, 2, 3) for j in (1, 2, 3) if i != j], weights, strict=True))
        assert network(3, edges).is_symmetric == all(edges[j, i] == w for (i, j), w in edges.items())
    assert network(2, {(1, 2): 3, (2, 1): 3}).is_symmetric
    assert not network(2, {(1, 2): 3, (2, 1): 2}).is_symmetric


def test_quotients_are_exact() -> None:
    """L = [[2, -2], [-2, 2]] / 3."""
    pair = network(2, {(1, 2): 2, (2, 1): 2}, 3)
    assert pair.image([1, -1]) == [4, -4]
    assert pair.quotients([[1, -1]]) == (Fraction(4, 3), Fraction(16, 9))
    assert pair.quotients([[1, -1], [0, 0]]) == (Fraction(4, 3), Fraction(16, 9))
    ring = network(3, {(1, 2): 1, (2, 3): 1, (3, 1): 1})
    # both columns add to numerators and denominator: (3 + 3) / (2 + 2), (6 + 6) / (2 + 2)
    assert ring.quotients([[1, -1, 0], [0, 1, -1]]) == (Fraction(3, 2), Fraction(3))


def read(data: bytes, edges: int = 3, agents: int = 3) -> Network:
    digest = file_graph(data)["sha256"]
    return read_edge_list(lambda _: io.BytesIO(data), "graph.edges", digest, edges, agents, "$")


def test_a_list_is_read_to_the_last_byte_that_is_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(edge_list, "MAX_FILE_BYTES", len(RING))
    assert read(RING).weights == [1, 1, 1]
    monkeypatch.setattr(edge_list, "MAX_FILE_BYTES", len(RING) - 1)
    with pytest.raises(Malformed, match="in all, each ended"):
        read(RING)
    monkeypatch.setattr(edge_list, "MAX_FILE_BYTES", 100)
    with pytest.raises(Malformed, match="in all, each ended"):
        read(RING[:-1])


@pytest.mark.parametrize("chunk", range(1, 20))
def test_a_list_is_the_same_in_chunks_of_every_size(chunk: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(edge_list, "_CHUNK", chunk)
    found = read(RING)
    assert (list(found.sources), list(found.targets)) == ([0, 1, 2], [1, 2, 0])


def test_a_line_has_its_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(edge_list, "_CHUNK", 3)
    monkeypatch.setattr(edge_list, "_LINE", 2)
    with pytest.raises(Malformed, match="lines of at most 2 bytes"):
        read(RING)


def test_weights_over_one_denominator() -> None:
    found = read(b"1 2 1/2\n2 3 1/3\n3 1 5\n")
    assert [Fraction(w, found.denominator) for w in found.weights] == [Fraction(1, 2), Fraction(1, 3), 5]


def test_each_weight_is_read_as_a_whole() -> None:
    """Weights that begin or end alike are not the same."""
    found = read(b"1 2 11\n1 3 21\n2 1 3/2\n2 3 1/2\n3 1 3/4\n3 2 12\n", 6)
    weights = [Fraction(w, found.denominator) for w in found.weights]
    assert weights == [11, 21, Fraction(3, 2), Fraction(1, 2), Fraction(3, 4), 12]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"1 2 1\n2 4 1\n3 1 1\n", "line 2: expected two of 3 agents"),
        (b"1 2 1\n2 3 1\n4 1 1\n", "line 3: expected two of 3 agents"),
        (b"1 2 1\n2 2 1\n3 1 1\n", "line 2: expected two of 3 agents"),
        (b"1 2 1\n1 2 1\n3 1 1\n", "line 2: expected two of 3 agents"),
        (b"1 2 1\n2 3 x\n3 1 1\n", "line 2: expected an edge: from to weight"),
        (b"1 2 1\n2 3 1\n3 1 1\n3 2 1\n", "line 4: expected its end"),
        (b"1 2 1\n2 3 2/4\n3 1 1\n", "line 2: expected a weight in lowest terms"),
        (b"1 2 1\n2 3 1\n", "expected 3 edges, got 2"),
    ],
    ids=str,
)
def test_a_line_is_refused_by_its_number(data: bytes, words: str) -> None:
    with pytest.raises(Malformed, match=words):
        read(data)


@pytest.mark.parametrize("bits", [4, 5])
def test_the_denominator_has_its_limit(bits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """15 has four bits, 17 has five."""
    monkeypatch.setattr(edge_list, "MAX_DENOMINATOR_BITS", 4)
    data = b"1 2 1/3\n2 3 1/5\n3 1 1\n" if bits == 4 else b"1 2 1/17\n2 3 1\n3 1 1\n"
    if bits == 4:
        assert read(data).denominator == 15
    else:
        with pytest.raises(Malformed, match="at most 4 bits"):
            read(data)


def test_the_limits_are_those_that_the_format_names() -> None:
    assert (large_form.MAX_AGENTS, large_form.MAX_EDGES, edge_list.MAX_FAMILY_EDGES) == (2**22, 2**24, 2**22)
    assert (edge_list.MAX_FILE_BYTES, edge_list.MAX_DENOMINATOR_BITS) == (2**29, 2**12)
    assert (network_module.MAX_AGENTS, network_module.MAX_EDGES) == (2**22, 2**24)
    assert large_bounds.MAX_STATE_BITS == 2**30


def about(graph: Any, agents: int) -> Any:
    return certificate(design(graph, agents, mu="1/10"))


def test_a_name_of_no_family_is_refused_as_such() -> None:
    for name in ("ring", "Cycle", 3, None):
        with pytest.raises(Malformed, match=r"family: expected one of cycle, path"):
            checked(about({"family": name}, 5))


def test_more_agents_than_a_list_may_have_are_refused_as_such(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large_form, "MAX_AGENTS", 3)
    ring = text_of([(i, i % 3 + 1, Fraction(1)) for i in (1, 2, 3)])
    assert checked(about(file_graph(ring), 3), ring).exit_status == 0
    with pytest.raises(Malformed, match="expected at most 3 agents with an edge list, got 4"):
        checked(about(file_graph(ring), 4), ring)
    with pytest.raises(Malformed, match="expected at most 3 agents with an edge list, got 5"):
        checked(about(file_graph(ring), 5), ring)
