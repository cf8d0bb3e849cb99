"""Families against their definitions by neighbourhood."""

from collections.abc import Callable
from fractions import Fraction
from itertools import product

import pytest

from fomas_verify.network import FAMILIES, SHAPED_FAMILIES, GraphError, family, is_strongly_connected, is_symmetric

# hears(i, j, N): whether agent i hears agent j, agents from 1.
DEFINITIONS: dict[str, Callable[[int, int, int], bool]] = {
    "directed-cycle": lambda i, j, n: j == (n if i == 1 else i - 1),
    "cycle": lambda i, j, n: abs(i - j) in {1, n - 1},
    "path": lambda i, j, _: abs(i - j) == 1,
    "star": lambda i, j, _: (i == 1) != (j == 1),
    "complete": lambda i, j, _: i != j,
    "hypercube": lambda i, j, _: bin((i - 1) ^ (j - 1)).count("1") == 1,
}


@pytest.mark.parametrize("agents", [2, 3, 4, 5, 8, 16])
@pytest.mark.parametrize("name", FAMILIES)
def test_who_hears_whom(name: str, agents: int) -> None:
    if name == "hypercube" and agents in {3, 5}:
        with pytest.raises(GraphError, match=f"^expected a power of 2 for a hypercube, got {agents}$"):
            family(name, agents=agents)
        return
    graph = family(name, agents=agents)
    everyone = range(1, agents + 1)
    heard = {(i, j) for i in everyone for j in everyone if DEFINITIONS[name](i, j, agents)}
    assert {(target, source) for source, target, _ in graph.edges} == heard
    assert {weight for *_, weight in graph.edges} == {Fraction(1)}
    assert is_strongly_connected(graph)
    assert is_symmetric(graph) == (name != "directed-cycle" or agents == 2)


@pytest.mark.parametrize(("rows", "columns"), [(3, 3), (3, 4), (5, 3), (1, 4), (2, 2), (4, 1), (2, 3)])
@pytest.mark.parametrize("name", SHAPED_FAMILIES)
def test_lattices_row_by_row(name: str, rows: int, columns: int) -> None:
    if name == "torus" and min(rows, columns) < 3:
        with pytest.raises(GraphError, match=r"^expected at least 3 rows and 3 columns for a torus, got "):
            family(name, shape=(rows, columns))
        return

    def apart(a: int, b: int, size: int) -> int:
        return min((a - b) % size, (b - a) % size) if name == "torus" else abs(a - b)

    cells = list(product(range(rows), range(columns)))
    heard = {
        (p + 1, q + 1)
        for (p, one), (q, two) in product(enumerate(cells), repeat=2)
        if apart(one[0], two[0], rows) + apart(one[1], two[1], columns) == 1
    }
    graph = family(name, shape=(rows, columns))
    assert {(target, source) for source, target, _ in graph.edges} == heard
    assert graph.agents == rows * columns
    assert is_strongly_connected(graph)


@pytest.mark.parametrize(
    ("name", "size", "reason"),
    [
        ("path", {"agents": 1}, "expected at least 2 agents, got 1"),
        ("complete", {"agents": 513}, "expected at most 512 agents in a complete graph, got 513"),
        ("hypercube", {"agents": 0}, "expected at least 2 agents, got 0"),
        ("grid", {"shape": (1, 1)}, "expected at least 1 row, 1 column and 2 agents for a grid, got [1, 1]"),
        ("grid", {"shape": (0, 3)}, "expected at least 1 row, 1 column and 2 agents for a grid, got [0, 3]"),
        ("grid", {"agents": 4}, "expected a family with its agents or its shape, got 'grid' with agents=4, shape=None"),
        ("tree", {"agents": 4}, "expected a family with its agents or its shape, got 'tree' with agents=4, shape=None"),
    ],
)
def test_no_such_graph(name: str, size: dict[str, int], reason: str) -> None:
    with pytest.raises(GraphError) as caught:
        family(name, **size)
    assert str(caught.value) == reason
